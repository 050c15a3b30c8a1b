#include "player/passes/frame.h"

#include <algorithm>

#include "player/gpu/raster_state.h"
#include "player/passes/geometry_pass.h"
#include "player/passes/holes.h"
#include "player/reflections/reflected_view.h"

namespace oriel {
namespace {

// Nearer to the plane than this share of the reflector's size, an eye sees nothing in it but its edge.
constexpr float kEdgeOn = 1e-5f;

// Of the frame, from which a reflector is large.
constexpr float kLargeShare = 0.02f;

float share_of_frame(const NdcRect& rect) {
  const Vec2 size = glm::max(glm::min(rect.upper, Vec2(1)) - glm::max(rect.lower, Vec2(-1)), Vec2(0));
  return 0.25f * size.x * size.y;
}

bool shows_reflectors(Show show) {
  return show != Show::kD;
}
bool shows_scene(Show show) {
  return show == Show::kAll || show == Show::kD;
}

SceneWeights weights_of(Show show) {
  return show == Show::kD ? SceneWeights{1, 0, 0} : SceneWeights{1, 1, 1};
}

// The opaque scene as the eye may see it.
std::vector<DrawBatch> choose_shown(GpuScene& scene, const View& view, const FrameOptions& options, FrameStats& stats) {
  SeenMask seen;
  if (options.visible_sets && !view.orthographic) seen = scene.seen_from(Vec3(view.eye));
  if (seen) {
    stats.groups = static_cast<std::uint32_t>(seen->size());
    stats.groups_seen = static_cast<std::uint32_t>(std::count(seen->begin(), seen->end(), 1));
  }
  return options.coarse ? scene.show_fewer(view, seen) : scene.show(make_frustum(view.clip_from_pack), seen);
}

void count_images(GpuScene& scene, FrameStats& stats) {
  const LoadingState state = scene.images().state();
  stats.map_bytes = scene.map_bytes();
  stats.image_bytes = state.used;
  stats.most_image_bytes = state.most_used;
  stats.coarser_images = static_cast<std::uint32_t>(state.coarser);
  stats.missing_images = static_cast<std::uint32_t>(state.left_out);
}

template <class T>
std::vector<T> flipped(const std::vector<T>& rgba, int width, int height) {
  std::vector<T> rgb;
  rgb.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t at =
          (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 4;
      rgb.insert(rgb.end(), {rgba[at], rgba[at + 1], rgba[at + 2]});
    }
  }
  return rgb;
}

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(const gpu::Device& device) {
  std::unique_ptr<Renderer> renderer(new Renderer);
  renderer->device_ = device;
  renderer->clock_ = PassClock(device.pass_timers);
  ORIEL_TRY(renderer->scene_pass_, ScenePass::create(device.dialect));
  ORIEL_TRY(renderer->mover_pass_, MoverPass::create(device.dialect));
  ORIEL_TRY(renderer->bright_pass_, BrightPass::create(device.dialect));
  ORIEL_TRY(renderer->reflector_pass_, ReflectorPass::create(device.dialect));
  ORIEL_TRY(renderer->march_pass_, MarchPass::create(device.dialect));
  ORIEL_TRY(renderer->mesh_pass_, MeshPass::create(device));
  ORIEL_TRY(renderer->reproject_pass_, ReprojectPass::create(device));
  ORIEL_TRY(renderer->fill_pass_, FillPass::create(device.dialect));
  ORIEL_TRY(renderer->convolve_pass_, ConvolvePass::create(device.dialect));
  ORIEL_TRY(renderer->curved_pass_, CurvedPass::create(device.dialect));
  ORIEL_TRY(renderer->survey_pass_, SurveyPass::create(device.dialect));
  ORIEL_TRY(renderer->display_, DisplayPass::create(device.dialect));
  ORIEL_TRY_VOID(gpu::check_gl("compiling shaders"));
  return renderer;
}

Status Renderer::ensure_frame(int width, int height, int samples) {
  const int given = std::clamp(samples, 1, device_.samples);
  if (frame_ && frame_->size() == IVec2(width, height) && frame_->asked == given) return {};
  if (width < 1 || height < 1 || width > device_.texture_size || height > device_.texture_size) {
    return fail(ErrorCode::kUsage, "frame size", "found {}x{}, expected 1x1 to {}x{} ({})", width, height,
                device_.texture_size, device_.texture_size, device_.renderer);
  }
  std::swap(frame_, spare_);
  if (frame_ && frame_->size() == IVec2(width, height) && frame_->asked == given) return {};
  frame_.reset();
  ORIEL_TRY(FrameTarget frame, make_frame_target(width, height, given));
  frame_ = std::move(frame);
  return {};
}

Result<std::vector<Renderer::Candidate>> Renderer::draw_masks(GpuScene& scene, const View& view,
                                                              const FrameOptions& options, FrameStats& stats) {
  std::vector<Candidate> candidates;
  marked_.clear();
  if (!shows_reflectors(options.show) || options.reflections == Reflections::kOff) return candidates;
  if (options.maps_per_element <= 0) return candidates;
  for (const GpuReflector& reflector : scene.reflectors()) {
    if (reflector.elements.empty() || reflector.index_count == 0) continue;
    const Vec4 eye = eye_in_reflector(reflector, view);
    if (eye.z <= (view.orthographic ? kEdgeOn : kEdgeOn * reflector.size)) continue;
    Candidate candidate{&reflector, project_polygon(view.clip_from_pack, reflector.corners), 0,
                        kMaskQueries * candidates.size(), false};
    if (candidate.screen.empty || (options.few_reflections && share_of_frame(candidate.screen) < kLargeShare)) continue;
    ORIEL_TRY(const bool shows, scene.may_show_maps(reflector));
    candidate.waits = !shows;
    const bool see_through = scene.is_transparent(reflector.material);
    if (!see_through && marked_.size() + 1 >= kMoverBits) continue;  // more than the stencil counts
    if (!see_through && !candidate.waits) {
      marked_.push_back(reflector.material);
      candidate.value = static_cast<GLint>(marked_.size());
    }
    while (queries_.size() < candidate.query + kMaskQueries) queries_.push_back(gpu::make_query());
    reflector_pass_.draw_mask(scene, reflector, view, candidate.screen,
                              see_through ? static_cast<GLint>(kSeeThroughBit) : candidate.value,
                              candidate.waits ? 0
                              : see_through   ? kSeeThroughBit
                                              : kReflectorBits,
                              std::span(queries_).subspan(candidate.query, kMaskQueries), stats);
    candidates.push_back(candidate);
  }
  for (Candidate& candidate : candidates) {
    candidate.screen =
        ReflectorPass::visible_part(candidate.screen, view, std::span(queries_).subspan(candidate.query, kMaskQueries));
  }
  for (const Candidate& candidate : candidates)
    if (candidate.waits && !candidate.screen.empty) scene.want_maps(*candidate.reflector);
  std::erase_if(candidates, [](const Candidate& candidate) { return candidate.screen.empty || candidate.waits; });
  return candidates;
}

// M into the image.
Status Renderer::draw_mirrored_world(GpuScene& scene, const Candidate& candidate, const GpuKernel* kernel,
                                     const View& view, const ImageRect& rect, const FrameOptions& options,
                                     FrameStats& stats) {
  const GpuReflector& reflector = *candidate.reflector;
  const ShownPixels shown{&frame_->framebuffer, candidate.value, kReflectorBits};
  switch (options.reflections) {
    case Reflections::kPoints:
      return reproject_pass_.draw(scene, reflector, view, rect, *image_, options, stats);
    case Reflections::kMesh:
      if (!scene.has_map_meshes()) break;
      mesh_pass_.draw(scene, reflector, view, rect, *image_, kernel == nullptr && shown.value != 0 ? &shown : nullptr,
                      options, stats);
      return {};
    case Reflections::kGeometry:
      draw_geometry(scene_pass_, scene, reflector, view, rect, *image_, options.white, stats);
      return {};
    default:
      break;
  }
  march_pass_.draw(scene, reflector, kernel, view, rect, *image_, shown, options, stats);
  return {};
}

Status Renderer::draw_reflection(GpuScene& scene, const Candidate& candidate, const View& view,
                                 const FrameOptions& options, FrameStats& stats) {
  const GpuReflector& reflector = *candidate.reflector;
  ORIEL_TRY(const bool there, scene.bring_maps(reflector));
  if (!there) return {};  // another reflector's took their room
  const GpuKernel& kernel = scene.kernel(reflector.material, options.kernel, options.coarse);
  const bool blurs = kernel.blurs() && options.blur != Blur::kOff && options.show != Show::kM;
  const ImageRect rect =
      choose_image(candidate.screen, blurs ? kernel.median : 0.0f, view, device_.texture_size, options.coarse);
  ORIEL_TRY_VOID(ensure_image_target(image_, rect.width, rect.height, device_.texture_size));
  stats.image_pixels += static_cast<std::uint64_t>(rect.width) * static_cast<std::uint64_t>(rect.height);
  const bool counted = options.count_holes && candidate.value > 0;
  if (counted && !kernel.blurs() && options.reflections == Reflections::kMarch) {
    march_pass_.measure(scene, reflector, view, rect, *image_, options);
    const PixelCount count = count_pixels(*frame_, candidate.value, *image_, rect, is_sharp);
    stats.mirror_pixels += count.pixels;
    stats.sharp += count.counted;
  }
  ORIEL_TRY_VOID(clock_.time(Pass::kReflect, [&] {
    return draw_mirrored_world(scene, candidate, blurs ? &kernel : nullptr, view, rect, options, stats);
  }));
  if (counted) {
    const PixelCount count = count_pixels(*frame_, candidate.value, *image_, rect, is_hole);
    stats.reflected_pixels += count.pixels;
    stats.holes += count.counted;
  }
  clock_.time(Pass::kFill, [&] { fill_pass_.draw(rect, *image_, blurs, stats); });
  if (rect.coarse > 1) {
    clock_.time(Pass::kConvolve, [&] {
      convolve_pass_.draw(reflector, kernel, view, rect, *image_, scene.bounds().radius(), options.blur, stats);
    });
  }
  frame_->drawn().bind();
  glViewport(0, 0, view.width, view.height);
  clock_.time(blurs ? Pass::kConvolve : Pass::kCompose, [&] {
    if (blurs) {
      reflector_pass_.draw_convolved(scene, reflector, kernel, view, rect, *image_, candidate.value, options, stats);
    } else {
      reflector_pass_.draw_light(scene, reflector, view, rect, image_->filled, candidate.value, options, stats);
    }
  });
  clock_.time(Pass::kEmitters,
              [&] { reflector_pass_.draw_emitters(scene, reflector, view, candidate.value, options, stats); });
  ++stats.reflectors;
  return {};
}

// Gives the see-through ones, whose light is added once the scene is drawn.
Result<std::vector<const GpuCurvedReflector*>> Renderer::draw_curved(GpuScene& scene, const View& view,
                                                                     const FrameOptions& options,
                                                                     std::set<std::uint32_t>& reflective,
                                                                     FrameStats& stats) {
  std::vector<const GpuCurvedReflector*> see_through;
  if (!shows_reflectors(options.show) || options.reflections == Reflections::kOff) return see_through;
  if (options.few_reflections) return see_through;
  const Frustum frustum = make_frustum(view.clip_from_pack);
  std::vector<CurvedPass::Shown> opaque;
  for (const GpuCurvedReflector& reflector : scene.curved_reflectors()) {
    if (!may_be_visible(frustum, reflector.triangles.bounds)) continue;
    ORIEL_TRY(const bool there, scene.bring_surround_map(reflector.map));
    if (!there) continue;
    if (scene.is_transparent(reflector.material)) {
      curved_pass_.draw_mask(scene, reflector, view, static_cast<GLint>(kSeeThroughBit), kSeeThroughBit, stats);
      see_through.push_back(&reflector);
    } else if (marked_.size() + 1 < kMoverBits) {
      marked_.push_back(reflector.material);
      opaque.push_back({&reflector, static_cast<GLint>(marked_.size())});
      reflective.insert(reflector.material);
    }
  }
  ORIEL_TRY_VOID(curved_pass_.shade(scene, opaque, view, options, stats));
  frame_->drawn().bind();
  for (const CurvedPass::Shown& shown : opaque)
    curved_pass_.draw_shaded(scene, shown, view, kReflectorBits, options, stats);
  return see_through;
}

Result<std::optional<BrightChange>> Renderer::draw_change(const GpuScene& scene, const View& view,
                                                          std::span<const DrawBatch> shown,
                                                          std::span<const PlacedMover> movers,
                                                          const FrameOptions& options, FrameStats& stats) {
  ORIEL_TRY(const auto change,
            clock_.time(Pass::kMovers, [&] { return bright_pass_.draw(scene, view, shown, movers, options, stats); }));
  frame_->drawn().bind();
  glViewport(0, 0, view.width, view.height);
  return change;
}

Result<float> Renderer::white_for(const GpuScene& scene, const FrameOptions& options) {
  if (options.white > 0 || !needs_white(scene)) return options.white;
  frame_->resolve_light();
  ORIEL_TRY(const std::optional<float> ev100, meter());
  frame_->drawn().bind();
  glViewport(0, 0, frame_->light.width(), frame_->light.height());
  return white_of_exposure(ev100.value_or(0.0f));
}

Result<FrameStats> Renderer::render(GpuScene& scene, const View& view, const FrameOptions& options) {
  ORIEL_TRY_VOID(ensure_frame(view.width, view.height, options.samples));
  in_window_ = false;
  if (!scene.images().in_background()) ORIEL_TRY_VOID(scene.aim(view));
  scene.use_mipmaps(options.mipmaps);
  FrameStats stats;
  clock_.start(options.timed);
  frame_->shows_samples = frame_->samples() > 1;
  frame_->drawn().bind();
  glViewport(0, 0, view.width, view.height);
  gpu::RasterState all;
  all.depth_write = true;
  all.stencil_write = 0xff;
  gpu::apply(all);
  const Vec3 sky = options.show == Show::kAll ? scene.pack().sky : Vec3(0);
  glClearColor(sky.x, sky.y, sky.z, 1);
  glClearStencil(0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);

  const std::vector<DrawBatch> shown = choose_shown(scene, view, options, stats);
  clock_.time(Pass::kDepth, [&] { scene_pass_.draw_depth(scene, view, shown, stats); });
  if (is_survey(options.show)) {
    ORIEL_TRY_VOID(
        clock_.time(Pass::kScene, [&] { return survey_pass_.draw(scene, view, shown, options.show, stats); }));
    frame_->resolve_light();
    stats.ms = clock_.read();
    ORIEL_TRY_VOID(gpu::check_gl("drawing the frame"));
    return stats;
  }
  const std::vector<PlacedMover> movers = clock_.time(Pass::kMovers, [&] { return place_movers(scene, options); });
  if (!movers.empty()) clock_.time(Pass::kMovers, [&] { mover_pass_.draw_depth(scene, view, movers, stats); });
  ORIEL_TRY(const std::vector<Candidate> candidates,
            clock_.time(Pass::kMask, [&] { return draw_masks(scene, view, options, stats); }));
  if (!candidates.empty()) frame_->resolve_depth_stencil();
  std::set<std::uint32_t> reflective;
  for (const Candidate& candidate : candidates) {
    if (candidate.value == 0) continue;
    ORIEL_TRY_VOID(draw_reflection(scene, candidate, view, options, stats));
    reflective.insert(candidate.reflector->material);
  }
  ORIEL_TRY(const auto see_through,
            clock_.time(Pass::kCurved, [&] { return draw_curved(scene, view, options, reflective, stats); }));
  if (shows_scene(options.show)) {
    const SceneWeights weights = weights_of(options.show);
    ORIEL_TRY(const auto change, draw_change(scene, view, shown, movers, options, stats));
    clock_.time(Pass::kScene, [&] { scene_pass_.draw_opaque(scene, view, shown, weights, reflective, change, stats); });
    if (!movers.empty()) {
      clock_.time(Pass::kMovers, [&] {
        mover_pass_.draw(scene, view, movers, {weights.diffuse, weights.undirected, weights.emission},
                         change ? &change->on_movers : nullptr, stats);
      });
    }
    ORIEL_TRY(const float white, white_for(scene, options));
    clock_.time(Pass::kTransparent, [&] { scene_pass_.draw_transparent(scene, view, weights, white, stats); });
  }
  for (const Candidate& candidate : candidates) {
    if (candidate.value == 0) ORIEL_TRY_VOID(draw_reflection(scene, candidate, view, options, stats));
  }
  clock_.time(Pass::kCurved, [&] {
    for (const GpuCurvedReflector* reflector : see_through)
      if (scene.images().has({ImageKind::kSurround, reflector->map}))
        curved_pass_.add_light(scene, *reflector, view, options, stats);
  });
  frame_->resolve_light();
  count_images(scene, stats);
  stats.ms = clock_.read();
  ORIEL_TRY_VOID(gpu::check_gl("drawing the frame"));
  return stats;
}

std::vector<float> Renderer::read_light() const {
  const int width = frame_->light.width(), height = frame_->light.height();
  std::vector<float> rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  frame_->framebuffer.bind();
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, rgba.data());
  return flipped(rgba, width, height);
}

