#include "bake/radiosity/texels/texels.h"

#include <algorithm>

#include "bake/jobs/units.h"
#include "bake/radiosity/texels/more_sites.h"
#include "bake/radiosity/texels/seeds.h"
#include "bake/radiosity/texels/texel_part.h"
#include "bake/scene/shade.h"
#include "bake/trace/buried.h"
#include "bake/trace/onlookers.h"
#include "bake/trace/warp.h"

namespace oriel {
namespace {

constexpr std::size_t kRun = 256;      // texels a task
constexpr double kRaysATexel = 32;     // about
constexpr std::uint32_t kColored = 2;  // sites of a half whose albedo is averaged
// Where a texel is partly buried: tried at least and at most, and those not buried that are enough.
constexpr std::uint32_t kManyPoints = 64, kMostPoints = 512, kManySites = 32;
constexpr std::size_t kSparse = 16;        // places of a page for each of its texels: more are not tabulated
constexpr std::uint32_t kFewPoints = 16;   // tried where a texel lies under another body
constexpr std::uint32_t kNearPoints = 32;  // tried where a texel is whole, but something is close to it

class SiteFinder {
 public:
  SiteFinder(const LightmapScene& scene, const TexelUse& use, std::uint64_t seed)
      : scene_(scene),
        t_(scene.transport),
        met_(use.met),
        fewer_(use.fewer),
        onlookers_(scene.transport, use.eyes),
        seed_(seed) {}

  struct Found {
    TexelPart part;  // what a wall leaves of the texel
    std::array<std::vector<TexelSite>, kHalves> many;
  };

  Found find(Texels& texels, std::size_t i, std::uint64_t& rays) const {
    const std::uint64_t stream = stream_of(texels, i);
    std::vector<ShadePoint> shade;
    int buried = 0;
    bool crowded = false;
    for (int k = 0; k < kSites; ++k) {
      const auto turn = static_cast<std::uint32_t>(k % kSitesPerHalf);
      const SurfacePoint surface = candidate(texels, i, k / kSitesPerHalf, turn);
      texels.site[i][k] = site_of(surface);
      buried += is_buried(t_, surface, {seed_, stream, static_cast<std::uint32_t>(k)}, rays);
      crowded = crowded || meets_near(texels, i, k, stream, rays);
      if (met_ && turn < kColored) shade.push_back(shade_at(surface));
    }
    keep_means(shade, texels, i);
    texels.visible[i] = 1;
    Found found{TexelPart(t_, {scene_.atlas, scene_.map[texels.page[i]], texels.index[i]}, onlookers_, rays), {}};
    if (found.part.covered())
      find_unburied(texels, i, kFewPoints, found, rays);
    else if (buried > 0 || !found.part.whole())
      find_unburied(texels, i, kManyPoints, found, rays);
    else if (crowded)
      find_unburied(texels, i, kNearPoints, found, rays);
    return found;
  }

  // Again, with many points: their share, and those that are left.
  void find_unburied(Texels& texels, std::size_t i, std::uint32_t points, Found& found, std::uint64_t& rays) const {
    const std::uint64_t stream = stream_of(texels, i);
    std::vector<ShadePoint> shade;
    const std::uint32_t most = kMostPoints / fewer_, enough_sites = kManySites / fewer_;
    std::uint32_t tried = 0, total = 0;
    bool in_sight = false;
    Onlookers::Nearest eyes;
    // A handful of points that escaped the probes do not make a texel visible, nor do any under another body: somebody
    // who sees one does.
    const auto enough = [&] {
      const bool many = total * 16 >= tried && !found.part.covered();
      return (many || in_sight) && !found.many[0].empty() && !found.many[1].empty();
    };
    for (; tried < points / fewer_ || (tried < most && total < enough_sites && enough()); ++tried) {
      const std::uint32_t k = tried;
      const int half = static_cast<int>(k % kHalves);
      const SurfacePoint surface = candidate(texels, i, half, k / kHalves);
      if (is_buried(t_, surface, {seed_, stream, kSites + k}, rays) ||
          !found.part.holds(surface.triangle, surface.barycentric, rays) ||
          !onlookers_.see(surface, texels.gap_reach(i), {seed_, stream, k}, eyes, rays))
        continue;
      const bool ask = found.part.covered() || (!in_sight && (total + 1) * 16 <= tried);
      const bool seen = ask && onlookers_.any() && sees(surface, eyes, rays);
      if (found.part.covered() && !seen) continue;
      in_sight = in_sight || seen;
      if (met_) shade.push_back(shade_at(surface));
      found.many[half].push_back(site_of(surface));
      ++total;
    }
    texels.visible[i] = enough() ? static_cast<float>(total) / static_cast<float>(tried) : 0.0f;
    keep_means(shade, texels, i);
    if (!enough()) found.many = {};
    for (std::size_t k = 0; enough() && k < kSites; ++k) {
      const auto& many = found.many[k / kSitesPerHalf];
      texels.site[i][k] = many[k % kSitesPerHalf % many.size()];
    }
  }

