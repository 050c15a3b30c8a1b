#include "bake/radiosity/seams.h"

#include <algorithm>
#include <bit>

#include "bake/jobs/parallel.h"
#include "bake/scene/box_tree.h"
#include "bake/trace/buried.h"

namespace oriel {
namespace {

constexpr double kTolerance = 0.1;       // texels between edges that count as one
constexpr double kParallel = 0.95;       // cosine between edges
constexpr float kSameNormal = 0.98481f;  // cos 10°: a larger angle shows in the light
constexpr float kSameFace = 0.70711f;    // cos 45°: no chart bends more sharply
constexpr double kPointsPerTexel = 3;    // along a seam
constexpr double kInside = 1e-3;         // texels inwards from the chart's border, so that the texel is the chart's own
constexpr float kLift = 0.1f;            // texels above the surface at which both sides must see each other
constexpr double kSamePlace = 0.01;      // texels: not a seam, the two sides read the same texels
constexpr std::size_t kEdgesATask = 256;  // edges a task

// An edge of a triangle at the rim of its chart, from corner to the next, counter-clockwise.
struct RimEdge {
  std::uint32_t triangle, corner;
  DVec3 a, along;  // along: to its end, not unit
  double length_texels;
  double texel_m;  // side of a texel of its chart

  double length_m() const { return glm::length(along); }
};

std::uint64_t hash_of(std::uint64_t h, const Vec2& uv) {
  h = mix64(h ^ std::bit_cast<std::uint32_t>(uv.x + 0.0f));  // + 0: one zero
  return mix64(h ^ std::bit_cast<std::uint32_t>(uv.y + 0.0f));
}

std::vector<double> chart_texel_m(const Scene& scene, const Atlas& atlas) {
  std::vector<double> world(atlas.chart_count, 0), texels(atlas.chart_count, 0);
  for (std::uint32_t t = 0; t < atlas.page.size(); ++t) {
    if (atlas.page[t] < 0) continue;
    const auto corner = texel_triangle(atlas, t);
    const DVec2 e = corner[1] - corner[0], f = corner[2] - corner[0];
    world[atlas.chart[t]] += triangle_area(scene, t);
    texels[atlas.chart[t]] += 0.5 * std::abs(e.x * f.y - e.y * f.x);
  }
  for (std::size_t c = 0; c < world.size(); ++c) world[c] = texels[c] > 0 ? std::sqrt(world[c] / texels[c]) : 0;
  return world;
}

// Edges that no other triangle of the chart shares on the page.
std::vector<RimEdge> rim_edges(const Scene& scene, const Atlas& atlas) {
  struct Key {
    std::uint64_t hash;
    std::uint32_t triangle, corner;
    bool operator<(const Key& o) const {
      return std::tie(hash, triangle, corner) < std::tie(o.hash, o.triangle, o.corner);
    }
  };
  std::vector<Key> keys;
  for (std::uint32_t t = 0; t < atlas.page.size(); ++t)
    for (std::uint32_t c = 0; c < 3 && atlas.page[t] >= 0; ++c) {
      const Vec2 &a = atlas.uv[t][c], &b = atlas.uv[t][(c + 1) % 3];
      const std::uint64_t chart = mix64(atlas.chart[t]);
      keys.push_back({hash_of(chart, a) + hash_of(chart, b), t, c});
    }
  std::sort(keys.begin(), keys.end());
  const std::vector<double> texel_m = chart_texel_m(scene, atlas);
  std::vector<RimEdge> edges;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const bool shared =
        (i > 0 && keys[i - 1].hash == keys[i].hash) || (i + 1 < keys.size() && keys[i + 1].hash == keys[i].hash);
    const auto [hash, t, c] = keys[i];
    const double size = texel_m[atlas.chart[t]];
    if (shared || !(size > 0)) continue;
    const UVec3& v = scene.triangles[t];
    const auto corner = texel_triangle(atlas, t);
    const DVec3 a(scene.positions[v[c]]), b(scene.positions[v[(c + 1) % 3]]);
    edges.push_back({t, c, a, b - a, glm::distance(corner[c], corner[(c + 1) % 3]), size});
  }
  std::sort(edges.begin(), edges.end(), [](const RimEdge& a, const RimEdge& b) {
    return std::tie(a.triangle, a.corner) < std::tie(b.triangle, b.corner);
  });
  return edges;
}

int point_count(const RimEdge& edge) {
  return std::max(1, static_cast<int>(std::ceil(kPointsPerTexel * edge.length_texels)));
}

BoxTree tree_of(std::span<const RimEdge> edges) {
  std::vector<TreeBox> boxes(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) boxes[i].add(edges[i].a), boxes[i].add(edges[i].a + edges[i].along);
  return BoxTree(boxes);
}

class SeamFinder {
 public:
  SeamFinder(const Transport& t, const Atlas& atlas, std::span<const LightmapPage> pages, std::uint64_t seed)
      : t_(t),
        scene_(t.accel.scene()),
        atlas_(atlas),
        pages_(pages),
        seed_(seed),
        edges_(rim_edges(scene_, atlas)),
        tree_(tree_of(edges_)) {}

