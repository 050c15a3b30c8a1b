#include "player/passes/scene_pass.h"

#include <algorithm>

#include "player/scene/surface.h"

namespace oriel {
namespace {

void set_frame(const gpu::Program& program, const FrameContext& context) {
  const auto& [scene, view, options, stats] = context;
  program.set("u_clip_from_pack", view.clip_from_pack);
  program.set("u_eye", view.eye);
  program.set("u_base_texture", kBaseUnit);
  program.set("u_lightmap", kLightmapUnit);
  program.set("u_reflectance", kReflectanceUnit);
  program.set("u_direction", kDirectionUnit);
  program.set("u_cells", kCellUnit);
  program.set("u_detail", kDetailUnit);
  program.set("u_normal_texture", kNormalUnit);
  program.set("u_change", kChangeUnit);
  program.set("u_surfaces", kPlaceUnit);
  program.set("u_change_scale", Vec2(0));
  program.set("u_sharp_at", kSharpAtUnit);
  program.set("u_sharp_words", kSharpWordsUnit);
  program.set("u_sharp_triangles", kSharpTrianglesUnit);
  program.set("u_sharp_lamps", kSharpLampsUnit);
  program.set("u_reflectance_count", scene.reflectance_tables().width());
  scene.reflectance_tables().bind(kReflectanceUnit);
  if (const GpuSharpLight& sharp = scene.sharp_light()) {
    sharp.words.bind(kSharpWordsUnit);
    sharp.triangles.bind(kSharpTrianglesUnit);
    sharp.lamps.bind(kSharpLampsUnit);
  }
  scene.bind_geometry();
}

bool is_plain(const GpuScene& scene, std::uint32_t material) {
  const Material& m = scene.pack().materials[material];
  return m.normal_texture < 0 && cutoff_of(m) < 0 && !m.unlit && scene.emission_texture(material) == nullptr &&
         scene.metalness(material) == nullptr;
}

// A see-through part, or a body of glass.
struct SeeThrough {
  float depth = 0;  // along the view, less is farther
  std::span<const DrawRange> ranges;
  const GlassBody* body = nullptr;
  std::size_t index = 0;
};

// What of it is in view, from far to near.
std::vector<SeeThrough> see_through(const GpuScene& scene, const View& view) {
  const Frustum frustum = make_frustum(view.clip_from_pack);
  std::vector<SeeThrough> sorted;
  const auto add = [&](const Bounds& bounds, SeeThrough one) {
    if (!may_be_visible(frustum, bounds)) return;
    one.depth = (view.view_from_pack * Vec4(bounds.center(), 1)).z;
    sorted.push_back(one);
  };
  for (const DrawRange& range : scene.transparent()) add(range.bounds, {0, {&range, 1}, nullptr, 0});
  for (std::size_t i = 0; i < scene.glass().size(); ++i)
    add(scene.glass()[i].bounds, {0, scene.glass()[i].ranges, &scene.glass()[i], i});
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const SeeThrough& a, const SeeThrough& b) { return a.depth < b.depth; });
  return sorted;
}

}  // namespace

Result<ScenePass::Shading> ScenePass::Shading::create(std::string_view name, gpu::Dialect dialect,
                                                      const std::string& define) {
  Shading out;
  ORIEL_TRY(out.smooth, gpu::Program::create(name, dialect, define));
  ORIEL_TRY(out.points, gpu::Program::create(name, dialect, define + " SHARP"));
  ORIEL_TRY(out.suns, gpu::Program::create(name, dialect, define + " SHARP SUNS"));
  return out;
}

Result<ScenePass> ScenePass::create(const gpu::Device& device) {
  const gpu::Dialect dialect = device.dialect;
  ScenePass pass;
  if (device.shades_hidden) {
    ORIEL_TRY(pass.seen_, gpu::Program::create("seen", dialect));
  }
  ORIEL_TRY(pass.sky_, gpu::Program::create("screen_sky", dialect));
  ORIEL_TRY(pass.depth_, gpu::Program::create("depth", dialect));
  ORIEL_TRY(pass.plain_depth_, gpu::Program::create("depth", dialect, "PLAIN"));
  ORIEL_TRY(pass.opaque_, Shading::create("scene", dialect));
  ORIEL_TRY(pass.plain_, Shading::create("scene", dialect, "PLAIN"));
  ORIEL_TRY(pass.reflected_, Shading::create("scene", dialect, "REFLECTED"));
  ORIEL_TRY(pass.transparent_, Shading::create("transparent", dialect));
  return pass;
}

