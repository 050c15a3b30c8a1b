// What is likely wrong with a scene, before hours are spent on it: each finding with what would mend it.
#pragma once

#include "bake/run/options.h"
#include "bake/run/prepare.h"
#include "bake/visibility/view_shares.h"

namespace oriel {

// Numbers are stable: scripts may switch on them.
enum class FindingKind {
  kOneSidedWall = 1,  // seen from behind by people: nothing is drawn there
  kLightmapUv = 2,    // --atlas uv1: coordinates overlap or are missing
  kFlippedNormals = 3,
  kAlbedo = 4,         // reflects more than anything real
  kLightUnits = 5,     // brighter or dimmer than light in candela, lux or cd/m² is
  kFarFromOrigin = 6,  // coordinates too coarse for the texels
  kTexelDensity = 7,   // far more, or larger, texels than make sense
  kDegenerate = 8,     // triangles without area, copies of triangles, edges of more than two
  kNoLight = 9,
  kImport = 10,  // what else the importer warned of
};

struct Finding {
  FindingKind kind = FindingKind::kImport;
  std::string object;  // surface, material, light or option
  std::string found, expected, fix;
};

const char* name_of(FindingKind kind);  // "one-sided wall", …
// error: the light will be wrong where people look; warning: some of it may be; note: nothing of it is.
enum class FindingSeverity { kError, kWarning, kNote };
FindingSeverity severity_of(FindingKind kind);
const char* name_of(FindingSeverity severity);

// Findings that are known and taken: a kind by its name or number (D3), or one with its object, "one-sided
// wall:Curtain*", where * stands for any text and ? for any one character.
struct AllowedFinding {
  std::string kind, object = "*";
};
// A list of them, comma-separated, or @FILE with one a line (# begins a comment). Errors kUsage, kIo.
Result<std::vector<AllowedFinding>> parse_allowed(const std::string& text);
bool is_allowed(const Finding& finding, std::span<const AllowedFinding> allowed);

// What warnings of the importer and the atlas mean.
std::vector<Finding> findings_of_import(std::span<const Warning> warnings);
// Punctual lights, emitters and the sum of all of them beside the area that they light, m².
void check_lights(const Scene& scene, const LightSet& lights, double area_m2, std::vector<Finding>& findings);
// Surfaces of which the eyes see the back.
void check_walls(const Scene& scene, const ViewShares& views, std::vector<Finding>& findings);
void check_albedos(const Scene& scene, std::span<const MaterialSummary> materials, std::vector<Finding>& findings);
// How fine the texels are asked for, beside positions, page and surfaces. area_m2: of all surfaces.
void check_texels(const Scene& scene, const AtlasOptions& atlas, double area_m2, std::vector<Finding>& findings);

}  // namespace oriel
