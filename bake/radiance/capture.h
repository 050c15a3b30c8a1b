// Radiance maps with depth: what each viewpoint behind a reflector sees through its element.
#pragma once

#include <functional>

#include "bake/jobs/units.h"
#include "bake/radiance/sight.h"

namespace oriel {

// Radiance (cd/m²) that a surface sends back along the ray, without regard to its throughput, which here is the share
// of it that the reflector sends on. Called from any thread.
using OutgoingRadiance = std::function<Vec3(const SeenSurface&)>;

// What rays from reflectors see, and its light.
struct LitSurroundings {
  const ReflectedSurroundings& around;
  const OutgoingRadiance& outgoing;
};

// The light without what is negative or not finite.
Vec3 usable_light(const Vec3& c);

// What a ray from a reflector's plane sees (ReflectedSurroundings::look), with its light: finite, not negative, 0 where
// nothing usable is seen. The reflector's emitters shine by way of other mirrors only.
struct SeenLight {
  Sight sight;
  Vec3 radiance{0};  // cd/m²
  std::uint64_t rays = 0;
};
SeenLight see(const LitSurroundings& lit, std::uint32_t reflector, const Vec3& from, const Vec3& direction,
              const Cone& cone = {});

// The ray of a place of a map, in pixels: from the plane, scene space; with what a pixel there shows.
struct CaptureRay {
  Vec3 from{0}, direction{0};
  Cone cone;
};
CaptureRay capture_ray(const Reflector& reflector, const RadianceMap& map, const Vec2& at);
// Fills the pixels of maps that are planned (formats/assets/radiance_map.h says how): depth and light are those of the
// ray through a pixel's centre; textures of what it ends on are means over what the pixel shows of them (its cone,
// after Akenine-Möller et al. 2021), so that fine ones do not alias and colour and depth still belong together. Both as
// ReflectedSurroundings::look has them: what transmitting surfaces hide and show is weighted by their transmittance,
// and mirrors add what they reflect. The reflector's own triangles are never hit. The back of a one-sided surface keeps
// its depth, with radiance 0 and valid 0. Radiance that is not finite or negative counts as 0. Maps of a reflector that
// lists emitters show those by way of other mirrors only. The same bytes for any number of threads. Error kStopped.
Status capture_maps(const LitSurroundings& lit, const Stage& stage, std::vector<RadianceMap>& maps);

}  // namespace oriel
