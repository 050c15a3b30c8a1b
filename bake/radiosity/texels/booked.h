// Light of texels by the group of lamps that gave it.
#pragma once

#include <span>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// By texel, and of each by group (Scene::light_groups): what of the texel's light is whose. It goes through the same
// linear steps as the light itself, whose sum over groups stays that light. No groups: nothing is kept.
struct BookedLight {
  std::size_t groups = 0;
  std::vector<Vec3> light;  // at texel * groups + group

  BookedLight() = default;
  BookedLight(std::size_t texels, std::size_t group_count) : groups(group_count), light(texels * group_count) {}

  bool empty() const { return groups == 0; }
  std::span<Vec3> of(std::size_t texel) { return std::span(light).subspan(texel * groups, groups); }
  std::span<const Vec3> of(std::size_t texel) const { return std::span(light).subspan(texel * groups, groups); }

  bool is_dark(std::size_t group) const {
    for (std::size_t i = group; i < light.size(); i += groups)
      if (light[i] != Vec3(0)) return false;
    return true;
  }
  // Adds that many times another's, of as many texels and groups.
  void add(const BookedLight& other, float times = 1) {
    for (std::size_t i = 0; i < light.size(); ++i) light[i] += times * other.light[i];
  }
  // Light of one group by texel, and back.
  std::vector<Vec3> of_group(std::size_t group) const {
    std::vector<Vec3> out;
    for (std::size_t i = group; i < light.size(); i += groups) out.push_back(light[i]);
    return out;
  }
  void set_group(std::size_t group, std::span<const Vec3> of_texels) {
    for (std::size_t i = 0; i < of_texels.size(); ++i) light[i * groups + group] = of_texels[i];
  }
};

// Makes the groups' light of one texel sum to `total`, channel by channel: what rounding, clamps and decisions taken
// for the total leave between the two is shared as the light is. Negative light counts as none. Where no group has any,
// the groups get even shares.
inline void share_out(std::span<Vec3> groups, const Vec3& total) {
  Vec3 sum(0);
  for (Vec3& light : groups) sum += light = glm::max(light, Vec3(0));
  for (int c = 0; c < 3; ++c) {
    const bool known = sum[c] > 1e-30f;
    const float share = known ? total[c] / sum[c] : total[c] / static_cast<float>(groups.size());
    for (Vec3& light : groups) light[c] = known ? light[c] * share : share;
  }
}

}  // namespace oriel
