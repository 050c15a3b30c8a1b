#include "bake/radiosity/texels/texels.h"

#include <algorithm>

#include "bake/jobs/parallel.h"
#include "bake/jobs/units.h"
#include "bake/radiosity/texels/extra_sample_points.h"
#include "bake/radiosity/texels/nearest.h"
#include "bake/radiosity/texels/seeds.h"
#include "bake/radiosity/texels/texel_part.h"
#include "bake/scene/shade.h"
#include "bake/trace/buried.h"
#include "bake/trace/view_samples.h"
#include "bake/trace/warp.h"

namespace oriel {
namespace {

constexpr std::size_t kRun = 256;      // texels a task
constexpr double kRaysATexel = 32;     // about
constexpr std::uint32_t kColored = 2;  // sample points of a half whose albedo is averaged
// Points of a partly buried texel: tried at least, tried at most, and unburied ones that suffice.
constexpr std::uint32_t kManyPoints = 64, kMostPoints = 512, kEnoughSamplePoints = 32;
constexpr std::size_t kSparse = 16;         // pixels of a page for each of its texels: a sparser page has no table
constexpr std::uint32_t kPointDivisor = 4;  // of these, for points of finer cells: they are small
constexpr std::uint32_t kFewPoints = 16;    // tried where a texel lies under another body
constexpr float kNotFound = -1;             // the visible fraction of a texel whose points were not looked for
constexpr std::size_t kTried = 64;          // one run in so many tells how long all take
constexpr std::size_t kLeastRuns = 8;       // that are finished however late it is: all else shows their light
constexpr std::uint32_t kMostDivided = 8;   // of TexelUse::point_divisor, for want of time
constexpr std::uint32_t kNearPoints = 32;   // tried where a texel is whole, but something is close to it

class SamplePointFinder {
 public:
  SamplePointFinder(const LightmapScene& scene, const TexelUse& use, std::uint64_t seed)
      : scene_(scene),
        t_(scene.transport),
        coarse_(use.coarse),
        divisor_(use.point_divisor * (use.coarse ? kPointDivisor : 1)),
        side_(static_cast<float>(use.side)),
        views_(scene.transport, use.eyes),
        seed_(seed) {}

  struct Found {
    TexelPart part;  // the part that is sampled
    std::array<std::vector<SamplePoint>, kHalves> points;
  };

  Found find(Texels& texels, std::size_t i, std::uint64_t& rays) const {
    return coarse_ ? find_of_point(texels, i, rays) : find_of_texel(texels, i, rays);
  }

 private:
  // The texels around a point know whether a wall divides them, and whether anything is close.
  Found find_of_point(Texels& texels, std::size_t i, std::uint64_t& rays) const {
    Found found{TexelPart(t_.accel), {}};
    texels.visible[i] = 1;
    if (coarse_->open_around(texels.page[i], Vec2(texels.x[i], texels.y[i]) / side_ - 1.0f))
      for (int k = 0; k < kSamplePoints; ++k)
        texels.sample_points[i][k] = sample_point_of(stored_candidate(texels, i, k));
    else
      find_unburied(texels, i, kNearPoints, found, rays);
    return found;
  }

  Found find_of_texel(Texels& texels, std::size_t i, std::uint64_t& rays) const {
    const std::uint64_t stream = stream_of(texels, i);
    std::vector<ShadePoint> shade;
    ReachSum reach;
    int buried = 0;
    bool near_occluder = false;
    for (int k = 0; k < kSamplePoints; ++k) {
      const SurfacePoint surface = stored_candidate(texels, i, k);
      texels.sample_points[i][k] = sample_point_of(surface);
      reach.add(texels.offset(i, surface.triangle, surface.barycentric));
      buried += is_buried(t_, surface, {seed_, stream, static_cast<std::uint32_t>(k)}, rays);
      near_occluder = near_occluder || hits_near_occluder(texels, i, k, stream, rays);
      if (static_cast<std::uint32_t>(k % kSamplePointsPerHalf) < kColored) shade.push_back(shade_at(surface));
    }
    set_means(shade, texels, i);
    texels.visible[i] = 1;
    if (texels.covered[i] < kWholeTexel) texels.reach[i] = reach.mean();
    Found found{TexelPart(t_, {scene_.atlas, scene_.map[texels.page[i]], texels.index[i]}, views_, rays), {}};
    if (found.part.covered())
      find_unburied(texels, i, kFewPoints, found, rays);
    else if (buried > 0 || !found.part.whole())
      find_unburied(texels, i, kManyPoints, found, rays);
    else if (near_occluder)
      find_unburied(texels, i, kNearPoints, found, rays);
    return found;
  }