  std::size_t edge_count() const { return edges_.size(); }

  // The seams on which edges [first, last) are the finer sides.
  Seams find(std::size_t first, std::size_t last, std::uint64_t& rays) const {
    Seams seams;
    std::vector<Ray> bridges;  // two a point
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pair;
    std::vector<std::uint32_t> near;
    for (std::size_t i = first; i < last; ++i) {
      const int count = point_count(edges_[i]);
      for (int k = 0; k < count; ++k) {
        const Side a = side_of(static_cast<std::uint32_t>(i), (k + 0.5) / count);
        Side b;
        if (!find_other(a, near, b) || !visible(a, i, k, rays) || !visible(b, i, k, rays)) continue;
        seams.points.push_back({{a.page, b.page},
                                {a.place, b.place},
                                static_cast<float>(std::min(1 / kPointsPerTexel, edges_[i].length_texels / count))});
        pair.emplace_back(a.edge, b.edge);
        add_bridge(a, b, bridges);
      }
    }
    std::vector<Vec3> transmittance(bridges.size());
    t_.accel.transmittance(bridges, transmittance);
    rays += bridges.size();
    std::size_t visible_count = 0;
    for (std::size_t k = 0; k < seams.points.size(); ++k) {
      if (!(max_component(transmittance[2 * k] * transmittance[2 * k + 1]) > 0)) continue;
      seams.pairs += visible_count == 0 || pair[visible_count - 1] != pair[k];
      pair[visible_count] = pair[k];
      seams.points[visible_count++] = seams.points[k];
    }
    seams.points.resize(visible_count);
    return seams;
  }

 private:
  // A point of an edge, on its triangle's side.
  struct Side {
    std::uint32_t edge = 0, page = 0;
    double at = 0;  // along the edge, [0,1]
    DVec2 place{0};
    SurfacePoint surface;
  };

  Side side_of(std::uint32_t index, double at) const {
    const RimEdge& edge = edges_[index];
    Side side{index, static_cast<std::uint32_t>(atlas_.page[edge.triangle]), at, DVec2(0), {}};
    DVec3 weight(0);
    const auto c = static_cast<int>(edge.corner), next = (c + 1) % 3;
    weight[c] = 1 - at, weight[next] = at;
    side.surface = point_on_side(scene_, edge.triangle, Vec2(weight.y, weight.z));
    const auto corner = texel_triangle(atlas_, edge.triangle);
    side.place = corner[0] * weight.x + corner[1] * weight.y + corner[2] * weight.z;
    const DVec2 inwards = (corner[0] + corner[1] + corner[2]) / 3.0 - side.place;
    const double length = glm::length(inwards);
    if (length > 0) side.place += inwards * std::min(1.0, kInside / length);
    return side;
  }

  // Finds the nearest edge at which the surface continues, if that edge is the coarser one.
  bool find_other(const Side& a, std::vector<std::uint32_t>& near, Side& best) const {
    const RimEdge& own = edges_[a.edge];
    const DVec3 p = own.a + own.along * a.at;
    const double tolerance = kTolerance * own.texel_m + 4e-7 * a.surface.magnitude;
    double least = 1e300;
    tree_.near({p - tolerance, p + tolerance}, near);
    for (const std::uint32_t i : near) {
      const RimEdge& other = edges_[i];
      if (std::tie(other.texel_m, i) <= std::tie(own.texel_m, a.edge)) continue;
      const double length = other.length_m(), cosine = glm::dot(own.along, other.along);
      if (!(length > 0) || cosine > -kParallel * length * own.length_m()) continue;
      const double at = std::clamp(glm::dot(p - other.a, other.along) / (length * length), 0.0, 1.0);
      const double distance = glm::distance(p, other.a + other.along * at);
      if (distance > tolerance || distance >= least) continue;
      const Side b = side_of(i, at);
      if (!continues(a, b)) continue;
      least = distance, best = b;
    }
    return least < 1e300;
  }

