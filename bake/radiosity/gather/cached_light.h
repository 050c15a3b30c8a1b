// The radiosity cache that gather rays look up: one linear function of position per texel.
#pragma once

#include "bake/radiosity/texels/grouped_light.h"
#include "bake/radiosity/texels/neighbours.h"

namespace oriel {

// Radiance reflected diffusely by a texel, linear over it (first-order reconstruction of finite volumes; the texel's
// mean stays). In the corners of a room the mean alone is wrong for rays from close by.
struct alignas(64) CachedTexel {
  Vec3 radiance{0};             // at the centre, cd/m²
  Vec3 centre{0};               // of the texel's sample points, m
  std::array<Vec3, 3> slope{};  // by channel, along the surface, cd/m² per m

  Vec3 at(const Vec3& p) const {
    const Vec3 d = p - centre;
    return glm::max(radiance + Vec3(glm::dot(slope[0], d), glm::dot(slope[1], d), glm::dot(slope[2], d)), Vec3(0));
  }
};

class BrightTexels;

struct CachedLight {
  std::span<const Vec3> irradiance;  // by texel, lux
  std::vector<CachedTexel> texels;
  const GroupedLight* grouped = nullptr;  // `irradiance` by light group; null: not wanted
  const BrightTexels* bright = nullptr;   // to be importance sampled; null: none

  // Adds weight * irradiance of a texel to `groups`, by group. All groups vary alike within a texel.
  void add_to_groups(std::uint32_t texel, const Vec3& weight, std::span<Vec3> groups) const {
    const std::span<const Vec3> light = grouped->of(texel);
    for (std::size_t g = 0; g < groups.size(); ++g) groups[g] += weight * light[g];
  }
};

// Builds the cache from irradiance by texel, lux. Slopes are least-squares fits to the neighbours; they are limited so
// that radiance stays at least 0 at all sample points.
CachedLight cache_light(const Texels& texels, const TexelGraph& graph, std::span<const Vec3> irradiance,
                        Context& context);

}  // namespace oriel
