#include "formats/query/emitter_views.h"

#include <array>
#include <optional>

#include "formats/core/color.h"
#include "formats/core/low_discrepancy.h"
#include "formats/core/parallel.h"
#include "formats/query/clipped_polygon.h"

namespace oriel {
namespace {

constexpr std::uint32_t kRaysToPolygon = 32, kFirstRaysToPolygon = 8;  // to a polygon; the first alone where they agree
constexpr float kOnEdge = 0.05f;  // cells by which a node may lie beside a triangle

// Over a plane, as a point of it sees the polygon: twice Lambert's vector, steradians times cosine.
Vec3 vector_of(const Emitter& emitter, const Vec3& point, const Vec3& normal) {
  ClippedPolygon polygon;
  for (const Vec3& corner : emitter.corners) polygon.v[polygon.count++] = corner - point;
  return polygon_vector(clip(polygon, normal));
}

// Which nodes lie on the reflector's triangles, glass or not.
std::vector<bool> covered_nodes(const Reflector& r, const Mesh& mesh, std::uint32_t x, std::uint32_t y) {
  std::vector<bool> covered(std::size_t{x} * y);
  const Vec2 last(x - 1, y - 1), cells = last / glm::max(r.upper - r.lower, Vec2(1e-30f));
  for (std::size_t i = 0; i + 2 < r.indices.size(); i += 3) {
    std::array<Vec2, 3> c;  // in cells
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = (Vec2(reflector_from_pack(r, mesh.positions[r.indices[i + k]])) - r.lower) * cells;
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; };
    const float area = cross(c[1] - c[0], c[2] - c[0]);
    const Vec2 lower = glm::max(glm::ceil(glm::min(glm::min(c[0], c[1]), c[2]) - kOnEdge), Vec2(0));
    const Vec2 upper = glm::min(glm::floor(glm::max(glm::max(c[0], c[1]), c[2]) + kOnEdge), last);
    for (float j = lower.y; j <= upper.y; ++j)
      for (float k = lower.x; k <= upper.x; ++k) {
        bool inside = area != 0;
        for (std::size_t e = 0; e < 3 && inside; ++e) {
          const Vec2 edge = c[(e + 1) % 3] - c[e];
          inside = cross(edge, Vec2(k, j) - c[e]) * (area < 0 ? -1.0f : 1.0f) >= -kOnEdge * glm::length(edge);
        }
        if (inside) covered[static_cast<std::size_t>(j) * x + static_cast<std::size_t>(k)] = true;
      }
  }
  return covered;
}

// What a point or spot sends towards the node over what its square has, [0, 1].
float fade(const LiveLight& light, const Emitter& square, const Vec3& node) {
  const Vec3 to = light.position - node;
  const float distance2 = length2(to);
  if (!(distance2 > 0)) return 0;
  const Vec3 towards = to / std::sqrt(distance2), front = front_of(square);
  const float sends = luminance(unshadowed(light, node, towards)) * distance2;
  const float area = glm::length(front);  // of a parallelogram
  const float shows = luminance(square.radiance) * -glm::dot(front, towards);
  return area > 0 && shows > 0 ? std::clamp(sends / shows, 0.0f, 1.0f) : 0.0f;
}

class Viewer {
 public:
  Viewer(const EmitterQuestion& question, const LampScene& scene, const MoverPose& pose)
      : question_(question), scene_(scene), lamp_from_pack_(glm::inverse(pack_from_object(pose))) {}

