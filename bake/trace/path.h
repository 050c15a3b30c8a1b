// The path tracer that the radiosity textures and the reference frames share.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>

#include "bake/trace/bsdf.h"
#include "bake/trace/dropped.h"
#include "bake/trace/lights.h"
#include "bake/trace/sampler.h"

namespace oriel {

struct PathOptions {
  int max_bounces = 4096;  // a guard: Russian roulette ends paths long before; fewer where time is short
  int roulette_from = 3;   // bounces that are never ended by chance
  // cd/m² that eyes see of white unlit surfaces, straight or by specular lobes; 0: none, they are seen through.
  float unlit_white = 0;
  bool frosted_panes = false;  // rough thin panes spread what eyes see through them, straight or in mirrors
};

class PathGroups;

// What a path needs to know of the scene.
struct Transport {
  const Accel& accel;
  const LightSet& lights;
  PathOptions options;
  PathGroups* grouped = nullptr;  // filled by one thread; null: light by group is not wanted
};

// A surface as a path meets it.
struct SurfacePoint {
  std::uint32_t triangle = 0;
  Vec2 barycentric{0};
  Vec3 position{0};
  float magnitude = 0;  // largest |coordinate| of the triangle: what position's rounding error is relative to
  Vec3 geometric_normal{0, 0, 1};  // unit, on the side of wo
  Vec3 normal{0, 0, 1};            // unit shading normal, on the side of wo
  float rounded = 0;               // height_of_rounded(), m; 0 where a map turns the normal
  Vec3 tangent{0};                 // along the wide direction of an anisotropic lobe; 0: any
  ShadePoint shade;
  bool front = true;      // wo is on the triangle's front side
  bool emits = false;     // towards wo
  bool reflects = false;  // towards wo: false for the back of a one-sided surface that is not solid glass

  const Vec3& horizon() const { return rounded > 0 ? normal : geometric_normal; }  // of light that it reflects
};

// Everything but the shading parameters and `rounded`: cheap, no texture is read.
SurfacePoint geometry_at(const Scene& scene, const Hit& hit, const Vec3& direction);
// The surface at a hit, for light that leaves it against `direction` (unit, of the ray that hit). Textures are their
// means over what a cone of width_m around the ray meets of it.
SurfacePoint surface_at(const Scene& scene, const Hit& hit, const Vec3& direction, float width_m = 0);

// The surface as light meets it that falls straight on one side of it, as geometry_at().
SurfacePoint point_on_side(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric, bool front = true);

// The same with `rounded`, for which a ray is traced: surfaces that rays leave.
SurfacePoint surface_at(const Accel& accel, const Hit& hit, const Vec3& direction, float width_m = 0);
SurfacePoint point_on_side(const Accel& accel, std::uint32_t triangle, const Vec2& barycentric, bool front = true);

// Light of paths by light group (Scene::light_groups), one AOV a group. Paths that leave diffuse reflection to their
// caller fill it (trace_to_diffuse, specular_light).
class PathGroups {
 public:
  enum Kind { kEmitted, kSky, kScattered, kLamps };  // as PathLight's members

  // Clears the sums. weight: by Kind, a factor of the light that follows.
  void begin(std::size_t groups, const std::array<float, 4>& weight) {
    light_.assign(groups, Vec3(0));
    weight_ = weight;
  }
  void add(Kind kind, std::uint32_t group, const Vec3& light) {
    if (is_usable(light)) light_[group] += weight_[kind] * light;
  }
  std::span<const Vec3> light() const { return light_; }  // by group

