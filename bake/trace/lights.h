// Everything that emits, sampled explicitly: emissive triangles, point, spot and directional lights, the constant sky.
#pragma once

#include "bake/trace/accel.h"

namespace oriel {

struct LightSample {
  Vec3 direction{0};       // unit, from the point to the light
  float distance = 3.0e38f;
  Vec3 radiance_over_pdf{0};  // incident radiance divided by the density below; for delta lights the irradiance on a
                              // facing plane divided by the probability of picking that light
  float pdf = 0;           // per steradian, including the choice of the light; 0 for delta lights
};

class LightSet {
 public:
  explicit LightSet(const Scene& scene);

  bool empty() const { return picks_.empty(); }
  // Emitted power, lm where radiance is in cd/m²: emissive triangles, point and spot lights; per channel.
  DVec3 power() const { return power_; }

  // One light in proportion to its power and one point on it, seen from p. u picks the light, v the point.
  LightSample sample(const Vec3& p, float u, const Vec2& v) const;
  // The density with which sample() would choose `direction` towards that hit of an emissive triangle.
  float pdf(const Vec3& p, const Hit& hit, const Vec3& direction) const;
  // The same for a ray that leaves the scene, 0 where the sky is black.
  float sky_pdf() const;

 private:
  enum class Kind : std::uint8_t { kTriangle, kPunctual, kSky };
  struct Pick {
    Kind kind;
    std::uint32_t index;
    float probability;
  };
  const Scene* scene_;
  std::vector<Pick> picks_;
  std::vector<float> cdf_;
  std::vector<float> triangle_pdf_;  // by triangle: probability of the pick over its area, 0 for the others
  float sky_probability_ = 0;
  DVec3 power_{0};
};

}  // namespace oriel