  // Samples the texel again with many points: sets its visible fraction and keeps the visible points.
  void find_unburied(Texels& texels, std::size_t i, std::uint32_t point_count, Found& found,
                     std::uint64_t& rays) const {
    const std::uint64_t stream = stream_of(texels, i);
    std::vector<ShadePoint> shade;
    ReachSum reach;
    const std::uint32_t most = kMostPoints / divisor_, enough_points = kEnoughSamplePoints / divisor_;
    std::uint32_t tried = 0, total = 0;
    bool in_sight = false;
    texels.meets_gap[i] = found.part.has_lamp();
    ViewSamples::Nearest eyes;
    // A texel is visible if a sixteenth of the points are and no body covers it, or if a view sees one of its points.
    const auto enough = [&] {
      const bool share_is_enough = total * 16 >= tried && !found.part.covered();
      return (share_is_enough || in_sight) && !found.points[0].empty() && !found.points[1].empty();
    };
    for (; tried < point_count / divisor_ || (tried < most && total < enough_points && enough()); ++tried) {
      const std::uint32_t k = tried;
      const int half = static_cast<int>(k % kHalves);
      const SurfacePoint surface = candidate(texels, i, half, k / kHalves);
      if (is_buried(t_, surface, {seed_, stream, kSamplePoints + k}, rays) ||
          !found.part.holds(surface.triangle, surface.barycentric, rays))
        continue;
      if (!views_.sees(surface, texels.gap_reach(i), {seed_, stream, k}, eyes, rays)) {
        texels.meets_gap[i] = true;
        continue;
      }
      const bool needs_view = found.part.covered() || (!in_sight && (total + 1) * 16 <= tried);
      const bool seen = needs_view && views_.any() && sees(surface, eyes, rays);
      if (found.part.covered() && !seen) continue;
      in_sight = in_sight || seen;
      if (!coarse_) shade.push_back(shade_at(surface));
      found.points[half].push_back(sample_point_of(surface));
      reach.add(texels.offset(i, surface.triangle, surface.barycentric));
      ++total;
    }
    texels.visible[i] = enough() ? static_cast<float>(total) / static_cast<float>(tried) : 0.0f;
    set_means(shade, texels, i);
    if (!enough()) found.points = {};
    if (enough() && texels.visible_fraction(i) < kWholeTexel) texels.reach[i] = reach.mean();
    for (std::size_t k = 0; enough() && k < kSamplePoints; ++k) {
      const auto& points = found.points[k / kSamplePointsPerHalf];
      texels.sample_points[i][k] = points[k % kSamplePointsPerHalf % points.size()];
    }
  }

  static std::uint64_t stream_of(const Texels& texels, std::size_t i) {
    return std::uint64_t{texels.page[i]} << 32 | texels.index[i];
  }
  SurfacePoint stored_candidate(const Texels& texels, std::size_t i, int k) const {
    return candidate(texels, i, k / kSamplePointsPerHalf, static_cast<std::uint32_t>(k % kSamplePointsPerHalf));
  }
  SurfacePoint candidate(const Texels& texels, std::size_t i, int half, std::uint32_t k) const {
    return texel_candidate(scene_, texels, {i, half, k}, seed_);
  }
  bool sees(const SurfacePoint& s, ViewSamples::Nearest& eyes, std::uint64_t& rays) const {
    return views_.in_sight(spawn_origin(s, s.geometric_normal), s.geometric_normal, eyes, rays);
  }
  ShadePoint shade_at(const SurfacePoint& s) const { return shade_point(t_.accel.scene(), s.triangle, s.barycentric); }
  static void set_means(std::span<const ShadePoint> points, Texels& texels, std::size_t i) {
    if (points.empty()) return;
    Vec3 albedo(0);
    for (const ShadePoint& point : points) albedo += point.diffuse;
    texels.albedo[i] = albedo / static_cast<float>(points.size());
    texels.diffuse_share[i] = DiffuseShare(points);
  }

