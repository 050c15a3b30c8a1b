// Radiosity textures: irradiance per texel of the lightmap, with its standard error.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/trace/path.h"
#include "formats/assets/lightmap.h"

namespace oriel {

struct RadiosityOptions {
  std::uint32_t samples = 256;  // paths a texel, best a power of two; the error falls as 1/√samples
  int dilation = 4;             // texels by which charts are extended beyond their border
  bool directional = false;     // fill LightmapPage::direction
};

struct RadiosityReport {
  std::uint64_t rays = 0;
  std::size_t texels = 0;  // valid ones
  std::size_t buried = 0;
  std::size_t back_charts = 0;  // of double-sided surfaces whose back is lit more: the back was baked (sides.h)
  Vec3 mean{0};                 // lux, over valid texels
  Vec3 max{0};                  // lux
  double relative_error =
      0;                 // rms of standard error over (irradiance + 1 % of the page's mean), over texels and channels
  DVec3 incident_lm{0};  // power falling on the visible parts of all lightmapped surfaces, front sides
};

struct Radiosity {
  std::vector<LightmapPage> pages;
  // By page and covered texel (as TexelMapPage::texel): the share of the texel's surface that is not inside other
  // geometry.
  std::vector<std::vector<float>> visible;
  RadiosityReport report;
};

// The `reference` estimator: unbiased paths from points spread over each texel, light and BSDF sampling combined.
// Points that lie inside other geometry (independent probes meet little but back faces of one-sided materials) are left
// out; a texel with none left is kBuried and filled from its chart's neighbours. Stage name "radiosity"; error
// kStopped.
Result<Radiosity> bake_radiosity(const Transport& transport, const Atlas& atlas,
                                 std::span<const TexelMapPage> texel_map, const RadiosityOptions& options,
                                 Context& context);

}  // namespace oriel
