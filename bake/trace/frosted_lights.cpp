#include "bake/trace/frosted_lights.h"

#include <algorithm>
#include <optional>

#include "bake/trace/lights.h"
#include "bake/trace/sampler.h"
#include "bake/trace/shading.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr double kInPlane = 1e-6;      // of the scene's size: a light in a pane's plane shines through it nowhere
constexpr double kLeastSpread = 1e-3;  // of a light that touches its pane
constexpr int kProbes = 16;            // of a pane, whether a light shines there: only noise depends on them

// What one pane spreads of a light to a receiver, by points of the pane: as light would be spread that comes from
// there, to the receiver, about where it would pass straight. Nearer to the light all is as much narrower.
class SpreadLobe {
 public:
  // towards: unit, from the receiver to the light. left: of that way, from the pane to the light.
  SpreadLobe(const PlanarMirror& pane, const DVec3& from, const DVec3& towards, double left)
      : pane_(pane),
        from_(from),
        height_(pane.height(from)),
        crossing_(from + height_ / -glm::dot(pane.normal, towards) * towards),
        left_(left),
        world_from_local_(frame_from_normal(Vec3(-pane.normal))),
        shade_(isotropic(pane.shade)),
        lobe_(shade_, glm::transpose(world_from_local_) * Vec3(towards)) {}
  SpreadLobe(const SpreadLobe&) = delete;
  SpreadLobe& operator=(const SpreadLobe&) = delete;

  // A point of the pane's plane; nothing where the lobe misses it.
  std::optional<DVec3> point(const Vec2& v) const {
    const DVec3 wide = -DVec3(glm::normalize(world_from_local_ * lobe_.spread(v)));
    const double cosine = -glm::dot(pane_.normal, wide);
    if (!(cosine > 0)) return std::nullopt;
    return crossing_ + left_ * (from_ + height_ / cosine * wide - crossing_);
  }
  // With which density a point of the plane is chosen, per m².
  double density(const DVec3& point) const {
    const DVec3 leg = crossing_ + (point - crossing_) / left_ - from_;
    const double length = glm::length(leg), cosine = height_ / length;
    const float pdf = lobe_.spread_pdf(glm::transpose(world_from_local_) * Vec3(-leg / length));
    return pdf * cosine / (length * length) / (left_ * left_);
  }

 private:
  static ShadePoint isotropic(ShadePoint shade) {
    shade.anisotropy = 0;
    return shade;
  }

  const PlanarMirror& pane_;
  DVec3 from_;
  double height_;
  DVec3 crossing_;
  double left_;
  Mat3 world_from_local_;
  ShadePoint shade_;
  Bsdf lobe_;
};

}  // namespace

FrostedLights::FrostedLights(const Scene& scene, const LightSet& lights, const Accel* accel) : scene_(&scene) {
  if (scene.lights.empty()) return;
  panes_ = PlanarMirrors::frosted_panes(scene);
  triangles_ = panes_.triangles_of(scene);
  const double in_plane = kInPlane * std::max(1e-30, double{scene.radius()});
  for (std::size_t m = 0; m < panes_.size(); ++m) {
    areas_.emplace_back();
    double area = 0;
    for (const std::uint32_t t : panes_[m].triangles) areas_.back().push_back(area += triangle_area(scene, t));
    DVec3 sum(0);
    for (const DVec3& corner : panes_[m].hull) sum += corner / double(panes_[m].hull.size());
    middle_.push_back(sum), extent_.push_back(0);
    for (const DVec3& corner : panes_[m].hull) extent_.back() = std::max(extent_.back(), glm::distance(corner, sum));
  }
  of_pane_.resize(panes_.size()), power_.resize(panes_.size());
  for (std::uint32_t l = 0; l < scene.lights.size(); ++l) {
    const Light& light = scene.lights[l];
    const bool afar = light.type == LightType::kDirectional;
    const double power = luminance(afar ? light.intensity : Vec3(punctual_power(scene, light)));
    for (std::uint16_t m = 0; m < panes_.size(); ++m) {
      const PlanarMirror& pane = panes_[m];
      // Of a sun's disk a part may be behind the pane where its centre is not.
      const double low = std::sin(double{light.angular_radius_rad});
      const double behind =
          afar ? glm::dot(pane.normal, DVec3(light.direction)) + low : -pane.height(DVec3(light.position));
      if (!(behind > (afar ? 0 : in_plane))) continue;
      const double size = std::sqrt(pane.area_m2);
      double own = power * pane.area_m2 * (afar ? behind : 1 / (pane.area_m2 + behind * behind + size * behind));
      if (!(own > 0)) continue;
      if (accel) own *= openness({l, m}, lights, *accel);
      of_pane_[m].push_back(ways_.size());
      power_[m].push_back((power_[m].empty() ? 0 : power_[m].back()) + own);
      ways_.push_back({l, m});
    }
  }
}

