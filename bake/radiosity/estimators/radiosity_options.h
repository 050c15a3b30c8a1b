// What radiosity is asked for, what it makes, and what it says of that.
#pragma once

#include <cmath>
#include <functional>

#include "bake/atlas/texel_map.h"
#include "bake/trace/path.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// How a smoothing filter of the gathered light works (filter.h).
struct FilterOptions {
  int scales = 3;      // the first does the work of about 33 times the rays, each further one of four times that of the
                       // one before, where the halves of the estimate agree that it is right
  float strength = 1;  // edges of this many standard deviations are kept; 0: no filter
};

inline constexpr int kRefinements = 2;  // after verification
// RadiosityOptions::most_rays of a bake for which nobody named an error: a minute or two of two cores. And what a texel
// may have on average, where that is more.
inline constexpr std::uint64_t kDefaultMostRays = 32 << 20, kMostTexelMean = 256;

enum class Estimator : std::uint8_t {
  kReference,  // unbiased paths from every texel
  kCached,     // bounces cached in the lightmap, one final gather, filtered
};

// What texels hold of the parts of them that lie inside other geometry.
enum class Hidden : std::uint8_t {
  kLeftOut,  // the light of what can be seen: no dark rims where objects stand on a floor
  kBlack,    // no light, as most bakers have it: for comparing with them. Seams are not stitched then
};

struct RadiosityOptions {
  Estimator estimator = Estimator::kReference;
  std::uint32_t samples = 256;  // reference: paths a texel, best a power of two; the error falls as 1/√samples.
                                // cached: gather rays a texel, at most
  double error = 0;             // stop at this error of frames (RadiosityReport::relative_error); 0: take all samples
  // cached: refinement to `error` ends after so many rays (or kMostTexelMean a texel), a shadow ray being a third of
  // one, with the error that is stated then. 0: never for that.
  std::uint64_t most_rays = 0;
  int bounces = 0;  // reflections counted after leaving the texel; 0: all. For comparing with bakers that stop
  // Asked by many threads while an estimate is refined: true ends that at once, and what is there is the result (a time
  // limit, say). Context::finishable is set while it is asked.
  std::function<bool()> enough = {};
  // Seconds that the estimate and its verification may still take; empty: as long as they need. Where they are few,
  // bounces have fewer rays, texels that no gather ray left keep the bounces' light, and nothing is verified.
  std::function<double()> left = {};
  bool late() const { return left && left() <= 0; }
  // Whether no time at all is left, not even that of later stages: seams are stitched until then, which takes little.
  std::function<bool()> over = {};
  // Where people's eyes are, scene space, m: the error is that of the frames which they see
  // (texels/frame_error.h). Empty: anywhere in the air in front of surfaces. `held_out` are others, by which the error
  // is verified; empty: other directions from the same.
  std::vector<Vec3> eyes = {}, held_out = {};
  // cached: so many rays, as a share of the bake's, measure the error of held-out pixels by unbiased paths (at least
  // some thousand); 0: none. What is measurably worse than 1.1 times `error` is refined where less noise, or looking
  // up less (cached.h), can mend it, at most kRefinements times.
  double verify = 0.1;
  // cached: tiles of texels whose light an edit of the scene changes by no more than this, relative, keep that of the
  // last bake with these options that reused none (Context::units knows it); 0: all are baked.
  double reuse_error = 0;
  FilterOptions filter = {};  // cached
  Hidden hidden = Hidden::kLeftOut;
  int dilation = 4;          // texels by which charts are extended beyond their border
  bool fit_texels = false;   // values whose interpolation has the texels' light (texels/fit_texels.h), not their means
  std::uint32_t detail = 1;  // cached: cells between texels are divided into up to so many steps a side (a power of 2
                             // up to 32) where light changes within them (cells.h)
  bool stitch = true;        // make light continuous over the seams of the lightmap
  bool directional = false;  // fill LightmapPage::direction
};

// Seams of the lightmap (seams.h), and what stitching did to the light there. Steps are differences of what bilinear
// filtering reads on the two sides, relative to the light there (plus 1 % of the mean); of luminance.
struct SeamReport {
  std::size_t pairs = 0;  // of edges that were stitched
  double mean_step_before = 0, max_step_before = 0;
  double mean_step = 0, max_step = 0;  // after
  double energy_change = 0;            // of the power on all surfaces, relative
  double moved = 0;                    // by how much, rms over all surfaces, relative to the light of each texel
};

