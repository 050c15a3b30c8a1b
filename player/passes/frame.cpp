#include "player/passes/frame.h"

#include <algorithm>

#include "player/gpu/raster_state.h"

namespace oriel {
namespace {

bool shows_scene(Show show) {
  return show == Show::kAll || show == Show::kD;
}

SceneWeights weights_of(Show show) {
  return show == Show::kD ? SceneWeights{1, 0, 0} : SceneWeights{1, 1, 1};
}

// The opaque scene as the eye may see it.
std::vector<DrawBatch> choose_shown(const FrameContext& context) {
  const auto& [scene, view, options, stats] = context;
  SeenMask seen;
  if (options.visible_sets && !view.orthographic) seen = scene.seen_from(Vec3(view.eye));
  if (seen) {
    stats.groups = static_cast<std::uint32_t>(seen->size());
    stats.groups_seen = static_cast<std::uint32_t>(std::count(seen->begin(), seen->end(), 1));
  }
  return options.coarse ? scene.show_fewer(view, seen) : scene.show(make_frustum(view.clip_from_pack), seen);
}

// Movers as mirrors show them: bright lights are among their harmonics, without shadows.
std::vector<PlacedMover> in_mirrors(const GpuScene& scene, const FrameOptions& options) {
  FrameOptions unshadowed = options;
  unshadowed.mover_lights = MoverLights::kHarmonics;
  return scene.reflectors().empty() ? std::vector<PlacedMover>() : place_movers(scene, unshadowed);
}

void clear_bound(const View& view, const Vec3& color) {
  glViewport(0, 0, view.width, view.height);
  gpu::RasterState all;
  all.depth_write = true;
  all.stencil_write = 0xff;
  gpu::apply(all);
  glClearColor(color.x, color.y, color.z, 1);
  glClearStencil(0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

void count_images(GpuScene& scene, FrameStats& stats) {
  const LoadingState state = scene.images().state();
  stats.map_bytes = scene.map_bytes();
  stats.image_bytes = state.used;
  stats.most_image_bytes = state.most_used;
  stats.coarser_images = static_cast<std::uint32_t>(state.coarser);
  stats.missing_images = static_cast<std::uint32_t>(state.left_out);
}

// Of the bound framebuffer, row 0 at the top.
template <class T>
std::vector<T> read_pixels(const IVec2& size, GLenum format, GLenum type, std::size_t channels) {
  const std::size_t row = channels * static_cast<std::size_t>(size.x);
  std::vector<T> out(row * static_cast<std::size_t>(size.y));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.x, size.y, format, type, out.data());
  for (std::size_t low = 0, high = out.size() / row; low + 1 < high--; ++low)
    std::swap_ranges(&out[low * row], &out[low * row] + row, &out[high * row]);
  return out;
}

template <class T>
std::vector<T> without_alpha(const std::vector<T>& rgba) {
  std::vector<T> rgb;
  rgb.reserve(rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), &rgba[i], &rgba[i] + 3);
  return rgb;
}

}  // namespace

Renderer::Renderer() = default;
Renderer::~Renderer() = default;

Result<std::unique_ptr<Renderer>> Renderer::create(const gpu::Device& device) {
  std::unique_ptr<Renderer> renderer(new Renderer);
  renderer->device_ = device;
  renderer->glass_pass_ = GlassPass(device.dialect);
  renderer->clock_ = PassClock(device.pass_timers);
  ORIEL_TRY(renderer->scene_pass_, ScenePass::create(device));
  ORIEL_TRY(renderer->mover_pass_, MoverPass::create(device.dialect));
  ORIEL_TRY(renderer->bright_pass_, BrightPass::create(device.dialect));
  ORIEL_TRY(renderer->reflections_, ReflectionRenderer::create(device));
  ORIEL_TRY(renderer->survey_pass_, SurveyPass::create(device.dialect));
  ORIEL_TRY(renderer->display_, DisplayPass::create(device.dialect));
  ORIEL_TRY_VOID(gpu::check_gl("compiling shaders"));
  return renderer;
}

Status Renderer::ensure_frame(int width, int height, int samples, bool halves) {
  const int given = std::clamp(samples, 1, device_.samples);
  const auto fits = [&] {
    return frame_ && frame_->size() == IVec2(width, height) && frame_->asked == given && frame_->halves == halves;
  };
  if (fits()) return {};
  if (width < 1 || height < 1 || width > device_.texture_size || height > device_.texture_size) {
    return fail(ErrorCode::kUsage, "frame size", "found {}x{}, expected 1x1 to {}x{} ({})", width, height,
                device_.texture_size, device_.texture_size, device_.renderer);
  }
  std::swap(frame_, spare_);
  if (fits()) return {};
  frame_.reset();
  ORIEL_TRY(FrameTarget frame, make_frame_target(width, height, given, halves));
  frame_ = std::move(frame);
  return {};
}

Result<std::optional<BrightChange>> Renderer::draw_change(const FrameContext& context, std::span<const DrawBatch> shown,
                                                          std::span<const PlacedMover> movers,
                                                          FrameExtension* extension) {
  SceneShadows* const shadows = extension ? extension->scene_shadows() : nullptr;
  const auto draw = [&] { return bright_pass_.draw(context, shown, movers, shadows); };
  ORIEL_TRY(const auto change, clock_.time(Pass::kMovers, draw));
  frame_->drawn().bind();
  glViewport(0, 0, context.view.width, context.view.height);
  return change;
}

// Before movers are drawn: the stencil has reflectors' marks.
Status Renderer::add_light(const FrameContext& context, const LitBatches& lit, FrameExtension& extension) {
  ORIEL_TRY_VOID(extension.add_light(context, LitImage::of(*frame_), lit));
  frame_->drawn().bind();
  glViewport(0, 0, context.view.width, context.view.height);
  return {};
}

Result<FrameStats> Renderer::render(GpuScene& scene, const View& view, const FrameOptions& options,
                                    FrameExtension* extension) {
  in_window_ = drew_movers_ = false;
  // Light of moved lamps is that of the textures that are there.
  if (!options.live.in_background && !options.lamps.empty()) ORIEL_TRY_VOID(scene.load_images(view));
  ORIEL_TRY_VOID(scene.set_lamps(options.lights, options.lamps, options.live));
  if (!scene.images().in_background()) ORIEL_TRY_VOID(scene.load_images(view));
  const bool halves = options.halves && scene.fits_halves();
  ORIEL_TRY_VOID(ensure_frame(view.width, view.height, options.samples, halves));
  reflections_.use_halves(halves);
  FrameStats stats;
  const FrameContext context{scene, view, options, stats};
  clock_.start(options.timed);
  frame_->shows_samples = frame_->samples() > 1;
  frame_->unlit_white = scene.unlit_white();
  frame_->drawn().bind();
  clear_bound(view, options.show == Show::kAll ? scene.pack().sky : Vec3(0));

  std::vector<DrawBatch> shown = choose_shown(context);
  clock_.time(Pass::kDepth, [&] {
    // Movers' light is taken at other places of pixels than the samples.
    const bool marks = device_.shades_hidden && frame_->samples() > 1 && scene.pack().movers.empty();
    if (marks) shown = scene.keep_shown(std::move(shown), {});
    scene_pass_.draw_depth(context, shown);
    if (!marks || shown.empty()) return;
    const std::vector<std::uint32_t> seen = scene_pass_.mark_seen(context, shown);
    shown = scene.keep_shown(std::move(shown), seen);
  });
  if (options.show == Show::kAll) clock_.time(Pass::kScene, [&] { scene_pass_.draw_sky(context, 1); });
  if (is_survey(options.show)) {
    ORIEL_TRY_VOID(clock_.time(Pass::kScene, [&] { return survey_pass_.draw(context, shown); }));
  } else {
    ORIEL_TRY_VOID(draw_light(context, shown, extension));
    count_images(scene, stats);
  }
  frame_->resolve_light();
  stats.ms = clock_.read();
  ORIEL_TRY_VOID(gpu::check_gl("drawing the frame"));
  return stats;
}

Status Renderer::draw_light(const FrameContext& context, std::span<const DrawBatch> shown, FrameExtension* extension) {
  const auto& [scene, view, options, stats] = context;
  const std::vector<PlacedMover> movers = clock_.time(Pass::kMovers, [&] { return place_movers(scene, options); });
  if (!movers.empty()) clock_.time(Pass::kMovers, [&] { mover_pass_.draw_depth(context, movers); });
  const std::vector<PlacedMover> mirrored = in_mirrors(scene, options);
  if (extension) ORIEL_TRY_VOID(extension->begin(context, movers));
  const ReflectionWork work{context, scene_pass_, mover_pass_, mirrored, glass_pass_, extension};
  ReflectionTarget target{&*frame_};
  target.budget_ms = frame_budget_ms(
      options.image_budget_ms == kBudgetOfDevice ? device_budget_ms(device_.renderer) : options.image_budget_ms,
      view.width, view.height, options.coarse);
  ReflectionMarks marks;
  ORIEL_TRY(const std::vector<MarkedReflector> marked,
            clock_.time(Pass::kMask, [&] { return reflections_.draw_masks(context, target, marks); }));
  if (!marked.empty()) {
    // What eyes see straight is known first, whatever mirrors show.
    ORIEL_TRY_VOID(glass_pass_.prepare(context, scene_pass_, target));
    target.bind(view);
    frame_->resolve_depth_stencil();
  }
  for (const MarkedReflector& m : marked)
    if (m.value > 0) ORIEL_TRY_VOID(reflections_.draw(work, target, m, &clock_));
  ORIEL_TRY(const auto see_through,
            clock_.time(Pass::kCurved, [&] { return reflections_.draw_curved(context, target, marks); }));
  marked_ = std::move(marks.materials);
  if (shows_scene(options.show)) {
    const SceneWeights weights = weights_of(options.show);
    ORIEL_TRY(const auto change, draw_change(context, shown, movers, extension));
    drew_movers_ = !movers.empty();
    clock_.time(Pass::kScene, [&] { scene_pass_.draw_opaque(context, shown, weights, marks.reflective, change); });
    if (extension) ORIEL_TRY_VOID(add_light(context, {shown, false, marks.reflective, weights}, *extension));
    if (!movers.empty()) {
      clock_.time(Pass::kMovers, [&] {
        mover_pass_.draw(context, movers, {weights.diffuse, weights.undirected, weights.emission},
                         change ? &change->on_movers : nullptr);
      });
    }
    ORIEL_TRY_VOID(clock_.time(Pass::kTransparent,
                               [&] { return glass_pass_.draw_see_through(context, scene_pass_, target, weights); }));
  }
  for (const MarkedReflector& m : marked)
    if (m.value == 0) ORIEL_TRY_VOID(reflections_.draw(work, target, m, &clock_));
  clock_.time(Pass::kCurved, [&] { reflections_.add_curved(context, see_through); });
  return {};
}

FloatImage Renderer::read_frame() const {
  const IVec2 size = frame_size();
  frame_->framebuffer.bind();
  return {static_cast<std::uint32_t>(size.x), static_cast<std::uint32_t>(size.y), 4,
          read_pixels<float>(size, GL_RGBA, GL_FLOAT, 4)};
}

std::vector<float> Renderer::read_light() const {
  return without_alpha(read_frame().pixels);
}

Status Renderer::take_light(const FloatImage& rgba) {
  ORIEL_TRY_VOID(
      ensure_frame(static_cast<int>(rgba.width), static_cast<int>(rgba.height), frame_ ? frame_->asked : 1, false));
  frame_->shows_samples = in_window_ = false;
  const std::size_t row = 4 * std::size_t{rgba.width};
  std::vector<float> upwards;
  upwards.reserve(rgba.pixels.size());
  for (std::size_t y = rgba.height; y-- > 0;)
    upwards.insert(upwards.end(), &rgba.pixels[y * row], &rgba.pixels[y * row] + row);
  frame_->light.upload(0, upwards.data());
  return gpu::check_gl("taking a picture");
}

std::vector<std::int32_t> Renderer::read_reflective() const {
  frame_->resolve_depth_stencil();
  frame_->framebuffer.bind();
  std::vector<std::int32_t> materials;
  for (const auto stencil : read_pixels<std::uint8_t>(frame_size(), GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 1)) {
    const std::uint32_t value = stencil & kReflectorBits;
    materials.push_back(value == kMoverBits ? kMoverPixel
                        : value > 0         ? static_cast<std::int32_t>(marked_[value - 1])
                                            : -1);
  }
  return materials;
}

Result<std::vector<std::uint8_t>> Renderer::read_display(float ev100, ToneCurve curve) {
  const IVec2 size = frame_size();
  const gpu::Texture2d color(gpu::kRgba8, size.x, size.y, nullptr);
  ORIEL_TRY(const gpu::Framebuffer framebuffer, gpu::Framebuffer::create("picture", &color, nullptr));
  framebuffer.bind();
  display_.draw(*frame_, ev100, curve);
  const auto rgba = read_pixels<std::uint8_t>(size, GL_RGBA, GL_UNSIGNED_BYTE, 4);
  ORIEL_TRY_VOID(gpu::check_gl("reading the picture"));
  return without_alpha(rgba);
}

}  // namespace oriel
