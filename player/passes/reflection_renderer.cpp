#include "player/passes/reflection_renderer.h"

#include <algorithm>

#include "player/gpu/raster_state.h"
#include "player/passes/holes.h"
#include "player/passes/mirrored_view.h"
#include "player/reflections/reflected_view.h"
#include "player/scene/surface.h"

namespace oriel {

// M of a reflector, and how it is shown.
struct ReflectionRenderer::Image {
  const ImageTarget& target;
  ImageRect rect;
  const GpuKernel& kernel;
  bool blurs = false;
  bool has_holes = true;
};

namespace {

// Nearer to the plane than this share of the reflector's size, an eye sees nothing in it but its edge.
constexpr float kEdgeOn = 1e-5f;

// Of the frame, from which a reflector is large.
constexpr float kLargeShare = 0.02f;

// What mirrors on the way leave of a reflection that is drawn: less shows as if its lobe was wide. And that, times its
// share of the frame: an image in an image of 30 by 30 pixels at 720p, as bright as the scene.
constexpr float kLeastReflectance = 0.01f, kLeastShown = 1e-3f;

// Of the light, from which a reflector is a mirror to others.
constexpr float kMirroring = 0.5f;

float share_of_picture(const NdcRect& rect) {
  const Vec2 size = glm::max(glm::min(rect.upper, Vec2(1)) - glm::max(rect.lower, Vec2(-1)), Vec2(0));
  return 0.25f * size.x * size.y;
}

// At 60 degrees, largest channel; 0 where nothing is known.
float reflectance_of(const Pack& pack, std::uint32_t material) {
  const std::int32_t row = pack.materials[material].fresnel_map;
  if (row < 0) return 0;
  const auto& table = pack.fresnel_maps[static_cast<std::size_t>(row)].table;
  return table.empty() ? 0.0f : max_component(table[table.size() / 2]);
}

bool shows_reflectors(const FrameOptions& options) {
  return options.show != Show::kD && options.reflections != Reflections::kOff;
}

bool marches(Reflections way) {
  return way == Reflections::kMarch || way == Reflections::kChosen;
}

template <class Draw>
decltype(auto) timed(PassClock* clock, Pass pass, const Draw& draw) {
  return clock != nullptr ? clock->time(pass, draw) : draw();
}

}  // namespace

void ReflectionTarget::bind() const {
  (frame != nullptr ? frame->drawn() : image->sharp_framebuffer).bind();
  if (image != nullptr) image->sharp_framebuffer.attach_color_level(image->sharp, 0);
  glViewport(0, 0, view.width, view.height);
}

Result<ReflectionRenderer> ReflectionRenderer::create(const gpu::Device& device) {
  ReflectionRenderer out;
  out.device_ = device;
  ORIEL_TRY(out.reflector_pass_, ReflectorPass::create(device.dialect));
  ORIEL_TRY(out.march_pass_, MarchPass::create(device.dialect));
  ORIEL_TRY(out.mesh_pass_, MeshPass::create(device));
  ORIEL_TRY(out.reproject_pass_, ReprojectPass::create(device));
  ORIEL_TRY(out.fill_pass_, FillPass::create(device.dialect));
  ORIEL_TRY(out.convolve_pass_, ConvolvePass::create(device.dialect));
  ORIEL_TRY(out.curved_pass_, CurvedPass::create(device.dialect));
  return out;
}

Result<std::vector<MarkedReflector>> ReflectionRenderer::draw_masks(ReflectionWork& work,
                                                                    const ReflectionTarget& target,
                                                                    ReflectionMarks& marks) {
  std::vector<MarkedReflector> out;
  const FrameOptions& options = work.options;
  if (!shows_reflectors(options)) return out;
  GpuScene& scene = work.scene;
  for (const GpuReflector& reflector : scene.reflectors()) {
    const bool maps = shows_maps(reflector, options);
    if (reflector.index_count == 0 || (maps && options.maps_per_element <= 0)) continue;
    const Vec4 eye = eye_in_reflector(reflector, target.view);
    if (eye.z <= (target.view.orthographic ? kEdgeOn : kEdgeOn * reflector.size)) continue;
    MarkedReflector marked{&reflector, project_polygon(target.view.clip_from_pack, reflector.corners), 0,
                           kMaskQueries * out.size(), false};
    if (marked.screen.empty ||
        (options.few_reflections && target.share * share_of_picture(marked.screen) < kLargeShare))
      continue;
    const bool see_through = scene.is_transparent(reflector.material);
    const float left = target.reflectance * reflectance_of(scene.pack(), reflector.material);
    if (target.frame == nullptr && (see_through || left < kLeastReflectance ||
                                    left * target.share * share_of_picture(marked.screen) < kLeastShown))
      continue;
    if (maps) {
      ORIEL_TRY(const bool shows, scene.may_show_maps(reflector));
      marked.waits = !shows;
    }
    if (!see_through && marks.materials.size() + 1 >= kMoverBits) continue;  // more than the stencil counts
    if (!see_through && !marked.waits) {
      marks.materials.push_back(reflector.material);
      marked.value = static_cast<GLint>(marks.materials.size());
    }
    while (queries_.size() < marked.query + kMaskQueries) queries_.push_back(gpu::make_query());
    reflector_pass_.draw_mask(scene, reflector, target.view, marked.screen,
                              see_through ? static_cast<GLint>(kSeeThroughBit) : marked.value,
                              marked.waits  ? 0
                              : see_through ? kSeeThroughBit
                                            : kReflectorBits,
                              std::span(queries_).subspan(marked.query, kMaskQueries), work.stats);
    out.push_back(marked);
  }
  for (MarkedReflector& m : out) {
    m.screen = ReflectorPass::visible_part(m.screen, target.view, std::span(queries_).subspan(m.query, kMaskQueries));
    if (m.waits && !m.screen.empty) scene.want_maps(*m.reflector);
  }
  std::erase_if(out, [](const MarkedReflector& m) { return m.screen.empty || m.waits; });
  for (const MarkedReflector& m : out)
    if (m.value > 0) marks.reflective.insert(m.reflector->material);
  return out;
}

Status ReflectionRenderer::draw(ReflectionWork& work, const ReflectionTarget& target, const MarkedReflector& marked,
                                PassClock* clock) {
  auto& [scene, options, stats, scene_pass, mover_pass, movers] = work;
  const GpuReflector& reflector = *marked.reflector;
  const bool maps = shows_maps(reflector, options);
  if (maps) {
    ORIEL_TRY(const bool there, scene.bring_maps(reflector));
    if (!there) return {};  // another reflector's took their room
  }
  const GpuKernel& kernel = scene.kernel(reflector.material, options.kernel, options.coarse);
  const bool blurs = kernel.blurs() && options.blur != Blur::kOff && options.show != Show::kM;
  const ImageRect rect =
      choose_image(marked.screen, blurs ? kernel.median : 0.0f, target.view, device_.texture_size, options.coarse);
  const auto level = static_cast<std::size_t>(target.mirrors);
  if (images_.size() <= level) images_.resize(level + 1);
  const bool halves = halves_ && (!maps || scene.fit_halves(reflector));
  ORIEL_TRY_VOID(ensure_image_target(images_[level], rect.width, rect.height, device_.texture_size, halves));
  const Image image{*images_[level], rect, kernel, blurs, maps};
  stats.image_pixels += static_cast<std::uint64_t>(rect.width) * static_cast<std::uint64_t>(rect.height);
  const bool counted = options.count_holes && marked.value > 0 && target.frame != nullptr;
  if (counted && !kernel.blurs() && maps && marches(options.reflections)) {
    march_pass_.measure(scene, reflector, target.view, rect, image.target, options);
    const PixelCount count = count_pixels(*target.frame, marked.value, image.target, rect, is_sharp);
    stats.mirror_pixels += count.pixels;
    stats.sharp += count.counted;
  }
  ORIEL_TRY_VOID(timed(clock, Pass::kReflect, [&] { return draw_image(work, target, marked, image); }));
  if (counted) {
    const PixelCount count = count_pixels(*target.frame, marked.value, image.target, rect, is_hole);
    stats.reflected_pixels += count.pixels;
    stats.holes += count.counted;
  }
  if (blurs || maps) timed(clock, Pass::kFill, [&] { fill_pass_.draw(rect, image.target, blurs, stats); });
  if (rect.coarse > 1) {
    timed(clock, Pass::kConvolve, [&] {
      convolve_pass_.draw(reflector, kernel, target.view, rect, image.target, scene.bounds().radius(), options.blur,
                          stats);
    });
  }
  target.bind();
  timed(clock, blurs ? Pass::kConvolve : Pass::kCompose, [&] { compose(work, target, marked, image); });
  const GLint value = target.frame != nullptr ? marked.value : kAdded;
  timed(clock, Pass::kEmitters,
        [&] { reflector_pass_.draw_emitters(scene, reflector, target.view, value, options, stats); });
  ++stats.reflectors;
  return {};
}

void ReflectionRenderer::compose(ReflectionWork& work, const ReflectionTarget& target, const MarkedReflector& marked,
                                 const Image& image) const {
  // Of what mostly mirrors, the image's depth counts, as in radiance maps: it is what blurs it in another reflector.
  const bool mirrors = reflectance_of(work.scene.pack(), marked.reflector->material) > kMirroring;
  const GLint value = target.frame != nullptr ? marked.value : mirrors ? kAddedWithDistance : kAdded;
  if (image.blurs) {
    reflector_pass_.draw_convolved(work.scene, *marked.reflector, image.kernel, target.view, image.rect, image.target,
                                   value, work.options, work.stats);
  } else {
    reflector_pass_.draw_light(work.scene, *marked.reflector, target.view, image.rect,
                               image.has_holes ? image.target.filled : image.target.sharp, value, work.options,
                               work.stats);
  }
}

Status ReflectionRenderer::draw_image(ReflectionWork& work, const ReflectionTarget& target,
                                      const MarkedReflector& marked, const Image& image) {
  const GpuReflector& reflector = *marked.reflector;
  if (!image.has_holes) {
    FrameOptions whole = work.options;  // what is in it is shown with all stages
    whole.show = Show::kAll;
    ReflectionWork within{work.scene, whole, work.stats, work.scene_pass, work.mover_pass, work.movers};
    return draw_mirrored(within, target, reflector, image);
  }
  if (work.options.reflections == Reflections::kPoints)
    return reproject_pass_.draw(work.scene, reflector, target.view, image.rect, image.target, work.options, work.stats);
  const ShownPixels shown{target.frame != nullptr ? &target.frame->framebuffer : nullptr,
                          target.frame != nullptr ? marked.value : 0, kReflectorBits};
  if (work.options.reflections == Reflections::kMesh && work.scene.has_map_meshes()) {
    mesh_pass_.draw(work.scene, reflector, target.view, image.rect, image.target,
                    !image.blurs && shown.value != 0 ? &shown : nullptr, work.options, work.stats);
    return {};
  }
  march_pass_.draw(work.scene, reflector, image.blurs ? &image.kernel : nullptr, target.view, image.rect, image.target,
                   shown, work.options, work.stats);
  return {};
}

bool ReflectionRenderer::sets_hold(const ReflectionWork& work, const ReflectionTarget& target) {
  if (!work.options.visible_sets || target.mirrors > 0 || target.view.orthographic) return false;
  if (zone_of_ != work.scene.serial()) {
    zone_ = planned_zone(work.scene.pack());
    zone_of_ = work.scene.serial();
  }
  return zone_.holds(Vec3(target.view.eye));
}

// M by drawing the mirrored scene: what radiance maps stand for, at the cost of the scene's triangles.
Status ReflectionRenderer::draw_mirrored(ReflectionWork& work, const ReflectionTarget& target,
                                         const GpuReflector& reflector, const Image& image) {
  auto& [scene, options, stats, scene_pass, mover_pass, movers] = work;
  const Pack& pack = scene.pack();
  clear_image(image.target, image.rect, Vec4(pack.sky, kClosest));
  const View view = mirrored_view(scene, reflector, target.view, image.rect);
  const ReflectionTarget inside{view,
                                nullptr,
                                &image.target,
                                target.mirrors + 1,
                                target.reflectance * reflectance_of(pack, reflector.material),
                                target.share * static_cast<float>(view.width) * static_cast<float>(view.height) /
                                    (static_cast<float>(target.view.width) * static_cast<float>(target.view.height))};
  MirroredScene mirrored{view,
                         visible_batches(scene.opaque(), make_frustum(view.clip_from_pack),
                                         sets_hold(work, target) ? reflector.seen : std::nullopt),
                         pack.reflectors[reflector.index].emitters,
                         {}};
  if (inside.mirrors < (options.coarse ? 1 : options.orders)) {
    ORIEL_TRY_VOID(draw_mirrors_in(work, inside, mirrored));
  } else {
    scene_pass.draw_reflected(scene, mirrored, stats);
  }
  if (!movers.empty()) {
    mover_pass.draw_depth(scene, view, movers, stats);
    mover_pass.draw_reflected(scene, view, movers, stats);
  }
  return scene_pass.draw_transparent(scene, view, {}, options.white, stats);
}

// The opaque scene in a mirror, with what its own reflectors show.
Status ReflectionRenderer::draw_mirrors_in(ReflectionWork& work, const ReflectionTarget& target,
                                           MirroredScene& mirrored) {
  auto& [scene, options, stats, scene_pass, mover_pass, movers] = work;
  const auto in_view = [&](const GpuReflector& r) {
    return !project_polygon(target.view.clip_from_pack, r.corners).empty;
  };
  const auto& planar = scene.reflectors();
  if (std::none_of(planar.begin(), planar.end(), in_view) && scene.curved_reflectors().empty()) {
    scene_pass.draw_reflected(scene, mirrored, stats);
    return {};
  }
  scene_pass.draw_reflected_depth(scene, mirrored, stats);
  ReflectionMarks marks;
  ORIEL_TRY(const std::vector<MarkedReflector> inside, draw_masks(work, target, marks));
  ORIEL_TRY(const auto curved, draw_curved(work, target, marks));
  mirrored.reflective = marks.reflective;
  scene_pass.draw_reflected(scene, mirrored, stats);
  for (const MarkedReflector& marked : inside) ORIEL_TRY_VOID(draw(work, target, marked, nullptr));
  target.bind();
  add_curved(work, target, curved);
  return {};
}

Result<std::vector<const GpuCurvedReflector*>> ReflectionRenderer::draw_curved(ReflectionWork& work,
                                                                               const ReflectionTarget& target,
                                                                               ReflectionMarks& marks) {
  auto& [scene, options, stats, scene_pass, mover_pass, movers] = work;
  std::vector<const GpuCurvedReflector*> later;
  std::vector<CurvedPass::Shown> opaque;
  if (!shows_reflectors(options) || options.few_reflections) return later;
  const Frustum frustum = make_frustum(target.view.clip_from_pack);
  const bool in_frame = target.frame != nullptr;
  for (const GpuCurvedReflector& reflector : scene.curved_reflectors()) {
    if (!may_be_visible(frustum, reflector.triangles.bounds)) continue;
    const bool see_through = scene.is_transparent(reflector.material);
    if (!in_frame && see_through) continue;
    ORIEL_TRY(const bool there, scene.bring_surround_map(reflector.map));
    if (!there) continue;
    if (see_through) {
      curved_pass_.draw_mask(scene, reflector, target.view, static_cast<GLint>(kSeeThroughBit), kSeeThroughBit, stats);
      later.push_back(&reflector);
      continue;
    }
    if (marks.materials.size() + 1 >= kMoverBits) continue;
    marks.materials.push_back(reflector.material);
    marks.reflective.insert(reflector.material);
    const auto value = static_cast<GLint>(marks.materials.size());
    if (in_frame) {
      opaque.push_back({&reflector, value});
    } else {
      curved_pass_.draw_mask(scene, reflector, target.view, value, kReflectorBits, stats);
      later.push_back(&reflector);
    }
  }
  ORIEL_TRY_VOID(curved_pass_.shade(scene, opaque, target.view, options, stats));
  target.bind();
  for (const CurvedPass::Shown& shown : opaque)
    curved_pass_.draw_shaded(scene, shown, target.view, kReflectorBits, options, stats);
  return later;
}

void ReflectionRenderer::add_curved(ReflectionWork& work, const ReflectionTarget& target,
                                    const std::vector<const GpuCurvedReflector*>& curved) const {
  for (const GpuCurvedReflector* reflector : curved)
    if (work.scene.images().has({ImageKind::kSurround, reflector->map}))
      curved_pass_.add_light(work.scene, *reflector, target.view, work.options, work.stats);
}

}  // namespace oriel
