#include "player/passes/reflector_pass.h"

#include <algorithm>

#include "player/gpu/raster_state.h"
#include "player/passes/scene_pass.h"

namespace oriel {
namespace {

void draw_reflector(const GpuReflector& reflector, FrameStats& stats) {
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(reflector.index_count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(std::uintptr_t{reflector.first_index} * sizeof(std::uint32_t)));
  ++stats.draws;
  stats.triangles += reflector.index_count / 3;
}

}  // namespace

Result<ReflectorPass> ReflectorPass::create(gpu::Dialect dialect) {
  ReflectorPass pass;
  ORIEL_TRY(pass.mask_, gpu::Program::create("reflector/mask", dialect));
  ORIEL_TRY(pass.compose_, gpu::Program::create("reflector/compose", dialect));
  ORIEL_TRY(pass.emitters_, gpu::Program::create("reflector/emitters", dialect));
  return pass;
}

void ReflectorPass::draw_mask(const GpuScene& scene, const GpuReflector& reflector, const View& view, GLint value,
                              GLuint bits, const gpu::Query& query, FrameStats& stats) const {
  gpu::RasterState state;
  state.depth_test = true;
  state.color_write = false;
  state.cull = gpu::Cull::kBack;
  state.stencil_ref = value;
  state.stencil_write = bits;
  gpu::apply(state);
  mask_.use();
  mask_.set("u_clip_from_pack", view.clip_from_pack);
  scene.bind_geometry();
  glBeginQuery(GL_ANY_SAMPLES_PASSED, query.name());
  draw_reflector(reflector, stats);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
}

void ReflectorPass::draw_light(GpuScene& scene, const GpuReflector& reflector, const View& view, const ImageRect& rect,
                               const gpu::Texture& image, GLint value, const FrameOptions& options,
                               FrameStats& stats) const {
  gpu::RasterState state;
  state.depth_test = true;
  state.cull = gpu::Cull::kBack;
  if (value != 0) {
    state.stencil_func = GL_EQUAL;
    state.stencil_ref = value;
    state.stencil_read = kReflectorBits;
  } else {
    state.blend = gpu::Blend::kAdd;
    state.alpha_write = false;
  }
  gpu::apply(state);
  compose_.use();
  compose_.set("u_clip_from_pack", view.clip_from_pack);
  compose_.set("u_image", 0);
  compose_.set("u_texture_size", Vec2(static_cast<float>(image.width()), static_cast<float>(image.height())));
  compose_.set("u_image_size", Vec2(static_cast<float>(rect.width), static_cast<float>(rect.height)));
  compose_.set("u_origin", rect.origin);
  compose_.set("u_scale", rect.scale);
  compose_.set("u_missing", reflector.mean_radiance);
  set_reflectance(compose_, scene, reflector, view, options);
  image.bind(0);  // last: what is uploaded on first use is bound meanwhile
  scene.bind_geometry();
  draw_reflector(reflector, stats);
  // M shows a mirror's world, in which a glossy lobe has no place.
  if (options.show == Show::kM || !set_emitters(scene, reflector, options)) return;
  emitters_.set("u_clip_from_pack", view.clip_from_pack);
  set_reflectance(emitters_, scene, reflector, view, options);
  state.blend = gpu::Blend::kAdd;
  state.alpha_write = false;
  gpu::apply(state);
  draw_reflector(reflector, stats);
}

void ReflectorPass::set_reflectance(const gpu::Program& program, GpuScene& scene, const GpuReflector& reflector,
                                    const View& view, const FrameOptions& options) const {
  const Material& material = scene.pack().materials[reflector.material];
  const auto row = material.fresnel_map;
  const FresnelMap* fresnel = row < 0 ? nullptr : &scene.pack().fresnel_maps[static_cast<std::size_t>(row)];
  const bool sphere = options.reflectance == Reflectance::kSphereMap && fresnel != nullptr && fresnel->sphere_size > 1;
  const gpu::Texture& reflectance =
      sphere ? scene.sphere_map(static_cast<std::uint32_t>(row)) : scene.reflectance_tables();
  reflectance.bind(1);
  program.set("u_eye", view.eye);
  program.set("u_normal", Vec3(reflector.pack_from_reflector[2]));
  program.set("u_reflectance", 1);
  program.set("u_reflectance_row", row);
  program.set("u_reflectance_count", fresnel == nullptr ? 1
                                     : sphere           ? static_cast<int>(fresnel->sphere_size)
                                                        : static_cast<int>(fresnel->table.size()));
  program.set("u_sphere_map", sphere ? 1 : 0);
  program.set("u_modulate", options.show == Show::kM || options.show == Show::kMK ? 0 : 1);
}

bool ReflectorPass::set_emitters(GpuScene& scene, const GpuReflector& reflector, const FrameOptions& options) const {
  const Pack& pack = scene.pack();
  const Reflector& shape = pack.reflectors[reflector.index];
  const GpuKernel& kernel = scene.kernel(pack.materials[reflector.material].kernel, options.kernel);
  if (shape.emitters.empty() || !kernel.fits) return false;
  emitters_.use();
  emitters_.set("u_emitter_count", static_cast<int>(shape.emitters.size()));
  std::vector<Vec4> corners;
  std::vector<Vec3> light;
  for (const std::uint32_t index : shape.emitters) {
    const Emitter& emitter = pack.emitters[index];
    const auto count = static_cast<float>(emitter.corners.size());
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& corner = emitter.corners[std::min(i, emitter.corners.size() - 1)];
      corners.emplace_back(Vec3(reflector.reflector_from_pack * Vec4(corner, 1)), emitter.two_sided ? -count : count);
    }
    light.push_back(emitter.radiance);
  }
  emitters_.set("u_emitter_corners", corners);
  emitters_.set("u_emitter_light", light);
  emitters_.set("u_visibility", 2);
  emitters_.set("u_lobes", 3);
  reflector.visibility.bind(2);
  kernel.fits.bind(3);
  emitters_.set("u_visibility_nodes",
                IVec2(static_cast<int>(shape.visibility_x), static_cast<int>(shape.visibility_y)));
  emitters_.set("u_lower", shape.lower);
  emitters_.set("u_upper", shape.upper);
  emitters_.set("u_lobe_rows", kernel.fits.width());
  emitters_.set("u_sharp", options.blur == Blur::kOff ? 1 : 0);
  emitters_.set("u_reflector_from_pack", reflector.reflector_from_pack);
  return true;
}

}  // namespace oriel
