// The path tracer that both the radiosity textures and the reference frames use.
#pragma once

#include <atomic>

#include "bake/trace/bsdf.h"
#include "bake/trace/lights.h"
#include "bake/trace/sampler.h"

namespace oriel {

struct PathOptions {
  int max_bounces = 64;          // a cut far beyond what matters; Russian roulette ends paths before it
  int roulette_from = 4;         // bounces that are never ended by chance
};

// Light that arrives along a ray, all bounces (unbiased but for max_bounces). Emission met directly is counted when
// bsdf_pdf is 0 (camera rays, delta lobes), else by multiple importance sampling against light sampling from
// `from` with density bsdf_pdf (balance heuristic).
Vec3 path_radiance(const Accel& accel, const LightSet& lights, const Ray& ray, float bsdf_pdf, Sampler& sampler,
                   const PathOptions& options, std::uint64_t& rays);

// Irradiance estimate at a point from one path: light sampling and a cosine-distributed ray combined by MIS. lux.
// n: unit shading normal; ng: unit geometric normal on the same side.
struct IrradianceSample {
  Vec3 direct{0};    // from emitters without a bounce
  Vec3 indirect{0};
  bool back_face = false;  // the ray met the back of a one-sided opaque surface
};
IrradianceSample path_irradiance(const Accel& accel, const LightSet& lights, const Vec3& p, const Vec3& n, const Vec3& ng,
                                 Sampler& sampler, const PathOptions& options, std::uint64_t& rays);

}  // namespace oriel
