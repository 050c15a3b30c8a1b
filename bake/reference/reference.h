// The reference: path-traced frames, by component. Unbiased; every faster way is judged against it.
#pragma once

#include "bake/jobs/context.h"
#include "bake/trace/path.h"
#include "formats/image/image.h"

namespace oriel {

struct ReferenceOptions {
  int width = 640, height = 360;
  std::uint32_t samples = 64;  // paths a pixel for each component at most; best a power of two
  bool antialias = true;       // false: every ray through the pixel's centre, as a rasteriser without samples sees it
  double error = 0;            // stop at the power of two whose relative_noise is at most this; 0: take all samples
};

// Pictures of three channels, cd/m². total = direct + indirect + specular + emission.
struct ReferenceFrame {
  std::uint32_t samples = 0;  // taken of each pixel
  FloatImage total;
  FloatImage direct;          // reflected by the diffuse lobe of the first surface, straight from emitters
  FloatImage indirect;        // and after bounces
  FloatImage specular;        // S: reflected by its specular lobe; glints of lamps and the sun in flat mirrors too
  FloatImage emission;        // of the first surface or the sky, and what shows through transmission and cut-outs
  FloatImage noise;           // standard error of total,
  FloatImage diffuse_noise;   // of D = direct + indirect
  FloatImage specular_noise;  // and of specular
  double relative_noise = 0;  // root of the mean of noise² / (total² + (0.01 mean)²), means over pixels and channels
};

// The transport as eyes see: frosted panes blur, and unlit_white is as this frame shows it: what is white where its lit
// part is, on the (log) average, middle grey. That is as it was where the scene has no unlit surface or it is set.
Transport for_eyes(const Transport& transport, const Camera& camera, ReferenceOptions options, std::uint64_t seed);

// Paths start as pixel_ray() of formats/query has them. Error kStopped only.
Result<ReferenceFrame> render_reference(const Transport& transport, const Camera& camera,
                                        const ReferenceOptions& options, Context& context);

// One sample of a pixel of that frame alone (of for_eyes()'s transport), from the same random numbers: its radiance,
// cd/m².
struct PixelSample {
  std::uint64_t seed = 1;
  std::uint32_t x = 0, y = 0, number = 0;
};
Vec3 trace_sample(const Transport& transport, const Camera& camera, const ReferenceOptions& options,
                  const PixelSample& sample);

}  // namespace oriel
