// Light tracing: light of lamps that reaches texels by specular reflections alone (caustics).
#pragma once

#include <memory>

#include "bake/radiosity/gather/cache_query.h"
#include "bake/radiosity/gather/polished_suns.h"
#include "bake/radiosity/texels/grouped_light.h"

namespace oriel {

// The light that particles carry to texels, by half. CacheQuery::leave_out_lamps() takes it out of gather rays.
struct LampLight {
  std::array<std::vector<Vec3>, kHalves> sum;  // lux * particles
  std::vector<Vec4> moments;                   // as in HalfSums, of both halves; empty unless directional
  std::array<GroupedLight, kHalves> grouped;   // `sum` by light group
  std::uint64_t particles = 0;                 // per half
  std::shared_ptr<const PolishedSuns> suns;    // created at the first use

  LampLight(std::size_t texels, bool directional, std::size_t groups = 0)
      : moments(directional ? texels : 0), grouped{GroupedLight(texels, groups), GroupedLight(texels, groups)} {
    for (auto& s : sum) s.resize(texels);
  }
  Vec3 half(int h, std::size_t i) const { return particles ? sum[h][i] / static_cast<float>(particles) : Vec3(0); }
};

// Adds particles until each half has `per_half` of them, and as many again for suns.
//
// Gather rays rarely hit the image of a small bright lamp in a polished floor, which made up three quarters or more of
// their squared error in furnished rooms. Particles from the lamp hit the floor at once, and from there the texels
// (light tracing, Arvo 1986). Gather rays and particles partition the light path by path (Veach 1997, section 9). Paths
// that continue from near surfaces keep their light (CacheQuery::continues_path). A point light seen by a mirror is
// left out: no camera path finds it. Light spread by frosted glass is left to paths (is_frosted).
//
// Does nothing where no lamp is near (LightSample::near) and no sun can hit anything polished. Error kStopped.
Status trace_lamps(const Texels& texels, const CacheQuery& query, std::uint64_t per_half, const Stage& stage,
                   LampLight& light);

}  // namespace oriel