 private:
  static std::uint64_t stream_of(const Texels& texels, std::size_t i) {
    return std::uint64_t{texels.page[i]} << 32 | texels.index[i];
  }
  SurfacePoint candidate(const Texels& texels, std::size_t i, int half, std::uint32_t k) const {
    return texel_candidate(scene_, texels, {i, half, k}, seed_);
  }
  bool sees(const SurfacePoint& s, Onlookers::Nearest& eyes, std::uint64_t& rays) const {
    return onlookers_.in_sight(spawn_origin(s, s.geometric_normal), s.geometric_normal, eyes, rays);
  }
  ShadePoint shade_at(const SurfacePoint& s) const { return shade_point(t_.accel.scene(), s.triangle, s.barycentric); }
  static void keep_means(std::span<const ShadePoint> points, Texels& texels, std::size_t i) {
    if (points.empty()) return;
    Vec3 albedo(0);
    for (const ShadePoint& point : points) albedo += point.diffuse;
    texels.albedo[i] = albedo / static_cast<float>(points.size());
    texels.diffuse_share[i] = DiffuseShare(points);
  }

  // Whether a ray from a site finds something nearer than a texel's side.
  bool meets_near(const Texels& texels, std::size_t i, int k, std::uint64_t stream, std::uint64_t& rays) const {
    Sampler sampler(seed_ + seeds::kCrowded, stream, static_cast<std::uint32_t>(k));
    const TexelSite& site = texels.site[i][k];
    const Vec3 direction =
        glm::normalize(frame_from_normal(site.geometric_normal) * square_to_cosine_hemisphere(sampler.next2()));
    ++rays;
    return bool(t_.accel.intersect({site.origin, direction, std::sqrt(texels.area_m2[i])}));
  }

