// Options, results and report of the radiosity stage.
#pragma once

#include <cmath>
#include <functional>

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/texels/reach.h"
#include "bake/trace/path.h"
#include "formats/assets/lightmap.h"
#include "formats/assets/sharp_light.h"

namespace oriel {

// Options of the smoothing filter (filter.h).
struct FilterOptions {
  // Number of scales: the first equals about 33 times the rays, each further one four times the one before, where the
  // halves of the estimate show that it reduces the error.
  int scales = 3;
  float strength = 1;  // edge threshold in standard deviations; 0: no filter
};

// The default of RadiosityOptions::most_rays where no error is given: a minute or two on two cores. Scenes of many
// texels may have kMostTexelMean rays a texel instead.
inline constexpr std::uint64_t kDefaultMostRays = 32 << 20, kMostTexelMean = 256;

// Steps along a side of a finer cell. 16 and 32 bring frames little for a tenth of the time (docs/notes/radiosity.md).
inline constexpr std::uint32_t kMostCellSide = 8;

enum class Estimator : std::uint8_t {
  kReference,  // unbiased paths from every texel
  kCached,     // bounces cached in the lightmap, one final gather, filtered
};

// The light of the parts of texels that lie inside other geometry.
enum class Hidden : std::uint8_t {
  kLeftOut,  // left out of the texel's mean: no dark rims where objects stand on a floor
  kBlack,    // black, as in most bakers, for comparison. Seams are not stitched then
};

struct RadiosityOptions {
  Estimator estimator = Estimator::kReference;
  std::uint32_t samples = 256;  // reference: paths a texel, best a power of two; the error falls as 1/√samples.
                                // cached: gather rays a texel, at most
  double error = 0;             // stop at this error of frames (RadiosityReport::relative_error); 0: take all samples
  // cached: limit on the rays of refinement (or kMostTexelMean a texel), a shadow ray counting a third. The error
  // reached by then is stated. 0: no limit.
  std::uint64_t most_rays = 0;
  int bounces = 0;  // limit on reflections after leaving the texel, for comparison with other bakers; 0: all
  // Polled by many threads during refinement: true ends it at once with the result so far, as for a time limit.
  // Context::finishable is set meanwhile.
  std::function<bool()> enough = {};
  // Seconds left for the estimate and its verification; empty: no limit. When they are few, bounces get fewer rays,
  // texels without gather rays keep the bounces' light, and verification is left out.
  std::function<double()> left = {};
  bool late() const { return left && left() <= 0; }
  // Seconds left with those of later stages, but for writing; empty likewise. Seams, which take little, are stitched as
  // long as there are any.
  std::function<double()> left_of_all = {};
  // Positions of people's eyes, scene space, m: the error is that of frames seen from there (texels/frame_error.h).
  // Empty: anywhere in the air in front of surfaces. held_out: other positions, for the held-out error; empty: other
  // directions from the same ones.
  std::vector<Vec3> eyes = {}, held_out = {};
  // cached: rays that measure the held-out error by unbiased paths, as a fraction of the bake's (at least some
  // thousand); 0: none.
  double verify = 0.1;
  FilterOptions filter = {};  // cached
  Hidden hidden = Hidden::kLeftOut;
  int dilation = 4;          // texels by which charts are extended beyond their border
  bool fit_texels = false;   // deconvolve values for bilinear interpolation (texels/fit_texels.h)
  std::uint32_t detail = 1;  // cached: cells between texels are divided into up to so many steps a side (a power of 2
                             // up to 8) where light changes within them (cells.h)
  bool stitch = true;        // make light continuous over the seams of the lightmap
  bool directional = false;  // fill LightmapPage::direction
  bool sharp = false;        // cached: light of points, spots and suns on flat charts is computed by pixel
                             // (formats/assets/sharp_light.h); false: all is in texels and their cells
};

// Seams of the lightmap (seams.h) before and after stitching. Steps are luminance differences of bilinear filtering on
// the two sides, relative to the light there (plus 1 % of the mean).
struct SeamReport {
  std::size_t pairs = 0;  // stitched pairs of edges
  bool late = false;      // none is, for want of time
  double mean_step_before = 0, max_step_before = 0;
  double mean_step = 0, max_step = 0;  // after
  double energy_change = 0;            // of the power on all surfaces, relative
  double moved = 0;                    // change of texels, rms over all surfaces, relative to each texel's light
};

// A frame pixel with a large error.
struct WorstPixel {
  std::uint32_t triangle = 0;   // visible in it
  Vec3 position{0};             // scene space, m
  double baked = 0, paths = 0;  // luminance, cd/m²
  double share = 0;             // of the squared error of all pixels, at most 1
};

// The error of frame light against unbiased paths at held-out pixels (held_out_error.h).
struct HeldOutError {
  std::size_t pixels = 0;                // compared
  std::uint64_t paths = 0;               // of all pixels
  double bias = 0;                       // Σ (baked - paths) / Σ paths, luminance
  double bias_interval = 0;              // 95 % confidence: bias ± this
  double relative_error = 0;             // rms over pixels (texels/frame_error.h), without the paths' noise
  double error_low = 0, error_high = 0;  // 95 % confidence interval of the rms
  std::uint64_t rays = 0;
  std::vector<WorstPixel> worst;  // at most eight, the worst first, each with 1 % of the squared error or more
};

// Finer light (LightmapPage::cell).
struct DetailReport {
  std::size_t cells = 0, points = 0;
  double relative_error = 0;  // estimated, rms over points
  double unresolved = 0;      // estimated error of interpolation that remains: rms over frames, relative
  bool left_out = false;      // for lack of time
  std::uint64_t rays = 0;
};

struct RadiosityReport {
  DetailReport detail;
  HeldOutError held_out_error;  // of the cached estimator
  std::uint64_t rays = 0;
  std::size_t texels = 0;  // valid ones
  std::size_t buried = 0;
  std::size_t assumed = 0;    // of the valid ones: their light is that of near ones, for want of time
  Vec3 mean{0};               // lux, over valid texels
  Vec3 max{0};                // lux
  double relative_error = 0;  // rms of standard error over frame pixels (texels/frame_error.h)
  double stated() const { return std::hypot(relative_error, detail.unresolved); }
  int sweeps = 0;                   // cached: Jacobi iterations over the patches
  bool ended_early = false;         // by `enough`, above the error requested
  std::uint64_t first_rays = 0;     // cached: of `rays`, before any refinement
  bool out_of_rays = false;         // ended by RadiosityOptions::most_rays, likewise
  double sweep_tail = 0;            // cached: bound on the light of further bounces, relative
  double sweep_growth = 0;          // cached: light of the last bounce over that of the one before
  std::size_t bounded_patches = 0;  // cached: patches with bounded weights (patches.h)
  double filter_drift = 0;          // cached: relative change of energy by the filter, absolute value
  SeamReport seams;
  DVec3 incident_lm{0};  // power falling on the visible parts of all lightmapped surfaces, front sides
};

struct Radiosity {
  std::vector<LightmapPage> pages;
  // Visible fraction of each covered texel, by page and index into TexelMapPage::texel: neither inside other geometry
  // nor behind a wall on the texel (TexelPart). All 1 with Hidden::kBlack, which has it in the light.
  std::vector<std::vector<float>> visible;
  std::vector<std::vector<Reach>> reach{};  // of the sampled parts, likewise; empty with unbiased paths
  // While pages hold light without it: the sharp light of texels, by page. Later LightmapPage::sharp has it.
  std::vector<LightmapPage> sharp{};
  // Texels, by page, whose light is that of near ones, for want of time.
  std::vector<std::vector<std::uint32_t>> assumed{};
  // True for cells (LightmapPage::cell) whose light continues across a stitched seam, by page and y * width + x. Empty
  // without stitching.
  std::vector<std::vector<bool>> at_seam{};
  // Irradiance and details by light group (Scene::light_groups) and page; states and cells are those of `pages`. They
  // sum to the light of `pages`, apart from rounding. Empty without groups, or if the estimator does not separate them.
  std::vector<std::vector<LightmapPage>> groups{};
  SharpLight sharp_light;  // with RadiosityOptions::sharp
  RadiosityReport report;
};

}  // namespace oriel
