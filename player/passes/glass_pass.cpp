#include "player/passes/glass_pass.h"

#include <algorithm>

#include "player/scene/surface.h"

namespace oriel {
namespace {

enum GlassUnit {
  kGlassPlaces = 0,
  kGlassBehind = 1,
  kGlassReflectance = 2,
  kGlassAround = 3,
  kGlassNormals = 4,
  kGlassShape = 5,
  kGlassTints = 6,
  kGlassThrough = 7,
  kGlassTree = 8
};

constexpr float kMostIor = 10;              // beyond it numbers run out
constexpr std::ptrdiff_t kMostWindows = 4;  // bodies of a frame that have one, 1 while something moves
constexpr float kLeastBend = 8;             // pixels by which glass shifts things, for that
// What reflectors show of glass is as in the frame for bodies that cover so much of the whole picture, the largest in
// an image, after so few of them; where a reflector leaves less than half of the light, or blurs, with fewer rays.
constexpr float kLeastInImage = 3e-4f, kMirroringGlass = 0.5f;
constexpr std::size_t kMostInImage = 8;
constexpr int kMostMirrors = 2;
constexpr int kLooks = 32, kPaneLooks = 12, kCoarseLooks = 4;  // of a lobe

// Depth of a view without a mirror's near plane, from where that one has it: of x, y, z, 1 in normalised device
// coordinates.
Vec4 upright_depth(const View& view) {
  const DMat4 upright = DMat4(view.clip_from_view) * DMat4(view.view_from_pack);
  return Vec4(glm::transpose(upright * glm::inverse(DMat4(view.clip_from_pack)))[2]);
}

// Whole pixels around it, and what glass.frag reads beside them.
void scissor_to(const NdcRect& rect, const View& view) {
  const Vec2 size(static_cast<float>(view.width), static_cast<float>(view.height));
  const IVec2 lower(glm::floor((glm::clamp(rect.lower, -1.0f, 1.0f) * 0.5f + 0.5f) * size));
  const IVec2 upper(glm::ceil((glm::clamp(rect.upper, -1.0f, 1.0f) * 0.5f + 0.5f) * size));
  const IVec2 first = glm::max(lower - 2, IVec2(0));
  glScissor(first.x, first.y, rect.empty ? 0 : upper.x + 2 - first.x, rect.empty ? 0 : upper.y + 2 - first.y);
}

bool overlap(const NdcRect& a, const NdcRect& b) {
  return !a.empty && !b.empty && glm::all(glm::lessThanEqual(a.lower, b.upper)) &&
         glm::all(glm::lessThanEqual(b.lower, a.upper));
}

bool blurs(const Material& m, const FrameOptions& options) {
  return m.roughness > kClearGlass && options.blur != Blur::kOff;
}

}  // namespace

Status GlassPass::compile() {
  if (no_vertices_) return {};
  ORIEL_TRY(surface_, gpu::Program::create("glass_surface", dialect_));
  ORIEL_TRY(light_, gpu::Program::create("screen_glass", dialect_));
  ORIEL_TRY(glass_, gpu::Program::create("glass", dialect_));
  ORIEL_TRY(glow_, PaneGlow::create(dialect_));
  ORIEL_TRY(copy_, gpu::Program::create("screen_behind", dialect_));
  no_vertices_ = gpu::make_vertex_array();
  return cubes_.compile(dialect_);
}

std::vector<std::pair<float, std::size_t>> GlassPass::shown_in(const FrameContext& context,
                                                               const ReflectionTarget& target) {
  const auto& [scene, view, options, stats] = context;
  const Frustum frustum = make_frustum(view.clip_from_pack);
  const bool image = target.frame == nullptr;
  std::vector<std::pair<float, std::size_t>> seen;
  if (image && target.mirrors > kMostMirrors) return seen;
  for (std::size_t i = 0; i < scene.glass().size(); ++i) {
    const Bounds& box = scene.glass()[i].bounds;
    if (!may_be_visible(frustum, box)) continue;
    const float share = target.share * share_of_picture(project_box(view.clip_from_pack, box));
    if (!image || share >= kLeastInImage) seen.emplace_back(-share, i);
  }
  std::sort(seen.begin(), seen.end());
  if (image && seen.size() > kMostInImage) seen.resize(kMostInImage);
  return seen;
}

Status GlassPass::prepare(const FrameContext& context, const ScenePass& scene_pass, const ReflectionTarget& target) {
  const auto& [scene, view, options, stats] = context;
  for (Body& body : bodies_) body.shown = false;
  since_.reset();
  const std::vector<std::pair<float, std::size_t>> seen = shown_in(context, target);
  if (seen.empty()) return {};
  ORIEL_TRY_VOID(compile());
  if (!tree_light_ && std::ranges::any_of(scene.glass(), [](const GlassBody& b) { return !b.tree.empty(); })) {
    ORIEL_TRY(tree_light_, gpu::Program::create("screen_glass", dialect_, "TREE"));
  }
  cubes_.start(scene);
  bodies_.resize(scene.glass().size());
  few_looks_ = options.coarse || target.blurs || target.mirrors > 1 || target.reflectance < kMirroringGlass;
  choose_windows(context, target, seen);
  for (const auto& [share, i] : seen) {
    bodies_[i].shown = true;
    ORIEL_TRY_VOID(cubes_.make(context, scene_pass, i, -share));
  }
  return gpu::check_gl("drawing around glass");
}

void GlassPass::choose_windows(const FrameContext& context, const ReflectionTarget& target,
                               std::span<const std::pair<float, std::size_t>> by_share) {
  const auto& [scene, view, options, stats] = context;
  for (Body& body : bodies_) body.window.reset();
  const bool in_image = target.frame == nullptr;
  std::ptrdiff_t left = in_image ? (few_looks_ ? 0 : 1) : options.coarse ? 1 : kMostWindows;
  for (const auto& [share, i] : by_share) {
    if (left == 0) break;
    const GlassBody& body = scene.glass()[i];
    if (body.pane) continue;
    const float ior = std::clamp(scene.pack().materials[body.material].ior, 1.0f, kMostIor);
    bodies_[i].window = window_of(body, ior, kLeastBend, view, scene.bounds());
    left -= bodies_[i].window ? 1 : 0;
  }
}

Status GlassPass::take_behind(const FrameContext& context, const ReflectionTarget& target, bool levels) {
  const auto& [scene, view, options, stats] = context;
  ORIEL_TRY(canvas_, canvases_.of(target, view));
  if (target.frame != nullptr) {
    target.frame->resolve_light();
    target.frame->resolve_depth_stencil();
  }
  canvas_->behind_framebuffer.bind();
  glViewport(0, 0, canvas_->size().x, canvas_->size().y);
  gpu::apply({});
  glBindVertexArray(no_vertices_.name());
  copy_.use();
  (target.frame != nullptr ? target.frame->light : target.image->sharp).bind(0);
  (target.frame != nullptr ? target.frame->depth : target.image->depth).bind(1);
  copy_.set("u_light", 0);
  copy_.set("u_depth", 1);
  copy_.set("u_size", IVec2(view.width, view.height));
  copy_.set("u_oblique", target.frame == nullptr ? 1 : 0);
  if (target.frame == nullptr) copy_.set("u_depth_row", upright_depth(view));
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ++stats.draws;
  if (levels) canvas_->behind.make_mipmaps();
  has_levels_ = levels;
  since_.emplace();
  return {};
}

Status GlassPass::draw_through(const FrameContext& context, const GlassWindow& window, const ScenePass& scene_pass) {
  GpuScene& scene = context.scene;
  ORIEL_TRY_VOID(canvas_->make_through());
  canvas_->through_framebuffer.bind();
  glViewport(0, 0, canvas_->size().x, canvas_->size().y);
  clear_all(Vec4(scene.pack().sky, kClosest));
  View beyond = window.view;
  beyond.clip_from_pack = window.clip;
  const FrameContext through{scene, beyond, context.options, context.stats};
  View all = window.view;
  all.width = canvas_->size().x, all.height = canvas_->size().y;
  scene_pass.draw_sky({scene, all, context.options, context.stats}, kClosest);
  scene_pass.draw_reflected(through, {visible_batches(scene.opaque(), make_frustum(window.clip)), {}, {}});
  if (has_levels_) canvas_->through.make_mipmaps();
  return gpu::check_gl("drawing through glass");
}

// Depth there is as clip_from_view_to() has it.
void GlassPass::set_window(const gpu::Program& light, const std::optional<GlassWindow>& window) const {
  light.set("u_window", window ? 1 : 0);
  if (!window) return;
  const View& view = window->view;
  const Vec2 size(canvas_->size());
  light.set("u_window_from_pack", view.clip_from_pack);
  light.set("u_window_size", size);
  light.set("u_window_tangents", Vec4(view.tangents, view.centre));
  light.set("u_window_depth", Vec3(-view.clip_from_view[2][2], view.clip_from_view[3][2], kClosest));
  light.set("u_window_pixels", 0.5f * std::min(size.x / view.tangents.x, size.y / view.tangents.y));
}

void GlassPass::draw_surface(const FrameContext& context, const GlassBody& body, gpu::RasterState state) const {
  const auto& [scene, view, options, stats] = context;
  canvas_->surfaces_framebuffer.bind();
  glViewport(0, 0, view.width, view.height);
  clear_all(Vec4(0));
  state.depth_write = true;
  gpu::apply(state);
  surface_.use();
  set_surface(surface_, scene, body.material, !scene.pack().mesh.normal_uvs.empty());
  surface_.set("u_clip_from_pack", view.clip_from_pack);
  surface_.set("u_eye", view.eye);
  surface_.set("u_base_texture", kBaseUnit);
  surface_.set("u_normal_texture", kNormalUnit);
  scene.bind_geometry();
  for (const DrawRange& range : body.ranges) draw_indices(range.first_index, range.index_count, stats);
}

void GlassPass::set_body(const gpu::Program& light, const GpuScene& scene, const GlassBody& body,
                         const FrameOptions& options) const {
  const Material& m = scene.pack().materials[body.material];
  const SolidGlass solid = body.pane ? SolidGlass{body.material, m.base_color * ((1 - m.metallic) * m.transmission)}
                                     : scene.pack().solids[body.solid];
  const bool frosted = blurs(m, options);
  light.set("u_pane", body.pane ? 1 : 0);
  light.set("u_tint", glm::clamp(solid.tint, Vec3(0), Vec3(1)));
  light.set("u_absorption", solid.absorption);
  light.set("u_ior", std::clamp(m.ior, 1.0f, kMostIor));
  light.set("u_width", frosted ? m.roughness * m.roughness : 0.0f);
  light.set("u_looks", !frosted                          ? 1
                       : few_looks_                      ? kCoarseLooks
                       : body.pane || !body.tree.empty() ? kPaneLooks
                                                         : kLooks);
  light.set("u_turn", static_cast<float>(glm::fract(0.618033988749895 * options.look)));
  light.set("u_centre", body.centre);
  light.set("u_radius", body.radius);
  light.set("u_plane_count", static_cast<int>(body.planes.size()));
  if (!body.planes.empty()) light.set("u_planes", std::span<const Vec4>(body.planes));
  light.set("u_reflectance_row", m.fresnel_map);
  if (m.fresnel_map < 0) return;
  const auto& table = scene.pack().fresnel_maps[static_cast<std::size_t>(m.fresnel_map)].table;
  light.set("u_reflectance_count", static_cast<int>(table.size()));
}

void GlassPass::shade(const FrameContext& context, std::size_t index, bool inside) const {
  const auto& [scene, view, options, stats] = context;
  const GlassBody& body = scene.glass()[index];
  const gpu::Program& light = body.tree.empty() ? light_ : *tree_light_;
  canvas_->shaded_framebuffer.bind();
  light.use();
  set_body(light, scene, body, options);
  const std::size_t around = cubes_.nearest_around(scene, index);
  scene.reflectance_tables().bind(kGlassReflectance);
  canvas_->places.bind(kGlassPlaces);
  canvas_->normals.bind(kGlassNormals);
  canvas_->tints.bind(kGlassTints);
  canvas_->behind.bind(kGlassBehind);
  cubes_.around(around).bind(kGlassAround);
  if (!body.pane && body.tree.empty()) cubes_.shape(index).bind(kGlassShape);
  if (!body.tree.empty()) cubes_.tree(index).bind(kGlassTree);
  canvas_->through.bind(kGlassThrough);
  constexpr std::pair<const char*, GlassUnit> kUnits[] = {
      {"u_places", kGlassPlaces}, {"u_normals", kGlassNormals},         {"u_tints", kGlassTints},
      {"u_behind", kGlassBehind}, {"u_reflectance", kGlassReflectance}, {"u_around", kGlassAround},
      {"u_shape", kGlassShape},   {"u_through", kGlassThrough},         {"u_tree", kGlassTree}};
  for (const auto& [name, unit] : kUnits) light.set(name, static_cast<int>(unit));
  light.set("u_inside", inside ? 1 : 0);
  set_window(light, bodies_[index].window);
  light.set("u_clip_from_pack", view.clip_from_view * view.view_from_pack);  // no mirror's near plane
  light.set("u_eye", view.eye);
  light.set("u_levels", has_levels_ ? 1 : 0);
  light.set("u_behind_size", Vec2(static_cast<float>(view.width), static_cast<float>(view.height)));
  light.set("u_far", 2 * (view.far + scene.bounds().radius()));
  light.set("u_pixels_per_tangent", 0.5f * static_cast<float>(view.height) / view.tangents.y);
  light.set("u_around_centre", scene.glass()[around].centre);
  light.set("u_around_size", static_cast<float>(kAroundSize));
  clear_all(Vec4(0));
  gpu::apply({});
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ++stats.draws;
}

Status GlassPass::draw_see_through(const FrameContext& context, const ScenePass& scene_pass,
                                   const ReflectionTarget& target, const SceneWeights& weights) {
  if (context.scene.glass().empty()) return scene_pass.draw_transparent(context, weights);
  ORIEL_TRY_VOID(prepare(context, scene_pass, target));
  target.bind(context.view);
  return scene_pass.draw_transparent(context, weights, [&](std::size_t body) -> Result<bool> {
    if (body >= bodies_.size() || !bodies_[body].shown) return false;
    ORIEL_TRY_VOID(draw(context, scene_pass, target, body));
    ++(target.frame != nullptr ? context.stats.glass : context.stats.mirrored_glass);
    return true;
  });
}

Status GlassPass::draw(const FrameContext& context, const ScenePass& scene_pass, const ReflectionTarget& target,
                       std::size_t index) {
  const auto& [scene, view, options, stats] = context;
  const GlassBody& body = scene.glass()[index];
  const NdcRect screen = project_box(view.clip_from_pack, body.bounds);
  const bool frosted = blurs(scene.pack().materials[body.material], options);
  const bool levels = (body.planes.empty() && !body.pane) || frosted;
  // Thin panes are drawn in between.
  const bool stale = !since_ || !scene.transparent().empty() || (levels && !has_levels_) ||
                     std::ranges::any_of(*since_, [&](const NdcRect& drawn) { return overlap(drawn, screen); });
  if (stale) ORIEL_TRY_VOID(take_behind(context, target, levels));
  since_->push_back(screen);
  if (const auto& window = bodies_[index].window) ORIEL_TRY_VOID(draw_through(context, *window, scene_pass));
  const bool inside = !body.pane && view.eye.w > 0 && scene.is_inside_glass(body, Vec3(view.eye));
  gpu::RasterState state;
  state.depth_test = true;
  state.cull = body.pane ? gpu::Cull::kNone : inside ? gpu::Cull::kFront : gpu::Cull::kBack;
  state.mirrored = view.mirrored;
  glEnable(GL_SCISSOR_TEST);
  scissor_to(screen, view);
  draw_surface(context, body, state);
  shade(context, index, inside);
  glDisable(GL_SCISSOR_TEST);
  target.bind(view);
  // What is seen through frosted glass lies in it, as a lobe that looks at it has it; else it lies where it is.
  state.alpha_write = target.frame == nullptr && frosted;
  gpu::apply(state);
  set_distance_alpha(glass_, view);
  glass_.set("u_clip_from_pack", view.clip_from_pack);
  glass_.set("u_eye", view.eye);
  glass_.set("u_shaded", 0);
  canvas_->shaded.bind(0);
  scene.bind_geometry();
  for (const DrawRange& range : body.ranges) draw_indices(range.first_index, range.index_count, stats);
  if (frosted && options.show != Show::kD) glow_.draw(context, body);
  return {};
}

}  // namespace oriel
