#include "bake/run/start.h"

#include "bake/visibility/first_look.h"

namespace oriel {

Result<Start> choose_start(const BakeTask& bake) {
  Pack& pack = bake.pack;
  const BakedScene baked = bake.baked();
  if (!pack.cameras.empty() || !pack.paths.empty()) return Start::kOfScene;
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
  ORIEL_TRY(FirstLook first, find_first_look(baked.accel, floors, light, bake.context));
  pack.cameras.push_back(std::move(first.camera));
  return first.inside ? Start::kInside : Start::kOutside;
}

}  // namespace oriel
