#include "bake/transfer/bright_lights.h"

#include <algorithm>

#include "bake/jobs/units.h"
#include "bake/trace/sampler.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kMaxTriangles = 64;  // of a polygon
constexpr std::size_t kTried = 12;         // lights of a point that get shadow rays
constexpr float kLeastShare = 0.01f;       // of the strongest light's irradiance: below it none is bright
constexpr std::uint32_t kShadowRays = 16;

}  // namespace

BrightLights::BrightLights(const Accel& accel, const LightSet& lights)
    : accel_(accel), lights_(lights), polygons_(find_polygon_lights(accel.scene())) {
  const Scene& scene = accel.scene();
  if (!polygons_.empty()) of_triangle_.assign(scene.triangles.size(), ~0u);
  for (std::uint32_t i = 0; i < polygons_.size(); ++i) {
    if (polygons_[i].triangles.size() > kMaxTriangles) continue;
    candidates_.push_back({&polygons_[i], 0});
    for (const std::uint32_t t : polygons_[i].triangles) of_triangle_[t] = i;
  }
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i)
    if (scene.lights[i].profile < 0 && luminance(scene.lights[i].intensity) > 0) candidates_.push_back({nullptr, i});
  set_list(std::vector<double>(candidates_.size()));
}

float BrightLights::unshadowed(const Candidate& candidate, const Vec3& p) const {
  if (candidate.polygon) {
    const Vec3 towards = normalize_or(candidate.polygon->center - p, -candidate.polygon->normal);
    return luminance(candidate.polygon->radiance) * polygon_irradiance(*candidate.polygon, {p, towards, towards});
  }
  return luminance(lights_.sample_light(candidate.light, p, Vec2(0.5f)).estimate);
}

float BrightLights::visibility(const Candidate& candidate, const Vec3& p, std::uint64_t stream) const {
  const Vec3 towards =
      candidate.polygon ? normalize_or(candidate.polygon->center - p, -candidate.polygon->normal) : Vec3(0);
  float passed = 0;
  for (std::uint32_t s = 0; s < kShadowRays; ++s) {
    Sampler sampler(seed_, stream, s);
    const Vec2 u = sampler.next2();
    if (candidate.polygon) {
      const auto sample = sample_polygon(*candidate.polygon, {p, towards, towards}, u);
      if (sample) passed += luminance(accel_.transmittance({p, sample->direction, sample->distance}));
    } else {
      const LightSample sample = lights_.sample_light(candidate.light, p, u);
      passed += luminance(accel_.transmittance({p, sample.direction, sample.distance}));
    }
  }
  return passed / kShadowRays;
}

std::vector<BrightLights::Shine> BrightLights::rank(const Vec3& p, std::uint64_t stream) const {
  std::vector<Shine> shines;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    if (const float lux = unshadowed(candidates_[c], p); lux > 0 && std::isfinite(lux))
      shines.push_back({c, lux, false});
  }
  const auto stronger = [](const Shine& a, const Shine& b) {
    return a.lux != b.lux ? a.lux > b.lux : a.candidate < b.candidate;
  };
  std::sort(shines.begin(), shines.end(), stronger);
  shines.resize(std::min(shines.size(), kTried));
  for (Shine& shine : shines) {
    shine.lux *= visibility(candidates_[shine.candidate], p, mix64(stream) + shine.candidate);
    shine.hidden = shine.lux <= 0;
  }
  std::sort(shines.begin(), shines.end(), stronger);
  return shines;
}

Status BrightLights::choose(std::span<const Vec3> points, int strongest, const std::function<bool()>& enough,
                            Context& context) {
  seed_ = context.seed;
  strongest_ = strongest;
  std::vector<double> lux(candidates_.size());
  if (strongest > 0 && !candidates_.empty()) {
    ranked_.assign(points.size(), {});
    UnitLoop loop{.stage = "bright lights", .count = points.size()};
    loop.rays = static_cast<double>(kShadowRays * candidates_.size());
    loop.inputs = [&](std::size_t i, Archive& key) { key(i, points[i]); };
    loop.compute = [&](std::size_t i) {
      ranked_[i] = rank(points[i], i);
      return 0;
    };
    loop.results = [&](std::size_t i, Archive& archive) { archive(ranked_[i]); };
    ORIEL_TRY_VOID(done_in_time(context, enough, [&] { return parallel_units(context, loop); }));
    for (const std::vector<Shine>& shines : ranked_)
      for (std::size_t i = 0; i < std::min(shines.size(), static_cast<std::size_t>(strongest)); ++i)
        if (shines[i].lux > kLeastShare * shines[0].lux) lux[shines[i].candidate] += shines[i].lux;
  }
  set_list(lux);
  return {};
}