const gpu::Program& ScenePass::set_material(const Shading& shading, const GpuScene& scene, std::uint32_t material,
                                            std::int32_t lightmap_page) const {
  const LoadedLightmap& lightmap = scene.lightmap(lightmap_page);
  const gpu::Program& program = shading.of(lightmap, scene.sharp_light());
  program.use();
  set_surface(program, scene, material, !scene.pack().mesh.normal_uvs.empty());
  lightmap.texture.bind(kLightmapUnit);
  program.set("u_lightmap_scale", lightmap.scale);
  const bool directional = static_cast<bool>(lightmap.direction);
  program.set("u_directional", directional ? 1 : 0);
  (directional ? lightmap.direction : lightmap.texture).bind(kDirectionUnit);
  const bool detailed = static_cast<bool>(lightmap.detail);
  program.set("u_detailed", detailed ? 1 : 0);
  if (lightmap.sharp_at) lightmap.sharp_at.bind(kSharpAtUnit);
  if (!detailed) return program;
  lightmap.cells.bind(kCellUnit);
  lightmap.detail.bind(kDetailUnit);
  return program;
}

void ScenePass::draw_depth(const FrameContext& context, std::span<const DrawBatch> shown) const {
  context.scene.bind_shown();
  draw_depths(context, shown);
}

void ScenePass::draw_depths(const FrameContext& context, std::span<const DrawBatch> shown) const {
  const auto& [scene, view, options, stats] = context;
  for (const gpu::Program* program : {&plain_depth_, &depth_}) {
    program->use();
    program->set("u_clip_from_pack", view.clip_from_pack);
  }
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.color_write = false;
  state.mirrored = view.mirrored;
  for (const DrawBatch& batch : shown) {
    const Material& m = scene.pack().materials[batch.material];
    state.cull = cull_of(m);
    gpu::apply(state);
    const gpu::Program& program = cutoff_of(m) < 0 ? plain_depth_ : depth_;
    program.use();
    set_cutout(program, scene, m);
    draw_batch(batch, stats);
  }
}

std::vector<std::uint32_t> ScenePass::mark_seen(const FrameContext& context, std::span<const DrawBatch> shown) const {
  const auto& [scene, view, options, stats] = context;
  std::vector<std::uint32_t> seen(scene.shown_indices().size() / 3);
  const gpu::Buffer marks(GLenum{GL_SHADER_STORAGE_BUFFER}, std::span<const std::uint32_t>(seen));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, marks.name());
  scene.bind_shown();
  seen_.use();
  seen_.set("u_clip_from_pack", view.clip_from_pack);
  gpu::RasterState state;
  state.depth_test = true;
  state.color_write = false;
  for (const DrawBatch& batch : shown) {
    state.cull = cull_of(scene.pack().materials[batch.material]);
    gpu::apply(state);
    seen_.set("u_first", static_cast<int>(reinterpret_cast<std::uintptr_t>(batch.offsets[0]) / (3 * sizeof(seen[0]))));
    draw_batch(batch, stats);
  }
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLsizeiptr>(4 * seen.size()), seen.data());
  return seen;
}

void ScenePass::draw_opaque(const FrameContext& context, std::span<const DrawBatch> shown, const SceneWeights& weights,
                            const std::set<std::uint32_t>& reflective,
                            const std::optional<BrightChange>& change) const {
  const auto& [scene, view, options, stats] = context;
  plain_.each([&](const gpu::Program& program) { set_frame(program, context); });
  Vec2 scale(0);
  if (change) {
    change->on_scene->bind(kChangeUnit);
    change->scene_surfaces->bind(kPlaceUnit);
    scale = Vec2(change->on_scene->width(), change->on_scene->height()) / Vec2(view.width, view.height);
  }
  opaque_.each([&](const gpu::Program& program) {
    set_frame(program, context);
    program.set("u_change_scale", scale);
    program.set("u_alpha_kind", 0);
  });
  scene.bind_shown();
  gpu::RasterState state;
  state.depth_test = true;
  for (const DrawBatch& batch : shown) {
    const Material& m = scene.pack().materials[batch.material];
    const bool twice = is_partly_opaque(m) || reflective.contains(batch.material);
    state.stencil_read = is_partly_opaque(m) ? kSeeThroughBit : kReflectorBits;
    state.cull = cull_of(m);
    state.blend = gpu::Blend::kNone;
    state.stencil_func = twice ? GL_EQUAL : GL_ALWAYS;
    gpu::apply(state);
    const Shading& shading = is_plain(scene, batch.material) && !change ? plain_ : opaque_;
    const gpu::Program& program = set_material(shading, scene, batch.material, batch.lightmap_page);
    program.set("u_weights", Vec3(weights.diffuse, weights.undirected, weights.emission));
    draw_batch(batch, stats);
    if (!twice) continue;
    state.blend = gpu::Blend::kAdd;
    state.stencil_func = GL_NOTEQUAL;
    gpu::apply(state);
    program.set("u_weights", Vec3(weights.diffuse, 0, weights.emission));
    draw_batch(batch, stats);
  }
}

