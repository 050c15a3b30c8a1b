#include "bake/radiance/frosted_panes.h"

#include <algorithm>
#include <map>

#include "bake/trace/planar_mirrors.h"

namespace oriel {
namespace {

bool any_light_before(const Scene& scene, const PlanarMirror& side) {
  return std::ranges::any_of(scene.lights, [&](const Light& light) {
    if (light.type != LightType::kDirectional) return side.height(DVec3(light.position)) > 0;
    return glm::dot(side.normal, DVec3(light.direction)) < std::sin(double{light.angular_radius_rad});
  });
}

// The triangles of one material in a plane that may be of several.
std::map<std::uint32_t, PlanarPatch> by_material(const Scene& scene, const PlanarMirror& side) {
  std::map<std::uint32_t, PlanarPatch> patches;
  for (const std::uint32_t t : side.triangles) {
    PlanarPatch& patch = patches[scene.surfaces[scene.triangle_surface[t]].material];
    patch.triangles.push_back(t);
    if (!scene.twin.empty() && scene.twin[t] != ~0u) patch.triangles.push_back(scene.twin[t]);
    patch.area_m2 += triangle_area(scene, t);
  }
  for (auto& [material, patch] : patches) {
    std::ranges::sort(patch.triangles);
    patch.normal = side.normal, patch.offset = side.offset;
  }
  return patches;
}

}  // namespace

Result<std::vector<FoundReflector>> find_lit_panes(const Accel& accel, Context& context, std::vector<Emitter>& emitters,
                                                   std::vector<std::string>& omitted) {
  const Scene& scene = accel.scene();
  std::vector<FoundReflector> panes;
  if (scene.lights.empty()) return panes;
  const PlanarMirrors sides = PlanarMirrors::frosted_panes(scene);
  for (std::size_t m = 0; m < sides.size(); ++m) {
    if (!any_light_before(scene, sides[m])) continue;
    for (const auto& [material, patch] : by_material(scene, sides[m]))
      panes.push_back(make_reflector(scene, patch, true));
  }
  // As mirrors they list what has no surface.
  const std::vector<float> lobe_widths(scene.materials.size(), 0.0f);
  ORIEL_TRY_VOID(leave_out_emitters(accel, {.lobe_widths = lobe_widths}, context, {panes, emitters, omitted}));
  std::erase_if(panes, [](const FoundReflector& pane) { return pane.reflector.emitters.empty(); });
  for (FoundReflector& pane : panes)  // rays meet either twin, but it is drawn once
    std::erase_if(pane.triangles, [&](std::uint32_t t) { return !scene.twin.empty() && scene.twin[t] < t; });
  return panes;
}

}  // namespace oriel
