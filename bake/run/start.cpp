#include "bake/run/start.h"

namespace oriel {

Result<FirstLook> find_start(const BakeTask& bake, const std::function<bool()>& enough) {
  const BakedScene baked = bake.baked();
  std::vector<WalkGrid> floors = bake.prepared.region.grids;
  if (bake.options.eyes.source != EyeSource::kWalk) {
    EyeOptions walk;  // people walk whatever eyes reflections are planned for
    walk.walk = bake.prepared.walk;
    ORIEL_TRY(EyeRegion walked, find_eye_region(baked.accel, walk, bake.context));
    floors = std::move(walked.grids);
  }
  const SurfaceLight light = [&](const Hit& hit, const Vec3& towards_eye) {
    return baked_radiance(baked, {.hit = hit, .towards_eye = towards_eye});
  };
  return find_first_look(baked.accel, floors, light, bake.context, enough);
}

}  // namespace oriel
