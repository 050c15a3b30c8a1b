// Everything that emits, sampled explicitly: emissive triangles, point, spot and directional lights. The constant sky
// is left to cosine-distributed rays, which sample it best.
#pragma once

#include "bake/trace/accel.h"

namespace oriel {

struct LightSample {
  Vec3 direction{0, 0, 1};   // unit, from the point to the light
  float distance = 3.0e38f;  // that a shadow ray must go; may be <= 0 where the light touches the point
  Vec3 estimate{0};          // incident radiance over pdf; for delta lights the irradiance on a facing plane over the
                     // probability of picking that light. Times f·cosθ: an unbiased estimate of reflected light
  float pdf = 0;  // per steradian, including the choice of the light; 0 for delta lights
};

// Immutable; holds a reference to the scene.
class LightSet {
 public:
  explicit LightSet(const Scene& scene);

  bool empty() const { return picks_.empty(); }
  // Emitted power per channel, lm: emissive triangles, point and spot lights. Not the sky, not directional lights.
  DVec3 power() const { return power_; }

  // One light in proportion to its power and one point on it, seen from p. u picks the light, v the point. An estimate
  // of 0 where that point cannot shine on p.
  LightSample sample(const Vec3& p, float u, const Vec2& v) const;
  // Scene::lights[light] alone, probability of choice 1.
  LightSample sample_light(std::uint32_t light, const Vec3& p, const Vec2& v) const;
  // The density per steradian with which sample() chooses, from p, the point `on` of an emissive triangle with that
  // unit normal (either side); 0 for triangles that are not sampled.
  float pdf(const Vec3& p, std::uint32_t triangle, const Vec3& on, const Vec3& normal) const;

 private:
  struct Pick {
    bool punctual;
    std::uint32_t index;  // of a triangle or of Scene::lights
    float probability;
    Vec3 normal;        // of a triangle, front side
    float margin;       // of a triangle: see emitter_margin, metres
    bool double_sided;  // triangles
  };
  LightSample sample_triangle(const Pick& pick, const Vec3& p, const Vec2& v) const;
  LightSample sample_punctual(const Pick& pick, const Vec3& p) const;
  void add(const Pick& pick, double weight);

  const Scene* scene_;
  std::vector<Pick> picks_;
  std::vector<double> cdf_;          // cumulative weights, unnormalised until the constructor's end
  std::vector<float> triangle_pdf_;  // by triangle: probability of its pick over its area, per m²; empty: no emitter
  DVec3 power_{0};
};

}  // namespace oriel
