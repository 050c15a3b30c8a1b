#include "player/passes/glass_pass.h"

#include <algorithm>
#include <array>
#include <limits>

#include "player/gpu/raster_state.h"
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
  kGlassThrough = 7
};

constexpr int kShapeSize = 128, kAroundSize = 256;  // texels a side of a face
constexpr std::ptrdiff_t kMostAround = 16;  // bodies that the scene is drawn around; others use the nearest one's
constexpr float kLeastOfPicture = 1e-4f;    // of it, that a body covers for that
constexpr float kMostIor = 10;              // beyond it numbers run out
constexpr std::ptrdiff_t kMostWindows = 4;  // bodies of a frame that have one, 1 while something moves
constexpr float kLeastBend = 8;             // pixels by which glass shifts things, for that
constexpr int kLooks = 32, kPaneLooks = 12, kCoarseLooks = 4;  // of a lobe

Camera face_camera(const Vec3& eye, int face) {
  Camera camera;
  camera.eye = eye;
  camera.forward = Vec3(0);
  camera.forward[face / 2] = face % 2 == 0 ? 1.0f : -1.0f;
  camera.up = face / 2 == 1 ? Vec3(0, 0, camera.forward.y) : Vec3(0, -1, 0);
  camera.vertical_fov_rad = 0.5f * kPi;
  return camera;
}

gpu::TextureOptions with_levels(const IVec2& size) {
  gpu::TextureOptions options;
  options.levels = gpu::mip_levels(size.x, size.y);
  options.mag_filter = GL_LINEAR;
  options.min_filter = GL_LINEAR_MIPMAP_NEAREST;
  return options;
}

