#include "player/reflections/curved_pass.h"

namespace oriel {
namespace {

enum Unit {
  kLightUnit = 0,
  kDistanceUnit = 1,
  kReflectanceUnit = 2,
  kTapsUnit = 3,
  kNormalUnit = 4,
};

void draw_reflector(const GpuScene& scene, const GpuCurvedReflector& reflector, FrameStats& stats) {
  scene.bind_geometry();
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(reflector.index_count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(std::uintptr_t{reflector.first_index} * sizeof(std::uint32_t)));
  ++stats.draws;
  stats.triangles += reflector.index_count / 3;
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

}  // namespace

Result<CurvedPass> CurvedPass::create(gpu::Dialect dialect) {
  CurvedPass pass;
  ORIEL_TRY(pass.mask_, gpu::Program::create("reflector_mask", dialect));
  ORIEL_TRY(pass.light_, gpu::Program::create("curved_light", dialect));
  return pass;
}

void CurvedPass::draw_mask(const GpuScene& scene, const GpuCurvedReflector& reflector, const View& view, GLint value,
                           GLuint bits, FrameStats& stats) const {
  gpu::RasterState state = state_for(view, value, bits);
  state.color_write = false;
  gpu::apply(state);
  mask_.use();
  mask_.set("u_clip_from_pack", view.clip_from_pack);
  draw_reflector(scene, reflector, stats);
}

void CurvedPass::draw_light(GpuScene& scene, const GpuCurvedReflector& reflector, const View& view, GLint value,
                            GLuint bits, const FrameOptions& options, FrameStats& stats) const {
  gpu::RasterState state = state_for(view, value, bits);
  if (bits == 0) {
    state.blend = gpu::Blend::kAdd;
    state.alpha_write = false;
  }
  gpu::apply(state);
  const Pack& pack = scene.pack();
  const Material& material = pack.materials[reflector.material];
  const SurroundTextures& map = scene.surround_map(reflector.map);
  const bool sharp = options.show == Show::kM || options.blur == Blur::kOff;
  const GpuKernel& kernel =
      sharp ? scene.mirror_kernel() : scene.kernel(reflector.material, options.kernel, options.coarse);
  map.light.bind(kLightUnit);
  map.inverse_distance.bind(kDistanceUnit);
  scene.reflectance_tables().bind(kReflectanceUnit);
  kernel.taps.bind(kTapsUnit);
  scene.normal_map(material.normal_texture).bind(kNormalUnit);
  light_.use();
  light_.set("u_clip_from_pack", view.clip_from_pack);
  light_.set("u_eye", view.eye);
  light_.set("u_centre", pack.surround_maps[reflector.map].centre);
  light_.set("u_size", map.size);
  light_.set("u_light", kLightUnit);
  light_.set("u_light_scale", map.scale);
  light_.set("u_inverse_distance", kDistanceUnit);
  light_.set("u_range", map.range);
  light_.set("u_taps", kTapsUnit);
  light_.set("u_tap_count", kernel.count);
  light_.set("u_tap_rows", kernel.rows);
  light_.set("u_normal_texture", kNormalUnit);
  light_.set("u_normal_mapped", material.normal_texture >= 0 && !pack.mesh.normal_uvs.empty() ? 1 : 0);
  light_.set("u_normal_scale", material.normal_scale);
  light_.set("u_modulate", options.show == Show::kM || options.show == Show::kMK ? 0 : 1);
  light_.set("u_reflectance", kReflectanceUnit);
  light_.set("u_reflectance_row", material.fresnel_map);
  if (material.fresnel_map >= 0) {
    const auto& table = pack.fresnel_maps[static_cast<std::size_t>(material.fresnel_map)].table;
    light_.set("u_reflectance_count", static_cast<int>(table.size()));
  }
  draw_reflector(scene, reflector, stats);
  ++stats.reflectors;
  ++stats.maps;
}

}  // namespace oriel