  LightmapScene scene_;
  const Transport& t_;
  bool met_;
  std::uint32_t fewer_;
  Onlookers onlookers_;
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

// Their pages and where they lie on these; nothing else of them.
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
  const Placement& where = placement[triangle];
  if (where.page < 0) return {};
  const Vec2 p = where.corner + b.x * where.edge1 + b.y * where.edge2;
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

bool Texels::parts(std::uint32_t triangle, const Vec2& b) const {
  const Placement& place = placement[triangle];
  if (place.page < 0) return false;
  const Vec2 p = place.corner + b.x * place.edge1 + b.y * place.edge2;
  const std::uint32_t texel = at(static_cast<std::uint32_t>(place.page), static_cast<int>(p.x), static_cast<int>(p.y));
  std::uint64_t rays = 0;
  return texel != kNoTexel && is_cut[texel] && !cut.at(texel).holds(triangle, b, rays);
}

std::uint32_t Texels::beside(std::uint32_t texel, const IVec2& step) const {
  const std::uint32_t found = at(page[texel], static_cast<int>(x[texel]) + step.x, static_cast<int>(y[texel]) + step.y);
  return found != kNoTexel && chart[found] == chart[texel] ? found : texel;
}

// The texel across the border next to p, in texels of the page, if it speaks of this side of the wall. The end of a
// board that reaches through a wall is one texel, which has the daylight: no ray indoors may find that.
std::uint32_t Texels::across_wall(std::uint32_t texel, std::uint32_t triangle, const Vec2& barycentric,
                                  const Vec2& p) const {
  const Vec2 off = p - Vec2(x[texel], y[texel]) - 0.5f;
  const bool level = std::abs(off.x) > std::abs(off.y);
  const std::uint32_t found = beside(texel, IVec2(level ? (off.x > 0 ? 1 : -1) : 0, level ? 0 : (off.y > 0 ? 1 : -1)));
  if (found == texel || visible[found] == 0) return kNoTexel;
  std::uint64_t rays = 0;
  const bool speaks = is_cut[found] ? cut.at(found).holds(triangle, barycentric, rays)
                                    : cut.at(texel).is_beside(site[found][0].origin, triangle, barycentric, rays);
  return speaks ? found : kNoTexel;
}

double texel_area_m2(const Scene& scene, const Atlas& atlas, const TexelMapPage& map, std::size_t i) {
  double area = 0;
  for (std::uint32_t f = map.first[i]; f < map.first[i + 1]; ++f) {
    const TexelFragment& fragment = map.fragments[f];
    const auto& uv = atlas.uv[fragment.triangle];
    const DVec2 size(map.width, map.height);
    const DVec2 a = DVec2(uv[1] - uv[0]) * size, b = DVec2(uv[2] - uv[0]) * size;
    const double texels = 0.5 * std::abs(a.x * b.y - a.y * b.x);
    if (texels > 0) area += std::min(1.0, fragment.area / texels) * triangle_area(scene, fragment.triangle);
  }
  return area;
}

Result<Texels> list_texels(const LightmapScene& scene, const Stage& stage, const TexelUse& use) {
  const auto& [t, atlas, texel_map] = scene;
  Texels texels = place_texels(atlas, texel_map);
  texels.eyes.assign(use.eyes.begin(), use.eyes.end());
  const std::size_t n = texels.count();
  texels.site.resize(n), texels.visible.resize(n), texels.area_m2.resize(n), texels.albedo.resize(n),
      texels.diffuse_share.resize(n), texels.has_many.resize(n), texels.is_cut.resize(n);
  place_triangles(atlas, texels);
  const SiteFinder finder(scene, {texels.eyes, use.met, use.fewer}, stage.context.seed);
  using Hidden = std::pair<std::uint32_t, SiteFinder::Found>;
  std::vector<std::vector<Hidden>> hidden((n + kRun - 1) / kRun);
  UnitLoop loop{.stage = "texel points", .count = hidden.size(), .rays = kRun * kRaysATexel};
  loop.inputs = [&](std::size_t run, Archive& key) { key(run, texels.eyes, use.met, use.fewer); };
  loop.compute = [&](std::size_t run) {
    std::uint64_t traced = 0;
    for (std::size_t i = run * kRun; i < std::min(n, (run + 1) * kRun); ++i) {
      texels.area_m2[i] =
          static_cast<float>(texel_area_m2(t.accel.scene(), atlas, texel_map[texels.page[i]], texels.index[i]));
      SiteFinder::Found found = finder.find(texels, i, traced);
      if (texels.visible[i] != 1 || !found.many[0].empty())
        hidden[run].emplace_back(static_cast<std::uint32_t>(i), std::move(found));
    }
    return traced;
  };
  loop.results = [&](std::size_t run, Archive& archive) {
    for (std::size_t i = run * kRun; i < std::min(n, (run + 1) * kRun); ++i)
      archive(texels.site[i], texels.visible[i], texels.area_m2[i], texels.albedo[i], texels.diffuse_share[i]);
    std::uint64_t count = hidden[run].size();
    archive(count);
    while (hidden[run].size() < std::min<std::uint64_t>(count, kRun))
      hidden[run].push_back({0, {TexelPart(t.accel), {}}});
    for (auto& [i, found] : hidden[run]) archive(i, found.part, found.many);
  };
  ORIEL_TRY_VOID(parallel_units(stage, loop));
  for (auto& run : hidden)
    for (auto& [i, found] : run) {
      if (!found.part.whole()) {
        texels.cut.emplace(i, found.part);
        texels.is_cut[i] = true;
      }
      if (found.many[0].empty()) continue;
      texels.has_many[i] = true;
      texels.many_sites.emplace(i, std::move(found.many));
    }
  return texels;
}

}  // namespace oriel
