#include <algorithm>
#include <array>

#include "bake/run/assemble.h"
#include "formats/pack/layout.h"
#include "formats/pack/validate.h"

namespace oriel {
namespace {

constexpr int kDirectionIssue = 304;  // of a lightmap page, which can do without directions

// Sections that mean something together only, and how a pack is without them.
struct Removable {
  const char* name;
  std::vector<std::uint32_t> kinds;
  void (*remove)(Pack&);
};

void remove_directions(Pack& pack) {
  for (LightmapPage& page : pack.lightmaps) page.direction.clear();
}

void remove_textures(Pack& pack) {
  pack.textures.clear();
  for (Material& m : pack.materials) m.base_color_texture = -1;
  pack.emission_textures.clear();
  pack.metalness.clear();
}

void remove_normal_textures(Pack& pack) {
  pack.normal_textures.clear();
  for (Material& m : pack.materials) m.normal_texture = -1;
}

void remove_reflectors(Pack& pack) {
  pack.reflectors.clear();
  pack.radiance_maps.clear();
  pack.map_meshes.clear();
  pack.emitters.clear();
  pack.frosted_panes.clear();
  pack.reflected_sets = {};
  for (LightGroup& group : pack.light_groups) group.reflectors.clear(), group.emitters.clear();
}

void remove_curved_reflectors(Pack& pack) {
  pack.curved_reflectors.clear();
  pack.surround_maps.clear();
  for (LightGroup& group : pack.light_groups) group.surrounds.clear();
}

void remove_kernels(Pack& pack) {
  pack.kernels.clear();
  for (Material& m : pack.materials) m.kernel = -1;
}

void remove_movers(Pack& pack) {
  pack.movers.clear();
  pack.light_field = {};
  for (LightGroup& group : pack.light_groups) group.probes.clear(), group.bright_lights.clear();
}

void remove_light_groups(Pack& pack) {
  pack.light_groups.clear();
  pack.day = {};
  pack.page_groups.clear();
}

void remove_walk_grids(Pack& pack) {
  pack.walk_grids.clear();
  pack.visible_sets = {};
  pack.reflected_sets = {};
}

const std::array<Removable, 15>& removables() {
  static const std::array<Removable, 15> kAll = {{
      {"directions of the lightmap", {}, remove_directions},
      {"textures", {kTextureSection}, remove_textures},
      {"normal maps", {kNormalTextureSection}, remove_normal_textures},
      {"solid glass", {kSolidSection}, [](Pack& pack) { pack.solids.clear(); }},
      {"emission textures", {kEmissionTextureSection}, [](Pack& pack) { pack.emission_textures.clear(); }},
      {"metalness", {kMetalnessSection}, [](Pack& pack) { pack.metalness.clear(); }},
      {"radiance maps",
       {kReflectorSection, kRadianceMapSection, kMapMeshSection, kEmitterSection, kFrostedPaneSection},
       remove_reflectors},
      {"surround maps", {kCurvedReflectorSection, kSurroundMapSection}, remove_curved_reflectors},
      {"kernels", {kKernelSection}, remove_kernels},
      {"cameras", {kCameraSection}, [](Pack& pack) { pack.cameras.clear(); }},
      {"camera paths", {kPathSection}, [](Pack& pack) { pack.paths.clear(); }},
      {"walk grids", {kWalkSection}, remove_walk_grids},
      {"visible sets",
       {kVisibleSetsSection, kReflectedSetsSection},
       [](Pack& pack) { pack.visible_sets = {}, pack.reflected_sets = {}; }},
      {"light groups", {kLightGroupSection, kPageGroupsSection, kDaySection}, remove_light_groups},
      {"movers", {kMoverSection, kLightFieldSection}, remove_movers},
  }};
  return kAll;
}

const Removable* find_removable(const Issue& issue) {
  if (issue.number == kDirectionIssue) return &removables().front();
  for (const Removable& r : removables())
    if (std::find(r.kinds.begin(), r.kinds.end(), issue.kind) != r.kinds.end()) return &r;
  return nullptr;
}

}  // namespace

Status leave_out_unsound(Pack& pack, std::vector<std::string>& left_out) {
  // What is removed may be what something else refers to: until nothing is wrong, at most once each.
  for (std::size_t round = 0; round <= removables().size(); ++round) {
    const std::vector<Issue> issues = validate(pack);
    const auto bad = std::find_if(issues.begin(), issues.end(),
                                  [](const Issue& issue) { return issue.severity == Severity::kError; });
    if (bad == issues.end()) return {};
    const Removable* part = find_removable(*bad);
    if (!part) return fail(ErrorCode::kRuntime, bad->section, "{}", bad->message);
    part->remove(pack);
    left_out.push_back(
        fmt::format("{}: left out, they fail the pack's checks: {}: {}", part->name, bad->section, bad->message));
  }
  return fail(ErrorCode::kRuntime, "pack", "fails its checks, whatever is left out");
}

}  // namespace oriel
