#include "player/gpu/raster_state.h"

namespace oriel::gpu {
namespace {

void enable(GLenum what, bool on) {
  on ? glEnable(what) : glDisable(what);
}

}  // namespace

void apply(const RasterState& state) {
  enable(GL_DEPTH_TEST, state.depth_test);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(state.depth_write ? GL_TRUE : GL_FALSE);
  const GLboolean color = state.color_write ? GL_TRUE : GL_FALSE;
  glColorMask(color, color, color, state.color_write && state.alpha_write ? GL_TRUE : GL_FALSE);
  enable(GL_BLEND, state.blend != Blend::kNone);
  glBlendEquation(state.blend == Blend::kMax ? GL_MAX : GL_FUNC_ADD);
  if (state.blend == Blend::kAdd) glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ZERO);
  if (state.blend == Blend::kMultiply) glBlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
  if (state.blend == Blend::kCover) glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  enable(GL_CULL_FACE, state.cull != Cull::kNone);
  glFrontFace(state.mirrored ? GL_CW : GL_CCW);
  glCullFace(state.cull == Cull::kFront ? GL_FRONT : GL_BACK);
  enable(GL_STENCIL_TEST, state.stencil_func != GL_ALWAYS || state.stencil_write != 0);
  glStencilFunc(state.stencil_func, state.stencil_ref, state.stencil_read);
  glStencilMask(state.stencil_write);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
}

}  // namespace oriel::gpu