MirroredSample FrostedLights::sample(const LightSet& lights, const Vec3& p, const Chosen& chosen) const {
  MirroredSample sample;
  const auto [i, choice_weight] = choose(DVec3(p), chosen.way);
  if (!(choice_weight > 0)) return sample;
  const PlanarMirror& pane = panes_[ways_[i].pane];
  const DVec3 from(p);
  const double height = pane.height(from);
  // Its own surface gets none of what it spreads.
  if (!(height > 2 * mirror_margin(*scene_, pane.triangles.front(), p, 1))) return sample;
  const LightSample straight = lights.sample_light(ways_[i].light, p, chosen.light);
  const DVec3 towards(straight.direction);
  const double cosine = -glm::dot(pane.normal, towards);
  // A spot sends nothing this way, but maybe to a part of the pane: its estimate is asked there.
  if (!(cosine > 0)) return sample;
  const bool afar = scene_->lights[ways_[i].light].type == LightType::kDirectional;
  const double all = afar ? 0 : glm::distance(from, DVec3(scene_->lights[ways_[i].light].position));
  const double left = afar ? 1 : std::max(kLeastSpread, (all - height / cosine) / all);
  const SpreadLobe lobe(pane, from, towards, left);
  // Where the lobe is, or anywhere on the pane: the one knows wide panes, the other small and far ones.
  std::optional<PlanarMirrors::On> on;
  if (chosen.facet.x >= 0.5f) {
    on = point_by_area(ways_[i].pane, {2 * chosen.facet.x - 1, chosen.facet.y});
    // Of surfaces in one place the first counts: the density is that of choosing it.
    const auto first =
        on ? panes_.on(*scene_, ways_[i].pane, DVec3(point_on(*scene_, on->triangle, on->barycentric))) : on;
    if (!first || first->triangle != on->triangle) return sample;
  } else if (const auto point = lobe.point({2 * chosen.facet.x, chosen.facet.y})) {
    on = panes_.on(*scene_, ways_[i].pane, *point);
  }
  if (!on) return sample;
  const DVec3 on_plane(point_on(*scene_, on->triangle, on->barycentric));
  const double per_m2 = 0.5 * (lobe.density(on_plane) + 1 / pane.area_m2);
  const LightSample light = lights.sample_light(ways_[i].light, Vec3(on_plane), chosen.light);
  if (!(max_component(light.estimate) > 0)) return sample;  // a spot that looks elsewhere
  const DVec3 leg = on_plane - from;
  const double length = glm::length(leg);
  const DVec3 direction = leg / length;
  const double leg_cosine = -glm::dot(pane.normal, direction);
  const bool front = glm::dot(DVec3(geometric_normal(*scene_, on->triangle)), pane.normal) > 0;
  const SurfacePoint surface =
      surface_at(*scene_, {on->triangle, static_cast<float>(length), on->barycentric, front}, Vec3(direction));
  const Shading shading(surface, -Vec3(direction));
  const float facets = shading.spread_pdf(light.direction);
  const Vec3 passed = surface.shade.transmission *
                      (1 - max_component(reflectance(surface.shade, glm::dot(surface.normal, -Vec3(direction)))));
  const auto weight = static_cast<float>(facets * leg_cosine / (length * length * per_m2)) * choice_weight;
  sample.direction = Vec3(direction), sample.group = light.group;
  sample.endless = light.estimate * passed * weight;
  if (!(max_component(sample.endless) > 0)) return sample;
  sample.share = Vec3(1);
  const double margin = mirror_margin(*scene_, on->triangle, p, leg_cosine);
  const auto add_leg = [&](const Ray& ray) { sample.leg[static_cast<std::size_t>(sample.legs++)] = ray; };
  if (length > margin) add_leg({p, sample.direction, static_cast<float>(length - margin), true, false});
  add_leg({spawn_origin(*scene_, on->triangle, on->barycentric, light.direction), light.direction, light.distance});
  return sample;
}

std::pair<std::size_t, float> FrostedLights::choose(const DVec3& p, float u) const {
  thread_local std::vector<double> until;
  until.clear();
  double sum = 0;
  for (std::size_t m = 0; m < panes_.size(); ++m) until.push_back(sum += worth(m, p));
  if (!(sum > 0)) return {};
  const std::size_t m = at_or_below(until, u * sum);
  const double before = m > 0 ? until[m - 1] : 0, of_pane = until[m] - before;
  if (!(of_pane > 0)) return {};
  const std::size_t k = at_or_below(power_[m], (u * sum - before) / of_pane * power_[m].back());
  const double own = (power_[m][k] - (k > 0 ? power_[m][k - 1] : 0)) / power_[m].back() * of_pane;
  return {of_pane_[m][k], own > 0 ? static_cast<float>(sum / own) : 0.0f};
}

double FrostedLights::openness(const Way& way, const LightSet& lights, const Accel& accel) const {
  double seen = 0.5;
  for (int k = 0; k < kProbes; ++k) {
    Sampler random(way.light, way.pane, static_cast<std::uint32_t>(k));
    const auto on = point_by_area(way.pane, random.next2());
    if (!on) continue;
    const LightSample light =
        lights.sample_light(way.light, point_on(*scene_, on->triangle, on->barycentric), random.next2());
    const Vec3 from = spawn_origin(*scene_, on->triangle, on->barycentric, light.direction);
    if (max_component(light.estimate) > 0 &&
        max_component(accel.transmittance({from, light.direction, light.distance})) > 0)
      ++seen;
  }
  return seen / (kProbes + 0.5);
}

double FrostedLights::worth(std::size_t pane, const DVec3& p) const {
  if (power_[pane].empty() || !(panes_[pane].height(p) > 0)) return 0;
  const double nearest = std::max(0.0, glm::distance(middle_[pane], p) - extent_[pane]);
  return power_[pane].back() / (panes_[pane].area_m2 + nearest * nearest);
}

std::optional<PlanarMirrors::On> FrostedLights::point_by_area(std::size_t pane, const Vec2& v) const {
  const std::vector<double>& areas = areas_[pane];
  const double at = double{v.y} * areas.back();
  const std::size_t k = at_or_below(areas, at);
  const double before = k > 0 ? areas[k - 1] : 0, own = areas[k] - before;
  if (!(own > 0)) return std::nullopt;
  const auto rest = static_cast<float>(std::clamp((at - before) / own, 0.0, 1.0));
  return PlanarMirrors::On{panes_[pane].triangles[k], square_to_triangle({v.x, rest})};
}

}  // namespace oriel
