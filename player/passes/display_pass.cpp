#include "player/passes/display_pass.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "player/gpu/raster_state.h"

namespace oriel {
namespace {

constexpr int kBlock = 16;  // pixels a side that one fragment of the meter adds up

constexpr double kMiddle = 0.5;  // of the frame's half width and height: how far the look falls off by 1/e² there
constexpr double kBright = 0.9;  // share of what is looked at that is darker than its bright parts
constexpr double kShadows = 7;   // stops under these: nobody exposes for what is darker

struct Block {
  double log_luminance = 0, weight = 0;
};

// How much a place counts, (-1, -1) to (1, 1) over the frame: people look at the middle.
double look(double x, double y) {
  return 0.1 + std::exp(-0.5 * (x * x + y * y) / (kMiddle * kMiddle));
}

}  // namespace

std::optional<float> log_luminance_of(std::span<const Vec4> sums, int width) {
  std::vector<Block> blocks;
  double all = 0;
  const int height = static_cast<int>(sums.size()) / std::max(width, 1);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (!(sums[i].y > 0) || !std::isfinite(sums[i].x)) continue;
    const double x = (2.0 * static_cast<double>(i % static_cast<std::size_t>(width)) + 1) / width - 1;
    const double y = (2.0 * static_cast<double>(i / static_cast<std::size_t>(width)) + 1) / height - 1;
    const double weight = double{sums[i].y} * look(x, y);
    blocks.push_back({double{sums[i].x} / double{sums[i].y}, weight});
    all += weight;
  }
  if (blocks.empty()) return std::nullopt;
  std::stable_sort(blocks.begin(), blocks.end(),
                   [](const Block& a, const Block& b) { return a.log_luminance < b.log_luminance; });
  double run = 0, bright = blocks.back().log_luminance;
  for (const Block& b : blocks)
    if ((run += b.weight) >= kBright * all) {
      bright = b.log_luminance;
      break;
    }
  double sum = 0, weight = 0;
  for (const Block& b : blocks) {
    if (b.log_luminance < bright - kShadows) continue;
    sum += b.log_luminance * b.weight;
    weight += b.weight;
  }
  return static_cast<float>(sum / weight);
}

float white_of_exposure(float ev100) {
  return 1.2f * std::exp2(ev100);
}

float exposure_of_white(float white) {
  return std::log2(white / 1.2f);
}

Result<DisplayPass> DisplayPass::create(gpu::Dialect dialect) {
  DisplayPass pass;
  ORIEL_TRY(pass.luminance_, gpu::Program::create("screen_luminance", dialect));
  ORIEL_TRY(pass.tonemap_, gpu::Program::create("screen_tonemap", dialect));
  if (dialect == gpu::Dialect::kDesktop330) {
    ORIEL_TRY(pass.tonemap_samples_, gpu::Program::create("screen_tonemap", dialect, "MULTISAMPLED"));
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
  const std::optional<float> log_luminance = log_luminance_of(sums, width);
  if (!log_luminance) return std::optional<float>();
  return std::optional<float>(*log_luminance - std::log2(1.2f * 0.18f));
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
  program.set("u_unlit_exposure", 1 / frame.unlit_white);
  program.set("u_curve", curve == ToneCurve::kAces ? 1 : 0);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Status DisplayPass::draw_in_window(const FrameTarget& frame, float ev100, ToneCurve curve, const IVec2& window,
                                   bool again) {
  const IVec2 size = frame.size();
  const bool fits = shown_ && shown_.width() == size.x && shown_.height() == size.y;
  if (!fits) {
    shown_ = gpu::Texture2d(gpu::kRgba8, size.x, size.y, nullptr);
    ORIEL_TRY(shown_framebuffer_, gpu::Framebuffer::create("shown frame", &shown_, nullptr));
  }
  if (!fits || !again || ev100 != shown_ev100_ || curve != shown_curve_) {
    shown_framebuffer_.bind();
    draw(frame, ev100, curve);
    shown_ev100_ = ev100;
    shown_curve_ = curve;
  }
  shown_framebuffer_.stretch_over_window(size, window);
  return {};
}

}  // namespace oriel
