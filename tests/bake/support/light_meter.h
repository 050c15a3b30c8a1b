// Irradiance by paths at points that lie on no surface, and what shines there.
#pragma once

#include "bake/trace/path.h"

namespace oriel::test {

inline Light point_light(const Vec3& position, float cd = 100) {
  Light light;
  light.position = position;
  light.intensity = Vec3(cd);
  return light;
}

class LightMeter {
 public:
  explicit LightMeter(Scene scene) : scene_(std::move(scene)), accel_(*Accel::build(scene_)), lights_(scene_) {}
  // At p on a plane with normal n, straight and after reflections.
  DVec3 at(const Vec3& p, const Vec3& n, std::uint32_t samples = 64) const {
    SurfacePoint s;
    s.position = p, s.normal = s.geometric_normal = n, s.magnitude = 1;
    DVec3 sum(0);
    for (std::uint32_t k = 0; k < samples; ++k) {
      Sampler sampler(1, 0, k);
      const IrradianceSample e = sample_irradiance({accel_, lights_, {}}, s, sampler, rays);
      sum += DVec3(e.direct) + DVec3(e.indirect);
    }
    return sum / double(samples);
  }
  const LightSet& lights() const { return lights_; }
  const Accel& accel() const { return accel_; }
  mutable std::uint64_t rays = 0;

 private:
  Scene scene_;
  Accel accel_;
  LightSet lights_;
};

}  // namespace oriel::test
