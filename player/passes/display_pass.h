// From light to the screen: exposure and tone mapping.
#pragma once

#include <optional>
#include <span>

#include "player/gpu/program.h"
#include "player/passes/targets.h"

namespace oriel {

enum class ToneCurve { kNone, kAces };

// The luminance that an exposure value shows as white: 1.2 * 2^EV cd/m² (EV at ISO 100; ISO 12232's saturation-based
// speed with a lens that passes 65 %).
float white_of_exposure(float ev100);
// Its inverse; white > 0.
float exposure_of_white(float white);

// log2 of the luminance that a frame is exposed for, from its blocks, row by row: sums of log2 luminance over pixels
// that are neither black nor unlit, and their number. Blocks count by how near they are to the middle; those 7 stops
// darker than the bright ones (the 90th percentile) do not: a dark corner does not burn out the lit room before it.
std::optional<float> log_luminance_of(std::span<const Vec4> sums, int width);

class DisplayPass {
 public:
  static Result<DisplayPass> create(gpu::Dialect dialect);
  // The exposure value that shows the frame's log-average luminance as middle grey (18 %): of what is lit, the middle
  // before the margin (log_luminance_of). Nothing where all pixels are black or unlit. The same frame always gives the
  // same value.
  Result<std::optional<float>> meter(const FrameTarget& frame);
  // Into the bound framebuffer, of the frame's size, encoded as sRGB. Of several samples a pixel each is tone-mapped,
  // so that an edge of a lamp stays smooth.
  void draw(const FrameTarget& frame, float ev100, ToneCurve curve) const;
  // Over the window of that size, whatever the frame's: its own few pixels are tone-mapped, not the window's many.
  // again: it is the frame of the last call, and tone-mapped anew only where the exposure is another.
  Status draw_in_window(const FrameTarget& frame, float ev100, ToneCurve curve, const IVec2& window, bool again);

 private:
  gpu::Program luminance_, tonemap_, tonemap_samples_;
  gpu::VertexArray no_vertices_;
  gpu::Texture2d sums_;
  gpu::Framebuffer sums_framebuffer_;
  gpu::Texture2d shown_;  // of the frame in a window
  float shown_ev100_ = 0;
  ToneCurve shown_curve_ = ToneCurve::kNone;
  gpu::Framebuffer shown_framebuffer_;
};

}  // namespace oriel
