#include "player/movers/bright_pass.h"

#include <algorithm>

#include "player/scene/surface.h"

namespace oriel {
namespace {

// LitSurface::id: the scene, nothing; movers count from 1, by their place among those of the frame.
constexpr int kSceneId = 0, kNothingId = 1023;
constexpr GLuint kNothing[] = {0, 0, 0, ~0u};

int id_of(std::size_t mover) {
  return static_cast<int>(std::min<std::size_t>(mover + 1, kNothingId));
}

Mat4 box_from_pack(const PlacedMover& placed) {
  const Bounds& box = placed.mover->bounds;
  const Vec3 half = 0.5f * (box.upper - box.lower), middle = box.center();
  Mat4 scale(0);
  for (int axis = 0; axis < 3; ++axis) {
    scale[axis][axis] = half[axis] > 0 ? 1 / half[axis] : 0;
    scale[3][axis] = -middle[axis] * scale[axis][axis];
  }
  scale[3][3] = 1;
  return scale * glm::inverse(placed.pack_from_object);
}

// The screen's rectangle that holds points: lower x, y, upper x, y. All of it where one is behind the eye.
Vec4 rectangle_of(const Mat4& clip_from_pack, std::span<const Vec3> points) {
  Vec2 lower(1), upper(-1);
  for (const Vec3& p : points) {
    const Vec4 clip = clip_from_pack * Vec4(p, 1);
    if (!(clip.w > 1e-6f * std::max(std::abs(clip.x), std::abs(clip.y)))) return {-1, -1, 1, 1};
    const Vec2 at = glm::clamp(Vec2(clip) / clip.w, Vec2(-1), Vec2(1));
    lower = glm::min(lower, at);
    upper = glm::max(upper, at);
  }
  return {lower, upper};
}

std::size_t groups_of(const LightSamples& light) {
  return (light.at.size() + kPointsOfLayer - 1) / kPointsOfLayer;
}

std::span<const Vec4> points_of(const LightSamples& light, std::size_t group) {
  const std::span<const Vec4> rest = std::span(light.at).subspan(group * kPointsOfLayer);
  return rest.first(std::min<std::size_t>(kPointsOfLayer, rest.size()));
}

}  // namespace

Result<BrightPass> BrightPass::create(gpu::Dialect dialect) {
  BrightPass pass;
  ORIEL_TRY(pass.maps_, ShadowMaps::create(dialect));
  ORIEL_TRY(pass.shade_, ShadePass::create(dialect));
  ORIEL_TRY(pass.surface_, gpu::Program::create("mover_surface", dialect));
  ORIEL_TRY(pass.shadow_, gpu::Program::create("mover_shadow", dialect));
  ORIEL_TRY(pass.light_, gpu::Program::create("mover_bright_light", dialect));
  pass.no_vertices_ = gpu::make_vertex_array();
  return pass;
}

Status BrightPass::Canvas::make(int width, int height) {
  depth = gpu::Texture2d(gpu::kDepth32f, width, height, nullptr);
  surfaces = gpu::Texture2d(gpu::kRgba32ui, width, height, nullptr);
  taken = gpu::Texture2d(gpu::kRgba8, width, height, nullptr);
  change = gpu::Texture2d(gpu::kRgba32f, width, height, nullptr);
  ORIEL_TRY(surfaces_target, gpu::Framebuffer::create("surfaces", &surfaces, &depth));
  ORIEL_TRY(taken_target, gpu::Framebuffer::create("shadows", &taken, nullptr));
  ORIEL_TRY(change_target, gpu::Framebuffer::create("bright lights", &change, nullptr));
  return gpu::check_gl("making the pictures of bright lights");
}

void BrightPass::Canvas::bind(const gpu::Framebuffer& target) const {
  target.bind();
  glViewport(0, 0, change.width(), change.height());
}

Status BrightPass::make_targets(const FrameContext& context) {
  const int width = context.view.width, height = context.view.height, less = context.options.shade.every_pixel ? 1 : 2;
  ++targets_;
  ORIEL_TRY_VOID(of_movers_.make(width, height));
  return of_scene_.make((width + less - 1) / less, (height + less - 1) / less);
}

void BrightPass::draw_batches(const FrameContext& context, std::span<const DrawBatch> batches,
                              const Mat4& clip_from_object, const Mat4& pack_from_object, int id) const {
  const auto& [scene, view, options, stats] = context;
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  surface_.set("u_clip_from_pack", clip_from_object);
  surface_.set("u_pack_from_object", pack_from_object);
  for (const DrawBatch& batch : batches) {
    const Material& m = scene.pack().materials[batch.material];
    state.cull = cull_of(m);
    gpu::apply(state);
    surface_.set("u_id", m.unlit ? kNothingId : id);
    set_cutout(surface_, scene, m);
    draw_batch(batch, stats);
  }
}

// Movers as if there were no scene, the scene as if there were no movers: at the middle of pixels, while the frame's
// depth is that of its samples.
void BrightPass::draw_surfaces(const FrameContext& context, std::span<const DrawBatch> shown,
                               std::span<const PlacedMover> movers) const {
  const auto& [scene, view, options, stats] = context;
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  gpu::apply(state);
  surface_.use();
  of_movers_.bind(of_movers_.surfaces_target);
  glClearBufferuiv(GL_COLOR, 0, kNothing);
  glClear(GL_DEPTH_BUFFER_BIT);
  for (std::size_t i = 0; i < movers.size(); ++i) {
    glBindVertexArray(movers[i].mover->vertex_array.name());
    const Mat4 clip = clip_from_object(view, movers[i]);
    draw_batches(context, visible_batches(movers[i].mover->ranges, make_frustum(clip)), clip,
                 movers[i].pack_from_object, id_of(i));
  }
  of_scene_.bind(of_scene_.surfaces_target);
  glClearBufferuiv(GL_COLOR, 0, kNothing);
  glClear(GL_DEPTH_BUFFER_BIT);
  scene.bind_shown();
  draw_batches(context, shown, view.clip_from_pack, Mat4(1), kSceneId);
}

void BrightPass::start_shadows(const Canvas& canvas, const View& view, std::span<const Vec4> points) const {
  canvas.bind(canvas.taken_target);
  gpu::RasterState state;
  gpu::apply(state);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  state.blend = gpu::Blend::kMax;
  state.cull = gpu::Cull::kFront;  // one layer of pixels, from within too
  gpu::apply(state);
  shadow_.use();
  shadow_.set("u_surfaces", kSurfaceUnit);
  shadow_.set("u_mover_depth", kShadowUnit);
  shadow_.set("u_scene_depth", kStaticUnit);
  shadow_.set("u_clip_from_pack", view.clip_from_pack);
  shadow_.set("u_at", points);
  shadow_.set("u_points", static_cast<int>(points.size()));
  canvas.surfaces.bind(kSurfaceUnit);
  maps_.movers().bind(kShadowUnit);
  maps_.scene().bind(kStaticUnit);
}

void BrightPass::set_caster(const LitMovers::Caster& caster, std::span<const Vec4> points, int layer,
                            float reach) const {
  std::array<Mat4, kPointsOfLayer> places{};
  std::array<Vec4, kPointsOfLayer> depths{};
  Vec4 tangents(0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Shaft shaft = make_shaft(points[i], caster.mover->sphere);
    places[i] = place_from_pack(shaft);
    depths[i] = {depth_terms(shaft, mover_range(shaft, caster.mover->sphere.w)),
                 depth_terms(shaft, scene_range(shaft, reach))};
    tangents[static_cast<int>(i)] = shaft.tangent;
  }
  shadow_.set("u_places", std::span<const Mat4>(places));
  shadow_.set("u_depths", std::span<const Vec4>(depths));
  shadow_.set("u_tangents", tangents);
  shadow_.set("u_layer", layer);
  shadow_.set("u_caster", id_of(caster.index));
}

void BrightPass::draw_box(std::span<const Vec3> corners, FrameStats& stats) const {
  shadow_.set("u_corners", corners);
  glDrawArrays(GL_TRIANGLES, 0, 36);
  ++stats.draws;
}

void BrightPass::start_light(const Canvas& canvas, const LitMovers& lit, std::span<const Vec4> points) const {
  canvas.bind(canvas.change_target);
  gpu::RasterState state;
  state.blend = gpu::Blend::kAdd;
  gpu::apply(state);
  light_.use();
  light_.set("u_surfaces", kSurfaceUnit);
  light_.set("u_taken", kTakenUnit);
  light_.set("u_at", points);
  light_.set("u_points", static_cast<int>(points.size()));
  light_.set("u_intensity", lit.samples.intensity / static_cast<float>(lit.samples.at.size()));
  light_.set("u_axis", lit.samples.axis);
  light_.set("u_cones", lit.samples.cones);
  light_.set("u_cosine", lit.samples.cosine ? 1 : 0);
  canvas.surfaces.bind(kSurfaceUnit);
  canvas.taken.bind(kTakenUnit);
}

void BrightPass::draw_rectangle(int id, const Vec4& rectangle, FrameStats& stats) const {
  if (!(rectangle.x < rectangle.z && rectangle.y < rectangle.w)) return;
  light_.set("u_receiver", id);
  light_.set("u_rectangle", rectangle);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  ++stats.draws;
}

void BrightPass::add_to_movers(const FrameContext& context, const LitMovers& lit) const {
  for (const LitMovers::Receiver& r : lit.receivers) {
    if (!r.visible) continue;
    light_.set("u_box_from_pack", box_from_pack(*r.mover));
    light_.set("u_share", r.share);
    draw_rectangle(id_of(r.index), rectangle_of(context.view.clip_from_pack, corners_of(*r.mover)), context.stats);
  }
}

void BrightPass::take_from_scene(const FrameContext& context, const LitMovers& lit) const {
  std::vector<Vec3> shadows;
  for (const LitMovers::Caster& caster : lit.casters)
    if (caster.on_scene) shadows.insert(shadows.end(), caster.scene_box.begin(), caster.scene_box.end());
  draw_rectangle(kSceneId, rectangle_of(context.view.clip_from_pack, shadows), context.stats);
}

void BrightPass::take_otherwise(const FrameContext& context, const SceneShadows& shadows) const {
  of_scene_.bind(of_scene_.change_target);
  gpu::RasterState state;
  state.blend = gpu::Blend::kAdd;
  gpu::apply(state);
  glBindVertexArray(no_vertices_.name());
  shadows.draw(context, of_scene_.surfaces, std::nullopt);
}

Status BrightPass::draw_light(const FrameContext& context, const LitMovers& lit, const SceneShadows* shadows) {
  const auto& [scene, view, options, stats] = context;
  const std::size_t groups = groups_of(lit.samples);
  const float reach = 2 * scene.bounds().radius();
  std::vector<ShadowMaps::Request> requests;
  const auto onto_scene = [](const LitMovers::Caster& caster) { return caster.on_scene; };
  const bool any_on_scene = std::ranges::any_of(lit.casters, onto_scene);
  for (std::uint32_t g = 0; g < groups; ++g)
    for (const LitMovers::Caster& caster : lit.casters)
      requests.push_back({caster.mover, points_of(lit.samples, g), lit.light, caster.index, g});
  ORIEL_TRY(const std::vector<int> layers, maps_.layers(scene, requests, stats));
  glBindVertexArray(no_vertices_.name());
  for (std::size_t g = 0; g < groups; ++g) {
    const std::span<const Vec4> points = points_of(lit.samples, g);
    const auto draw = [&](const Canvas& canvas, auto draw_boxes, auto correct) {
      start_shadows(canvas, view, points);
      for (std::size_t c = 0; c < lit.casters.size(); ++c) {
        set_caster(lit.casters[c], points, layers[g * lit.casters.size() + c], reach);
        draw_boxes(lit.casters[c]);
      }
      correct();
      start_light(canvas, lit, points);
    };
    draw(
        of_movers_,
        [&](const LitMovers::Caster& caster) {
          for (const std::size_t r : caster.on_movers) draw_box(corners_of(*lit.receivers[r].mover), stats);
        },
        [] {});
    add_to_movers(context, lit);
    if (!any_on_scene) continue;
    draw(
        of_scene_,
        [&](const LitMovers::Caster& caster) {
          if (caster.on_scene) draw_box(caster.scene_box, stats);
        },
        [&] {
          if (shadows == nullptr) return;
          gpu::apply({});
          shadows->draw(context, of_scene_.surfaces, lit.light);
        });
    take_from_scene(context, lit);
  }
  return {};
}

Result<std::optional<BrightChange>> BrightPass::draw(const FrameContext& context, std::span<const DrawBatch> shown,
                                                     std::span<const PlacedMover> movers, SceneShadows* shadows) {
  const auto& [scene, view, options, stats] = context;
  std::vector<LitMovers> lights =
      find_lit(scene.bright_lights(), movers, make_frustum(view.clip_from_pack), scene.bounds(), options);
  ORIEL_TRY(const bool shaded, shade_.prepare(context, movers));
  if (lights.empty() && !shaded) return std::nullopt;
  const BrightChange change{{&of_movers_.change, &of_movers_.surfaces}, &of_scene_.change, &of_scene_.surfaces};
  Known now{scene.serial(),
            view.clip_from_pack,
            view.width,
            view.height,
            options.mover_lights,
            shadows,
            options.light_points,
            options.look,
            options.shade,
            shade_.version(),
            shaded,
            options.visible_sets,
            {}};
  for (const PlacedMover& placed : movers) now.poses.push_back(placed.pack_from_object);
  if (now == known_ && shadows == nullptr) return change;
  if (known_.width != now.width || known_.height != now.height || known_.shade.every_pixel != now.shade.every_pixel)
    ORIEL_TRY_VOID(make_targets(context));
  known_ = {};
  if (shadows != nullptr) shadows->prepare(context, lights);
  draw_surfaces(context, shown, movers);
  gpu::apply({});
  glClearColor(0, 0, 0, 0);
  for (const Canvas* canvas : {&of_movers_, &of_scene_}) {
    canvas->bind(canvas->change_target);
    glClear(GL_COLOR_BUFFER_BIT);
  }
  for (const LitMovers& lit : lights) ORIEL_TRY_VOID(draw_light(context, lit, shadows));
  if (shadows != nullptr) take_otherwise(context, *shadows);
  if (shaded) {
    const LitTarget target{of_scene_.surfaces, of_scene_.change, of_scene_.change_target, targets_};
    ORIEL_TRY_VOID(shade_.draw(context, movers, target));
  }
  known_ = std::move(now);
  return change;
}

}  // namespace oriel
