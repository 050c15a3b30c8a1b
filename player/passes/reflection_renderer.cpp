#include "player/passes/reflection_renderer.h"

#include <algorithm>
#include <cmath>

#include "player/passes/holes.h"
#include "player/passes/mirrored_view.h"
#include "player/reflections/reflected_view.h"
#include "player/scene/surface.h"

namespace oriel {

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

// Reflectors on the way of a reflection, where nothing is asked for: images in images grow in number as a power of it.
// A way by mirrors alone that leaves kMirroring of the light goes on to kMostOrders, which facing mirrors of glass and
// silver (0.9 each) end at six.
constexpr int kOrders = 2, kMostOrders = 16;

// Images of mirrored geometry in a frame after which mirrors in them show none: mirrors that overlap on the screen are
// more in each image than its pixels tell.
constexpr int kMostImages = 1024;

int most_orders(const FrameOptions& options) {
  return options.coarse ? 1 : options.orders.value_or(kMostOrders);
}

bool shows_reflectors(const FrameOptions& options) {
  return options.show != Show::kD && options.reflections != Reflections::kOff;
}

// Whether what a reflector shows in an image is worth one of its own; left: of the light, by all mirrors on the way.
bool worth_an_image(const FrameContext& context, const ReflectionTarget& target, const GpuReflector& reflector,
                    float left) {
  const auto& [scene, view, options, stats] = context;
  if (left < kLeastReflectance || scene.is_transparent(reflector.material)) return false;
  if (options.orders || target.mirrors < kOrders) return true;
  return left >= kMirroring && !scene.kernel(reflector.material, options.coarse).blurs();
}

bool blurs(const GpuKernel& kernel, const FrameOptions& options) {
  return kernel.blurs() && options.blur != Blur::kOff && options.show != Show::kM;
}

// Of a reflector in an image.
bool shows_least(float worth, const NdcRect& screen) {
  return worth * share_of_picture(screen) < kLeastShown;
}

template <class Draw>
decltype(auto) timed(PassClock* clock, Pass pass, const Draw& draw) {
  return clock != nullptr ? clock->time(pass, draw) : draw();
}

}  // namespace

Result<ReflectionRenderer> ReflectionRenderer::create(const gpu::Device& device) {
  ReflectionRenderer out;
  out.device_ = device;
  out.prices_ = image_prices(device.renderer);
  ORIEL_TRY(out.reflector_pass_, ReflectorPass::create(device.dialect));
  ORIEL_TRY(out.mesh_pass_, MeshPass::create(device));
  ORIEL_TRY(out.fill_pass_, FillPass::create(device.dialect));
  ORIEL_TRY(out.convolve_pass_, ConvolvePass::create(device.dialect));
  ORIEL_TRY(out.curved_pass_, CurvedPass::create(device.dialect));
  return out;
}

Result<std::vector<MarkedReflector>> ReflectionRenderer::draw_masks(const FrameContext& context,
                                                                    const ReflectionTarget& target,
                                                                    ReflectionMarks& marks) {
  std::vector<MarkedReflector> out;
  const auto& [scene, view, options, stats] = context;
  if (!shows_reflectors(options)) return out;
  if (target.frame == nullptr && target.budget_ms < prices_.image_ms) return out;
  if (target.frame != nullptr) image_count_ = 0;
  for (const GpuReflector& reflector : scene.reflectors()) {
    const bool maps = shows_maps(scene, reflector, options);
    if (reflector.index_count == 0 || (maps && options.maps_per_element <= 0)) continue;
    const Vec4 eye = eye_in_reflector(reflector, view);
    if (eye.z <= (view.orthographic ? kEdgeOn : kEdgeOn * reflector.size)) continue;
    MarkedReflector marked{&reflector, project_polygon(view.clip_from_pack, reflector.corners), 0,
                           kMaskQueries * out.size(), false};
    if (marked.screen.empty) continue;
    const float left = target.reflectance * reflectance_of(scene.pack(), reflector.material);
    marked.worth = left * target.share;
    if (target.frame == nullptr &&
        (!worth_an_image(context, target, reflector, left) || shows_least(marked.worth, marked.screen)))
      continue;
    if (maps) {
      ORIEL_TRY(const bool shows, scene.may_show_maps(reflector));
      marked.waits = !shows;
    }
    while (queries_.size() < marked.query + kMaskQueries) queries_.push_back(gpu::make_query());
    reflector_pass_.ask_visible(context, reflector, marked.screen,
                                std::span(queries_).subspan(marked.query, kMaskQueries));
    out.push_back(marked);
  }
  for (MarkedReflector& m : out) {
    m.screen = ReflectorPass::visible_part(m.screen, view, std::span(queries_).subspan(m.query, kMaskQueries));
    if (m.waits && !m.screen.empty) scene.want_maps(*m.reflector);
  }
  std::erase_if(out, [&](const MarkedReflector& m) {
    return m.screen.empty || m.waits || (target.frame == nullptr && shows_least(m.worth, m.screen));
  });
  afford(context, target, out);
  std::vector<MarkedReflector> drawn;
  for (MarkedReflector& m : out) {
    const std::uint32_t material = m.reflector->material;
    const bool see_through = scene.is_transparent(material);
    if (!see_through && marks.materials.size() + 1 >= kMoverBits) continue;  // more than the stencil counts
    if (!see_through) {
      marks.materials.push_back(material);
      marks.reflective.insert(material);
      m.value = static_cast<GLint>(marks.materials.size());
    }
    reflector_pass_.draw_mask(context, *m.reflector, see_through ? kSeeThroughBit : static_cast<GLuint>(m.value));
    drawn.push_back(m);
  }
  return drawn;
}

