#include "player/passes/display_pass.h"

#include "player/gpu/raster_state.h"

namespace oriel {
namespace {

constexpr int kBlock = 16;  // pixels a side that one fragment of the meter adds up

}  // namespace

float white_of_exposure(float ev100) {
  return 1.2f * std::exp2(ev100);
}

float exposure_of_white(float white) {
  return std::log2(white / 1.2f);
}

Result<DisplayPass> DisplayPass::create(gpu::Dialect dialect) {
  DisplayPass pass;
  ORIEL_TRY(pass.luminance_, gpu::Program::create("screen/luminance", dialect));
  ORIEL_TRY(pass.tonemap_, gpu::Program::create("screen/tonemap", dialect));
  if (dialect == gpu::Dialect::kDesktop330) {
    ORIEL_TRY(pass.tonemap_samples_, gpu::Program::create("screen/tonemap", dialect, "MULTISAMPLED"));
  }
  pass.no_vertices_ = gpu::make_vertex_array();
  return pass;
}

Result<std::optional<float>> DisplayPass::meter(const FrameTarget& frame) {
  const int width = (frame.light.width() + kBlock - 1) / kBlock, height = (frame.light.height() + kBlock - 1) / kBlock;
  if (!sums_ || sums_.width() != width || sums_.height() != height) {
    sums_ = gpu::Texture2d(gpu::kRgba32f, width, height, nullptr);
    ORIEL_TRY(sums_framebuffer_, gpu::Framebuffer::create("exposure meter", &sums_, nullptr));
  }
  sums_framebuffer_.bind();
  glViewport(0, 0, width, height);
  gpu::apply({});
  glBindVertexArray(no_vertices_.name());
  frame.light.bind(0);
  luminance_.use();
  luminance_.set("u_frame", 0);
  luminance_.set("u_frame_size", IVec2(frame.light.width(), frame.light.height()));
  luminance_.set("u_block", kBlock);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<Vec4> sums(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, sums.data());
  double sum = 0, count = 0;
  for (const Vec4& s : sums) {
    sum += s.x;
    count += s.y;
  }
  if (!(count > 0) || !std::isfinite(sum)) return std::optional<float>();
  return std::optional<float>(static_cast<float>(sum / count - std::log2(1.2 * 0.18)));
}

void DisplayPass::draw(const FrameTarget& frame, float ev100, ToneCurve curve) const {
  glViewport(0, 0, frame.light.width(), frame.light.height());
  gpu::apply({});
  glBindVertexArray(no_vertices_.name());
  const gpu::Program& program = frame.shows_samples ? tonemap_samples_ : tonemap_;
  if (frame.shows_samples)
    frame.light_samples.bind(0);
  else
    frame.light.bind(0);
  program.use();
  program.set("u_frame", 0);
  program.set("u_samples", frame.samples());
  program.set("u_frame_size", frame.size());
  program.set("u_exposure", 1 / white_of_exposure(ev100));
  program.set("u_curve", curve == ToneCurve::kAces ? 1 : 0);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace oriel
