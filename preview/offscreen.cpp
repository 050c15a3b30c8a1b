#include "preview/offscreen.h"

#include <ctime>

#include "bake/run/view_options.h"
#include "formats/core/color.h"
#include "formats/core/json.h"
#include "formats/image/exr.h"
#include "formats/image/png.h"
#include "formats/query/camera_notes.h"
#include "player/gpu/headless.h"
#include "preview/frame/blend_paths.h"

namespace oriel {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kTold_s = 2;  // between words of how far it is

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Json json_of_pass(const PreviewStats& s) {
  return {{"total_s", s.total_s},         {"surfaces_s", s.surfaces_s},      {"direct_s", s.direct_s},
          {"bounce_s", s.bounce_s},       {"traced_s", s.traced_s},          {"points", s.points},
          {"shadow_rays", s.shadow_rays}, {"traced_pixels", s.traced_pixels}};
}

// Of what was drawn: the mean over pixels that are numbers, cd/m², and how many are none.
Json json_of_frame(const FloatImage& frame) {
  double sum = 0;
  std::size_t finite = 0;
  const std::size_t pixels = frame.pixels.size() / 3;
  for (std::size_t i = 0; i < pixels; ++i) {
    const Vec3 light(frame.pixels[3 * i], frame.pixels[3 * i + 1], frame.pixels[3 * i + 2]);
    if (is_finite(light)) sum += luminance(light), ++finite;
  }
  return {{"mean_cd_m2", sum / static_cast<double>(std::max<std::size_t>(finite, 1))}, {"no_number", pixels - finite}};
}

// Row 0 at the top.
std::vector<std::uint8_t> read_shown(const IVec2& size) {
  const auto row = 3 * static_cast<std::size_t>(size.x), rows = static_cast<std::size_t>(size.y);
  std::vector<std::uint8_t> raw(row * rows), out(row * rows);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, raw.data());
  for (std::size_t y = 0; y < rows; ++y)
    std::copy_n(raw.begin() + static_cast<std::ptrdiff_t>(row * (rows - 1 - y)), row,
                out.begin() + static_cast<std::ptrdiff_t>(row * y));
  return out;
}

Status write_frame(const PreviewArguments& a, const gpu::Device& device, const FrameTarget& frame,
                   std::map<std::string, std::string> notes) {
  const auto size = UVec2(frame.size());
  if (a.output.extension() == ".exr") {
    FloatImage light{size.x, size.y, 3, std::vector<float>(std::size_t{3} * size.x * size.y)};
    frame.framebuffer.bind();
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    std::vector<float> raw(light.pixels.size());
    glReadPixels(0, 0, frame.size().x, frame.size().y, GL_RGB, GL_FLOAT, raw.data());
    const auto row = std::size_t{3} * size.x;
    for (std::size_t y = 0; y < size.y; ++y)
      std::copy_n(raw.begin() + static_cast<std::ptrdiff_t>(row * (size.y - 1 - y)), row,
                  light.pixels.begin() + static_cast<std::ptrdiff_t>(row * y));
    notes["oriel.unit"] = "cd/m2";
    return write_exr(a.output, light, notes);
  }
  ORIEL_TRY(DisplayPass display, DisplayPass::create(device.dialect));
  ORIEL_TRY(const std::optional<float> metered, display.meter(frame));
  const float ev100 = a.ev100.value_or(metered.value_or(0));
  const gpu::Texture2d shown(gpu::kRgba8, frame.size().x, frame.size().y, nullptr);
  ORIEL_TRY(const gpu::Framebuffer target, gpu::Framebuffer::create("shown frame", &shown, nullptr));
  target.bind();
  display.draw(frame, ev100, a.curve);
  notes["oriel.ev100"] = fmt::format("{:.3f}", ev100);
  return write_png(a.output, {size.x, size.y, 3, read_shown(frame.size())}, notes);
}

// All of them; tells how far it is.
Result<PathMean> trace_paths(const PreviewArguments& a, const std::shared_ptr<const PreviewScene>& scene,
                             const Camera& camera, const Context& context) {
  PathFrame paths(a.threads);
  const ReferenceOptions frame{
      .width = a.width, .height = a.height, .samples = a.paths.value_or(0), .antialias = a.frame.antialias};
  paths.start({scene, camera, frame, a.seed});
  std::uint32_t told = 0;
  Clock::time_point last = Clock::now();
  while (!paths.wait(0.1)) {
    if (context.stopped()) return fail(ErrorCode::kStopped, "", "stopped; nothing was written");
    if (seconds_since(last) < kTold_s) continue;
    last = Clock::now();
    if (const auto mean = paths.newer(told)) {
      told = mean->samples;
      fmt::print(stderr, "oriel-preview: {} of {} paths a pixel, noise {:.1f} %\n", told, *a.paths,
                 100 * mean->relative_noise);
    }
  }
  if (auto mean = paths.newer(0)) return std::move(*mean);
  return fail(ErrorCode::kStopped, "", "stopped; nothing was written");
}

}  // namespace

Status preview_offscreen(const PreviewArguments& a, Context& context, Clock::time_point started) {
  ORIEL_TRY(const auto gl, gpu::HeadlessContext::create());
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  ORIEL_TRY(PreviewRenderer renderer, PreviewRenderer::create(device));
  const double ready_s = seconds_since(started);
  ORIEL_TRY(const auto scene, load_preview_scene(a.scene, context));
  ORIEL_TRY(const Camera camera, choose_camera(scene->scene(), a.camera));
  const double loaded_s = seconds_since(started);
  ORIEL_TRY_VOID(renderer.take(scene));
  ORIEL_TRY_VOID(renderer.look(camera, a.width, a.height));
  PreviewStats stats;
  double first_s = 0, first_cpu_s = 0;
  for (std::uint32_t i = 0; i < a.passes; ++i) {
    if (context.stopped()) return fail(ErrorCode::kStopped, "", "stopped; nothing was written");
    ORIEL_TRY(stats, renderer.pass(a.frame, context));
    if (i == 0) first_s = seconds_since(started), first_cpu_s = static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  }
  const double drawn_s = seconds_since(started);
  std::optional<FloatImage> paths;
  double noise = 0;
  if (a.paths.value_or(0) > 0) {
    ORIEL_TRY(const PathMean mean, trace_paths(a, scene, camera, context));
    noise = mean.relative_noise;
    ORIEL_TRY(paths, blend_paths(mean, renderer.read_mean(), context));
  }
  ORIEL_TRY(const FrameTarget* frame, renderer.frame(paths ? &*paths : nullptr));
  if (a.stats) {
    const Json json = {{"first_lit_s", first_s},
                       {"first_lit_cpu_s", first_cpu_s},
                       {"drawn_s", drawn_s},
                       {"cpu_s", static_cast<double>(std::clock()) / CLOCKS_PER_SEC},
                       {"device_s", ready_s},
                       {"loaded_s", loaded_s},
                       {"import_s", scene->import_s},
                       {"rays_s", scene->rays_s},
                       {"triangles", scene->scene().triangles.size()},
                       {"lamps", scene->lamps.count()},
                       {"passes", renderer.passes()},
                       {"paths", a.paths.value_or(0)},
                       {"noise", noise},
                       {"passes_frame", json_of_frame(renderer.read_mean())},
                       {"last_pass", json_of_pass(stats)}};
    fmt::print("{}\n", json.dump());
  }
  if (a.output.empty()) return {};
  auto notes = camera_notes(camera, scene->scene().origin);
  notes["oriel.camera"] = a.camera.empty() ? camera.name : a.camera;
  return write_frame(a, device, *frame, std::move(notes));
}

}  // namespace oriel
