// What live lights give points, now and where their lamp was baked.
#pragma once

#include "formats/query/live_lights.h"

namespace oriel {

// A lamp's lights at one pose.
struct PosedLights {
  LiveLights of;
  DMat4 lamp_from_pack{1};
};
PosedLights pose_lights(const LiveScene& scene, const LiveOptions& options, const MoverPose& pose);

// Irradiance, lux.
struct LiveSum {
  Vec3 now{0}, baked{0};
  // How much of what the bake knows of the lamp here still tells about it, [0,1]: the coefficient of the regression of
  // the lights now on the same ones as baked, direct ones and others apart (Owen 2013, "Monte Carlo theory, methods and
  // examples", section 8.9). Where nothing has changed it is 1 exactly; nothing in common: 0.
  float kept = 1;
  Vec3 missing{0};  // of `now`, what its indirect lights would give more without extent; without what is infinite
};

// now, baked: by the same options, so that lights of the same index belong together. normal: unit.
LiveSum live_sum(const LiveScene& scene, const PosedLights& now, const PosedLights& baked, const Vec3& point,
                 const Vec3& normal);

}  // namespace oriel
