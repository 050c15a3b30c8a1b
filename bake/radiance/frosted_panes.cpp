#include "bake/radiance/frosted_panes.h"

#include <algorithm>
#include <map>

#include "bake/trace/glass.h"
#include "bake/trace/planar_mirrors.h"

namespace oriel {
namespace {

// Of parts of bent panes: the player bends the light at each pixel's own normal.
constexpr double kMostBend = 0.35, kMostSag = 0.2;  // radians; of the square root of the area

constexpr float kNodes_m = 0.05f;       // what hides a sun has an edge
constexpr std::size_t kManyPanes = 64;  // then nodes are as far apart as of reflectors

bool any_light_before(const Scene& scene, const DVec3& normal, double offset) {
  return std::ranges::any_of(scene.lights, [&](const Light& light) {
    if (light.type != LightType::kDirectional) return glm::dot(normal, DVec3(light.position)) > offset;
    return glm::dot(normal, DVec3(light.direction)) < std::sin(double{light.angular_radius_rad});
  });
}

// Whether eyes that see its dark side see it through another frosted pane close by: that one shows the glow.
bool is_covered(const Accel& accel, const FoundReflector& pane) {
  constexpr float kSheets_m = 0.05f;  // between the sheets of one pane, at most
  const Scene& scene = accel.scene();
  const Vec3 dark = -Vec3(pane.reflector.pack_from_reflector[2]);
  const auto larger = [&](std::uint32_t a, std::uint32_t b) {
    return triangle_area(scene, a) < triangle_area(scene, b);
  };
  const std::uint32_t t = *std::ranges::max_element(pane.triangles, larger);
  const Hit hit = accel.intersect({spawn_origin(scene, t, Vec2(1.0f / 3), dark), dark, kSheets_m});
  return hit && may_be_frosted(scene.material_of(hit.triangle));
}

// Frosted surfaces that are in no flat pane.
std::vector<PlanarPatch> bent_parts(const Scene& scene, const PlanarMirrors& flat, std::vector<std::string>& omitted) {
  const std::vector<char> is_flat = flat.triangles_of(scene);
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const bool second_twin = !scene.twin.empty() && scene.twin[t] < t;
    const bool still = scene.surfaces[scene.triangle_surface[t]].mover < 0;
    if (may_be_frosted(scene.material_of(t)) && still && !second_twin && (is_flat.empty() || !is_flat[t]))
      triangles.push_back(t);
  }
  if (triangles.empty()) return {};
  PatchOptions options;
  options.max_angle_rad = kMostBend, options.relative_distance = kMostSag;
  options.max_distance_m = scene.radius(), options.min_area_m2 = 0;
  std::vector<PlanarPatch> parts = find_planar_patches(scene, triangles, options);
  if (parts.size() > kMostBentPanes)
    omitted.push_back(
        fmt::format("{} of {} parts of bent frosted panes, the smallest: points, spots and suns behind "
                    "them do not show in them",
                    parts.size() - kMostBentPanes, parts.size()));
  parts.resize(std::min(parts.size(), kMostBentPanes));
  omitted.emplace_back(
      "frosted glass that is bent, has a normal map or a texture of roughness: light of points, spots and "
      "suns passes it straight; the glass itself glows");
  return parts;
}

// The triangles of one material in a plane that may be of several, with their twins.
std::map<std::uint32_t, PlanarPatch> by_material(const Scene& scene, const PlanarPatch& side) {
  std::map<std::uint32_t, PlanarPatch> patches;
  for (const std::uint32_t t : side.triangles) {
    PlanarPatch& patch = patches[scene.surfaces[scene.triangle_surface[t]].material];
    patch.triangles.push_back(t);
    if (!scene.twin.empty() && scene.twin[t] != ~0u) patch.triangles.push_back(scene.twin[t]);
    patch.area_m2 += triangle_area(scene, t);
  }
  for (auto& [material, patch] : patches) {
    std::ranges::sort(patch.triangles);
    patch.normal = side.normal, patch.offset = side.offset, patch.flatness_m = side.flatness_m;
  }
  return patches;
}

}  // namespace

Result<std::vector<FoundReflector>> find_lit_panes(const Accel& accel, Context& context, std::vector<Emitter>& emitters,
                                                   std::vector<std::string>& omitted) {
  const Scene& scene = accel.scene();
  std::vector<FoundReflector> panes;
  if (scene.lights.empty()) return panes;
  const auto add = [&](const PlanarPatch& side, bool front) {
    const double sign = front ? 1 : -1;
    if (!any_light_before(scene, sign * side.normal, sign * side.offset)) return;
    for (const auto& [material, patch] : by_material(scene, side)) {
      FoundReflector pane = make_reflector(scene, patch, front);
      if (!is_covered(accel, pane)) panes.push_back(std::move(pane));
    }
  };
  const PlanarMirrors flat = PlanarMirrors::frosted_panes(scene);
  for (std::size_t m = 0; m < flat.size(); ++m)
    add({flat[m].triangles, flat[m].normal, flat[m].offset, flat[m].area_m2, 0}, true);
  for (const PlanarPatch& part : bent_parts(scene, flat, omitted))
    for (const bool front : {true, false}) add(part, front);
  // As mirrors they list what has no surface.
  const std::vector<float> lobe_widths(scene.materials.size(), 0.0f);
  EmitterOptions options{.lobe_widths = lobe_widths, .squares_turn = true};
  if (panes.size() <= kManyPanes) options.node_m = kNodes_m;
  ORIEL_TRY_VOID(leave_out_emitters(accel, options, context, {panes, emitters, omitted}));
  std::erase_if(panes, [](const FoundReflector& pane) { return pane.reflector.emitters.empty(); });
  for (FoundReflector& pane : panes)  // rays meet either twin, but it is drawn once
    std::erase_if(pane.triangles, [&](std::uint32_t t) { return !scene.twin.empty() && scene.twin[t] < t; });
  return panes;
}

}  // namespace oriel
