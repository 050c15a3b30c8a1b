// Everything that a user can ask of a bake, and how its values are written.
#pragma once

#include <filesystem>
#include <string>

#include "bake/atlas/atlas.h"
#include "bake/import/import.h"
#include "bake/material/materials.h"
#include "bake/radiance/curved_reflectors.h"
#include "bake/radiance/planned_views.h"
#include "bake/radiance/reflectors.h"
#include "bake/radiance/ways.h"
#include "bake/radiosity/radiosity.h"
#include "bake/run/light_groups.h"
#include "bake/transfer/compress.h"
#include "bake/transfer/probes.h"
#include "bake/visibility/eye_region.h"
#include "bake/visibility/find_sets.h"

namespace oriel {

// Whether the lightmap holds directions: where a normal map wants them, always, never.
enum class Directional { kAuto, kOn, kOff };

// Whether what is seen from where is found: where it is likely to pay, always, never.
enum class VisibleSetsWanted { kAuto, kOn, kOff };

inline constexpr double kBestError = 1e-3;  // where only time limits the work

struct BakeOptions {
  // In options.cpp, so that not every file compiles them.
  BakeOptions();
  ~BakeOptions();
  BakeOptions(const BakeOptions&);
  BakeOptions(BakeOptions&&) noexcept;
  BakeOptions& operator=(const BakeOptions&);
  BakeOptions& operator=(BakeOptions&&) noexcept;

  std::vector<std::string> given;  // long names of options that the command line has
  std::vector<std::string> words;  // of a command line that gives those options of bake_options() that were given
  std::filesystem::path scene;     // .glb or .gltf
  std::filesystem::path output;    // .oriel
  ImportOptions import;
  bool guess_unit = true;  // where the scene's numbers cannot be metres (visibility/scene_unit.h)
  AtlasOptions atlas;
  std::uint64_t memory_bytes = 0;  // of the whole bake; 0: no limit
  bool memory_given = false;       // by the user: else it is the machine's, and not recorded
  bool choose_texel = false;       // from what people see and how far (view_demand.h), instead of atlas.texel_m
  LightGroupOptions light_groups;
  RadiosityOptions radiosity;  // radiosity.directional follows from the next
  Directional directional = Directional::kAuto;
  ReflectorOptions reflectors;
  WaysWanted ways = WaysWanted::kAuto;
  DrawnOn target = DrawnOn::kCpu;
  PlannedViewOptions planned;
  EyeOptions eyes;
  bool error_named = false;      // by the user: else radiosity.error is a wish
  bool guess_eye_height = true;  // of people over the floor: told from the file (visibility/eye_height.h), instead of
  float eye_height_m = 1.6f;
  VisibleSetsWanted visible_sets = VisibleSetsWanted::kAuto;
  VisibilityOptions visibility;
  SightOptions sight;
  CurvedOptions curved;
  MaterialOptions material;
  TransferOptions transfer;
  CompressOptions compress;
  ProbeOptions probes;        // bands: those of transfer
  bool with_transfer = true;  // movers move; else they stand still in the scene
  bool with_radiance = true;  // radiance maps behind reflectors
  bool with_material = true;  // kernels; Fresnel maps are always there, the diffuse part needs them too
  double time_s = 0;  // wall clock of the whole bake (time_budget.h); 0: no limit. The bytes then depend on the machine
  bool reproducible = false;  // the same bytes on every CPU type
};

// Lengths, bytes and shares: formats/core/text.h.
// "30s", "10min" or "2h" as seconds; a unit is required. Error kUsage.
Result<double> parse_duration(const std::string& text);
// "10%" or "off" as a fraction, >= 0. Error kUsage.
Result<double> parse_verify(const std::string& text);
// "walk", "box", or a file for parse_eyes(), which is read. Errors kUsage, kIo, kInvalid.
Result<EyeOptions> parse_eye_source(const std::string& text);
// "100" (grey) or "90,95,100" (linear Rec. 709), >= 0. Error kUsage.
Result<Vec3> parse_color(const std::string& text);
// "2" or "lamp*=2". Error kUsage.
Result<LightScale> parse_light_scale(const std::string& text);
// What --sky takes, "auto", "none", "2000", "90,95,100" or "sky.exr", as ImportOptions::sky, ::sky_file and
// ::clear_sky. Error kUsage.
struct SkyChoice {
  Vec3 radiance{0};
  std::filesystem::path file;
  bool clear = false;
};
Result<SkyChoice> parse_sky(const std::string& text);
// "lamp=profile.ies": the first = divides. Error kUsage.
Result<std::pair<std::string, std::filesystem::path>> parse_ies_option(const std::string& text);

inline constexpr std::uint32_t kMostTexelRays = 4096;  // a texel, where an error is asked for

}  // namespace oriel
