#include "study/diefenbach1997/multi_pass.h"

#include "player/gpu/raster_state.h"
#include "player/scene/surface.h"

namespace oriel::study {
namespace {

// Of the passes' stencil.
constexpr GLuint kImageBit = 0x80, kLitBit = 0x40, kCountBits = 0x3f;
constexpr std::size_t kMostTargets = 8;  // that are kept

std::vector<LightMirror> mirrors_of(GpuScene& scene) {
  std::vector<LightMirror> mirrors;
  for (const GpuReflector& reflector : scene.reflectors()) {
    const Material& m = scene.pack().materials[reflector.material];
    if (scene.is_transparent(reflector.material) || m.fresnel_map < 0 || reflector.index_count == 0) continue;
    if (scene.kernel(reflector.material, false).blurs()) continue;
    const float flatness = scene.pack().reflectors[reflector.index].flatness_m;
    mirrors.push_back({reflector.index, glm::transpose(reflector.reflector_from_pack)[2],
                       flatness + 1e-5f * reflector.size, reflector.corners});
  }
  return mirrors;
}

}  // namespace

Status MultiPass::make_programs() {
  if (volumes_) return {};
  if (!epoxy_is_desktop_gl())
    return fail(ErrorCode::kRuntime, "OpenGL", "found OpenGL ES, expected OpenGL, which clamps depth");
  ORIEL_TRY(light_, gpu::Program::create("diefenbach1997_lamp", dialect_));
  ORIEL_TRY(plain_light_, gpu::Program::create("diefenbach1997_lamp", dialect_, "PLAIN"));
  ORIEL_TRY(every_pixel_, gpu::Program::create("screen_probe", dialect_));
  no_vertices_ = gpu::make_vertex_array();
  ORIEL_TRY(VolumeCache volumes, VolumeCache::create(dialect_));
  volumes_ = std::move(volumes);
  return {};
}

Status MultiPass::begin(const FrameContext& context, std::span<const PlacedMover> movers) {
  ORIEL_TRY_VOID(make_programs());
  mirrors_ = mirrors_of(context.scene);
  sources_ = sources_of(context.scene.bright_lights(), settings.points, context.options.look);
  paths_ = find_light_paths(sources_, mirrors_, settings.mirrors);
  volumes_->begin(context, movers, mirrors_);
  stats_ = {.paths = static_cast<std::uint32_t>(paths_.paths.size()),
            .left_out = static_cast<std::uint32_t>(paths_.left_out)};
  return {};
}

MultiPassStats MultiPass::stats() const {
  MultiPassStats out = stats_;
  if (volumes_) out.volumes = volumes_->stats();
  return out;
}

Result<MultiPass::Target*> MultiPass::target_of(const LitImage& image) {
  const int width = image.samples ? image.samples->width() : image.light->width();
  const int height = image.samples ? image.samples->height() : image.light->height();
  const int samples = image.samples ? image.samples->samples() : 0;
  auto found = std::ranges::find_if(targets_, [&](const Target& t) {
    return samples > 0
               ? t.depth_samples && IVec2(t.depth_samples.width(), t.depth_samples.height()) == IVec2(width, height) &&
                     t.depth_samples.samples() == samples
               : t.depth && IVec2(t.depth.width(), t.depth.height()) == IVec2(width, height);
  });
  if (found == targets_.end()) {
    if (targets_.size() >= kMostTargets) targets_.erase(targets_.begin());
    Target& made = targets_.emplace_back();
    if (samples > 0)
      made.depth_samples = gpu::MultisampleTexture(gpu::kDepthStencil, width, height, samples);
    else
      made.depth = gpu::Texture2d(gpu::kDepthStencil, width, height, nullptr);
    found = targets_.end() - 1;
  }
  auto framebuffer = samples > 0 ? gpu::Framebuffer::create("light of lamps", *image.samples, found->depth_samples)
                                 : gpu::Framebuffer::create("light of lamps", image.light, &found->depth, true);
  if (!framebuffer) return tl::unexpected(framebuffer.error());
  found->framebuffer = std::move(*framebuffer);
  return &*found;
}

void MultiPass::draw_fullscreen(const gpu::RasterState& state) const {
  gpu::apply(state);
  every_pixel_.use();
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

// The number of a reflector becomes one bit, and what lies before it none.
void MultiPass::mark_reflectors() const {
  gpu::RasterState state{.color_write = false, .stencil_read = kReflectorBits, .stencil_write = kImageBit};
  state.stencil_func = GL_NOTEQUAL, state.stencil_ref = kImageBit;
  draw_fullscreen(state);
  state.stencil_func = GL_EQUAL, state.stencil_ref = 0;
  draw_fullscreen(state);
}

void MultiPass::count_from(std::uint32_t around) const {
  glStencilMask(kCountBits);
  glClearStencil(static_cast<GLint>(around & kCountBits));
  glClear(GL_STENCIL_BUFFER_BIT);
  glClearStencil(0);
}

// Sets the bit of pixels that light meets through all mirrors of the path.
void MultiPass::mark_apertures(const FrameContext& context, const LightPath& path, std::span<const PathLeg> legs) {
  glStencilMask(kLitBit);
  glClearStencil(kLitBit);
  glClear(GL_STENCIL_BUFFER_BIT);
  gpu::RasterState outside{.color_write = false, .stencil_func = GL_EQUAL, .stencil_read = kCountBits};
  outside.stencil_write = kLitBit;
  for (std::size_t i = 1; i < legs.size(); ++i) {
    const VolumeCache::Request request{path, i, legs[i]};
    count_from(volumes_->around_aperture(request, context.view.eye));
    volumes_->draw_aperture(request, context.view, kCountBits, context.stats);
    draw_fullscreen(outside);
    ++stats_.aperture_passes;
  }
}

void MultiPass::mark_shadows(const FrameContext& context, const LightPath& path, std::span<const PathLeg> legs) {
  const bool any = static_cast<int>(path.mirrors.size()) <= settings.shadow_mirrors;
  const std::size_t first = !any ? legs.size() : settings.bent_shadows ? 0 : legs.size() - 1;
  std::uint32_t around = 0;
  for (std::size_t i = first; i < legs.size(); ++i) around += volumes_->around({path, i, legs[i]}, context.view.eye);
  count_from(around);
  for (std::size_t i = first; i < legs.size(); ++i) {
    volumes_->draw({path, i, legs[i]}, context.view, kCountBits, context.stats);
    ++stats_.shadow_passes;
  }
}

void MultiPass::set_path(const gpu::Program& program, const FrameContext& context, const LightPath& path,
                         std::span<const PathLeg> legs) const {
  const GpuScene& scene = context.scene;
  const LightSource& source = sources_[path.source];
  program.use();
  program.set("u_clip_from_pack", context.view.clip_from_pack);
  program.set("u_eye", context.view.eye);
  program.set("u_base_texture", kBaseUnit);
  program.set("u_reflectance", kReflectanceUnit);
  program.set("u_normal_texture", kNormalUnit);
  program.set("u_reflectance_count", scene.reflectance_tables().width());
  program.set("u_source", legs.back().light);
  program.set("u_intensity", source.intensity);
  program.set("u_axis", Vec3(legs.front().last_from_leg * Vec4(source.axis, 0)));
  program.set("u_cones", source.cones);
  program.set("u_cosine", source.cosine ? 1 : 0);
  std::array<Vec4, kMostLightMirrors> normals{};
  std::array<Vec4, kMostLightMirrors> tables{};
  for (std::size_t i = 0; i < path.mirrors.size(); ++i) {
    const LightMirror& mirror = mirrors_[path.mirrors[i]];
    const std::int32_t row = scene.pack().materials[scene.pack().reflectors[mirror.reflector].material].fresnel_map;
    normals[i] = legs[i + 1].last_from_leg * Vec4(Vec3(mirror.plane), 0);
    tables[i] = Vec4(row, scene.pack().fresnel_maps[static_cast<std::size_t>(row)].table.size(), 0, 0);
  }
  program.set("u_mirrors", static_cast<int>(path.mirrors.size()));
  program.set("u_mirror_normals", std::span<const Vec4>(normals));
  program.set("u_mirror_tables", std::span<const Vec4>(tables));
  scene.reflectance_tables().bind(kReflectanceUnit);
}

void MultiPass::add_light(const FrameContext& context, const LitBatches& lit, const LightPath& path,
                          std::span<const PathLeg> legs) {
  const auto& [scene, view, options, stats] = context;
  set_path(plain_light_, context, path, legs);
  set_path(light_, context, path, legs);
  lit.all_indices ? scene.bind_geometry() : scene.bind_shown();
  const GLuint lit_bits = path.mirrors.empty() ? kCountBits : kCountBits | kLitBit;
  const GLint lit_value = path.mirrors.empty() ? 0 : kLitBit;
  gpu::RasterState state{
      .depth_test = true, .alpha_write = false, .blend = gpu::Blend::kAdd, .mirrored = view.mirrored};
  state.stencil_func = GL_EQUAL;
  for (const DrawBatch& batch : lit.shown) {
    const Material& m = scene.pack().materials[batch.material];
    if (m.unlit || batch.lightmap_page < 0) continue;
    const bool plain = m.normal_texture < 0 && cutoff_of(m) < 0 && scene.metalness(batch.material) == nullptr;
    const gpu::Program& program = plain ? plain_light_ : light_;
    program.use();
    state.cull = cull_of(m);
    set_surface(program, scene, batch.material, !scene.pack().mesh.normal_uvs.empty());
    const auto draw = [&](GLuint bits, GLint value, float undirected) {
      state.stencil_read = bits, state.stencil_ref = value;
      gpu::apply(state);
      program.set("u_weights", Vec3(lit.weights.diffuse, undirected, 0));
      draw_batch(batch, stats);
    };
    if (!lit.reflective.contains(batch.material)) {
      draw(lit_bits, lit_value, lit.weights.undirected);
      continue;
    }
    draw(lit_bits | kImageBit, lit_value, lit.weights.undirected);
    draw(lit_bits | kImageBit, lit_value | static_cast<GLint>(kImageBit), 0);
  }
  ++stats_.light_passes;
}

Status MultiPass::add_light(const FrameContext& context, const LitImage& image, const LitBatches& lit) {
  ++stats_.images;
  if (paths_.paths.empty()) return {};
  ORIEL_TRY(Target* const target, target_of(image));
  target->framebuffer.bind();
  glViewport(0, 0, context.view.width, context.view.height);
  gpu::RasterState all;
  all.depth_write = true, all.stencil_write = 0xff;
  gpu::apply(all);
  target->framebuffer.copy_depth_stencil(image.from, IVec2(0), {context.view.width, context.view.height}, IVec2(0));
  mark_reflectors();
  for (const LightPath& path : paths_.paths) {
    const std::vector<PathLeg> legs = legs_of(path, sources_, mirrors_);
    if (!path.mirrors.empty()) mark_apertures(context, path, legs);
    mark_shadows(context, path, legs);
    add_light(context, lit, path, legs);
  }
  return {};
}

}  // namespace oriel::study
