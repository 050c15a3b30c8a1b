// Solid glass (KHR_materials_volume): refraction at its surfaces, and what it absorbs within (Beer and Lambert).
#pragma once

#include <optional>

#include "bake/brdf/specular.h"
#include "bake/scene/shade.h"
#include "bake/trace/accel.h"

namespace oriel {

// The cosine to the normal beyond a smooth surface, by Snell's law. eta: index beyond over index before, > 0;
// cos_theta in [0,1] before it. Nothing beyond the critical angle: all is reflected.
std::optional<double> refracted_cosine(double eta, double cos_theta);

// The unit direction beyond a facet with normal h that light towards wo (unit, dot(wo, h) > 0) comes from.
std::optional<DVec3> refract_about(const DVec3& wo, const DVec3& h, double eta);

// Whether facets spread what solid glass refracts there, or a coat takes of it on one side: then light is not weighted
// alike both ways through, and particles do not stand in for paths.
inline bool is_frosted(const ShadePoint& point) {
  return point.eta > 0 && (point.alpha >= kMirrorAlpha || point.coat > 0);
}

// Whether facets of a thin pane spread what is seen through it. Only eyes see that (PathOptions::frosted_panes): light
// is taken to pass straight, so that lamps behind frosted shades are found by shadow rays.
inline bool is_frosted_pane(const ShadePoint& point) {
  return !(point.eta > 0) && point.alpha >= kMirrorAlpha && max_component(point.transmission) > 0;
}

// Whether a material is thin glass whose facets spread what is seen through it, whole everywhere: by its factors.
inline bool may_be_frosted(const SceneMaterial& m) {
  constexpr float kLeastRoughness = 0.01f;
  const bool transmits = m.transmission > 0 && (m.metallic < 1 || m.metallic_roughness_texture.image >= 0);
  return transmits && !m.solid && m.metal == Metal::kNone && !m.unlit && m.alpha_mode == AlphaMode::kOpaque &&
         m.roughness >= kLeastRoughness;
}

// The glass that a path is in. Solids are taken to lie in air: of those that overlap the last one entered counts.
class Medium {
 public:
  // What is left of light along a ray that ended at `hit`. A ray that meets glass from within was in it all along,
  // wherever it came from.
  Vec3 passed(const Scene& scene, const Hit& hit) const;
  // The path goes on from a surface, beyond it or not.
  void leave(const ShadePoint& point, bool refracted) {
    if (point.eta > 0) inside_ = point.inside != refracted, absorption_ = point.absorption;
  }

 private:
  bool inside_ = false;
  Vec3 absorption_{0};  // 1/m
};

// Light that crosses solids unbent, as that of points, spots and suns is taken to (docs/notes/materials.md): surface by
// surface along one ray. A slab with parallel sides passes exactly what it would bent, and what its sides send to and
// fro between them.
class StraightGlass {
 public:
  // At any surface that lets light through, `distance` m from the last one; normal: unit, front side. What passes.
  Vec3 meet(const ShadePoint& point, bool front, const Vec3& normal, const Vec3& direction, float distance);
  // Of a ray that ends `distance` beyond the last surface: what it still loses.
  Vec3 end(float distance) const;

 private:
  Vec3 leave(const ShadePoint& point, const Vec3& normal, float cosine);

  bool inside_ = false;
  float length_ = 0;  // m since it was entered, or since the ray began
  Vec3 normal_{0};    // where it was entered
  Vec3 absorption_{0};
};

}  // namespace oriel