void ScenePass::draw_reflected_depth(const FrameContext& context, const MirroredScene& mirrored) const {
  context.scene.bind_geometry();
  draw_depths(context, mirrored.shown);
}

void ScenePass::draw_reflected(const FrameContext& context, const MirroredScene& mirrored) const {
  const auto& [scene, view, options, stats] = context;
  for (const Shading* shading : {&reflected_, &opaque_})
    shading->each([&](const gpu::Program& program) {
      set_frame(program, context);
      set_distance_alpha(program, view);
    });
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.mirrored = view.mirrored;
  state.stencil_read = kReflectorBits;
  const auto draw = [&](const DrawBatch& batch, float undirected, float emission) {
    const Material& m = scene.pack().materials[batch.material];
    state.cull = cull_of(m);
    gpu::apply(state);
    const Shading& shading = is_plain(scene, batch.material) ? reflected_ : opaque_;
    const gpu::Program& program = set_material(shading, scene, batch.material, batch.lightmap_page);
    program.set("u_weights", Vec3(1, undirected, emission));
    draw_batch(batch, stats);
  };
  for (const DrawBatch& batch : mirrored.shown) {
    const bool twice = mirrored.reflective.contains(batch.material);
    state.stencil_func = twice ? GL_EQUAL : GL_ALWAYS;
    draw(batch, 1, 1);
    if (!twice) continue;
    state.stencil_func = GL_NOTEQUAL;
    draw(batch, 0, 1);
  }
  state.stencil_func = GL_ALWAYS;
  const Frustum frustum = make_frustum(view.clip_from_pack);
  for (const std::uint32_t emitter : mirrored.dark)  // the same depths again
    for (const DrawBatch& batch : visible_batches(scene.emitter(emitter), frustum)) draw(batch, 1, 0);
}

void ScenePass::draw_sky(const FrameContext& context, float alpha) const {
  const auto& [scene, view, options, stats] = context;
  if (!scene.sky_map()) return;
  gpu::RasterState state;
  state.depth_test = true;
  gpu::apply(state);
  scene.bind_geometry();
  scene.sky_map().bind(0);
  sky_.use();
  sky_.set("u_sky", 0);
  sky_.set("u_color", scene.pack().sky);
  sky_.set("u_direction_from_clip", glm::inverse(view.clip_from_view * Mat4(Mat3(view.view_from_pack))));
  sky_.set("u_eye", view.eye);
  sky_.set("u_size", Vec2(view.width, view.height));
  sky_.set("u_alpha", alpha);
  glDepthRange(1, 1);  // behind all
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthRange(0, 1);
  ++stats.draws;
}

Status ScenePass::draw_transparent(const FrameContext& context, const SceneWeights& weights,
                                   const DrawGlass& glass) const {
  const auto& [scene, view, options, stats] = context;
  std::vector<SeeThrough> sorted = see_through(scene, view);
  if (sorted.empty()) return {};
  const auto set_frames = [&] { transparent_.each([&](const gpu::Program& program) { set_frame(program, context); }); };
  set_frames();
  gpu::RasterState state;
  state.depth_test = true;
  state.alpha_write = false;
  state.mirrored = view.mirrored;
  state.stencil_read = kSeeThroughBit;
  for (const SeeThrough& one : sorted) {
    bool solid = false;
    if (glass && one.body) {
      ORIEL_TRY(solid, glass(one.index));
      if (solid) set_frames();
    }
    for (const DrawRange& range : one.ranges) {
      const Material& m = scene.pack().materials[range.material];
      state.cull = cull_of(m);
      const gpu::Program& program = set_material(transparent_, scene, range.material, range.lightmap_page);
      // Coverage dims all colours alike: in one draw with its light each layer of a mesh covers those before it.
      const bool covers = m.alpha_mode == AlphaMode::kBlend && m.transmission <= 0;
      const gpu::Buffer ordered = covers ? scene.bind_far_to_near(range, view) : gpu::Buffer();
      const gpu::Blend added = covers ? gpu::Blend::kCover : gpu::Blend::kAdd;
      const auto draw = [&](gpu::Blend blend, bool dimming, GLenum func, float undirected) {
        state.blend = blend;
        state.stencil_func = func;
        gpu::apply(state);
        program.set("u_dimming", dimming ? 1 : 0);
        program.set("u_weights", Vec3(weights.diffuse, undirected, weights.emission));
        draw_indices(covers ? 0 : range.first_index, range.index_count, stats);
      };
      if (!solid && !covers) draw(gpu::Blend::kMultiply, true, GL_ALWAYS, 0);
      draw(added, false, view.mirrored ? GL_ALWAYS : GL_EQUAL, weights.undirected);
      if (!view.mirrored) draw(added, false, GL_NOTEQUAL, 0);
      if (covers) scene.bind_geometry();
    }
  }
  return {};
}

}  // namespace oriel
