#include "study/udeshi1999/hybrid_renderer.h"

#include <algorithm>
#include <chrono>

#include "bake/scene/shade.h"
#include "player/gpu/raster_state.h"
#include "study/udeshi1999/bright_elements.h"
#include "study/udeshi1999/sampled_caps.h"

namespace oriel::study {
namespace {

constexpr std::uint64_t kCapStream = 0x63617073;

// Adds the time that it takes, with the device's work.
template <typename Work>
auto timed(double& seconds, const Work& work) {
  struct Clock {
    double& seconds;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    ~Clock() {
      glFinish();
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
  } clock{seconds};
  return work();
}

// Surfaces that let light through throw no shadow.
ShadowMesh shadows_of(const Scene& scene) {
  std::vector<char> throws(scene.triangles.size());
  for (std::uint32_t t = 0; t < throws.size(); ++t) throws[t] = may_transmit(scene.material_of(t)) ? 0 : 1;
  return {scene.positions, scene.triangles, throws};
}

}  // namespace

Result<HybridRenderer> HybridRenderer::create(const gpu::Device& device) {
  HybridRenderer r;
  r.device_ = device;
  ORIEL_TRY(r.surface_pass_, SurfacePass::create(device.dialect));
  ORIEL_TRY(r.volume_pass_, VolumePass::create(device.dialect));
  ORIEL_TRY(r.lamp_pass_, LampPass::create(device.dialect));
  return r;
}

Status HybridRenderer::take(std::shared_ptr<const PreviewScene> scene) {
  for (const Light& light : scene->scene().lights)
    if (light.profile >= 0)
      return fail(ErrorCode::kUsage, light.name,
                  "found a measured lamp, expected flat, point, spot or directional ones");
  ORIEL_TRY(mesh_, PreviewMesh::create(scene->scene(), scene->parts, device_, mesh_));
  scene_ = std::move(scene);
  shadows_ = shadows_of(scene_->scene());
  volume_pass_.take(shadows_);
  return {};
}

Status HybridRenderer::look(const Camera& camera, int width, int height) {
  const Scene& scene = scene_->scene();
  view_ = make_view(camera, width, height, {scene.lower, scene.upper}, 5e-3f);  // small, for caps by rays
  ORIEL_TRY(surfaces_, make_seen_surfaces(width, height));
  light_ = gpu::Texture2d(gpu::kRgba32f, width, height, nullptr);
  ORIEL_TRY(light_framebuffer_, gpu::Framebuffer::create("seen light", &light_, &surfaces_->depth, true));
  return {};
}

SeenPoints HybridRenderer::seen(float glossy) {
  surface_pass_.draw(mesh_, view_, glossy, *surfaces_);
  return read_seen_points(*surfaces_);
}

ShadowVolumes HybridRenderer::volumes_of(const LampPoint& point, std::uint32_t cap_rays) const {
  if (cap_rays == 0) return shadows_.volumes(point.place, view_.eye);
  Sampler sampler(1, kCapStream, 1);
  return shadows_.volumes(point.place, view_.eye,
                          sampled_occluders(*scene_->accel, view_, point.place, cap_rays, sampler));
}

std::uint32_t HybridRenderer::volumes_around_eye(const LampPoint& point) const {
  return shadows_.volumes(point.place, view_.eye).around_eye;
}

std::vector<std::uint8_t> HybridRenderer::count_volumes(const LampPoint& point, std::uint32_t cap_rays) {
  light_framebuffer_.bind();
  volume_pass_.draw(volumes_of(point, cap_rays), point.place, view_);
  const IVec2 size = surfaces_->size();
  std::vector<std::uint8_t> counts(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.x, size.y, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, counts.data());
  return counts;
}

void HybridRenderer::draw_direct(const HybridOptions& options, HybridFrame& frame) {
  for (const LampPoint& point : frame.lamps) {
    const ShadowVolumes volumes = timed(frame.silhouettes_s, [&] { return volumes_of(point, options.cap_rays); });
    frame.quads += volumes.indices.size() / 6;
    timed(frame.volumes_s, [&] { volume_pass_.draw(volumes, point.place, view_); });
    timed(frame.direct_s, [&] { lamp_pass_.draw(point, scene_->scene(), *surfaces_); });
  }
}

Result<HybridFrame> HybridRenderer::draw(const HybridOptions& options, Context& context) {
  HybridFrame frame;
  const SeenPoints points = timed(frame.surfaces_s, [&] { return seen(options.glossy); });
  const Lamps& lamps = scene_->lamps;
  frame.lamps = lamps.points(context.seed, 0, options.points, lamps.by_power());
  const auto clear = [&] {
    light_framebuffer_.bind();
    gpu::apply({});
    glClearColor(0, 0, 0, 0);
    glClear(GL_COLOR_BUFFER_BIT);
  };
  clear();
  draw_direct(options, frame);
  frame.direct = timed(frame.composite_s, [&] { return read_texture(light_); });
  const auto reflect = [&]() -> Status {
    ORIEL_TRY(frame.elements, bright_elements(*scene_, frame.lamps, options.elements, context));
    clear();
    lamp_pass_.draw_elements(frame.elements, *surfaces_);
    return {};
  };
  ORIEL_TRY_VOID(timed(frame.indirect_s, reflect));
  std::vector<Vec4> light = timed(frame.composite_s, [&] {
    frame.indirect = read_texture(light_);
    std::vector<Vec4> both = frame.direct;
    for (std::size_t i = 0; i < both.size(); ++i) both[i] += frame.indirect[i];
    return both;
  });
  const auto trace = [&] {
    return trace_specular(*scene_, {points, view_.clip_from_pack, view_.eye, light, frame.elements}, 0, context);
  };
  ORIEL_TRY(TracedLight traced, timed(frame.traced_s, trace));
  frame.traced_pixels = traced.pixels;
  frame.traced = std::move(traced.light);
  timed(frame.composite_s, [&] {
    const std::vector<Vec4> diffuse = read_texture(surfaces_->diffuse);
    frame.sum = read_texture(surfaces_->emission);
    for (std::size_t i = 0; i < light.size(); ++i)
      frame.sum[i] = points.place[i].w > 0 ? frame.sum[i] + diffuse[i] * light[i] + frame.traced[i] : Vec4(0);
  });
  ORIEL_TRY_VOID(gpu::check_gl("drawing the hybrid's frame"));
  return frame;
}

}  // namespace oriel::study