  std::optional<EmitterView> view(std::uint32_t index) const {
    const Reflector& r = question_.reflectors[index];
    const double alpha = question_.alphas[index];
    EmitterView view{index, 0, 0, {}, {}};
    const Vec3 normal(r.pack_from_reflector[2]), at(r.pack_from_reflector[3]);
    for (std::uint32_t p = 0; p < question_.lamp.size(); ++p)
      if ((question_.of[p] < 0 ? alpha > 0 : question_.of[p] == index) && is_over(question_.lamp[p], at, normal))
        view.polygons.push_back(p);
    if (view.polygons.empty()) return std::nullopt;
    const Vec2 size = r.upper - r.lower;
    const bool has_nodes = r.visibility_x >= 2 && r.visibility_y >= 2;
    view.x = has_nodes ? r.visibility_x : nodes_along(size.x, kNodeDistance_m, kMostNodesAlong);
    view.y = has_nodes ? r.visibility_y : nodes_along(size.y, kNodeDistance_m, kMostNodesAlong);
    const ReflectorNodes nodes = lay_out_nodes(r, view.x, view.y);
    const std::vector<bool> covered = covered_nodes(r, scene_.mesh(), view.x, view.y);
    Worth worth;
    std::vector<std::uint32_t> over;
    std::swap(over, view.polygons);
    for (const std::uint32_t p : over) {
      std::vector<float> shares = seen_from(nodes, normal, p);
      if (std::ranges::all_of(shares, [](float share) { return share == 0; })) continue;  // its back
      view.polygons.push_back(p);
      worth.add(question_.lamp[p], nodes, normal, {shares, covered, alpha});
      fill_uncovered(nodes, covered, shares);
      for (const float share : shares)
        view.visibility.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(share, 0.0f, 1.0f))));
    }
    const double most = r.map_count == 0 ? kMostPartedOfGeometry : kMostParted;
    if (!(worth.light > 0) || (alpha > 0 && worth.parted > most * worth.light)) return std::nullopt;
    return view;
  }

 private:
  struct Seen {
    const std::vector<float>& shares;
    const std::vector<bool>& covered;
    double alpha = 0;
  };
  // Of the lamp's light on the reflector.
  struct Worth {
    double light = 0, parted = 0;
    void add(const Emitter& polygon, const ReflectorNodes& nodes, const Vec3& normal, const Seen& seen) {
      for (std::size_t i = 0; i < nodes.points.size(); ++i) {
        if (!seen.covered[i]) continue;
        const Vec3 vector = vector_of(polygon, nodes.points[i], normal);
        double here = -glm::dot(vector, normal);  // negative where its back is seen
        if (polygon.two_sided) here = std::abs(here);
        if (!(here > 0)) continue;
        here *= luminance(polygon.radiance);
        light += seen.shares[i] * here;
        parted += oriel::parted(seen.shares[i], glm::length(vector), seen.alpha) * here;
      }
    }
  };

  static bool is_over(const Emitter& emitter, const Vec3& at, const Vec3& normal) {
    return std::ranges::any_of(emitter.corners, [&](const Vec3& c) { return glm::dot(c - at, normal) > 0; });
  }

  // The share of the polygon's points over the plane that the node sees.
  float share(const Vec3& node, const Vec3& normal, const Emitter& polygon, std::uint32_t row) const {
    if (!polygon.two_sided && glm::dot(node - polygon.corners[0], front_of(polygon)) <= 0) return 0;
    LampScene::Blockers last;
    std::uint32_t over = 0, seen = 0;
    for (std::uint32_t i = 0; i < kRaysToPolygon; ++i) {
      if (i == kFirstRaysToPolygon && (seen == 0 || seen == over)) break;
      const Vec3 to = point_of(polygon, shifted_r2(i, row));
      if (!(glm::dot(to - node, normal) > 0)) continue;
      ++over;
      if (scene_.sees(node, to, lamp_from_pack_, last)) ++seen;
    }
    return over > 0 ? static_cast<float>(seen) / static_cast<float>(over) : 0.0f;
  }

  std::vector<float> seen_from(const ReflectorNodes& nodes, const Vec3& normal, std::uint32_t polygon) const {
    std::vector<float> shares;
    const auto first = static_cast<std::uint32_t>(polygon * nodes.points.size());
    const Emitter& emitter = question_.lamp[polygon];
    for (std::uint32_t i = 0; i < nodes.points.size(); ++i) {
      shares.push_back(share(nodes.points[i], normal, emitter, first + i));
      if (question_.of[polygon] >= 0) shares.back() *= fade(question_.points[polygon], emitter, nodes.points[i]);
    }
    return shares;
  }

  const EmitterQuestion& question_;
  const LampScene& scene_;
  Mat4 lamp_from_pack_;
};

}  // namespace

Vec3 point_of(const Emitter& polygon, Vec2 u) {
  const auto& c = polygon.corners;
  std::size_t second = 1;
  if (c.size() == 4) {  // the two triangles of the quadrangle by their areas
    const float a = glm::length(glm::cross(c[1] - c[0], c[2] - c[0])),
                b = glm::length(glm::cross(c[2] - c[0], c[3] - c[0]));
    const float first = a / std::max(a + b, 1e-30f);
    if (u.x >= first) second = 2;
    u.x = std::clamp(second == 1 ? u.x / first : (u.x - first) / (1 - first), 0.0f, 1.0f);
  }
  // Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
  const Vec2 t = u.y > u.x ? Vec2(0.5f * u.x, u.y - 0.5f * u.x) : Vec2(u.x - 0.5f * u.y, 0.5f * u.y);
  return c[0] + t.x * (c[second] - c[0]) + t.y * (c[second + 1] - c[0]);
}

double parted(double seen, double lamp_sr, double alpha) {
  // Of the mirror direction at normal incidence: one over the lobe's density there, D / 4 = 1 / (4 π α²).
  const double lobe_sr = 4 * double{kPi} * alpha * alpha;
  return lamp_sr > 0 ? 2 * seen * (1 - seen) * lamp_sr / (lamp_sr + lobe_sr) : 0.0;
}

std::vector<EmitterView> emitter_views(const EmitterQuestion& question, const LampScene& scene, const MoverPose& pose,
                                       const std::atomic<bool>* stop) {
  const Viewer viewer(question, scene, pose);
  std::vector<std::optional<EmitterView>> found(question.reflectors.size());
  for_each_parallel(found.size(), core_count(), [&](std::size_t r) {
    if (stop == nullptr || !*stop) found[r] = viewer.view(static_cast<std::uint32_t>(r));
  });
  std::vector<EmitterView> views;
  for (std::optional<EmitterView>& view : found)
    if (view) views.push_back(std::move(*view));
  return views;
}

}  // namespace oriel
