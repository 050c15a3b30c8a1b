#include "preview/frame/lamps.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "bake/jobs/parallel.h"
#include "bake/scene/shade.h"
#include "bake/scene/sky.h"
#include "bake/trace/punctual.h"
#include "bake/trace/rounded.h"
#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"
#include "preview/frame/streams.h"

namespace oriel {
namespace {

constexpr std::uint32_t kSky = ~0u;
// How far points are off their lamp, in radii of the scene: the lamp's own triangles then lie behind them. A place
// without size is moved as far aside, so that no edge lies exactly in a plane with eye and light.
constexpr float kOff = 1e-5f;
constexpr double kByPower = 0.1;                                                   // of points
constexpr std::size_t kCellsAcross = 16, kSkyCells = kCellsAcross * kCellsAcross;  // of the sky, that shares tell apart

// A point of one of the parts of the unit square.
Vec2 in_part(std::size_t part, const Vec2& on) {
  const auto x = static_cast<float>(part % kCellsAcross), y = static_cast<float>(part / kCellsAcross);
  return (Vec2(x, y) + on) / float{kCellsAcross};
}

// Of parts by their shares; share: how much less often than of all alike it is drawn there.
Vec2 drawn_by(std::span<const double> cdf, const Vec2& on, float& share) {
  const double at = double{on.x} * cdf.back();
  const auto found = std::upper_bound(cdf.begin(), cdf.end(), at) - cdf.begin();
  const std::size_t part = std::min(static_cast<std::size_t>(found), cdf.size() - 1);
  const double before = part > 0 ? cdf[part - 1] : 0, own = cdf[part] - before;
  share = static_cast<float>(cdf.back() / (own * static_cast<double>(cdf.size())));
  return in_part(part, Vec2(std::clamp(static_cast<float>((at - before) / own), 0.0f, 0x1.fffffep-1f), on.y));
}

bool shines(const SceneMaterial& material) {
  return !material.unlit && max_component(material.emission) > 0;
}

}  // namespace

std::optional<Shone> shine(const LampPoint& lamp, const EyePoint& at, const Scene& scene) {
  Shone out{{at.origin, Vec3(lamp.place)}, lamp.power};
  float d2 = 1;
  if (lamp.kind != LampKind::kAfar) {
    const Vec3 to = Vec3(lamp.place) - at.origin;
    d2 = std::max(length2(to), 1e-30f);
    const float distance = std::sqrt(d2);
    out.ray = {at.origin, to / distance, distance};
  }
  const Vec3 direction = out.ray.direction;
  const bool flat = lamp.kind == LampKind::kFlat;
  float share = incidence(at.at, direction, !flat) / (d2 + lamp.soft);
  if (flat) share *= -glm::dot(lamp.normal, direction);
  if (!(share > 0)) return std::nullopt;
  if (lamp.light != ~0u) out.light = lamp.share * punctual_intensity(scene, scene.lights[lamp.light], -direction);
  out.light *= share;
  out.ray = leaving(at.at, out.ray);
  return out;
}

Lamps::Lamps(const Scene& scene) : scene_(&scene) {
  const auto add = [&](const Near& near, double lumens) {
    if (!(lumens > 0) || !std::isfinite(lumens)) return;
    near_.push_back(near);
    near_cdf_.push_back((near_cdf_.empty() ? 0 : near_cdf_.back()) + lumens);
  };
  for (const Surface& surface : scene.surfaces) {
    const SceneMaterial& material = scene.materials[surface.material];
    if (!shines(material)) continue;
    ++count_;
    for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t) {
      const double lumens = kPiD * triangle_area(scene, t) * luminance(DVec3(mean_emission(scene, t)));
      add({false, t, false}, lumens);
      if (material.double_sided) add({false, t, true}, lumens);
    }
  }
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    ++count_;
    if (light.type != LightType::kDirectional)
      add({true, i, false}, luminance(punctual_power(scene, light)));
    else if (luminance(light.intensity) > 0)
      afar_.push_back(i);
  }
  if (luminance(scene.sky) > 0) afar_.push_back(kSky), ++count_;
  if (!scene.sky_image.texels.empty()) sky_ = SkySampler(scene.sky_image);
}

