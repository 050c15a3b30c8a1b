// The reflection of a shading point: Lambert, a GGX lobe with exact Fresnel, a clear coat, and transmission: thin and
// straight, or refraction at the surface of solid glass (docs/notes/materials.md). Local space: z along the shading
// normal on the side that wo is on, x along the wide direction of an anisotropic lobe; wo and wi point away from the
// surface.
#pragma once

#include <optional>

#include "bake/trace/albedo.h"

namespace oriel {

enum class Lobe : std::uint8_t { kDiffuse, kSpecular, kTransmission, kRefraction };

struct BsdfSample {
  Vec3 wi{0, 0, 1};
  Vec3 weight{0};            // f * |cos θi| / pdf, lobe choice included
  float pdf = 0;             // per steradian of all lobes together; 0 where delta
  bool delta = false;        // no other strategy finds the direction
  float radiance_scale = 1;  // 1/η² in `weight` by refraction, which scales radiance but not power
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
  // A direction in proportion to the lobes' albedo. u: lobe choice; v: direction. Transmission is wi = -wo, delta;
  // refraction has wi below the horizon. Nothing where the surface is black or the sample falls below the horizon.
  std::optional<BsdfSample> sample(float u, const Vec2& v) const;
  // Of solid glass, met from outside: what it refracts towards wo, alone and in full. Nothing where it refracts none.
  std::optional<BsdfSample> refracted(const Vec2& v) const;
  // Of a thin pane: the direction, below the horizon, whose light its facets send to wo in place of what lies straight
  // behind. It is spread like reflected light, mirrored at the pane (KHR_materials_transmission).
  Vec3 spread(const Vec2& v) const;
  // The density per steradian with which spread() chooses wi; 0 above the horizon. Of a pane that is not frosted 0.
  float spread_pdf(const Vec3& wi) const;

 private:
  DVec3 facet(const Vec2& v) const;  // a normal of the base lobe that wo sees
  std::optional<BsdfSample> refract_at(const DVec3& h, const Vec3& weight) const;
  std::optional<BsdfSample> sample_inside(float u, const Vec2& v) const;

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