void clear_face(const Vec4& color) {
  gpu::RasterState all;
  all.depth_write = true;
  all.stencil_write = 0xff;
  gpu::apply(all);
  glClearColor(color.x, color.y, color.z, color.w);
  glClearStencil(0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

float share_of_picture(const NdcRect& rect) {
  if (rect.empty) return 0;
  const Vec2 size = glm::max(glm::min(rect.upper, Vec2(1)) - glm::max(rect.lower, Vec2(-1)), Vec2(0));
  return 0.25f * size.x * size.y;
}

void scissor_to(const NdcRect& rect, const View& view) {
  const Vec2 size(static_cast<float>(view.width), static_cast<float>(view.height));
  const IVec2 lower(glm::floor((glm::clamp(rect.lower, -1.0f, 1.0f) * 0.5f + 0.5f) * size));
  const IVec2 upper(glm::ceil((glm::clamp(rect.upper, -1.0f, 1.0f) * 0.5f + 0.5f) * size));
  const IVec2 first = glm::max(lower - 1, IVec2(0));
  glScissor(first.x, first.y, rect.empty ? 0 : upper.x + 1 - first.x, rect.empty ? 0 : upper.y + 1 - first.y);
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
  ORIEL_TRY(shape_, gpu::Program::create("glass_shape", dialect_));
  ORIEL_TRY(copy_, gpu::Program::create("screen_behind", dialect_));
  no_vertices_ = gpu::make_vertex_array();
  depth_ = gpu::Texture2d(gpu::kDepthStencil, kAroundSize, kAroundSize, nullptr);
  ORIEL_TRY(face_, gpu::Framebuffer::create("faces around glass", nullptr, &depth_, true));
  return gpu::check_gl("compiling glass");
}

// Another scene has other bodies; the same one with other lights has the same shapes.
Status GlassPass::start(const GpuScene& scene) {
  ORIEL_TRY_VOID(compile());
  if (geometry_of_ == scene.geometry_serial()) return {};
  geometry_of_ = scene.geometry_serial();
  bodies_.clear();
  bodies_.resize(scene.glass().size());
  return {};
}

Status GlassPass::prepare(const FrameContext& context, const ScenePass& scene_pass) {
  const auto& [scene, view, options, stats] = context;
  const Frustum frustum = make_frustum(view.clip_from_pack);
  std::vector<std::pair<float, std::size_t>> seen;  // minus the share of the picture
  for (std::size_t i = 0; i < scene.glass().size(); ++i) {
    const Bounds& box = scene.glass()[i].bounds;
    if (may_be_visible(frustum, box)) seen.emplace_back(-share_of_picture(project_box(view.clip_from_pack, box)), i);
  }
  since_.reset();
  if (seen.empty()) return {};
  ORIEL_TRY_VOID(start(scene));
  std::sort(seen.begin(), seen.end());
  choose_windows(context, seen);
  const bool whole = !scene.images().state().busy;
  for (const auto& [share, i] : seen) {
    Body& body = bodies_[i];
    const GlassBody& glass = scene.glass()[i];
    if (glass.planes.empty() && !glass.pane && !body.shape) ORIEL_TRY_VOID(draw_shape(context, i));
    if (-share < kLeastOfPicture || (body.around_of == scene.serial() && (body.whole || !whole))) continue;
    const auto others = std::ranges::count_if(bodies_, [](const Body& b) { return static_cast<bool>(b.around); });
    if (!body.around && others >= kMostAround) continue;
    ORIEL_TRY_VOID(draw_around(context, i, scene_pass));
    body.around_of = scene.serial(), body.whole = whole;
  }
  return gpu::check_gl("drawing around glass");
}

void GlassPass::choose_windows(const FrameContext& context, std::span<const std::pair<float, std::size_t>> by_share) {
  const auto& [scene, view, options, stats] = context;
  for (Body& body : bodies_) body.window.reset();
  std::ptrdiff_t left = options.coarse ? 1 : kMostWindows;
  for (const auto& [share, i] : by_share) {
    if (left == 0) break;
    const GlassBody& body = scene.glass()[i];
    if (body.pane) continue;
    const float ior = std::clamp(scene.pack().materials[body.material].ior, 1.0f, kMostIor);
    bodies_[i].window = window_of(body, ior, kLeastBend, view, scene.bounds());
    left -= bodies_[i].window ? 1 : 0;
  }
}

Status GlassPass::draw_shape(const FrameContext& context, std::size_t body) {
  const GpuScene& scene = context.scene;
  const GlassBody& glass = scene.glass()[body];
  bodies_[body].shape = gpu::CubeTexture(gpu::kRgba32f, kShapeSize, 1);
  ORIEL_TRY_VOID(gpu::check_gl("making the shape of glass"));
  face_.bind();
  glViewport(0, 0, kShapeSize, kShapeSize);
  shape_.use();
  shape_.set("u_centre", glass.centre);
  scene.bind_geometry();
  for (int face = 0; face < 6; ++face) {
    face_.attach_color_face(bodies_[body].shape, face);
    clear_face(Vec4(0, 0, 0, glass.radius));
    gpu::RasterState state;
    state.depth_test = state.depth_write = true;
    gpu::apply(state);
    shape_.set("u_clip_from_pack",
               make_view(face_camera(glass.centre, face), kShapeSize, kShapeSize, glass.bounds).clip_from_pack);
    for (const DrawRange& range : glass.ranges) draw_indices(range.first_index, range.index_count, context.stats);
  }
  return {};
}

Status GlassPass::draw_around(const FrameContext& context, std::size_t body, const ScenePass& scene_pass) {
  GpuScene& scene = context.scene;
  gpu::CubeTexture& around = bodies_[body].around;
  if (!around) around = gpu::CubeTexture(gpu::kRgba32f, kAroundSize, gpu::mip_levels(kAroundSize, kAroundSize));
  ORIEL_TRY_VOID(gpu::check_gl("making the surroundings of glass"));
  for (int face = 0; face < 6; ++face) {
    const View view =
        make_view(face_camera(scene.glass()[body].centre, face), kAroundSize, kAroundSize, scene.bounds());
    face_.bind();
    face_.attach_color_face(around, face);
    glViewport(0, 0, kAroundSize, kAroundSize);
    clear_face(Vec4(scene.pack().sky, kClosest));
    const FrameContext outside{scene, view, context.options, context.stats};
    const MirroredScene seen{visible_batches(scene.opaque(), make_frustum(view.clip_from_pack)), {}, {}};
    scene_pass.draw_reflected(outside, seen);
    ORIEL_TRY_VOID(scene_pass.draw_transparent(outside, {}, [](const GlassBody&, std::size_t) { return Status(); }));
  }
  around.make_mipmaps();
  return {};
}

Status GlassPass::make_canvas(const IVec2& size) {
  if (behind_ && IVec2(behind_.width(), behind_.height()) == size) return {};
  behind_ = gpu::Texture2d(gpu::kRgba32f, size.x, size.y, nullptr, with_levels(size));
  places_ = gpu::Texture2d(gpu::kRgba32f, size.x, size.y, nullptr);
  normals_ = gpu::Texture2d(gpu::kRgba32f, size.x, size.y, nullptr);
  tints_ = gpu::Texture2d(gpu::kRgba8, size.x, size.y, nullptr);
  shaded_ = gpu::Texture2d(gpu::kRgba32f, size.x, size.y, nullptr);
  nearest_ = gpu::Texture2d(gpu::kDepthStencil, size.x, size.y, nullptr);
  ORIEL_TRY_VOID(gpu::check_gl("making the images of glass"));
  ORIEL_TRY(behind_framebuffer_, gpu::Framebuffer::create("the image behind glass", &behind_, nullptr));
  ORIEL_TRY(surfaces_framebuffer_,
            gpu::Framebuffer::create("surfaces of glass",
                                     std::array<const gpu::Texture2d*, 3>{&places_, &normals_, &tints_}, nearest_));
  ORIEL_TRY(shaded_framebuffer_, gpu::Framebuffer::create("light of glass", &shaded_, nullptr));
  return {};
}

Status GlassPass::take_behind(const FrameTarget& frame, bool levels, FrameStats& stats) {
  const IVec2 size = frame.size();
  ORIEL_TRY_VOID(make_canvas(size));
  frame.resolve_light();
  frame.resolve_depth_stencil();
  behind_framebuffer_.bind();
  glViewport(0, 0, size.x, size.y);
  gpu::apply({});
  glBindVertexArray(no_vertices_.name());
  copy_.use();
  frame.light.bind(0);
  frame.depth.bind(1);
  copy_.set("u_light", 0);
  copy_.set("u_depth", 1);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ++stats.draws;
  if (levels) behind_.make_mipmaps();
  has_levels_ = levels;
  since_.emplace();
  return {};
}

Status GlassPass::draw_through(const FrameContext& context, const GlassWindow& window, const ScenePass& scene_pass) {
  GpuScene& scene = context.scene;
  const IVec2 size(window.view.width, window.view.height);
  if (!through_ || IVec2(through_.width(), through_.height()) != size) {
    through_ = gpu::Texture2d(gpu::kRgba32f, size.x, size.y, nullptr, with_levels(size));
    through_depth_ = gpu::Texture2d(gpu::kDepthStencil, size.x, size.y, nullptr);
    ORIEL_TRY_VOID(gpu::check_gl("making the image through glass"));
    ORIEL_TRY(through_framebuffer_,
              gpu::Framebuffer::create("the image through glass", &through_, &through_depth_, true));
  }
  through_framebuffer_.bind();
  glViewport(0, 0, size.x, size.y);
  clear_face(Vec4(scene.pack().sky, kClosest));
  View beyond = window.view;
  beyond.clip_from_pack = window.clip;
  const FrameContext through{scene, beyond, context.options, context.stats};
  scene_pass.draw_reflected(through, {visible_batches(scene.opaque(), make_frustum(window.clip)), {}, {}});
  if (has_levels_) through_.make_mipmaps();
  return gpu::check_gl("drawing through glass");
}

// Depth there is as clip_from_view_to() has it.
void GlassPass::set_window(const std::optional<GlassWindow>& window) const {
  light_.set("u_window", window ? 1 : 0);
  if (!window) return;
  const View& view = window->view;
  const Vec2 size(static_cast<float>(view.width), static_cast<float>(view.height));
  light_.set("u_window_from_pack", view.clip_from_pack);
  light_.set("u_window_size", size);
  light_.set("u_window_tangents", Vec4(view.tangents, view.centre));
  light_.set("u_window_depth", Vec3(-view.clip_from_view[2][2], view.clip_from_view[3][2], kClosest));
  light_.set("u_window_pixels", 0.5f * std::min(size.x / view.tangents.x, size.y / view.tangents.y));
}

std::size_t GlassPass::nearest_around(const GpuScene& scene, std::size_t body) const {
  std::size_t best = body;
  float nearest = std::numeric_limits<float>::max();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const float away = length2(scene.glass()[i].centre - scene.glass()[body].centre);
    if (!bodies_[i].around || away >= nearest) continue;
    nearest = away;
    best = i;
  }
  return best;
}

void GlassPass::draw_surface(const FrameContext& context, const GlassBody& body, gpu::Cull cull) const {
  const auto& [scene, view, options, stats] = context;
  surfaces_framebuffer_.bind();
  glViewport(0, 0, view.width, view.height);
  clear_face(Vec4(0));
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.cull = cull;
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

void GlassPass::set_body(const GpuScene& scene, const GlassBody& body, const FrameOptions& options) const {
  const Material& m = scene.pack().materials[body.material];
  const SolidGlass solid = body.pane ? SolidGlass{body.material, m.base_color * ((1 - m.metallic) * m.transmission)}
                                     : scene.pack().solids[body.solid];
  const bool frosted = blurs(m, options);
  light_.set("u_pane", body.pane ? 1 : 0);
  light_.set("u_tint", glm::clamp(solid.tint, Vec3(0), Vec3(1)));
  light_.set("u_absorption", solid.absorption);
  light_.set("u_ior", std::clamp(m.ior, 1.0f, kMostIor));
  light_.set("u_width", frosted ? m.roughness * m.roughness : 0.0f);
  light_.set("u_looks", !frosted ? 1 : options.coarse ? kCoarseLooks : body.pane ? kPaneLooks : kLooks);
  light_.set("u_turn", static_cast<float>(glm::fract(0.618033988749895 * options.look)));
  light_.set("u_centre", body.centre);
  light_.set("u_radius", body.radius);
  light_.set("u_plane_count", static_cast<int>(body.planes.size()));
  if (!body.planes.empty()) light_.set("u_planes", std::span<const Vec4>(body.planes));
  light_.set("u_reflectance_row", m.fresnel_map);
  if (m.fresnel_map < 0) return;
  const auto& table = scene.pack().fresnel_maps[static_cast<std::size_t>(m.fresnel_map)].table;
  light_.set("u_reflectance_count", static_cast<int>(table.size()));
}

void GlassPass::shade(const FrameContext& context, std::size_t index, bool inside) const {
  const auto& [scene, view, options, stats] = context;
  const GlassBody& body = scene.glass()[index];
  shaded_framebuffer_.bind();
  light_.use();
  set_body(scene, body, options);
  const std::size_t around = nearest_around(scene, index);
  scene.reflectance_tables().bind(kGlassReflectance);
  places_.bind(kGlassPlaces);
  normals_.bind(kGlassNormals);
  tints_.bind(kGlassTints);
  behind_.bind(kGlassBehind);
  bodies_[around].around.bind(kGlassAround);
  if (!body.pane) bodies_[index].shape.bind(kGlassShape);
  through_.bind(kGlassThrough);
  constexpr std::pair<const char*, GlassUnit> kUnits[] = {
      {"u_places", kGlassPlaces}, {"u_normals", kGlassNormals},         {"u_tints", kGlassTints},
      {"u_behind", kGlassBehind}, {"u_reflectance", kGlassReflectance}, {"u_around", kGlassAround},
      {"u_shape", kGlassShape},   {"u_through", kGlassThrough}};
  for (const auto& [name, unit] : kUnits) light_.set(name, static_cast<int>(unit));
  light_.set("u_inside", inside ? 1 : 0);
  set_window(bodies_[index].window);
  light_.set("u_clip_from_pack", view.clip_from_pack);
  light_.set("u_eye", view.eye);
  light_.set("u_levels", has_levels_ ? 1 : 0);
  light_.set("u_behind_size", Vec2(static_cast<float>(view.width), static_cast<float>(view.height)));
  light_.set("u_far", 2 * (view.far + scene.bounds().radius()));
  light_.set("u_pixels_per_tangent", 0.5f * static_cast<float>(view.height) / view.tangents.y);
  light_.set("u_around_centre", scene.glass()[around].centre);
  light_.set("u_around_size", static_cast<float>(kAroundSize));
  clear_face(Vec4(0));
  gpu::apply({});
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ++stats.draws;
}

Status GlassPass::draw(const FrameContext& context, const ScenePass& scene_pass, const FrameTarget& frame,
                       std::size_t index) {
  const auto& [scene, view, options, stats] = context;
  const GlassBody& body = scene.glass()[index];
  const NdcRect screen = project_box(view.clip_from_pack, body.bounds);
  const bool levels = (body.planes.empty() && !body.pane) || blurs(scene.pack().materials[body.material], options);
  // Thin panes are drawn in between.
  const bool stale = !since_ || !scene.transparent().empty() || (levels && !has_levels_) ||
                     std::ranges::any_of(*since_, [&](const NdcRect& drawn) { return overlap(drawn, screen); });
  if (stale) ORIEL_TRY_VOID(take_behind(frame, levels, stats));
  since_->push_back(screen);
  if (const auto& window = bodies_[index].window) ORIEL_TRY_VOID(draw_through(context, *window, scene_pass));
  const bool inside = !body.pane && view.eye.w > 0 && scene.is_inside_glass(body, Vec3(view.eye));
  gpu::RasterState state;
  state.cull = body.pane ? gpu::Cull::kNone : inside ? gpu::Cull::kFront : gpu::Cull::kBack;
  glEnable(GL_SCISSOR_TEST);
  scissor_to(screen, view);
  draw_surface(context, body, state.cull);
  shade(context, index, inside);
  glDisable(GL_SCISSOR_TEST);
  frame.drawn().bind();
  state.depth_test = true;
  state.alpha_write = false;
  gpu::apply(state);
  glass_.use();
  glass_.set("u_clip_from_pack", view.clip_from_pack);
  glass_.set("u_shaded", 0);
  shaded_.bind(0);
  scene.bind_geometry();
  for (const DrawRange& range : body.ranges) draw_indices(range.first_index, range.index_count, stats);
  if (blurs(scene.pack().materials[body.material], options)) glow_.draw(context, body);
  return {};
}

std::uint64_t GlassPass::bytes() const {
  std::uint64_t sum = depth_.bytes();
  for (const gpu::Texture2d* t :
       {&behind_, &places_, &normals_, &tints_, &nearest_, &shaded_, &through_, &through_depth_})
    sum += t->bytes();
  for (const Body& body : bodies_) sum += body.shape.bytes() + body.around.bytes();
  return sum;
}

}  // namespace oriel
