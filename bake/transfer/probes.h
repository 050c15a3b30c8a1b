// The light field that movers move through: probes of incident light on an adaptive grid (after Majercik et al. 2019,
// "Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields", with harmonics and refinement).
#pragma once

#include "bake/transfer/probe_rays.h"

namespace oriel {

struct ProbeOptions {
  int bands = 5;                 // of spherical harmonics, 2 to 6
  float spacing_m = 1;           // of the grid before refinement, at most; larger where max_probes would not do
  std::uint32_t samples = 1024;  // rays a probe; a power of two, at least depth_side²
  std::uint32_t depth_side = 16;
  std::size_t max_probes = 4096;  // of the grid; refinement may add as many
  int levels = kMaxFieldLevels;   // of refinement
  float max_difference = 0.3f;    // between neighbours, relative, beyond which a cell is refined
  int bright_lights = 4;          // the strongest, of a probe, that its harmonics leave out
  // Seconds, none for all that it takes. Once they are over, the level of refinement under way is left out; probes of
  // the grid that are not measured by then have the light of the nearest, with a warning.
  std::function<double()> left = {};
};
inline void fields(Archive& archive, ProbeOptions& o) {
  archive(o.bands, o.spacing_m, o.samples, o.depth_side, o.max_probes, o.levels, o.max_difference, o.bright_lights);
}

struct FieldBox {
  Vec3 lower{0}, upper{0};  // scene space
};

// A field over `box`, which has a volume. Cells whose corners differ in their harmonics' first two bands are cut into
// eight, those that differ most first. Harmonics are windowed where they would be negative somewhere. Errors: kStopped;
// kUsage for options out of range.
Result<LightField> bake_probes(const FieldScene& scene, const FieldBox& box, const ProbeOptions& options,
                               const Stage& stage);

}  // namespace oriel