  bool continues(const Side& a, const Side& b) const {
    if (a.page == b.page && glm::distance(a.place, b.place) < kSamePlace) return false;
    return glm::dot(a.surface.normal, b.surface.normal) >= kSameNormal &&
           glm::dot(a.surface.geometric_normal, b.surface.geometric_normal) >= kSameFace;
  }

  bool visible(const Side& s, std::size_t edge, int k, std::uint64_t& rays) const {
    const LightmapPage& page = pages_[s.page];
    const auto x = static_cast<std::uint32_t>(std::clamp(s.place.x, 0.0, page.width - 1.0)),
               y = static_cast<std::uint32_t>(std::clamp(s.place.y, 0.0, page.height - 1.0));
    return page.state[std::size_t{y} * page.width + x] == TexelState::kValid &&
           !is_buried(t_, s.surface, {~seed_, edge, static_cast<std::uint32_t>(k)}, rays);
  }

  // A point of the side's triangle, up to a texel away from its edge.
  Vec3 stepped_in(const Side& s) const {
    const RimEdge& edge = edges_[s.edge];
    const DVec3 apex(scene_.positions[scene_.triangles[edge.triangle][(edge.corner + 2) % 3]]);
    const double length = edge.length_m();
    const double foot = glm::dot(apex - edge.a, edge.along) / (length * length);
    const DVec3 inwards = apex - edge.a - edge.along * foot;
    double share = 1;  // of the way to the apex' height at which the triangle ends
    if (foot > 0) share = std::min(share, s.at / foot);
    if (foot < 1) share = std::min(share, (1 - s.at) / (1 - foot));
    const double height = glm::length(inwards);
    if (height > 0) share = std::min(share, edge.texel_m / height);
    return s.surface.position + Vec3(inwards * share);
  }

  // Adds two segments that meet above the edge, so that a bent surface does not occlude them.
  void add_bridge(const Side& a, const Side& b, std::vector<Ray>& bridges) const {
    const float lift = kLift * static_cast<float>(edges_[a.edge].texel_m);
    const float magnitude = std::max(a.surface.magnitude, b.surface.magnitude);
    const auto above = [&](const Vec3& p, const Vec3& n) { return offset_origin(p, n, magnitude) + lift * n; };
    const Vec3 &na = a.surface.geometric_normal, &nb = b.surface.geometric_normal;
    const Vec3 middle = above(0.5f * (a.surface.position + b.surface.position), glm::normalize(na + nb));
    for (const Vec3& from : {above(stepped_in(a), na), above(stepped_in(b), nb)})
      bridges.push_back({from, normalize_or(middle - from, na), std::sqrt(length2(middle - from))});
  }

  const Transport& t_;
  const Scene& scene_;
  const Atlas& atlas_;
  std::span<const LightmapPage> pages_;
  std::uint64_t seed_;
  std::vector<RimEdge> edges_;
  BoxTree tree_;
};

}  // namespace

Result<Seams> find_seams(const Transport& transport, const Atlas& atlas, std::span<const LightmapPage> pages,
                         const Stage& stage) {
  // Edges take a second for a million triangles: not where it is late already.
  if (stage.context.stopped()) return fail(ErrorCode::kStopped, "seams", "stopped");
  const SeamFinder finder(transport, atlas, pages, stage.context.seed);
  const std::size_t count = finder.edge_count(), runs = (count + kEdgesATask - 1) / kEdgesATask;
  std::vector<Seams> found(runs);
  ORIEL_TRY_VOID(parallel_for(stage, "seams", runs, [&](std::size_t run) {
    std::uint64_t traced = 0;
    found[run] = finder.find(run * kEdgesATask, std::min(count, (run + 1) * kEdgesATask), traced);
    stage.count(traced);
  }));
  Seams seams;
  for (const Seams& part : found) {
    seams.points.insert(seams.points.end(), part.points.begin(), part.points.end());
    seams.pairs += part.pairs;
  }
  return seams;
}

}  // namespace oriel
