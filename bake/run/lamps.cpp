#include "bake/run/lamps.h"

#include <algorithm>

#include "bake/transfer/bright_lights.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

// A field that says nothing but where lamps are: probes inside walls, without light.
LightField field_without_light(const Scene& scene) {
  LightField field;
  field.bands = 2, field.depth_side = 2, field.depth_cap_m = 1;
  field.lower = scene.lower;
  field.cell_m = glm::max(scene.upper - scene.lower, Vec3(1e-3f));
  field.size = {1, 1, 1};
  field.cells.resize(1);
  for (std::uint32_t corner = 0; corner < 8; ++corner) {
    field.cells[0].probes[corner] = corner;
    LightProbe probe;
    probe.position = field.lower + field.cell_m * Vec3(corner & 1, corner >> 1 & 1, corner >> 2);
    probe.sh.assign(3 * 2 * 2, 0);
    probe.depth.assign(2 * 2, Vec2(1));
    field.probes.push_back(std::move(probe));
  }
  return field;
}

bool same_lamp(const BrightLight& a, const BrightLight& b) {
  return a.kind == b.kind && a.name == b.name && a.corners == b.corners && a.position == b.position &&
         a.direction == b.direction && a.intensity == b.intensity;
}

bool shines(const Scene& scene, std::uint32_t triangle) {
  return luminance(scene.material_of(triangle).emission) > 0;
}

// What shines and is no bright light.
void tell_of_others(const Scene& scene, const BrightLights& all, std::vector<Warning>& omissions) {
  std::size_t triangles = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (shines(scene, t) && all.of_triangle(t) == nullptr) ++triangles;
  if (triangles > 0)
    omissions.emplace_back(
        fmt::format("light of {} emissive triangles: in no pass, textured or of more than 64 triangles", triangles));
  const auto profiled = std::ranges::count_if(scene.lights, [](const Light& light) { return light.profile >= 0; });
  if (profiled > 0) omissions.emplace_back(fmt::format("light of {} lamps with profiles: in no pass", profiled));
  if (luminance(scene.sky) > 0) omissions.emplace_back("light of the sky: in no pass, but for what surfaces reflect");
}

}  // namespace

Status check_lamps(const BakeTask& bake) {
  const std::size_t lamps = BrightLights(bake.accel(), bake.lights).choose_all();
  if (lamps <= kMaxBrightLights) return {};
  return fail(ErrorCode::kUsage, "--method diefenbach1997", "found {} lamps, expected at most {}: each is a pass",
              lamps, kMaxBrightLights);
}

Status list_lamps(const BakeTask& bake, std::vector<Warning>& omissions) {
  const Scene& scene = bake.scene();
  BrightLights all(bake.accel(), bake.lights);
  const std::size_t lamps = all.choose_all();
  LightField& field = bake.pack.light_field;
  if (field.bands == 0 && lamps > 0) field = field_without_light(scene);
  for (BrightLight& lamp : all.list())
    if (std::ranges::none_of(field.lights, [&](const BrightLight& known) { return same_lamp(known, lamp); }))
      field.lights.push_back(std::move(lamp));
  tell_of_others(scene, all, omissions);
  return {};
}

}  // namespace oriel
