// What eyes see in a reflector, as samples, and which viewpoints see the same: what planning maximises.
#pragma once

#include "bake/jobs/context.h"
#include "bake/radiance/elements.h"
#include "bake/radiance/sight.h"

namespace oriel {

// Screens that maps are to be sharp for: 60° over 486 rows. A pixel of a map is sharp where it covers no more than two
// of the screen's, or half the radius of the lobe that blurs it.
inline constexpr double kSharpAngleRad = 2 * 2 * 0.57735026919 / 486;

// A point of a reflector, an eye that sees it, and what it reflects there. Reflector space.
struct ReflectedSample {
  Vec3 on_plane{0}, eye{0};
  Vec4 image{0};      // homogeneous: the point behind the plane's front that is seen; w = 0: a direction, a sky image
  Vec3 normal{0};     // of the surface there, unit; a sky image: 0
  float spacing = 0;  // at the image, across the eye's ray: the widest that is still sharp; metres, sky: radians
  float weight = 0;   // solid angle that it stands for, on average over the eyes
  bool sky = false;   // of one colour, or an image
};

inline void fields(Archive& archive, ReflectedSample& s) {
  archive(s.on_plane, s.eye, s.image, s.normal, s.spacing, s.weight, s.sky);
}

struct SampleOptions {
  std::span<const Vec3> eyes;  // scene space, each in turn
  std::uint32_t count = 0;
  std::uint64_t seed = 0;
};

// Pairs of an eye and a point of the reflector that see each other: `count` of them, or fewer where eyes seldom see it,
// or none. What shows the back of a surface is left out. A black sky counts, as it would be filled from the light
// beside it where no map tells, but none are given of a reflector that shows nothing else. The same for the same seed.
Result<std::vector<ReflectedSample>> sample_reflections(const ReflectedSurroundings& surroundings,
                                                        std::uint32_t reflector, const SampleOptions& options,
                                                        Context& context);

// Pixels that the longer side of a map from `viewpoint` through `window` needs to show the sample sharp; infinite where
// it does not see it.
float needed_resolution(const ReflectedSurroundings& surroundings, std::uint32_t reflector, const Vec3& viewpoint,
                        const Element& window, const ReflectedSample& sample);

// Where the map's eye has what the sample shows, as map_pixel() of a point; the sky's directions are the same from
// everywhere.
Vec2 map_pixel(const RadianceMap& map, const ReflectedSample& sample);

// Shares of the samples' weight.
struct ViewQuality {
  double seen = 0, sharp = 0;  // by any of the maps
  double worst = 1;            // seen by that camera which sees least; 1 without cameras
};
ViewQuality judge_maps(const ReflectedSurroundings& surroundings, std::span<const RadianceMap> maps,
                       std::span<const ReflectedSample> samples, Context& context);

}  // namespace oriel
