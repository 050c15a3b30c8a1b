#include "bake/visibility/view_importance.h"

#include "bake/jobs/units.h"
#include "bake/scene/shade.h"
#include "bake/trace/path.h"
#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint64_t kSeed = 0x7e1e5;
constexpr int kPanes = 4;             // that a ray goes on through
constexpr float kMirrorAlpha = 0.1f;  // a wider lobe shows no image that texels could be told apart in

struct Sight {
  std::uint32_t triangle = 0;
  float distance = 0;
};
void fields(Archive& archive, Sight& sight) {
  archive(sight.triangle, sight.distance);
}

std::vector<Vec3> eyes_of(const EyeRegion& region, const Scene& scene, std::uint32_t count, std::uint64_t seed) {
  std::vector<Vec3> eyes = sample_eyes(region, count, seed);
  if (!region.grids.empty() || !region.points.empty()) return eyes;
  const Vec3 middle = 0.5f * (scene.lower + scene.upper);
  for (std::uint32_t i = 0; i < count; i += 2)
    eyes[i] = middle + 2 * scene.radius() * square_to_sphere(Sampler(mix64(seed + kSeed), 0, i).next2());
  return eyes;
}

// What one ray meets on its way: surfaces, panes that it goes on through, and one mirror that turns it. A pane or a
// mirror that only lets a part of the light through does so to as many rays.
void follow(const Accel& accel, Ray ray, Hit hit, Sampler& sampler, std::vector<Sight>& out) {
  const Scene& scene = accel.scene();
  bool mirrored = false;
  float way = 0;
  for (int step = 0; hit; ++step) {
    way += hit.distance;
    out.push_back({hit.triangle, way});
    const SceneMaterial& material = scene.material_of(hit.triangle);
    const bool may_mirror = !mirrored && !material.unlit && material.roughness * material.roughness <= kMirrorAlpha;
    if (step == kPanes || !(may_mirror || may_transmit(material))) return;
    const SurfacePoint surface = surface_at(scene, hit, ray.direction);
    const float chance = sampler.next1(), passed = luminance(transmittance_at(scene, hit.triangle, hit.barycentric));
    if (chance < passed) {
      ray = {spawn_origin(surface, ray.direction), ray.direction};
    } else if (may_mirror && surface.reflects && surface.shade.alpha <= kMirrorAlpha &&
               chance - passed < luminance(surface.shade.f0)) {
      const Vec3 turned = glm::reflect(ray.direction, surface.geometric_normal);
      ray = {spawn_origin(surface, turned), turned};
      mirrored = true;
    } else {
      return;
    }
    hit = accel.intersect(ray);
  }
}

}  // namespace

Result<ViewImportance> find_view_importance(const Accel& accel, const EyeRegion& region,
                                            const ViewImportanceOptions& options, Context& context) {
  const Scene& scene = accel.scene();
  const std::vector<Vec3> eyes = eyes_of(region, scene, options.eyes, context.seed);
  const bool anywhere = region.grids.empty() && region.points.empty();
  const float nearest = anywhere ? std::min(options.nearest_m, 0.1f * scene.radius()) : options.nearest_m;
  std::vector<std::vector<Sight>> seen(eyes.size());
  UnitLoop loop{.stage = "importance", .count = eyes.size(), .rays = 2.0 * options.directions};
  loop.inputs = [&](std::size_t e, Archive& key) { key(e, eyes[e], options.directions, nearest); };
  loop.compute = [&](std::size_t e) {
    std::vector<Ray> rays;
    std::vector<Hit> hits(options.directions);
    for (std::uint32_t k = 0; k < options.directions; ++k)
      rays.push_back({eyes[e], square_to_sphere(Sampler(mix64(context.seed + kSeed), e + 1, k).next2())});
    accel.intersect(rays, hits);
    for (std::uint32_t k = 0; k < options.directions; ++k) {
      Sampler sampler(mix64(context.seed + ~kSeed), e + 1, k);
      follow(accel, rays[k], hits[k], sampler, seen[e]);
    }
    for (Sight& sight : seen[e]) sight.distance = std::max(sight.distance, nearest);
    return std::uint64_t{options.directions} + seen[e].size();
  };
  loop.results = [&](std::size_t e, Archive& archive) { archive(seen[e]); };
  ORIEL_TRY_VOID(parallel_units(context, loop));
  ViewImportance importance;
  importance.triangles.resize(scene.triangles.size());
  importance.rays = static_cast<double>(eyes.size()) * options.directions;
  for (const auto& of_eye : seen)
    for (const Sight& sight : of_eye) {
      TriangleView& triangle = importance.triangles[sight.triangle];
      triangle.pixels += 1;
      triangle.inverse_square += 1 / (sight.distance * sight.distance);
    }
  return importance;
}

}  // namespace oriel
