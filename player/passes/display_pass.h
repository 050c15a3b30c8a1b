// From light to the screen: exposure and tone mapping.
#pragma once

#include <optional>

#include "player/gpu/program.h"
#include "player/passes/targets.h"

namespace oriel {

enum class ToneCurve { kNone, kAces };

// The luminance that an exposure value shows as white: 1.2 * 2^EV cd/m² (EV at ISO 100; ISO 12232's saturation-based
// speed with a lens that passes 65 %).
float white_of_exposure(float ev100);
// Its inverse; white > 0.
float exposure_of_white(float white);

class DisplayPass {
 public:
  static Result<DisplayPass> create(gpu::Dialect dialect);
  // The exposure value that shows the frame's log-average luminance as middle grey (18 %). Pixels that are black or
  // unlit do not count; nothing where all are. The same frame always gives the same value.
  Result<std::optional<float>> meter(const FrameTarget& frame);
  // Into the bound framebuffer, of the frame's size, encoded as sRGB. Of several samples a pixel each is tone-mapped,
  // so that an edge of a lamp stays smooth.
  void draw(const FrameTarget& frame, float ev100, ToneCurve curve) const;

 private:
  gpu::Program luminance_, tonemap_, tonemap_samples_;
  gpu::VertexArray no_vertices_;
  gpu::Texture2d sums_;
  gpu::Framebuffer sums_framebuffer_;
};

}  // namespace oriel