 private:
  std::vector<Vec3> light_;
  std::array<float, 4> weight_{};
};

// The origin of a ray that leaves the surface.
inline Vec3 spawn_origin(const SurfacePoint& s, const Vec3& direction) {
  if (glm::dot(s.geometric_normal, direction) >= 0) return offset_origin(s.position, s.geometric_normal, s.magnitude);
  if (s.rounded > 0 && glm::dot(s.normal, direction) > 0)
    return offset_origin(s.position + s.rounded * s.geometric_normal, s.geometric_normal, s.magnitude);
  return offset_origin(s.position, -s.geometric_normal, s.magnitude);
}

struct PathLight {
  Vec3 emitted{0};    // by surfaces met directly, through glass and cut-outs only
  Vec3 sky{0};        // met so
  Vec3 scattered{0};  // after one reflection or more
  // Where diffuse vertices are told: of near lights (LightSample::near), and of suns by way of polished surfaces
  // (is_polished), after reflections that were all specular; not in `scattered`.
  Vec3 lamps{0};
  bool back_face = false;  // the first surface met was the back of a one-sided one
};

// Light arriving along a ray, all bounces: unbiased. With bsdf_pdf > 0, emission met directly is weighted against light
// sampling from ray.origin (balance heuristic, Veach 1997); with 0 it counts in full.
PathLight trace_path(const Transport& transport, const Ray& ray, float bsdf_pdf, Sampler& sampler, std::uint64_t& rays);

// A diffuse reflection met on the way of a ray: `weight` times irradiance over π adds to the radiance along the ray.
struct DiffuseVertex {
  std::uint32_t triangle = 0;
  Vec2 barycentric{0};
  bool front = true;   // the side that is seen
  float distance = 0;  // from where the path came last, m
  Vec3 weight{0};
};
// A value: the caller knows the irradiance there and takes the diffuse reflection over; from what else reflects the
// path goes on that many times as often as that is bright, less where little of its light is left. None: it follows it.
using OnDiffuse = std::function<std::optional<float>(const DiffuseVertex&)>;

// A ray, what it hits, and with which density it was chosen (as trace_path).
struct TracedRay {
  const Ray& ray;
  const Hit& hit;
  float bsdf_pdf = 0;
};
// As trace_path, but every diffuse surface on the way is told to the caller. Where that takes it over, the path goes on
// through mirrors, glossy lobes, glass and cut-outs only.
PathLight trace_to_diffuse(const Transport& transport, const TracedRay& traced, Sampler& sampler, std::uint64_t& rays,
                           const OnDiffuse& on_diffuse);

// Light reflected by a surface towards wo (unit, world), all bounces; its own emission and what it lets through
// excluded.
Vec3 reflected_light(const Transport& transport, const SurfacePoint& surface, const Vec3& wo, Sampler& sampler,
                     std::uint64_t& rays);

// Light that solid glass refracts towards wo, outside of it, or that a frosted pane lets through, all bounces; 0 of
// other surfaces.
Vec3 refracted_light(const Transport& transport, const SurfacePoint& surface, const Vec3& wo, Sampler& sampler,
                     std::uint64_t& rays);

// A surface and where it is seen from.
struct ReflectingPoint {
  const SurfacePoint& surface;
  const Vec3& wo;
};
// The part of what reflected_light() has that leaves by specular lobes. Diffuse reflection met on the way is left to
// the caller as in trace_to_diffuse(); the surface's own is not told. All of it is `scattered` or of `lamps`.
PathLight specular_light(const Transport& transport, const ReflectingPoint& seen, Sampler& sampler, std::uint64_t& rays,
                         const OnDiffuse& on_diffuse);

// One estimate of the irradiance at a point, lux: light sampling and a cosine-distributed ray, combined by MIS.
struct IrradianceSample {
  Vec3 direct{0};    // straight from emitters, or of point, spot and directional lights by way of mirrors
  Vec3 indirect{0};  // after one reflection or more
  bool back_face = false;
  // Only where directional: the first moments of the incident luminance L, ∫ L dω / 4π and ∫ L ω dω / 4π.
  float mean = 0;
  Vec3 vector{0};
};
// directional: fills mean and vector too. Their integrands lack the cosine, so that rays of cosine density would give
// them unbounded weights: half of the density is uniform then, for a tenth more variance of an even light's irradiance.
IrradianceSample sample_irradiance(const Transport& transport, const SurfacePoint& surface, Sampler& sampler,
                                   std::uint64_t& rays, bool directional = false);

}  // namespace oriel
