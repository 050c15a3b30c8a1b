// Everything that emits, sampled explicitly: emissive triangles, point, spot and directional lights, and the image of a
// sky. A constant sky is left to cosine-distributed rays, which sample it best.
#pragma once

#include "bake/trace/accel.h"
#include "bake/trace/frosted_lights.h"
#include "bake/trace/light_tree.h"
#include "bake/trace/punctual.h"
#include "bake/trace/sky_sampler.h"
#include "bake/trace/virtual_lights.h"

namespace oriel {

struct LightSample {
  Vec3 direction{0, 0, 1};   // unit, from the point to the light
  float distance = 3.0e38f;  // that a shadow ray must go; may be <= 0 where the light touches the point
  Vec3 estimate{0};          // incident radiance over pdf; for delta lights the irradiance on a facing plane over the
                     // probability of picking that light. Times f·cosθ: an unbiased estimate of reflected light
  float pdf = 0;            // per steradian, including the choice of the light; 0 for delta lights
  bool near = false;        // an emissive triangle, a point or a spot
  bool sun = false;         // a directional light
  std::uint32_t group = 0;  // of lamps: into Scene::light_groups, or kSkyParts
};

// Immutable; holds a reference to the scene.
//
// A sample first chooses, evenly, among the kinds that the scene has: near lights (triangles, points, spots), which a
// light tree then chooses from; directional lights, by their illuminance; the sky image. A sun and a sky that a room
// sees through a window only thus never crowd out its lamps, nor the reverse.
//
// A directional light with an angular radius is sampled over its disk, uniformly. It counts as a delta light all the
// same (pdf 0): no ray can meet it, so light sampling alone answers for it, in full.
//
// What delta lights send by way of mirrors is no part of sample(): it is asked of mirrored(). Nor is what frosted panes
// spread of them, which frosted() has: shadow rays to them end at flat frosted panes (Ray::past_frosted).
class LightSet {
 public:
  // With an accelerator of the scene less is lost to lights that frosted panes do not see; only noise depends on it.
  explicit LightSet(const Scene& scene, const Accel* accel = nullptr);

  bool empty() const { return kinds_.empty(); }
  // Emitted power per channel, lm: emissive triangles, point and spot lights. Not the sky, not directional lights.
  DVec3 power() const { return power_; }

  // One light and one point on it, seen from p. u picks the light, v the point. An estimate of 0 where that point
  // cannot shine on p.
  LightSample sample(const Vec3& p, float u, const Vec2& v) const;
  // The density per steradian with which sample() chooses, from p, the point `on` of an emissive triangle with that
  // unit normal (either side); 0 for triangles that are not sampled.
  float pdf(const Vec3& p, std::uint32_t triangle, const Vec3& on, const Vec3& normal) const;
  // Whether sample() ever chooses a triangle: one whose texture is black wherever it was looked at emits unsampled.
  bool samples(std::uint32_t triangle) const { return !triangle_near_.empty() && triangle_near_[triangle] != ~0u; }
  // The density per steradian with which sample() chooses, from anywhere, a direction to the sky; 0 for a constant one.
  float pdf(const Vec3& direction) const;

  // Scene::lights[light] alone, as if it were chosen with probability 1.
  LightSample sample_light(std::uint32_t light, const Vec3& p, const Vec2& v) const;
  // The sky image alone, chosen with probability 1. For samples_sky() only, which is false for a constant or black sky.
  bool samples_sky() const { return !sky_.empty(); }
  LightSample sample_sky(const Vec2& v) const;
  float sky_pdf(const Vec3& direction) const { return sky_.pdf(direction); }
  // Point, spot and directional lights in planar mirrors, which no ray meets either.
  const VirtualLights& mirrored() const { return mirrored_; }
  const FrostedLights& frosted() const { return frosted_; }

 private:
  enum class Kind : std::uint8_t { kNear, kDirectional, kSky };
  struct Near {
    bool punctual;
    std::uint32_t index;  // of a triangle or of Scene::lights
    // Of a triangle:
    Vec3 normal;   // unit, front side
    float area;    // m²
    float margin;  // see emitter_margin, metres
    bool double_sided;
  };
  void add_triangles(std::vector<BoundedLight>& bounds);
  void add_lights(std::vector<BoundedLight>& bounds);
  LightSample sample_near(const Vec3& p, float u, const Vec2& v) const;
  LightSample sample_directional(const Vec3& p, float u, const Vec2& v) const;
  LightSample sample_triangle(const Near& near, const Vec3& p, const Vec2& v) const;

  const Scene* scene_;
  std::vector<Kind> kinds_;
  std::vector<Near> near_;
  LightTree tree_;                            // over near_
  std::vector<std::uint32_t> triangle_near_;  // by triangle: into near_, ~0u where it does not emit; empty: none does
  std::vector<std::uint32_t> directional_;    // into Scene::lights
  std::vector<double> directional_cdf_;       // cumulative illuminance
  SkySampler sky_;
  VirtualLights mirrored_;
  FrostedLights frosted_;
  DVec3 power_{0};
};

}  // namespace oriel