// A pixel whose light is far off.
struct WorstPixel {
  std::uint32_t triangle = 0;   // that it shows
  Vec3 position{0};             // scene space, m
  double baked = 0, paths = 0;  // luminance, cd/m²
  double share = 0;             // of the squared error of all pixels compared, at most 1: their noise may be negative
};

// What unbiased paths at held-out pixels say of the light that frames show (certificate.h).
struct Certificate {
  std::size_t pixels = 0;                // compared
  std::uint64_t paths = 0;               // from the points of all of them
  double bias = 0;                       // Σ (baked - paths) / Σ paths, luminance
  double bias_interval = 0;              // the truth lies within bias ± this with 95 % certainty
  double relative_error = 0;             // rms over pixels (texels/frame_error.h), free of the paths' own noise
  double error_low = 0, error_high = 0;  // the rms of all pixels lies between with 95 % certainty
  // The same of the texels that pixels read, each as a whole: what is beyond that is their size and interpolation.
  // Asked where the error was missed and that may be why; 0: not asked.
  double texel_error = 0;
  std::uint64_t rays = 0;
  std::vector<WorstPixel> worst;  // eight at most, worst first; none holds less than a hundredth
};

// What an edit of the scene left of the light of the bake before (RadiosityOptions::reuse_error).
struct ReuseReport {
  double asked = 0;                 // 0: all was baked
  std::size_t tiles = 0, kept = 0;  // of about 64 texels each
  double error = 0;                 // that this brings: rms over what is seen, relative; relative_error has it in it
};

// Finer light (LightmapPage::cell).
struct DetailReport {
  std::size_t cells = 0, points = 0;
  double relative_error = 0;  // stated, rms over points
  double unresolved = 0;      // what interpolation still misses, as told: rms over frames, relative
  bool left_out = false;      // there was no time
  std::uint64_t rays = 0;
};

struct RadiosityReport {
  DetailReport detail;
  ReuseReport reuse;
  Certificate certificate;  // of the cached estimator
  std::uint64_t rays = 0;
  std::size_t texels = 0;  // valid ones
  std::size_t buried = 0;
  Vec3 mean{0};               // lux, over valid texels
  Vec3 max{0};                // lux
  double relative_error = 0;  // rms of standard error over the pixels that eyes see (texels/frame_error.h)
  double stated() const { return std::hypot(relative_error, detail.unresolved); }
  int sweeps = 0;                   // cached: bounces computed in the coarse lightmap
  bool ended_early = false;         // by `enough`: the error asked for does not hold
  std::uint64_t first_rays = 0;     // cached: of `rays`, before any refinement
  bool out_of_rays = false;         // by RadiosityOptions::most_rays: neither
  int refinements = 0;              // cached: after held-out pixels told of a larger error than was asked for
  double sweep_tail = 0;            // cached: bound on what further bounces would add, relative
  double sweep_growth = 0;          // cached: what the last bounce added over what the one before did
  std::size_t bounded_patches = 0;  // cached: of the coarse lightmap, that handed on more than they got (patches.h)
  double filter_drift = 0;          // cached: size of the relative change of the gathered energy by the filter
  SeamReport seams;
  DVec3 incident_lm{0};  // power falling on the visible parts of all lightmapped surfaces, front sides
};

struct Radiosity {
  std::vector<LightmapPage> pages;
  // By page and covered texel (as TexelMapPage::texel): the share of the texel's surface that is not inside other
  // geometry nor behind a wall on the texel (TexelPart). With Hidden::kBlack all 1: the light has it in it.
  std::vector<std::vector<float>> visible;
  // By page and y * width + x: cells (LightmapPage::cell) whose light meets that of another place across a stitched
  // seam. Empty where nothing was stitched.
  std::vector<std::vector<bool>> at_seam{};
  // By group of lamps (Scene::light_groups) and page: irradiance and details, states and cells being the pages'. Their
  // sum is the pages' light but for rounding. Empty where there are no groups, or the estimator does not tell.
  std::vector<std::vector<LightmapPage>> groups{};
  RadiosityReport report;
};

}  // namespace oriel