ImageRect ReflectionRenderer::rect_of(const FrameContext& context, const MarkedReflector& marked) const {
  const auto& [scene, view, options, stats] = context;
  const GpuKernel& kernel = scene.kernel(marked.reflector->material, options.coarse);
  return choose_image(marked.screen, blurs(kernel, options) ? kernel.median : 0.0f, view, device_.texture_size,
                      options.coarse);
}

void ReflectionRenderer::afford(const FrameContext& context, const ReflectionTarget& target,
                                std::vector<MarkedReflector>& found) {
  const auto& [scene, view, options, stats] = context;
  if (std::isinf(target.budget_ms)) {
    for (MarkedReflector& m : found) m.budget_ms = target.budget_ms;
    return;
  }
  std::vector<PricedImage> images;
  for (const MarkedReflector& m : found) {
    const ImageRect rect = rect_of(context, m);
    const float share = share_of_picture(m.screen);
    std::uint64_t triangles = 0, parts = 0;
    if (!shows_maps(scene, *m.reflector, options)) {
      for (const DrawBatch& batch :
           batches_in(context, target, *m.reflector, mirrored_view(scene, *m.reflector, view, rect))) {
        ++parts;
        for (const std::int32_t count : batch.counts) triangles += static_cast<std::uint64_t>(count) / 3;
      }
    }
    const bool mirror = reflectance_of(scene.pack(), m.reflector->material) >= kMirroring;
    images.push_back({m.worth * share * image_gain(scene, view, *m.reflector, m.screen),
                      prices_.of(parts, triangles, std::uint64_t(rect.width) * std::uint64_t(rect.height)),
                      target.frame != nullptr && mirror && share >= kLargeShare});
  }
  const std::vector<ImageAllowance> allowed = afford_images(images, target.budget_ms);
  std::vector<MarkedReflector> drawn;
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].budget_ms = allowed[i].within_ms;
    if (allowed[i].drawn) drawn.push_back(found[i]);
  }
  found = std::move(drawn);
}

std::vector<DrawBatch> ReflectionRenderer::batches_in(const FrameContext& context, const ReflectionTarget& target,
                                                      const GpuReflector& reflector, const View& mirrored) {
  return visible_batches(context.scene.opaque(), make_frustum(mirrored.clip_from_pack),
                         sets_hold(context, target) ? reflector.seen : std::nullopt);
}