LampPoint Lamps::point_of(std::size_t i, const Vec2& on) const {
  const float off = kOff * scene_->radius();
  LampPoint point;
  if (near_[i].punctual) {
    const Light& light = scene_->lights[near_[i].index];
    point.kind = LampKind::kPunctual;
    point.place = Vec4(light.position + off * square_to_sphere(on), 1);
    point.normal = light.direction;
    point.power = light.profile >= 0 ? light.color : light.intensity;
    point.light = near_[i].index;
    point.lamp = static_cast<std::uint32_t>(scene_->surfaces.size()) + point.light;
    return point;
  }
  const std::uint32_t t = near_[i].index;
  const Vec2 barycentric = square_to_triangle(on);
  point.lamp = scene_->triangle_surface[t];
  point.normal = geometric_normal(*scene_, t) * (near_[i].back ? -1.0f : 1.0f);
  point.place = Vec4(point_on(*scene_, t, barycentric) + off * point.normal, 1);
  point.power = static_cast<float>(triangle_area(*scene_, t)) * shade_point(*scene_, t, barycentric).emission;
  return point;
}

// at: [0,1) of the shares. The point stands for 1 / count of all light.
LampPoint Lamps::near_point(double at, const Vec2& on, float count, std::span<const double> cdf) const {
  const auto found = std::upper_bound(cdf.begin(), cdf.end(), at * cdf.back()) - cdf.begin();
  const std::size_t i = std::min(static_cast<std::size_t>(found), near_.size() - 1);
  LampPoint point = point_of(i, on);
  point.share = static_cast<float>(cdf.back() / (cdf[i] - (i > 0 ? cdf[i - 1] : 0))) / count;
  point.power *= point.share;
  return point;
}

LampPoint Lamps::sky_point(const Vec2& on, float count) const {
  LampPoint point;
  point.kind = LampKind::kAfar;
  if (sky_.empty()) {
    point.place = Vec4(square_to_sphere(on), 0);
    point.power = scene_->sky * (4 * kPi / count);
    return point;
  }
  const SkySampler::Sample sample = sky_.sample(on);
  point.place = Vec4(sample.direction, 0);
  if (sample.pdf > 0) point.power = sky_radiance(*scene_, sample.direction) / (sample.pdf * count);
  return point;
}

LampPoint Lamps::afar_point(std::size_t k, const Vec2& on, float count) const {
  if (afar_[k] == kSky) return sky_point(on, count);
  const Light& sun = scene_->lights[afar_[k]];
  const float angle = std::max(sun.angular_radius_rad, kOff);
  LampPoint point;
  point.kind = LampKind::kAfar;
  point.place = Vec4(sample_cone(-sun.direction, angle, on), 0);
  point.power = sun.intensity * (2 / (1 + std::cos(angle)) / count);
  point.lamp = static_cast<std::uint32_t>(scene_->surfaces.size()) + afar_[k];
  return point;
}

LampShares Lamps::by_power() const {
  LampShares shares{
      near_cdf_, std::vector<double>(kinds(), 1.0 / std::max<double>(1, static_cast<double>(kinds()))), {}};
  for (std::size_t i = 0; i < kSkyCells; ++i) shares.sky_cdf.push_back(static_cast<double>(i + 1));
  return shares;
}

template <typename Point>
double Lamps::given(const Point& point_of_eye, std::span<const EyePoint> eye, const Accel& accel) const {
  std::vector<Ray> rays;
  std::vector<double> light;
  for (std::size_t k = 0; k < eye.size(); ++k) {
    const auto shone = shine(point_of_eye(static_cast<std::uint32_t>(k)), eye[k], *scene_);
    if (!shone) continue;
    rays.push_back(shone->ray);
    light.push_back(double{luminance(shone->light)});
  }
  std::vector<Vec3> passed(rays.size());
  accel.transmittance(rays, passed);
  double sum = 0;
  for (std::size_t k = 0; k < rays.size(); ++k) sum += light[k] * double{luminance(passed[k])};
  return sum;
}