  // True if a ray from a sample point meets something within a texel's side.
  bool hits_near_occluder(const Texels& texels, std::size_t i, int k, std::uint64_t stream, std::uint64_t& rays) const {
    Sampler sampler(seed_ + seeds::kOccluderRays, stream, static_cast<std::uint32_t>(k));
    const SamplePoint& point = texels.sample_points[i][k];
    const Vec3 direction =
        glm::normalize(frame_from_normal(point.geometric_normal) * square_to_cosine_hemisphere(sampler.next2()));
    ++rays;
    return bool(t_.accel.intersect({point.origin, direction, std::sqrt(texels.area_m2[i])}));
  }

  LightmapScene scene_;
  const Transport& t_;
  const Texels* coarse_;  // of points of finer cells
  std::uint32_t divisor_;
  float side_;
  ViewSamples views_;
  std::uint64_t seed_;
};

void place_triangles(const Atlas& atlas, Texels& texels) {
  texels.placement.resize(atlas.page.size());
  for (std::uint32_t t = 0; t < atlas.page.size(); ++t) {
    if (atlas.page[t] < 0) continue;
    const auto corners = texel_triangle(atlas, t);
    texels.placement[t] = {Vec2(corners[0]), Vec2(corners[1] - corners[0]), Vec2(corners[2] - corners[0]),
                           atlas.page[t]};
  }
}

// Divides the points of partly hidden texels as the time demands, by what a few runs take.
Status afford_points(const LightmapScene& scene, const Stage& stage, TexelUse& use, Texels& texels) {
  if (!std::isfinite(use.seconds)) return {};
  const SamplePointFinder finder(scene, use, stage.context.seed);
  const std::size_t runs = (texels.count() + kRun - 1) / kRun;
  const std::size_t tried = std::min(runs, runs / kTried + static_cast<std::size_t>(thread_count(stage.context)));
  const ElapsedTime clock;
  ORIEL_TRY_VOID(parallel_for(stage, "", tried, [&](std::size_t k) {
    std::uint64_t traced = 0;
    const std::size_t first = k * runs / tried * kRun;
    for (std::size_t i = first; i < std::min(texels.count(), first + kRun); ++i) finder.find(texels, i, traced);
  }));
  double needed = clock.spent() / static_cast<double>(tried) * static_cast<double>(runs);
  for (; needed > use.seconds && use.point_divisor < kMostDivided; needed /= 2) use.point_divisor *= 2;
  use.seconds -= clock.spent();
  return {};
}

// Leaves out the texels that no run came to.
void leave_out_unfinished(const LightmapScene& scene, std::uint64_t seed, Texels& texels) {
  std::vector<std::uint32_t> unfinished;
  for (std::uint32_t i = 0; i < texels.count(); ++i) {
    if (texels.visible[i] != kNotFound) continue;
    texels.sample_points[i].fill(sample_point_of(texel_candidate(scene, texels, {i, 0, 0}, seed)));
    unfinished.push_back(i);
  }
  leave_out(unfinished, texels);
}

// Fills pages and places of the texels; all else is as long, and empty.
Texels place_texels(const Atlas& atlas, std::span<const TexelMapPage> texel_map) {
  Texels texels;
  for (std::uint32_t p = 0; p < texel_map.size(); ++p) {
    const TexelMapPage& map = texel_map[p];
    const std::size_t places = std::size_t{map.width} * map.height;
    texels.pages.push_back({map.width, map.height, {}, {}, static_cast<std::uint32_t>(texels.page.size())});
    Texels::Page& page = texels.pages.back();
    if (places > kSparse * map.texel.size())
      page.place = map.texel;
    else
      page.number.assign(places, kNoTexel);
    for (std::uint32_t i = 0; i < map.texel.size(); ++i) {
      if (!page.number.empty()) page.number[map.texel[i]] = static_cast<std::uint32_t>(texels.page.size());
      texels.page.push_back(p);
      texels.index.push_back(i);
      texels.covered.push_back(covered_share(map, i));
      texels.x.push_back(map.texel[i] % map.width);
      texels.y.push_back(map.texel[i] / map.width);
      texels.chart.push_back(atlas.chart[map.fragments[map.first[i]].triangle]);
    }
  }
  const std::size_t n = texels.count();
  texels.sample_points.resize(n), texels.visible.resize(n), texels.reach.resize(n), texels.area_m2.resize(n);
  texels.albedo.resize(n), texels.diffuse_share.resize(n), texels.occlusion_heavy.resize(n);
  texels.is_cut.resize(n), texels.meets_gap.resize(n);
  return texels;
}

}  // namespace

std::uint32_t Texels::at(std::uint32_t page_number, int px, int py) const {
  const Page& p = pages[page_number];
  if (px < 0 || py < 0 || px >= static_cast<int>(p.width) || py >= static_cast<int>(p.height)) return kNoTexel;
  const std::size_t place = static_cast<std::size_t>(py) * p.width + static_cast<std::size_t>(px);
  if (!p.number.empty()) return p.number[place];
  const auto found = std::lower_bound(p.place.begin(), p.place.end(), place);
  if (found == p.place.end() || *found != place) return kNoTexel;
  return p.first + static_cast<std::uint32_t>(found - p.place.begin());
}

Texels::Place Texels::place(std::uint32_t triangle, const Vec2& b) const {
  Place found = place_of_own_light(triangle, b);
  if (found.texel != kNoTexel) found.texel = shown_by(found.texel);
  return found;
}

Texels::Place Texels::place_of_own_light(std::uint32_t triangle, const Vec2& b) const {
  const Placement& where = placement[triangle];
  if (where.page < 0) return {};
  const Vec2 p = where.at(b);
  const int px = static_cast<int>(p.x), py = static_cast<int>(p.y);
  const auto page_number = static_cast<std::uint32_t>(where.page);
  if (const std::uint32_t texel = at(page_number, px, py); texel != kNoTexel) {
    std::uint64_t rays = 0;
    if (!is_cut[texel]) return {texel, false, texel};
    const TexelPart& part = cut.at(texel);
    if (part.holds(triangle, b, rays)) return {texel, false, texel};
    if (part.has_lamp()) return {under_lamp(texel), true, texel};
    return {across_wall(texel, triangle, b, p), false, texel};
  }
  // Rounding may put a point on a border just beyond the texels that the border covers.
  for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
    if (const std::uint32_t texel = at(page_number, px + dx, py + dy); texel != kNoTexel) return {texel, false, texel};
  return {};
}

float Texels::texels2_per_m2(const Scene& scene, std::uint32_t triangle) const {
  const Placement& where = placement[triangle];
  const double area = triangle_area(scene, triangle);
  if (where.page < 0 || !(area > 0)) return 0;
  const DVec2 a(where.edge1), b(where.edge2);
  return static_cast<float>(0.5 * std::abs(a.x * b.y - a.y * b.x) / area);
}

bool Texels::open_around(std::uint32_t page_number, const Vec2& at_place) const {
  const IVec2 first(glm::floor(at_place)), last(glm::ceil(at_place));
  for (int py = first.y; py <= last.y; ++py)
    for (int px = first.x; px <= last.x; ++px) {
      const std::uint32_t texel = at(page_number, px, py);
      if (texel == kNoTexel || visible[texel] < 1 || occlusion_heavy[texel] || is_cut[texel]) return false;
    }
  return true;
}

bool Texels::parts(std::uint32_t triangle, const Vec2& b) const {
  const Placement& place = placement[triangle];
  if (place.page < 0) return false;
  const Vec2 p = place.at(b);
  const std::uint32_t texel = at(static_cast<std::uint32_t>(place.page), static_cast<int>(p.x), static_cast<int>(p.y));
  std::uint64_t rays = 0;
  return texel != kNoTexel && is_cut[texel] && !cut.at(texel).holds(triangle, b, rays);
}

std::uint32_t Texels::chart_neighbour(std::uint32_t texel, const IVec2& step) const {
  const std::uint32_t found = at(page[texel], static_cast<int>(x[texel]) + step.x, static_cast<int>(y[texel]) + step.y);
  return found != kNoTexel && chart[found] == chart[texel] ? found : texel;
}

// The texel across the border nearest to p (in texels of the page), if its light is that of p's side of the wall. The
// end of a board that reaches through a wall is one texel with daylight on it: no ray indoors may find that texel.
std::uint32_t Texels::across_wall(std::uint32_t texel, std::uint32_t triangle, const Vec2& barycentric,
                                  const Vec2& p) const {
  const Vec2 off = p - Vec2(x[texel], y[texel]) - 0.5f;
  const bool level = std::abs(off.x) > std::abs(off.y);
  const std::uint32_t found =
      chart_neighbour(texel, IVec2(level ? (off.x > 0 ? 1 : -1) : 0, level ? 0 : (off.y > 0 ? 1 : -1)));
  if (found == texel || visible[found] == 0) return kNoTexel;
  std::uint64_t rays = 0;
  const bool speaks = is_cut[found]
                          ? cut.at(found).holds(triangle, barycentric, rays)
                          : cut.at(texel).is_visible_from(sample_points[found][0].origin, triangle, barycentric, rays);
  return speaks ? found : kNoTexel;
}

Result<Texels> list_texels(const LightmapScene& scene, const Stage& stage, TexelUse use) {
  const auto& [t, atlas, texel_map] = scene;
  Texels texels = place_texels(atlas, texel_map);
  texels.eyes.assign(use.eyes.begin(), use.eyes.end());
  const std::size_t n = texels.count();
  place_triangles(atlas, texels);
  ORIEL_TRY_VOID(afford_points(scene, stage, use, texels));
  texels.visible.assign(n, kNotFound);
  const SamplePointFinder finder(scene, use, stage.context.seed);
  using Hidden = std::pair<std::uint32_t, SamplePointFinder::Found>;
  std::vector<std::vector<Hidden>> hidden((n + kRun - 1) / kRun);
  std::atomic<std::size_t> finished{0};
  UnitLoop loop{.stage = "texel points", .count = hidden.size(), .rays = kRun * kRaysATexel};
  loop.inputs = [&](std::size_t run, Archive& key) {
    key(run, texels.eyes, use.coarse != nullptr, use.side, use.point_divisor);
  };
  loop.compute = [&](std::size_t run) {
    std::uint64_t traced = 0;
    for (std::size_t i = run * kRun; i < std::min(n, (run + 1) * kRun); ++i) {
      texels.area_m2[i] =
          static_cast<float>(texel_area_m2(t.accel.scene(), atlas, texel_map[texels.page[i]], texels.index[i]));
      SamplePointFinder::Found found = finder.find(texels, i, traced);
      if (texels.visible[i] != 1 || !found.points[0].empty())
        hidden[run].emplace_back(static_cast<std::uint32_t>(i), std::move(found));
    }
    ++finished;
    return traced;
  };
  loop.results = [&](std::size_t run, Archive& archive) {
    for (std::size_t i = run * kRun; i < std::min(n, (run + 1) * kRun); ++i)
      archive(texels.sample_points[i], texels.visible[i], texels.reach[i], texels.area_m2[i], texels.albedo[i],
              texels.diffuse_share[i], texels.meets_gap[i]);
    std::uint64_t count = hidden[run].size();
    archive(count);
    while (hidden[run].size() > count) hidden[run].pop_back();
    while (hidden[run].size() < std::min<std::uint64_t>(count, kRun))
      hidden[run].push_back({0, {TexelPart(t.accel), {}}});
    for (auto& [i, found] : hidden[run]) {
      archive(i, found.part, found.points);
      archive.require(i < n && i / kRun == run);
    }
  };
  const ElapsedTime clock;
  const auto late = [&] { return finished >= kLeastRuns && clock.spent() > use.seconds; };
  ORIEL_TRY_VOID(done_in_time(stage.context, std::isfinite(use.seconds) ? late : std::function<bool()>(),
                              [&] { return parallel_units(stage, loop); }));
  leave_out_unfinished(scene, stage.context.seed, texels);
  for (auto& run : hidden)
    for (auto& [i, found] : run) {
      if (!found.part.whole()) {
        texels.cut.emplace(i, found.part);
        texels.is_cut[i] = true;
      }
      if (found.points[0].empty()) continue;
      texels.occlusion_heavy[i] = true;
      texels.extra_points.emplace(i, std::move(found.points));
    }
  return texels;
}

}  // namespace oriel