Status Renderer::take_light(const FloatImage& rgba) {
  ORIEL_TRY_VOID(ensure_frame(static_cast<int>(rgba.width), static_cast<int>(rgba.height), frame_ ? frame_->asked : 1));
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
  const auto width = static_cast<std::size_t>(frame_->light.width());
  const auto height = static_cast<std::size_t>(frame_->light.height());
  std::vector<std::uint8_t> stencil(width * height);
  frame_->resolve_depth_stencil();
  frame_->framebuffer.bind();
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, frame_->light.width(), frame_->light.height(), GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, stencil.data());
  std::vector<std::int32_t> materials;
  for (std::size_t y = height; y-- > 0;)
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint32_t value = stencil[y * width + x] & kReflectorBits;
      materials.push_back(value == kMoverBits ? kMoverPixel
                          : value > 0         ? static_cast<std::int32_t>(marked_[value - 1])
                                              : -1);
    }
  return materials;
}

Result<std::vector<std::uint8_t>> Renderer::read_display(float ev100, ToneCurve curve) {
  const int width = frame_->light.width(), height = frame_->light.height();
  const gpu::Texture2d color(gpu::kRgba8, width, height, nullptr);
  ORIEL_TRY(const gpu::Framebuffer framebuffer, gpu::Framebuffer::create("picture", &color, nullptr));
  framebuffer.bind();
  display_.draw(*frame_, ev100, curve);
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  ORIEL_TRY_VOID(gpu::check_gl("reading the picture"));
  return flipped(rgba, width, height);
}

}  // namespace oriel
