#include "player/movers/few_pixels.h"

#include <array>

#include "player/scene/surface.h"

namespace oriel {
namespace {

enum { kFewerUnit = 2, kFewerLightUnit = 3 };

}  // namespace

Result<FewPixels> FewPixels::create(gpu::Dialect dialect) {
  FewPixels out;
  ORIEL_TRY(out.fewer_, gpu::Program::create("screen_shade_fewer", dialect));
  ORIEL_TRY(out.between_, gpu::Program::create("screen_shade_between", dialect));
  out.no_vertices_ = gpu::make_vertex_array();
  return out;
}

Status FewPixels::make_pictures(const LitTarget& target) {
  const int width = (target.light.width() + kStep - 1) / kStep, height = (target.light.height() + kStep - 1) / kStep;
  if (of_ == target.serial) return {};
  surfaces_ = gpu::Texture2d(gpu::kRgba32ui, width, height, nullptr);
  light_ = gpu::Texture2d(gpu::kRgba32f, width, height, nullptr);
  mask_ = gpu::Texture2d(gpu::kR8, target.light.width(), target.light.height(), nullptr);
  ORIEL_TRY(surfaces_target_, gpu::Framebuffer::create("few surfaces", &surfaces_, nullptr));
  ORIEL_TRY(light_target_, gpu::Framebuffer::create("few lights", &light_, nullptr));
  const std::array<const gpu::Texture2d*, 2> both{&target.light, &mask_};
  ORIEL_TRY(between_target_, gpu::Framebuffer::create("light between", both));
  of_ = target.serial;
  return gpu::check_gl("making the pictures of the shade of movers");
}

Status FewPixels::draw(const LitTarget& target, const std::function<void(const LitPixels&)>& draw_light) {
  ORIEL_TRY_VOID(make_pictures(target));
  constexpr GLfloat kNothing[] = {0, 0, 0, 0};
  gpu::apply({});
  glBindVertexArray(no_vertices_.name());
  surfaces_target_.bind();
  glViewport(0, 0, light_.width(), light_.height());
  fewer_.use();
  fewer_.set("u_surfaces", kSurfaceUnit);
  fewer_.set("u_step", kStep);
  target.surfaces.bind(kSurfaceUnit);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  light_target_.bind();
  glClearBufferfv(GL_COLOR, 0, kNothing);
  draw_light({surfaces_, nullptr});
  // Light between the few; what is left is marked.
  between_target_.bind();
  glViewport(0, 0, target.light.width(), target.light.height());
  gpu::RasterState state;
  state.blend = gpu::Blend::kAdd;
  gpu::apply(state);
  glBindVertexArray(no_vertices_.name());
  glClearBufferfv(GL_COLOR, 1, kNothing);
  between_.use();
  between_.set("u_surfaces", kSurfaceUnit);
  between_.set("u_fewer", kFewerUnit);
  between_.set("u_light", kFewerLightUnit);
  between_.set("u_step", kStep);
  target.surfaces.bind(kSurfaceUnit);
  surfaces_.bind(kFewerUnit);
  light_.bind(kFewerLightUnit);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  target.framebuffer.bind();
  draw_light({target.surfaces, &mask_});
  return gpu::check_gl("drawing the shade of movers");
}

}  // namespace oriel
