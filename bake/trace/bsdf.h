// The reflection of a shading point: Lambert, a GGX lobe with exact Fresnel, a clear coat and thin straight
// transmission (docs/materials.md). Local space: z along the shading normal on the side that wo is on, x along the wide
// direction of an anisotropic lobe; wo and wi point away from the surface.
#pragma once

#include <optional>

#include "bake/trace/albedo.h"

namespace oriel {

enum class Lobe : std::uint8_t { kDiffuse, kSpecular, kTransmission };

struct BsdfSample {
  Vec3 wi{0, 0, 1};
  Vec3 weight{0};  // f * |cos θi| / pdf, lobe choice included
  float pdf = 0;   // per steradian of all lobes together; 0 where delta
  bool delta = false;
  Lobe lobe = Lobe::kDiffuse;
};

// What a point reflects towards wo. Refers to the point; what its lobes leave to each other is found once.
class Bsdf {
 public:
  Bsdf(const ShadePoint& point, const Vec3& wo);

  // f * cos θi, delta lobes excluded. 0 where wi or wo is below the horizon.
  Vec3 eval(const Vec3& wi) const;
  // Density of sample() choosing wi, delta lobes excluded.
  float pdf(const Vec3& wi) const;
  // A direction in proportion to the lobes' albedo. u: lobe choice; v: direction. Transmission is wi = -wo, delta.
  // Nothing where the surface is black or the sample falls below the horizon.
  std::optional<BsdfSample> sample(float u, const Vec2& v) const;

 private:
  // The lobes as wo sees them: probabilities in proportion to their albedo, sum 1 or all 0; and what each one leaves to
  // those below it.
  struct LobeChoice {
    float diffuse = 0, specular = 0, coat = 0, transmission = 0;
    float under_coat = 1;     // 1 - coat R_c
    float diffuse_scale = 1;  // (1 - coat R_c) (1 - max R)
  };
  static LobeChoice choose_lobes(const ShadePoint& point, float cos_o);

  const ShadePoint& point_;
  Vec3 wo_;
  LobeChoice lobes_;
};

}  // namespace oriel