Status ReflectionRenderer::draw(const ReflectionWork& work, const ReflectionTarget& target,
                                const MarkedReflector& marked, PassClock* clock) {
  const auto& [scene, view, options, stats] = work.context;
  const GpuReflector& reflector = *marked.reflector;
  if (work.extension != nullptr && target.frame != nullptr) {
    ORIEL_TRY(const bool drawn,
              work.extension->draw_reflection(work.context, {*target.frame, reflector, marked.screen, marked.value}));
    if (drawn) return {};
  }
  const bool maps = shows_maps(scene, reflector, options);
  if (maps) {
    ORIEL_TRY(const bool there, scene.bring_maps(reflector));
    if (!there) return {};  // another reflector's took their room
  }
  const GpuKernel& kernel = scene.kernel(reflector.material, options.coarse);
  const bool blurred = blurs(kernel, options);
  const ImageRect rect = rect_of(work.context, marked);
  const auto level = static_cast<std::size_t>(target.mirrors);
  if (images_.size() <= level) images_.resize(level + 1);
  const bool halves = halves_ && (!maps || scene.fit_halves(reflector));
  ORIEL_TRY_VOID(ensure_image_target(images_[level], rect.width, rect.height, device_.texture_size, halves));
  const ReflectedImage image{reflector, kernel, rect, *images_[level], blurred, maps};
  stats.image_pixels += static_cast<std::uint64_t>(rect.width) * static_cast<std::uint64_t>(rect.height);
  const bool counted = options.count_holes && marked.value > 0 && target.frame != nullptr;
  ORIEL_TRY_VOID(timed(clock, Pass::kReflect, [&] { return draw_image(work, target, marked, image); }));
  if (counted) {
    const HoleCount count = count_holes(*target.frame, marked.value, image.target, rect);
    stats.reflected_pixels += count.pixels;
    stats.mirror_pixels += kernel.blurs() ? 0 : count.pixels;
    stats.holes += count.holes;
  }
  const gpu::Texture2d& depth = target.frame != nullptr ? target.frame->depth : target.image->depth;
  if (blurred) {
    const bool whole = !maps && (!reflector.seen || !sets_hold(work.context, target));
    timed(clock, Pass::kFill, [&] { convolve_pass_.cut(work.context, image, depth, whole); });
  }
  if (maps || blurred) timed(clock, Pass::kFill, [&] { fill_pass_.draw({rect, image.target, blurred}, stats); });
  if (rect.coarse > 1) timed(clock, Pass::kConvolve, [&] { convolve_pass_.draw(work.context, image); });
  target.bind(view);
  timed(clock, blurred ? Pass::kConvolve : Pass::kCompose, [&] { compose(work.context, target, marked, image); });
  const GLint value = target.frame != nullptr ? marked.value : kAdded;
  timed(clock, Pass::kEmitters, [&] { reflector_pass_.draw_emitters(work.context, reflector, value); });
  ++stats.reflectors;
  return {};
}

void ReflectionRenderer::compose(const FrameContext& context, const ReflectionTarget& target,
                                 const MarkedReflector& marked, const ReflectedImage& image) const {
  // Of what mostly mirrors, the image's depth counts, as in radiance maps: it is what blurs it in another reflector.
  const bool mirrors = reflectance_of(context.scene.pack(), marked.reflector->material) > kMirroring;
  const GLint value = target.frame != nullptr ? marked.value : mirrors ? kAddedWithDistance : kAdded;
  if (image.blurs) {
    reflector_pass_.draw_convolved(context, image, value);
  } else {
    reflector_pass_.draw_light(context, image, value);
  }
}

Status ReflectionRenderer::draw_image(const ReflectionWork& work, const ReflectionTarget& target,
                                      const MarkedReflector& marked, const ReflectedImage& image) {
  if (!image.has_holes) return draw_mirrored(work, target, marked, image);
  const ShownPixels shown{target.frame != nullptr ? &target.frame->framebuffer : nullptr,
                          target.frame != nullptr ? marked.value : 0, kReflectorBits};
  mesh_pass_.draw(work.context, image, !image.blurs && shown.value != 0 ? &shown : nullptr);
  return {};
}

bool ReflectionRenderer::sets_hold(const FrameContext& context, const ReflectionTarget& target) {
  const auto& [scene, view, options, stats] = context;
  if (!options.visible_sets || target.mirrors > 0 || view.orthographic) return false;
  if (zone_of_ != scene.serial()) {
    zone_ = planned_zone(scene.pack());
    zone_of_ = scene.serial();
  }
  return zone_.holds(Vec3(view.eye));
}

// M by drawing the mirrored scene: what radiance maps stand for, at the cost of the scene's triangles.
Status ReflectionRenderer::draw_mirrored(const ReflectionWork& work, const ReflectionTarget& target,
                                         const MarkedReflector& marked, const ReflectedImage& image) {
  const auto& [scene, eyes, options, stats] = work.context;
  const GpuReflector& reflector = image.reflector;
  const Pack& pack = scene.pack();
  clear_image(image.target, image.rect, Vec4(pack.sky, kClosest));
  const View view = mirrored_view(scene, reflector, eyes, image.rect);
  FrameOptions whole = options;  // what is in it is shown with all stages
  whole.show = Show::kAll;
  const ReflectionWork within = work.with({scene, view, whole, stats});
  work.scene_pass.draw_sky(within.context, kClosest);
  const ReflectionTarget inside{nullptr,
                                &image.target,
                                target.mirrors + 1,
                                target.reflectance * reflectance_of(pack, reflector.material),
                                target.share * static_cast<float>(view.width) * static_cast<float>(view.height) /
                                    (static_cast<float>(eyes.width) * static_cast<float>(eyes.height)),
                                marked.budget_ms,
                                image.blurs};
  MirroredScene mirrored{batches_in(work.context, target, reflector, view), reflector.listed, {}};
  if (inside.mirrors < most_orders(options) && ++image_count_ <= kMostImages) {
    ORIEL_TRY_VOID(draw_mirrors_in(within, inside, mirrored));
  } else {
    work.scene_pass.draw_reflected(within.context, mirrored);
    ORIEL_TRY_VOID(add_light(within, inside, mirrored));
  }
  if (!work.movers.empty()) {
    work.mover_pass.draw_depth(within.context, work.movers);
    work.mover_pass.draw_reflected(within.context, work.movers);
  }
  return work.glass.draw_see_through(within.context, work.scene_pass, inside, {});
}

