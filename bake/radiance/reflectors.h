// Which parts of a scene are planar reflectors worth an image of their own (Bastos et al. 1999, section 8.1.3, models a
// handful of them per house: only what the scene requires).
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "bake/brdf/fresnel.h"
#include "bake/jobs/context.h"
#include "bake/radiance/patches.h"
#include "bake/trace/accel.h"
#include "formats/assets/fields.h"
#include "formats/assets/radiance_map.h"

namespace oriel {

// What the search must know of a material: averages over its textures.
struct ReflectorMaterial {
  float roughness = 1;
  Vec3 f0{0.04f};
  float f90 = 1;
  FresnelCurve curve = {};
};
inline void fields(Archive& archive, ReflectorMaterial& o) {
  archive(o.roughness, o.f0, o.f90, o.curve.ior, o.curve.schlick, o.curve.metal);
}

// R at 60 degrees, largest channel.
float reflectance_at_60_deg(const ReflectorMaterial& material);

// What sizes are multiplied by in a scene of that radius, m: below 2 m it is no building but a model of things, and
// their own size counts.
inline float small_scene(float radius) {
  return std::min(1.0f, radius / 2);
}

struct ReflectorOptions {
  float max_roughness = 0.5f;         // of planar ones: wider lobes show no image
  float min_reflectance = 0.03f;      // at 60°, largest channel: weaker ones are not seen
  float min_area_m2 = 0.25f;          // of one reflector; times small_scene()²
  std::uint32_t max_reflectors = 32;  // the largest by reflectance * area * (1 - roughness) are kept
  float max_angle_deg = 0.5f;         // of a triangle's normal from its reflector's
  float flatness = 1e-4f;       // largest distance of a vertex from the plane, in scene radii; and at most 1e-3 of the
                                // reflector's own size
  float min_open_share = 0.1f;  // of directions into which it sees something further away than a tenth of its size
};
inline void fields(Archive& archive, ReflectorOptions& o) {
  archive(o.max_roughness, o.min_reflectance, o.min_area_m2, o.max_reflectors, o.max_angle_deg, o.flatness,
          o.min_open_share);
}

// How the player makes what a planar reflector shows: it draws the mirrored scene, or has radiance maps.
enum class ReflectorWay { kGeometry, kMaps };

struct FoundReflector {
  Reflector reflector;                   // indices, elements and maps are left empty
  std::vector<std::uint32_t> triangles;  // into Scene::triangles, ascending
  float reflectance = 0;                 // as compared with min_reflectance
  float roughness = 0;
  float shown_sr = 0;                   // solid angle that it fills for an eye that sees it, mean; 0: not known
  std::vector<std::uint32_t> emitters;  // triangles whose own light its image leaves out, ascending
  ReflectorWay way = ReflectorWay::kMaps;
  std::string why;  // that way
};

inline void fields(Archive& archive, FoundReflector& f) {
  archive(f.reflector, f.triangles, f.reflectance, f.roughness, f.shown_sr, f.emitters, f.way, f.why);
}

// One side of a patch, with the frame that find_reflectors() tells of.
FoundReflector make_reflector(const Scene& scene, const PlanarPatch& patch, bool front);

struct FoundReflectors {
  std::vector<FoundReflector> reflectors;  // most important first
  std::vector<Warning> omitted;            // what reflects but was left out, and why; one line each
  // Triangles whose material shows an image, but which lie in no planar patch that is large enough; ascending.
  std::vector<std::uint32_t> unplanar;
};

// Of reflectors in order of importance; says what is left out.
template <class Found>
void keep_first(std::size_t limit, const char* what, std::vector<Found>& list, std::vector<Warning>& omitted) {
  if (list.size() <= limit) return;
  omitted.push_back({fmt::format("{} {} ('{}' and others): less important than the {} kept", list.size() - limit, what,
                                 list[limit].reflector.name, limit),
                     "no-reflections"});
  list.resize(limit);
}

// Coplanar triangles of one material in parts of one name make a reflector, connected or not. Its frame: origin in the
// middle of its bounds, z the normal (area-weighted mean), x, y the tightest rectangle's axes, or those aligned with
// the world where that costs no more than 2 % of area; x along the longer side. A double-sided surface reflects on each
// side from which it can be seen. The order depends on the scene only. materials: one entry for each of the scene's.
FoundReflectors find_reflectors(const Accel& accel, std::span<const ReflectorMaterial> materials,
                                const ReflectorOptions& options = {});

}  // namespace oriel
