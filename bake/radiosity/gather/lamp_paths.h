// Light of lamps that comes to texels by way of specular reflections alone, followed from the lamps.
#pragma once

#include <memory>

#include "bake/radiosity/gather/polished_suns.h"
#include "bake/radiosity/gather/surroundings.h"
#include "bake/radiosity/texels/grouped_light.h"

namespace oriel {

// What particles brought, by half and texel. What Surroundings::leave_out_lamps() leaves out is in it.
struct LampLight {
  std::array<std::vector<Vec3>, kHalves> sum;  // lux * particles
  std::vector<Vec4> moments;                   // as those of HalfSums, of both halves; empty unless asked for
  std::array<GroupedLight, kHalves> grouped;   // of `sum`, by group of lamps
  std::uint64_t particles = 0;                 // of each half
  std::shared_ptr<const PolishedSuns> suns;    // made when first asked for

  LampLight(std::size_t texels, bool directional, std::size_t groups = 0)
      : moments(directional ? texels : 0), grouped{GroupedLight(texels, groups), GroupedLight(texels, groups)} {
    for (auto& s : sum) s.resize(texels);
  }
  Vec3 half(int h, std::size_t i) const { return particles ? sum[h][i] / static_cast<float>(particles) : Vec3(0); }
};

// Rays from texels meet the image of a small bright lamp in a polished floor rarely, and few of them tell poorly how
// bright it is: in furnished rooms that was three quarters of a gather's squared error and more. The lamp's own light
// finds the floor at once, and from there the texels (light tracing, Arvo 1986; the two ways add up to all light, path
// for path: Veach 1997, section 9). What paths find that go on from near surfaces is theirs (Surroundings::goes_on). A
// point light met by way of a mirror is found by no path from an eye, and so left out. What frosted glass spreads is
// left to paths (is_frosted).
//
// Adds particles until each half has `per_half` of them, of suns as many more. Does nothing where no lamp is near
// (LightSample::near) and no sun can meet anything polished: others' particles rarely come into a room. Error kStopped.
Status trace_lamps(const Texels& texels, const Surroundings& around, std::uint64_t per_half, const Stage& stage,
                   LampLight& light);

}  // namespace oriel
