// What is measured of a configuration, and its JSON: kept by file, read back by the next run.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/core/json.h"
#include "formats/image/comparison.h"
#include "formats/pack/pack.h"

namespace oriel::trade {

struct BakeCost {
  double seconds = 0;  // wall clock of all stages, without the program's start; without a bake until the frame stood
  double cpu_seconds = 0;   // of the whole program
  std::uint64_t bytes = 0;  // of the pack; 0: there is none
};

// Over texels that both packs baked. All but noise are net of it, in quadrature (docs/notes/metrics.md).
struct TexelError {
  std::uint64_t texels = 0;
  double rel_rmse = 0, n_rmse = 0;
  double bias = 0;   // signed
  double noise = 0;  // the reference's own relRMSE
  // formats/analysis/error_bands.h; 0 where nothing is drawn with the lightmap.
  double clouds = 0;   // of 4 to 32 texels, of the light around
  double visible = 0;  // 1 is just noticeable
};

// A frame beside its path-traced reference; relRMSE net of that one's noise.
struct CameraError {
  std::string camera;
  double sum = 0, diffuse = 0;     // diffuse: NaN where it was not told apart
  std::optional<double> specular;  // over the pixels that show reflected images, if there are any
  double noise = 0;                // the reference's, of the sum
  double flip = 0;
  double mse = 0;  // of what is shown: PSNR follows
};

struct Measures {
  std::optional<BakeCost> bake;
  std::optional<double> frame_ms;  // mean over the cameras
  std::string renderer;            // that took them: the OpenGL device; empty for traced frames
  std::optional<TexelError> texels;
  std::vector<CameraError> frames;  // by camera

  bool empty() const { return !bake && !frame_ms && !texels && frames.empty(); }
};

// Over the cameras; nothing where there is none. Errors are root mean squares, FLIP is a mean.
std::optional<double> frame_error(const Measures& measures, double CameraError::*error);
std::optional<double> specular_error(const Measures& measures);
std::optional<double> mean_flip(const Measures& measures);
std::optional<double> psnr(const Measures& measures);

// One number of the above, as tables have it.
struct Quantity {
  const char* name;    // in trade.csv
  const char* title;   // on the page; empty: it is not there
  const char* format;  // there, of the value times `scale`
  double scale;
  const char* front;  // of which being on it is marked there; or empty
  std::optional<double> (*value)(const Measures&);
};
std::span<const Quantity> quantities();  // in the order of trade.csv

// Error kInvalid where the packs' texels are not the same or none is baked in both.
Result<TexelError> texel_error(const Pack& pack, const Pack& reference);
// What formats/image says of the whole frame, S of its reflectors.
CameraError frame_error_of(const std::string& camera, const Comparison& comparison);
// The same from what `oriel-play --compare --json` wrote. Error kInvalid.
Result<CameraError> read_comparison(const std::string& camera, const std::string& json);
// Sets the mean of the frames' times and the renderer from what `oriel-play --stats` wrote.
// Error kInvalid.
Status read_frame_times(const std::string& json, Measures& measures);
// What `oriel-preview --offscreen --stats` wrote: until the frame stood, and a pass of so many pixels, in ms. Error
// kInvalid.
struct PreviewTimes {
  double drawn_s = 0, cpu_s = 0, pass_ms = 0;
};
Result<PreviewTimes> read_preview_times(const std::string& json);
// Seconds of all stages from what `oriel-bake --report` wrote. Error kInvalid.
Result<double> read_bake_seconds(const std::string& json);

Json as_json(const Measures& measures);
// Error kInvalid.
Result<Measures> measures_from_json(const std::string& text);

}  // namespace oriel::trade
