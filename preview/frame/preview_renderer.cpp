#include "preview/frame/preview_renderer.h"

#include <algorithm>
#include <chrono>

#include "bake/trace/sampler.h"
#include "player/gpu/raster_state.h"
#include "preview/frame/streams.h"

namespace oriel {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::uint32_t kLampEyes = 48;      // points that the eye sees, by which lamps share points
constexpr std::size_t kElementsOfPass = 36;  // four for each of 3 x 3 pixels

// Adds the time until it ends; waits for the device, whose work comes later otherwise.
class PassTime {
 public:
  explicit PassTime(double& seconds) : seconds_(seconds), start_(Clock::now()) {}
  ~PassTime() {
    glFinish();
    seconds_ += std::chrono::duration<double>(Clock::now() - start_).count();
  }
  PassTime(const PassTime&) = delete;
  PassTime& operator=(const PassTime&) = delete;

 private:
  double& seconds_;
  Clock::time_point start_;
};

// Of reflected light. Later passes are smoothed less, so that nothing is left of it in their mean.
std::size_t smoothing_rounds(std::uint32_t pass) {
  return pass < 8 ? 2 : pass < 64 ? 1 : 0;
}

void draw_screen(const gpu::VertexArray& no_vertices) {
  glBindVertexArray(no_vertices.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

}  // namespace

Result<PreviewRenderer> PreviewRenderer::create(const gpu::Device& device) {
  PreviewRenderer r;
  r.device_ = device;
  ORIEL_TRY(r.surface_pass_, SurfacePass::create(device.dialect));
  ORIEL_TRY(r.sum_pass_, gpu::Program::create("screen_preview_sum", device.dialect));
  ORIEL_TRY(r.mean_pass_, gpu::Program::create("screen_preview_mean", device.dialect));
  r.no_vertices_ = gpu::make_vertex_array();
  return r;
}

Status PreviewRenderer::take(std::shared_ptr<const PreviewScene> scene) {
  ORIEL_TRY(mesh_, PreviewMesh::create(scene->scene(), scene->parts, device_, mesh_));
  scene_ = std::move(scene);
  begin_again();
  return {};
}

Status PreviewRenderer::look(const Camera& camera, int width, int height) {
  if (std::max(width, height) > device_.texture_size)
    return fail(ErrorCode::kUsage, "", "found a frame of {}x{}, expected at most {} a side on this device", width,
                height, device_.texture_size);
  camera_ = camera;
  begin_again();
  if (surfaces_ && surfaces_->size() == IVec2(width, height)) return {};
  ORIEL_TRY(surfaces_, make_seen_surfaces(width, height));
  light_ = gpu::Texture2d(gpu::kRgba32f, width, height, nullptr);
  sum_ = gpu::Texture2d(gpu::kRgba32f, width, height, nullptr);
  ORIEL_TRY(sum_framebuffer_, gpu::Framebuffer::create("seen light", &sum_, nullptr));
  ORIEL_TRY(frame_, make_frame_target(width, height, 1, false));
  frame_->framebuffer.bind();
  gpu::apply({});
  glClear(GL_COLOR_BUFFER_BIT);
  const std::vector<Vec4> black(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  traced_ = gpu::Texture2d(gpu::kRgba32f, width, height, black.data());
  has_traced_ = false;
  paths_ = gpu::Texture2d(gpu::kRgba32f, width, height, black.data());
  return {};
}

// Through another point of the pixels in each pass.
View PreviewRenderer::view_of_pass(bool antialias) const {
  const IVec2 size = surfaces_->size();
  const Scene& scene = scene_->scene();
  const View view = make_view(camera_, size.x, size.y, {scene.lower, scene.upper});
  if (!antialias) return view;
  Sampler sampler(1, kPixelStream, passes_);
  return part_of(view, sampler.next2() - 0.5f, size.x, size.y);
}

Result<PreviewStats> PreviewRenderer::pass(const PreviewOptions& options, Context& context) {
  PreviewStats stats;
  {
    const PassTime total(stats.total_s);
    reflecting_.clear();
    view_ = view_of_pass(options.antialias);
    {
      const PassTime stage(stats.surfaces_s);
      surface_pass_.draw(mesh_, view_, options.glossy, *surfaces_);
      points_ = read_seen_points(*surfaces_);
    }
    ORIEL_TRY_VOID(light(options, context, stats));
    if (options.traced) {
      const PassTime stage(stats.traced_s);
      ORIEL_TRY_VOID(trace(context, stats));
    }
    add_pass(options);
    ++passes_;
  }
  ORIEL_TRY_VOID(gpu::check_gl("drawing the preview"));
  return stats;
}

Status PreviewRenderer::light(const PreviewOptions& options, Context& context, PreviewStats& stats) {
  light_here_.assign(points_.place.size(), Vec4(0));
  if (options.direct) {
    const PassTime stage(stats.direct_s);
    ORIEL_TRY_VOID(add_lamps(options, context, stats));
  }
  if (options.bounce) {
    const PassTime stage(stats.bounce_s);
    ORIEL_TRY_VOID(reflect(options, context));
  }
  light_.upload(0, light_here_.data());
  return {};
}

Status PreviewRenderer::add_lamps(const PreviewOptions& options, Context& context, PreviewStats& stats) {
  ORIEL_TRY_VOID(share_lamps(context));
  const auto lamps = scene_->lamps.points(context.seed, passes_, options.samples, lamp_shares_);
  stats.points = lamps.size();
  if (lamps.empty()) return {};
  std::atomic<std::size_t> rays{0};
  SharedPoints shared{options.shared ? sharing_side(lamps.size()) : 1, passes_, nullptr, &rays};
  if (!options.shared) {
    if (!classes_) classes_.emplace(surfaces_->size());
    classes_->begin(lamps, context.seed, passes_);
    shared.classes = &*classes_;
  }
  ORIEL_TRY(light_here_, lamps_by_rays(points_, lamps, *scene_->accel, shared, context));
  stats.shadow_rays = rays;
  return {};
}

// Once for each view, so that points of its passes are stratified.
Status PreviewRenderer::share_lamps(Context& context) {
  if (passes_ > 0) return {};
  const auto eye = eye_points(points_, *scene_->accel, kLampEyes, context.seed, 0);
  ORIEL_TRY(lamp_shares_, scene_->lamps.by_eye(eye, *scene_->accel, context));
  return {};
}

// What surfaces shine back. Neighbours share it: it shines smoothly.
Status PreviewRenderer::reflect(const PreviewOptions& options, Context& context) {
  ORIEL_TRY(reflecting_, reflecting_points(*scene_, points_, {options.elements, kElementsOfPass}, passes_, context));
  if (reflecting_.empty()) return {};
  ORIEL_TRY(auto reflected,
            lamps_by_rays(points_, reflecting_, *scene_->accel, {sharing_side(reflecting_.size()), passes_}, context));
  const Neighbours neighbours(points_);
  for (std::size_t step = 3, i = 0; i < smoothing_rounds(passes_); ++i, step *= 2) {
    ORIEL_TRY(reflected, neighbours.smoothed(reflected, step, context));
  }
  for (std::size_t i = 0; i < light_here_.size(); ++i) light_here_[i] += reflected[i];
  return {};
}

Status PreviewRenderer::trace(Context& context, PreviewStats& stats) {
  const auto tagged = [](const Vec4& normal) { return normal.w > 0.5f; };
  if (std::none_of(points_.normal.begin(), points_.normal.end(), tagged)) {
    const std::vector<Vec4> black(has_traced_ ? points_.normal.size() : 0);
    if (std::exchange(has_traced_, false)) traced_.upload(0, black.data());
    return {};
  }
  const TracedFrame frame{points_, view_.clip_from_pack, view_.eye, light_here_, reflecting_};
  ORIEL_TRY(const TracedLight traced, trace_specular(*scene_, frame, passes_, context));
  traced_.upload(0, traced.light.data());
  has_traced_ = true;
  stats.traced_pixels = traced.pixels;
  return {};
}

void PreviewRenderer::add_pass(const PreviewOptions& options) const {
  sum_framebuffer_.bind();
  if (passes_ == 0) {
    gpu::apply({});
    glClear(GL_COLOR_BUFFER_BIT);
  }
  gpu::apply({.blend = gpu::Blend::kAdd});
  sum_pass_.use();
  const gpu::Texture2d* textures[] = {&surfaces_->place, &surfaces_->diffuse, &surfaces_->emission, &light_, &traced_};
  const char* names[] = {"u_place", "u_diffuse", "u_emission", "u_light", "u_traced"};
  for (int i = 0; i < 5; ++i) {
    textures[i]->bind(i);
    sum_pass_.set(names[i], i);
  }
  const Scene& scene = scene_->scene();
  if (mesh_.sky()) mesh_.sky().bind(5);
  sum_pass_.set("u_sky", 5);
  sum_pass_.set("u_sky_image", mesh_.sky() ? 1 : 0);
  sum_pass_.set("u_sky_color", scene.sky);
  sum_pass_.set("u_sky_turn", scene.sky_image.rotation_rad);
  sum_pass_.set("u_pack_from_clip", glm::inverse(view_.clip_from_pack));
  sum_pass_.set("u_eye", view_.eye);
  sum_pass_.set("u_size", Vec2(surfaces_->size()));
  sum_pass_.set("u_traces", options.traced ? 1.0f : 0.0f);
  sum_pass_.set("u_emits", options.emission ? 1.0f : 0.0f);
  draw_screen(no_vertices_);
}

Result<const FrameTarget*> PreviewRenderer::frame(const FloatImage* paths) {
  if (passes_ == 0) return &*frame_;
  if (paths != nullptr) paths_.upload(0, paths->pixels.data());
  frame_->framebuffer.bind();
  glViewport(0, 0, frame_->size().x, frame_->size().y);
  gpu::apply({});
  mean_pass_.use();
  sum_.bind(0);
  paths_.bind(1);
  mean_pass_.set("u_sum", 0);
  mean_pass_.set("u_paths", 1);
  mean_pass_.set("u_has_paths", paths != nullptr ? 1 : 0);
  mean_pass_.set("u_passes", static_cast<float>(std::max(passes_, 1u)));
  draw_screen(no_vertices_);
  ORIEL_TRY_VOID(gpu::check_gl("showing the preview"));
  return &*frame_;
}

FloatImage PreviewRenderer::read_mean() {
  const std::vector<Vec4> sum = read_texture(sum_);
  const auto size = UVec2(surfaces_->size());
  FloatImage out{size.x, size.y, 3, {}};
  out.pixels.reserve(3 * sum.size());
  const float share = 1 / static_cast<float>(std::max(passes_, 1u));
  for (std::uint32_t y = size.y; y-- > 0;)
    for (std::uint32_t x = 0; x < size.x; ++x)
      for (int c = 0; c < 3; ++c) out.pixels.push_back(share * sum[std::size_t{y} * size.x + x][c]);
  return out;
}

}  // namespace oriel
