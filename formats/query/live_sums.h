// What live lights give points, now and where their lamp was baked.
#pragma once

#include <array>

#include "formats/query/live_lights.h"

namespace oriel {

// A lamp's lights at one pose.
struct PosedLights {
  std::vector<LiveLight> lights;
  Mat4 lamp_from_pack{1};
};
PosedLights pose_lights(const LampScene& scene, std::size_t count, const MoverPose& pose);
// now, baked: as many, so that lights of the same index belong together.
struct LightPair {
  const PosedLights &now, &baked;
};

// How much is seen of the lights that face a point.
enum class SeenLights : std::uint8_t { kNone, kSome, kAll, kFacesNone };

// Irradiance, lux.
struct LiveSum {
  Vec3 now{0}, baked{0};
  // Of the luminances of those that it is the sum of, times their number, so that parts of other numbers count alike:
  // now times baked, baked squared.
  double products = 0, squares = 0;
  SeenLights sees_now = SeenLights::kFacesNone, sees_baked = SeenLights::kFacesNone;

  // Of both parts; what is seen is the left one's.
  LiveSum& operator+=(const LiveSum& other);
  // How much of what the bake knows of the lamp here still tells about it, [0,1]: the coefficient of the regression,
  // through the origin, of the lights now on the same ones as baked, as for control variates (Owen 2013, "Monte Carlo
  // theory, methods and examples", section 8.9). Where nothing has changed it is 1 exactly; with nothing in common 0;
  // nothing where no light came before: what the bake has there it has from around.
  std::optional<float> kept() const;
};

// For one thread, point after point that lie together: what was in the way of a light is asked first for the next.
class LiveSums {
 public:
  // All outlive it.
  LiveSums(const LampScene& scene, const LightPair& lights);
  // normal: unit. The same whatever was asked before.
  LiveSum at(const Vec3& point, const Vec3& normal);

 private:
  const LampScene& scene_;
  const LightPair lights_;
  std::vector<LampScene::Blockers> now_, baked_;  // by light
};

// Adds that share of it; what is seen stays.
void add_share(LiveSum& to, float share, const LiveSum& sum);
// Between four texels by their weights. Null: that one has no light; not all of them.
LiveSum mix_sums(const std::array<const LiveSum*, 4>& corners, const std::array<float, 4>& weights);

}  // namespace oriel
