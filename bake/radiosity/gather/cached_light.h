// What rays find at texels: light that varies over them.
#pragma once

#include "bake/radiosity/texels/grouped_light.h"
#include "bake/radiosity/texels/neighbours.h"

namespace oriel {

// Light reflected by a texel, linear over it: in the corners of a room a neighbour's mean is not what is seen from
// close by (first-order reconstruction of finite volumes; the mean over the texel stays).
struct alignas(64) CachedTexel {
  Vec3 radiance{0};             // at the centre, cd/m²
  Vec3 centre{0};               // of what is visible of the texel, m
  std::array<Vec3, 3> slope{};  // by channel, cd/m² per m, along the surface

  Vec3 at(const Vec3& p) const {
    const Vec3 d = p - centre;
    return glm::max(radiance + Vec3(glm::dot(slope[0], d), glm::dot(slope[1], d), glm::dot(slope[2], d)), Vec3(0));
  }
};

class BrightTexels;

struct CachedLight {
  std::span<const Vec3> irradiance;  // by texel, lux
  std::vector<CachedTexel> texels;
  const GroupedLight* grouped = nullptr;  // of irradiance, by group of lamps; null: nobody asks
  const BrightTexels* bright = nullptr;   // at which rays are aimed; null: at none

  // Adds to `groups` light of a texel that counts by `weight` for each lux; within a texel all groups' light varies
  // alike.
  void book(std::uint32_t texel, const Vec3& weight, std::span<Vec3> groups) const {
    const std::span<const Vec3> light = grouped->of(texel);
    for (std::size_t g = 0; g < groups.size(); ++g) groups[g] += weight * light[g];
  }
};

// Slopes are fitted to the texels beside (least squares); they take no light below zero.
CachedLight cache_light(const Texels& texels, const TexelGraph& graph, std::span<const Vec3> irradiance,
                        Context& context);

}  // namespace oriel
