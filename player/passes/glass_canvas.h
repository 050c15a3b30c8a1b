// What glass needs beside the picture that it is drawn into: what lies behind it, and by pixel where its surface is and
// what light comes from there.
#pragma once

#include <deque>
#include <optional>

#include "player/passes/targets.h"

namespace oriel {

// Pictures use the lower left corner.
struct GlassCanvas {
  gpu::Texture2d behind;  // the picture: light, a its depth; with levels. Beyond it its last pixels go on.
  gpu::Texture2d places, normals, tints, nearest, shaded;
  gpu::Framebuffer behind_framebuffer, surfaces_framebuffer, shaded_framebuffer;
  gpu::Texture2d through, through_depth;  // none before make_through()
  gpu::Framebuffer through_framebuffer;
  std::uint64_t used = 0;  // the last time

  static Result<GlassCanvas> create(const IVec2& size);
  Status make_through();
  IVec2 size() const { return {behind.width(), behind.height()}; }
  std::uint64_t bytes() const;
};

// All of the framebuffer that is bound, as far as the scissor goes: light, depth and stencil.
void clear_all(const Vec4& color);

// That of the frame, and those of reflectors' images that were drawn last. An image's is somewhat larger than it is: as
// eyes move sizes change little by little. What is drawn into it depends on nothing that was drawn before.
class GlassCanvases {
 public:
  // Valid until the next call. Error kRuntime.
  Result<GlassCanvas*> of(const ReflectionTarget& target, const View& view);
  std::uint64_t bytes() const;

 private:
  std::optional<GlassCanvas> frame_;
  std::deque<GlassCanvas> images_;
  std::uint64_t calls_ = 0;
};

}  // namespace oriel
