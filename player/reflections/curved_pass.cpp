#include "player/reflections/curved_pass.h"

#include <algorithm>

#include "player/scene/surface.h"

namespace oriel {
namespace {

enum CurvedUnit {
  kCurvedLight = 0,
  kCurvedDistance = 1,
  kCurvedReflectance = 2,
  kCurvedTaps = 3,
  kCurvedNormal = 4,
  kCurvedPlaces = 5,
  kCurvedNormals = 6,
  kCurvedShaded = 7,
  kCurvedBase = 8,  // and metalness after it
};

// Radius (tangent) that holds half of a lobe, from which on its taps find their own distances: roughness 0.17 or so.
constexpr float kWideLobe = 0.03f;

void draw_reflector(const FrameContext& context, const GpuCurvedReflector& reflector) {
  for (const DrawRange& range : context.scene.bind_curved(reflector))
    draw_indices(range.first_index, range.index_count, context.stats);
}

gpu::RasterState state_for(const View& view, GLint value, GLuint bits) {
  gpu::RasterState state;
  state.depth_test = true;
  state.cull = gpu::Cull::kBack;
  state.mirrored = view.mirrored;
  state.stencil_ref = value;
  state.stencil_write = bits;
  return state;
}

// Only the pixels around the box, for what is drawn over the whole image.
void scissor_to(const Bounds& box, const View& view) {
  const NdcRect all = project_box(view.clip_from_pack, box);
  const Vec2 size(static_cast<float>(view.width), static_cast<float>(view.height));
  const IVec2 lower(glm::floor((glm::clamp(all.lower, -1.0f, 1.0f) * 0.5f + 0.5f) * size));
  const IVec2 upper(glm::ceil((glm::clamp(all.upper, -1.0f, 1.0f) * 0.5f + 0.5f) * size));
  glScissor(lower.x, lower.y, all.empty ? 0 : upper.x - lower.x, all.empty ? 0 : upper.y - lower.y);
}

void set_normals(const gpu::Program& program, const FrameContext& context, const GpuCurvedReflector& reflector) {
  const GpuScene& scene = context.scene;
  const Material& material = scene.pack().materials[reflector.material];
  scene.normal_map(material.normal_texture).bind(kCurvedNormal);
  program.set("u_clip_from_pack", context.view.clip_from_pack);
  program.set("u_eye", context.view.eye);
  program.set("u_normal_texture", kCurvedNormal);
  program.set("u_normal_mapped", material.normal_texture >= 0 && !scene.pack().mesh.normal_uvs.empty() ? 1 : 0);
  program.set("u_normal_scale", material.normal_scale);
}

}  // namespace

Result<CurvedPass> CurvedPass::create(gpu::Dialect dialect) {
  CurvedPass pass;
  ORIEL_TRY(pass.mask_, gpu::Program::create("reflector_mask", dialect));
  ORIEL_TRY(pass.surface_, gpu::Program::create("curved_surface", dialect));
  ORIEL_TRY(pass.shade_, gpu::Program::create("screen_curved", dialect));
  ORIEL_TRY(pass.light_, gpu::Program::create("curved_light", dialect));
  ORIEL_TRY(pass.shaded_light_, gpu::Program::create("curved_light", dialect, "SHADED"));
  pass.no_vertices_ = gpu::make_vertex_array();
  return pass;
}

Status CurvedPass::Canvas::make(int width, int height) {
  if (light && light.width() >= width && light.height() >= height) return {};
  if (light) width = std::max(width, light.width()), height = std::max(height, light.height());
  places = gpu::Texture2d(gpu::kRgba32f, width, height, nullptr);
  normals = gpu::Texture2d(gpu::kRgba32f, width, height, nullptr);
  depth = gpu::Texture2d(gpu::kDepthStencil, width, height, nullptr);
  light = gpu::Texture2d(gpu::kRgba16f, width, height, nullptr);
  ORIEL_TRY(surfaces, gpu::Framebuffer::create("curved surfaces", places, normals, depth));
  ORIEL_TRY(shaded, gpu::Framebuffer::create("their light", &light, &depth, true));
  return gpu::check_gl("making the images of curved reflectors");
}

void CurvedPass::draw_mask(const FrameContext& context, const GpuCurvedReflector& reflector, GLint value,
                           GLuint bits) const {
  gpu::RasterState state = state_for(context.view, value, bits);
  state.color_write = false;
  gpu::apply(state);
  mask_.use();
  mask_.set("u_clip_from_pack", context.view.clip_from_pack);
  draw_reflector(context, reflector);
}

void CurvedPass::draw_surface(const FrameContext& context, const Shown& shown) const {
  gpu::RasterState state = state_for(context.view, shown.value, 0xff);
  state.depth_write = true;
  gpu::apply(state);
  set_normals(surface_, context, *shown.reflector);
  draw_reflector(context, *shown.reflector);
}

Status CurvedPass::shade(const FrameContext& context, std::span<const Shown> shown) {
  if (shown.empty()) return {};
  const View& view = context.view;
  ORIEL_TRY_VOID(canvas_.make(view.width, view.height));
  const auto begin = [&](const gpu::Framebuffer& target, GLbitfield what) {
    target.bind();
    glViewport(0, 0, view.width, view.height);
    glScissor(0, 0, view.width, view.height);
    gpu::RasterState all;
    all.depth_write = true;
    all.stencil_write = 0xff;
    gpu::apply(all);
    glClearColor(0, 0, 0, 0);
    glClearStencil(0);
    glClear(what);
  };
  glEnable(GL_SCISSOR_TEST);
  begin(canvas_.surfaces, GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  surface_.use();
  for (const Shown& one : shown) draw_surface(context, one);
  begin(canvas_.shaded, GL_COLOR_BUFFER_BIT);
  shade_.use();
  for (const Shown& one : shown) {
    gpu::RasterState state;
    state.stencil_func = GL_EQUAL;
    state.stencil_ref = one.value;
    gpu::apply(state);
    set_lobe(shade_, context, *one.reflector);
    canvas_.places.bind(kCurvedPlaces);  // after set_lobe(), which may make textures at the unit bound last
    canvas_.normals.bind(kCurvedNormals);
    shade_.set("u_places", kCurvedPlaces);
    shade_.set("u_normals", kCurvedNormals);
    shade_.set("u_id", static_cast<float>(one.value));
    scissor_to(one.reflector->triangles.bounds, view);
    glBindVertexArray(no_vertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    ++context.stats.draws;
  }
  glDisable(GL_SCISSOR_TEST);
  return {};
}

void CurvedPass::draw_shaded(const FrameContext& context, const Shown& shown, GLuint bits) const {
  gpu::apply(state_for(context.view, shown.value, bits));
  shaded_light_.use();
  set_lobe(shaded_light_, context, *shown.reflector);
  set_reflectance(shaded_light_, context, *shown.reflector);
  canvas_.light.bind(kCurvedShaded);
  canvas_.normals.bind(kCurvedNormals);
  shaded_light_.set("u_shaded", kCurvedShaded);
  shaded_light_.set("u_normals", kCurvedNormals);
  shaded_light_.set("u_id", static_cast<float>(shown.value));
  draw_reflector(context, *shown.reflector);
  ++context.stats.reflectors;
  ++context.stats.maps;
}

void CurvedPass::add_light(const FrameContext& context, const GpuCurvedReflector& reflector) const {
  gpu::RasterState state = state_for(context.view, 0, 0);
  state.blend = gpu::Blend::kAdd;
  state.alpha_write = false;
  gpu::apply(state);
  light_.use();
  set_lobe(light_, context, reflector);
  set_reflectance(light_, context, reflector);
  draw_reflector(context, reflector);
  ++context.stats.reflectors;
  ++context.stats.maps;
}

void CurvedPass::set_lobe(const gpu::Program& program, const FrameContext& context,
                          const GpuCurvedReflector& reflector) const {
  const auto& [scene, view, options, stats] = context;
  const SurroundTextures& map = scene.surround_map(reflector.map);
  const bool sharp = options.show == Show::kM || options.blur == Blur::kOff;
  const GpuKernel& kernel = sharp ? scene.mirror_kernel() : scene.curved_kernel(reflector.material, options.coarse);
  map.light.bind(kCurvedLight);
  map.inverse_distance.bind(kCurvedDistance);
  kernel.taps.bind(kCurvedTaps);
  program.set("u_eye", view.eye);
  program.set("u_centre", scene.pack().surround_maps[reflector.map].centre);
  program.set("u_size", map.size);
  program.set("u_light", kCurvedLight);
  program.set("u_light_scale", Vec3(map.scale));  // colours are for walkthroughs in a browser
  program.set("u_inverse_distance", kCurvedDistance);
  program.set("u_range", map.range);
  program.set("u_taps", kCurvedTaps);
  program.set("u_tap_count", kernel.count);
  program.set("u_tap_rows", kernel.rows);
  program.set("u_wide", kernel.median >= kWideLobe);
}

void CurvedPass::set_reflectance(const gpu::Program& program, const FrameContext& context,
                                 const GpuCurvedReflector& reflector) const {
  const auto& [scene, view, options, stats] = context;
  set_normals(program, context, reflector);
  set_place_reflectance(program, scene, reflector.material, kCurvedBase);
  const auto row = scene.pack().materials[reflector.material].fresnel_map;
  scene.reflectance_tables().bind(kCurvedReflectance);
  program.set("u_modulate", options.show == Show::kM || options.show == Show::kMK ? 0 : 1);
  program.set("u_reflectance", kCurvedReflectance);
  program.set("u_reflectance_row", row);
  if (row < 0) return;
  const auto& table = scene.pack().fresnel_maps[static_cast<std::size_t>(row)].table;
  program.set("u_reflectance_count", static_cast<int>(table.size()));
}

}  // namespace oriel
