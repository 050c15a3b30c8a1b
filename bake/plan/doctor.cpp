#include "bake/plan/doctor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oriel {
namespace {

constexpr float kMostAlbedo = 0.9f;     // fresh snow; white paint has 0.85
constexpr double kCoarsestStep = 0.01;  // of positions, in texels
constexpr double kMostPages = 16;       // of texels
constexpr double kLeastTexels = 100;    // of a whole scene

struct ImportRule {
  WarningCode warning;
  FindingKind kind;
  const char *expected, *fix;
};
constexpr std::array kImportRules{
    ImportRule{"normals-behind", FindingKind::kFlippedNormals,
               "normals on the side from which corners run counter-clockwise",
               "recalculate normals outside (Blender: Shift+N) and export again"},
    ImportRule{"facing-apart", FindingKind::kFlippedNormals, "neighbouring triangles that face alike",
               "recalculate normals outside (Blender: Shift+N), or bake with --double-sided"},
    ImportRule{"degenerate-triangles", FindingKind::kDegenerate, "triangles with an area, each once",
               "merge by distance and delete degenerate faces"},
    ImportRule{"duplicate-triangles", FindingKind::kDegenerate, "triangles with an area, each once",
               "delete the copies"},
    ImportRule{"too-small", FindingKind::kDegenerate, "triangles larger than the rounding of where they stand",
               "merge by distance, or move the scene to its origin"},
    ImportRule{"shared-edges", FindingKind::kDegenerate, "edges of two triangles",
               "delete faces inside the body, or split it"},
    ImportRule{"uv1-faulty", FindingKind::kLightmapUv, "coordinates on which every triangle owns its texels",
               "unwrap it again, without overlap, into a second UV layer"},
    ImportRule{"uv1-moved", FindingKind::kLightmapUv, "charts apart from each other, at the scale of the others",
               "accept that they are packed anew, or pack them so where the file was made"},
    ImportRule{"unit-guessed", FindingKind::kImport, "numbers in metres, as glTF has them",
               "export in metres, or name the unit with --unit"},
    ImportRule{"eyes-guessed", FindingKind::kImport, "cameras, or rooms, as people of usual size have them",
               "place a camera where eyes are, or name their height with --eye-height"},
    ImportRule{"sky-added", FindingKind::kImport, "a sky beside the sun",
               "--sky none leaves it out; --sky FILE.hdr or --day DATE@LAT,LON gives another"},
};

// 'surface "wall": text' as "wall" and the text.
Finding split_warning(const std::string& warning) {
  Finding f;
  const std::size_t colon = warning.find(": ");
  f.object = colon == std::string::npos ? "file" : warning.substr(0, colon);
  f.found = colon == std::string::npos ? warning : warning.substr(colon + 2);
  return f;
}

}  // namespace

const char* name_of(FindingKind kind) {
  static const std::array names{
      "one-sided wall",  "lightmap coordinates", "flipped normals",      "albedo",   "units of light",
      "far from origin", "texel density",        "degenerate triangles", "no light", "import"};
  return names.at(static_cast<std::size_t>(kind) - 1);
}

std::vector<Finding> findings_of_import(std::span<const Warning> warnings) {
  std::vector<Finding> findings;
  for (const Warning& warning : warnings) {
    Finding f = split_warning(warning.text);
    const auto rule = std::find_if(kImportRules.begin(), kImportRules.end(),
                                   [&](const ImportRule& r) { return r.warning == warning.code; });
    const bool known = rule != kImportRules.end();
    f.kind = known ? rule->kind : FindingKind::kImport;
    f.expected = known ? rule->expected : "a file that is imported as it stands";
    f.fix = known ? rule->fix : "mend it where the file was made, or accept what is said";
    findings.push_back(std::move(f));
  }
  return findings;
}

void check_walls(const Scene& scene, const ViewShares& views, std::vector<Finding>& findings) {
  for (const SeenBack& seen : seen_backs(scene, views)) {
    const Surface& surface = scene.surfaces[seen.surface];
    findings.push_back({FindingKind::kOneSidedWall, surface.name,
                        fmt::format("{:.3g} % of what people see is its back, where nothing is drawn and light ends",
                                    100 * seen.share),
                        "walls that show their front wherever people are",
                        fmt::format("turn it over, mark material '{}' double-sided, or bake with --double-sided",
                                    scene.materials[surface.material].name)});
  }
}

void check_albedos(const Scene& scene, std::span<const MaterialSummary> materials, std::vector<Finding>& findings) {
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const float albedo = max_component(materials[m].diffuse);
    if (scene.materials[m].unlit || materials[m].area_m2 <= 0 || albedo <= kMostAlbedo) continue;
    findings.push_back({FindingKind::kAlbedo, scene.materials[m].name, fmt::format("diffuse albedo {:.3g}", albedo),
                        fmt::format("at most {:.2g}: white paint has 0.85, fresh snow 0.9", kMostAlbedo),
                        fmt::format("multiply its base colour by {:.2g}; bounces take {:.0f} times longer to fade than "
                                    "at 0.8",
                                    0.8 / albedo, std::min(1e3, std::log(0.8) / std::log(std::min(0.9999f, albedo))))});
  }
}

void check_texels(const Scene& scene, const AtlasOptions& atlas, double area_m2, std::vector<Finding>& findings) {
  const glm::dvec3 a = glm::abs(scene.origin);
  const double distance = std::max({a.x, a.y, a.z});
  const double texel = atlas.resolution > 0 ? std::sqrt(area_m2) / atlas.resolution : atlas.texel_m;
  if (const double step = distance * 0x1p-23; step > kCoarsestStep * texel)
    findings.push_back(
        {FindingKind::kFarFromOrigin, "scene",
         fmt::format("{:.4g} m from the origin, where 32-bit coordinates step by {:.2g} mm", distance, 1000 * step),
         fmt::format("steps of at most {:.2g} mm, a hundredth of a texel", 10 * texel),
         "move the scene to its origin before it is exported"});
  const double texels = area_m2 / (texel * texel), page = double{1.0f * atlas.max_page} * atlas.max_page;
  if (texels > kMostPages * page)
    findings.push_back(
        {FindingKind::kTexelDensity, "--texel",
         fmt::format("{:.3g} m asks for {:.3g} million texels", texel, texels * 1e-6),
         fmt::format("at most {:.3g} million: {} pages of {}²", kMostPages * page * 1e-6, kMostPages, atlas.max_page),
         fmt::format("--texel {:.2g}m", std::sqrt(area_m2 / (kMostPages * page)))});
  if (texels < kLeastTexels)
    findings.push_back(
        {FindingKind::kTexelDensity, "--texel", fmt::format("{:.3g} m gives {:.0f} texels in all", texel, texels),
         fmt::format("at least {:.0f}: a scene of {:.3g} m² shows no shadow otherwise", kLeastTexels, area_m2),
         fmt::format("--texel {:.2g}m, and see that the scene is in metres", std::sqrt(area_m2 / 1e4))});
}

}  // namespace oriel