Result<LampShares> Lamps::by_eye(std::span<const EyePoint> eye, const Accel& accel, Context& context) const {
  LampShares shares = by_power();
  if (kinds() == 0 || eye.empty()) return shares;
  const bool sky = !afar_.empty() && afar_.back() == kSky;
  const std::size_t lamps = near_.size() + afar_.size() - (sky ? 1 : 0);
  std::vector<double> gives(lamps + (sky ? kSkyCells : 0));
  ORIEL_TRY_VOID(parallel_for(context, "", gives.size(), [&](std::size_t i) {
    const auto point = [&](std::uint32_t k) {
      Sampler sampler(context.seed, kShareStream + i, k);
      const Vec2 on = sampler.next2();
      if (i < near_.size()) return point_of(i, on);
      return i < lamps ? afar_point(i - near_.size(), on, 1) : sky_point(in_part(i - lamps, on), kSkyCells);
    };
    gives[i] = given(point, eye, accel);
  }));
  // cdf: of a tenth by what it was before.
  const auto share = [](std::span<const double> given, std::vector<double>& cdf) {
    const double all = std::accumulate(given.begin(), given.end(), 0.0);
    double run = 0, last = 0;
    const double before = cdf.back();
    for (std::size_t i = 0; i < given.size() && all > 0; ++i) {
      const double part = (cdf[i] - std::exchange(last, cdf[i])) / before;
      cdf[i] = run += kByPower * part + (1 - kByPower) * given[i] / all;
    }
    return all;
  };
  // What gives more varies more over the frame: kinds get points by the root of it.
  const std::span<const double> all(gives);
  std::vector<double> roots;
  if (!near_.empty()) roots.push_back(std::sqrt(share(all.first(near_.size()), shares.near_cdf)));
  for (std::size_t i = near_.size(); i < lamps; ++i) roots.push_back(std::sqrt(gives[i]));
  if (sky) roots.push_back(std::sqrt(share(all.subspan(lamps), shares.sky_cdf)));
  const double sum = std::accumulate(roots.begin(), roots.end(), 0.0);
  for (std::size_t k = 0; k < roots.size() && sum > 0; ++k)
    shares.kinds[k] = kByPower * shares.kinds[k] + (1 - kByPower) * roots[k] / sum;
  return shares;
}

std::vector<LampPoint> Lamps::points(std::uint64_t seed, std::uint32_t pass, std::uint32_t count,
                                     const LampShares& shares) const {
  std::vector<LampPoint> points;
  for (std::size_t kind = 0; kind < kinds(); ++kind) {
    const bool near = !near_.empty() && kind == 0;
    const std::size_t k = kind - (near_.empty() ? 0 : 1);  // of those afar
    const auto each = static_cast<std::uint32_t>(std::max(1.0, std::round(shares.kinds[kind] * count)));
    const auto n = static_cast<float>(each);
    for (std::uint32_t i = 0; i < each; ++i) {
      Sampler sampler(seed, near ? kNearStream : kFarStream + k, pass * each + i);
      if (near) {
        const float at = sampler.next1();
        points.push_back(near_point(double{at}, sampler.next2(), n, shares.near_cdf));
        continue;
      }
      Vec2 on = sampler.next2();
      float share = 1;
      if (afar_[k] == kSky) on = drawn_by(shares.sky_cdf, on, share);
      points.push_back(afar_point(k, on, n));
      points.back().power *= share;
    }
  }
  std::erase_if(points, [](const LampPoint& p) { return !(max_component(p.power) > 0); });
  return points;
}

}  // namespace oriel
