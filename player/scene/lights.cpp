#include "player/scene/lights.h"

#include <algorithm>

#include "player/navigation/lamps.h"

namespace oriel {

BakedLamps::BakedLamps(const Pack& pack) : sky_(pack.sky) {
  for (const Material& m : pack.materials) emission_.push_back(m.emission);
  for (const Emitter& emitter : pack.emitters)
    emitters_.push_back(emitter.radiance), corners_.push_back(emitter.corners);
  for (const BrightLight& light : pack.light_field.lights) bright_.push_back(light.intensity);
  for (const LightProbe& probe : pack.light_field.probes) harmonics_.push_back(probe.sh);
}

void BakedLamps::scale_light(std::span<const Vec3> factors, Pack& pack) const {
  for (std::size_t g = 0; g < factors.size(); ++g) {
    const LightGroup& group = pack.light_groups[g];
    for (const std::uint32_t m : group.materials) pack.materials[m].emission = factors[g] * emission_[m];
    for (const std::uint32_t e : group.emitters) pack.emitters[e].radiance = factors[g] * emitters_[e];
    for (const std::uint32_t b : group.bright_lights) pack.light_field.lights[b].intensity = factors[g] * bright_[b];
    if (group.sky && pack.day.empty()) pack.sky = factors[g] * sky_;
  }
  if (!factors.empty() && !pack.day.empty()) pack.sky = sky_of_day(pack.day, factors);
  for (std::size_t p = 0; p < harmonics_.size(); ++p) {
    const Vec3 factor = mean_factor(pack, factors, &LightGroup::probes, p);
    std::vector<float>& sh = pack.light_field.probes[p].sh;
    const std::size_t each = sh.size() / 3;
    for (std::size_t k = 0; k < sh.size(); ++k) sh[k] = factor[static_cast<int>(k / each)] * harmonics_[p][k];
  }
}

Vec3 middle_of(std::span<const Vec3> corners) {
  return 0.5f * (corners[0] + corners[std::min<std::size_t>(2, corners.size() - 1)]);
}

bool stands_for_point(const Pack& pack, const LightGroup& group, std::span<const Vec3> corners) {
  return std::ranges::any_of(group.bright_lights, [&](std::uint32_t b) {
    const BrightLight& light = pack.light_field.lights[b];
    return (light.kind == BrightLightKind::kPoint || light.kind == BrightLightKind::kSpot) &&
           glm::distance(light.position, middle_of(corners)) < 0.1f * glm::distance(corners[0], light.position);
  });
}

void BakedLamps::place(std::span<const MoverPose> poses, Pack& pack) const {
  for (std::size_t g = 0; g < poses.size(); ++g) {
    const Mat4 pose(pack_from_object(poses[g]));
    for (const std::uint32_t e : pack.light_groups[g].emitters) {
      pack.emitters[e].corners = corners_[e];
      if (is_rest(poses[g])) continue;
      const Vec3 middle = middle_of(corners_[e]), moved(pose * Vec4(middle, 1));
      const bool turns = !stands_for_point(pack, pack.light_groups[g], corners_[e]);
      for (Vec3& corner : pack.emitters[e].corners)
        corner = turns ? Vec3(pose * Vec4(corner, 1)) : moved + (corner - middle);
    }
  }
}

std::vector<BrightLight> placed_lights(const Pack& pack, std::span<const MoverPose> poses) {
  std::vector<BrightLight> lights = pack.light_field.lights;
  for (std::size_t g = 0; g < poses.size(); ++g) {
    if (is_rest(poses[g])) continue;
    const Mat4 pose(pack_from_object(poses[g]));
    for (const std::uint32_t b : pack.light_groups[g].bright_lights) {
      BrightLight& light = lights[b];
      if (light.kind == BrightLightKind::kDirectional) continue;  // it shines from everywhere alike
      light.position = Vec3(pose * Vec4(light.position, 1));
      light.direction = Mat3(pose) * light.direction;
      for (Vec3& corner : light.corners) corner = Vec3(pose * Vec4(corner, 1));
    }
  }
  return lights;
}

Vec3 mean_factor(const Pack& pack, std::span<const Vec3> factors, std::vector<Vec3> LightGroup::*shares,
                 std::size_t index) {
  Vec3 factor(1);
  for (std::size_t g = 0; g < factors.size(); ++g)
    factor += (factors[g] - Vec3(1)) * (pack.light_groups[g].*shares)[index];
  return glm::max(factor, Vec3(0));
}

Vec3 sky_of_day(const Day& day, std::span<const Vec3> factors) {
  Vec3 sky(0);
  for (const DayHour& hour : day.hours)
    if (hour.group != kNight) sky += factors[hour.group] / static_cast<float>(day.lit()) * hour.sky;
  return sky;
}

}  // namespace oriel
