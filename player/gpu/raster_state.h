// The fixed-function state of a draw, set as a whole so that no pass depends on the one before.
#pragma once

#include <epoxy/gl.h>

namespace oriel::gpu {

// kAdd: colour adds, alpha is replaced; kMultiply: colour only; kMax: the larger of each channel; kCover: colour adds,
// and what is behind keeps what alpha leaves of it.
enum class Blend { kNone, kAdd, kMultiply, kMax, kCover };
enum class Cull { kNone, kBack, kFront };

struct RasterState {
  bool depth_test = false;  // GL_LEQUAL
  bool depth_write = false;
  bool color_write = true;
  bool alpha_write = true;
  Blend blend = Blend::kNone;
  Cull cull = Cull::kNone;
  bool mirrored = false;  // fronts are clockwise on the screen
  // With stencil_func GL_ALWAYS and stencil_write 0 the stencil is off. Passing pixels get stencil_ref in the bits of
  // stencil_write.
  GLenum stencil_func = GL_ALWAYS;
  GLint stencil_ref = 0;
  GLuint stencil_read = 0xff;
  GLuint stencil_write = 0;
};

void apply(const RasterState& state);

}  // namespace oriel::gpu