std::size_t BrightLights::choose_all() {
  set_list(std::vector<double>(candidates_.size(), 1));
  return candidates_.size();
}

// Those with the most light, in the order of the scene.
void BrightLights::set_list(const std::vector<double>& lux) {
  listed_.clear();
  for (std::size_t c = 0; c < lux.size(); ++c)
    if (lux[c] > 0) listed_.push_back(c);
  std::sort(listed_.begin(), listed_.end(),
            [&](std::size_t a, std::size_t b) { return lux[a] != lux[b] ? lux[a] > lux[b] : a < b; });
  listed_.resize(std::min(listed_.size(), kMaxBrightLights));
  std::sort(listed_.begin(), listed_.end());
  const Scene& scene = accel_.scene();
  place_.assign(candidates_.size(), -1);
  of_light_.assign(scene.lights.size(), -1);
  for (std::size_t i = 0; i < listed_.size(); ++i) {
    const Candidate& candidate = candidates_[listed_[i]];
    place_[listed_[i]] = static_cast<std::int16_t>(i);
    if (!candidate.polygon) of_light_[candidate.light] = static_cast<std::int16_t>(i);
  }
}

std::vector<BrightLight> BrightLights::list() const {
  const Scene& scene = accel_.scene();
  std::vector<BrightLight> list;
  for (const std::size_t c : listed_) {
    BrightLight light;
    if (const PolygonLight* polygon = candidates_[c].polygon) {
      light.name = scene.surfaces[scene.triangle_surface[polygon->triangles[0]]].name;
      light.kind = BrightLightKind::kPolygon;
      light.intensity = polygon->radiance;
      light.two_sided = polygon->double_sided;
      light.direction = polygon->normal;
      for (const auto& triangle : polygon->corners)
        light.corners.insert(light.corners.end(), triangle.begin(), triangle.end());
    } else {
      const Light& from = scene.lights[candidates_[c].light];
      light.name = from.name;
      light.kind = from.type == LightType::kPoint  ? BrightLightKind::kPoint
                   : from.type == LightType::kSpot ? BrightLightKind::kSpot
                                                   : BrightLightKind::kDirectional;
      light.intensity = from.intensity;
      light.position = from.position;
      light.direction = from.direction;
      light.inner_cone_rad = from.inner_cone_rad;
      light.outer_cone_rad = from.outer_cone_rad;
      light.angular_radius_rad = from.angular_radius_rad;
    }
    list.push_back(std::move(light));
  }
  return list;
}

const PolygonLight* BrightLights::of_triangle(std::uint32_t triangle) const {
  const std::uint32_t polygon = of_triangle_.empty() ? ~0u : of_triangle_[triangle];
  return polygon == ~0u ? nullptr : &polygons_[polygon];
}

LightsAt BrightLights::at(const Vec3& p, std::uint64_t stream) const {
  LightsAt out;
  for (std::size_t i = 0; i < listed_.size(); ++i) out.kept |= std::uint64_t{1} << i;
  int left = strongest_;
  float strongest = 0;
  const bool known = stream < ranked_.size() && !ranked_[stream].empty();
  for (const Shine& shine : known ? ranked_[stream] : rank(p, stream)) {
    strongest = std::max(strongest, shine.lux);
    const int place = place_[shine.candidate];
    const bool bright = place >= 0 && left > 0 && shine.lux > kLeastShare * strongest;
    if (bright) {
      out.bright |= std::uint64_t{1} << place;
      --left;
    }
    if (place >= 0 && (bright || shine.hidden)) out.kept &= ~(std::uint64_t{1} << place);
    if (const PolygonLight* polygon = candidates_[shine.candidate].polygon) {
      out.unrayed.push_back(polygon);
      if (!bright && !shine.hidden) out.sampled.push_back(polygon);
    }
  }
  return out;
}

}  // namespace oriel