Status ReflectionRenderer::add_light(const ReflectionWork& work, const ReflectionTarget& target,
                                     const MirroredScene& mirrored) {
  if (work.extension == nullptr) return {};
  ORIEL_TRY_VOID(work.extension->add_light(work.context, LitImage::of(*target.image),
                                           {mirrored.shown, true, mirrored.reflective, {}}));
  target.bind(work.context.view);
  return {};
}

// The opaque scene in a mirror, with what its own reflectors show.
Status ReflectionRenderer::draw_mirrors_in(const ReflectionWork& work, const ReflectionTarget& target,
                                           MirroredScene& mirrored) {
  const auto& [context, scene_pass, mover_pass, movers, glass, extension] = work;
  const View& view = context.view;
  const auto in_view = [&](const GpuReflector& r) { return !project_polygon(view.clip_from_pack, r.corners).empty; };
  const auto& planar = context.scene.reflectors();
  if (std::none_of(planar.begin(), planar.end(), in_view) && context.scene.curved_reflectors().empty()) {
    scene_pass.draw_reflected(context, mirrored);
    return add_light(work, target, mirrored);
  }
  scene_pass.draw_reflected_depth(context, mirrored);
  ReflectionMarks marks;
  ORIEL_TRY(const std::vector<MarkedReflector> inside, draw_masks(context, target, marks));
  ORIEL_TRY(const auto curved, draw_curved(context, target, marks));
  mirrored.reflective = marks.reflective;
  scene_pass.draw_reflected(context, mirrored);
  ORIEL_TRY_VOID(add_light(work, target, mirrored));
  for (const MarkedReflector& marked : inside) ORIEL_TRY_VOID(draw(work, target, marked, nullptr));
  target.bind(view);
  add_curved(context, curved);
  return {};
}

Result<std::vector<const GpuCurvedReflector*>> ReflectionRenderer::draw_curved(const FrameContext& context,
                                                                               const ReflectionTarget& target,
                                                                               ReflectionMarks& marks) {
  const auto& [scene, view, options, stats] = context;
  std::vector<const GpuCurvedReflector*> later;
  std::vector<CurvedPass::Shown> opaque;
  if (!shows_reflectors(options)) return later;
  const Frustum frustum = make_frustum(view.clip_from_pack);
  const bool in_frame = target.frame != nullptr;
  for (const GpuCurvedReflector& reflector : scene.curved_reflectors()) {
    if (!may_be_visible(frustum, reflector.triangles.bounds)) continue;
    const bool see_through = scene.is_transparent(reflector.material);
    if (!in_frame && see_through) continue;
    const float worth = target.share * target.reflectance * reflectance_of(scene.pack(), reflector.material);
    if (target.blurs && shows_least(worth, project_box(view.clip_from_pack, reflector.triangles.bounds))) continue;
    ORIEL_TRY(const bool there, scene.bring_surround_map(reflector.map));
    if (!there) continue;
    if (see_through) {
      curved_pass_.draw_mask(context, reflector, static_cast<GLint>(kSeeThroughBit), kSeeThroughBit);
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
      curved_pass_.draw_mask(context, reflector, value, kReflectorBits);
      later.push_back(&reflector);
    }
  }
  ORIEL_TRY_VOID(curved_pass_.shade(context, opaque));
  target.bind(view);
  for (const CurvedPass::Shown& shown : opaque) curved_pass_.draw_shaded(context, shown, kReflectorBits);
  return later;
}

void ReflectionRenderer::add_curved(const FrameContext& context,
                                    const std::vector<const GpuCurvedReflector*>& curved) const {
  for (const GpuCurvedReflector* reflector : curved)
    if (context.scene.images().has({ImageKind::kSurround, reflector->map})) curved_pass_.add_light(context, *reflector);
}

}  // namespace oriel
