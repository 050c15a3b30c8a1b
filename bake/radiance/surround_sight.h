// What a ray from the centre of a surround map sees.
#pragma once

#include <limits>
#include <vector>

#include "bake/radiance/curved_reflectors.h"
#include "bake/trace/accel.h"

namespace oriel {

// What a ray has seen so far.
struct SurroundSight {
  // A surface on the way, and the share of its light that comes through what is before it.
  struct Layer {
    Hit hit;
    Vec3 share{0};
  };
  std::vector<Layer> layers;
  Vec3 throughput{1};
  float inverse_distance = 0;  // 1/m, of the opaque surface that ended it; 0: the sky
  std::uint8_t valid = 2;      // SurroundMap::valid
  bool ended = false;
};

// Whether a reflector or a surface on a ray's way is seen through rather than looked at.
inline bool is_glass(const Scene& scene, std::uint32_t triangle) {
  return scene.material_of(triangle).transmission >= 0.5f;
}

// Rays from one centre: of the object's own triangles and of what lies inside it they see what `view` says. Surfaces
// that let at least half of the light pass are walked through; the back of a one-sided surface ends a ray with no
// light.
class SurroundRays {
 public:
  // The arguments must outlive it.
  SurroundRays(const Accel& accel, const CurvedObject& object, const Vec3& centre, SurroundView view);

  // Along a unit direction, of what is no farther than `farthest`, m.
  SurroundSight look(const Vec3& direction, float farthest = std::numeric_limits<float>::max());
  std::uint64_t count() const { return count_; }

 private:
  enum class Own { kNo, kFront, kBack };
  Own own(const Hit& hit) const;
  float leaves_bounds(const Vec3& direction) const;
  void meet(const Hit& hit, const Vec3& p, const Vec3& direction, SurroundSight& sight) const;

  const Accel& accel_;
  const Scene& scene_;
  const CurvedObject& object_;
  Vec3 centre_;
  SurroundView view_;
  float nearest_;  // m
  std::uint64_t count_ = 0;
};

}  // namespace oriel
