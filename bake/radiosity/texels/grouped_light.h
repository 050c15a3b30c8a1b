// Irradiance of texels by light group: one AOV per group of lamps.
#pragma once

#include <span>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// Irradiance by texel and light group (Scene::light_groups), lux. It passes through the same linear steps as the sum of
// all light, so the groups of a texel add up to that sum. With 0 groups nothing is stored.
struct GroupedLight {
  std::size_t groups = 0;
  std::vector<Vec3> light;  // at texel * groups + group

  GroupedLight() = default;
  GroupedLight(std::size_t texels, std::size_t group_count) : groups(group_count), light(texels * group_count) {}

  bool empty() const { return groups == 0; }
  std::span<Vec3> of(std::size_t texel) { return std::span(light).subspan(texel * groups, groups); }
  std::span<const Vec3> of(std::size_t texel) const { return std::span(light).subspan(texel * groups, groups); }

  bool is_dark(std::size_t group) const {
    for (std::size_t i = group; i < light.size(); i += groups)
      if (light[i] != Vec3(0)) return false;
    return true;
  }
  // Adds `times` * other. Both must have the same number of texels and groups.
  void add(const GroupedLight& other, float times = 1) {
    for (std::size_t i = 0; i < light.size(); ++i) light[i] += times * other.light[i];
  }
  // These two read and write one group's light by texel.
  std::vector<Vec3> of_group(std::size_t group) const {
    std::vector<Vec3> out;
    for (std::size_t i = group; i < light.size(); i += groups) out.push_back(light[i]);
    return out;
  }
  void set_group(std::size_t group, std::span<const Vec3> of_texels) {
    for (std::size_t i = 0; i < of_texels.size(); ++i) light[i * groups + group] = of_texels[i];
  }
};

// Scales one texel's groups so that they sum to `total`, channel by channel. Rounding, clamps and decisions made for
// the total leave a difference between the two; each group gets a share of it in proportion to its light. Negative
// light counts as 0. Where all groups are dark, each gets an equal share.
inline void rescale_groups(std::span<Vec3> groups, const Vec3& total) {
  Vec3 sum(0);
  for (Vec3& light : groups) sum += light = glm::max(light, Vec3(0));
  for (int c = 0; c < 3; ++c) {
    const bool lit = sum[c] > 1e-30f;
    const float share = lit ? total[c] / sum[c] : total[c] / static_cast<float>(groups.size());
    for (Vec3& light : groups) light[c] = lit ? light[c] * share : share;
  }
}

}  // namespace oriel
