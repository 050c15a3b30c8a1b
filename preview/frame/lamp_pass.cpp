#include "preview/frame/lamp_pass.h"

#include <array>

#include "formats/assets/light_field.h"
#include "player/gpu/raster_state.h"

namespace oriel {
namespace {

enum LampUnit { kLampPlace, kLampNormal, kLampFace, kLampProfile };

}  // namespace

Result<PassLight> make_pass_light(const SeenSurfaces& surfaces) {
  PassLight out;
  out.light = gpu::Texture2d(gpu::kRgba32f, surfaces.size().x, surfaces.size().y, nullptr);
  ORIEL_TRY(out.framebuffer, gpu::Framebuffer::create("seen light", &out.light, &surfaces.depth, true));
  return out;
}

Result<VolumePass> VolumePass::create(gpu::Dialect dialect) {
  VolumePass pass;
  ORIEL_TRY(pass.program_, gpu::Program::create("shadow_volume", dialect));
  return pass;
}

void VolumePass::take(const ShadowMesh& mesh) {
  std::vector<Vec4> places;
  places.reserve(2 * mesh.positions().size());
  for (const Vec3& p : mesh.positions()) places.emplace_back(p, 0), places.emplace_back(p, 1);
  vertices_ = gpu::make_vertex_array();
  glBindVertexArray(vertices_.name());
  buffers_.clear();
  gpu::add_attribute(buffers_, 0, places, {4, GL_FLOAT});
  glBindVertexArray(0);
}

void VolumePass::draw(const ShadowVolumes& volumes, const Vec4& light, const View& view) const {
  glStencilMask(0xff);
  glClearStencil(static_cast<GLint>(volumes.around_eye % 256));
  glClear(GL_STENCIL_BUFFER_BIT);
  glClearStencil(0);
  if (volumes.indices.empty()) return;
  gpu::apply({.depth_test = true, .color_write = false, .stencil_write = 0xff});
  glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, GL_INCR_WRAP);
  glStencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, GL_DECR_WRAP);
  glDepthFunc(GL_LESS);
  glEnable(GL_DEPTH_CLAMP);  // no near plane cuts what lies between it and the eye, no far plane the endless sides
  program_.use();
  program_.set("u_clip_from_pack", view.clip_from_pack);
  program_.set("u_light", light);
  glBindVertexArray(vertices_.name());
  const gpu::Buffer indices(GL_ELEMENT_ARRAY_BUFFER, std::span<const std::uint32_t>(volumes.indices));
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(volumes.indices.size()), GL_UNSIGNED_INT, nullptr);
  glBindVertexArray(0);
  glDisable(GL_DEPTH_CLAMP);
}

Result<LampPass> LampPass::create(gpu::Dialect dialect) {
  LampPass pass;
  ORIEL_TRY(pass.program_, gpu::Program::create("screen_preview_lamp", dialect));
  pass.no_vertices_ = gpu::make_vertex_array();
  return pass;
}

void LampPass::draw(const LampPoint& point, const PreviewMesh& mesh, const SeenSurfaces& surfaces,
                    bool stencilled) const {
  gpu::RasterState state{.blend = gpu::Blend::kAdd};
  if (stencilled) state.stencil_func = GL_EQUAL;
  gpu::apply(state);
  surfaces.place.bind(kLampPlace);
  surfaces.normal.bind(kLampNormal);
  surfaces.face.bind(kLampFace);
  program_.use();
  for (const auto& [name, unit] : std::array<std::pair<const char*, int>, 4>{
           {{"u_place", kLampPlace}, {"u_normal", kLampNormal}, {"u_face", kLampFace}, {"u_profile", kLampProfile}}})
    program_.set(name, unit);
  program_.set("u_kind", static_cast<int>(point.kind));
  program_.set("u_light", point.place);
  program_.set("u_front", point.normal);
  program_.set("u_power", point.power);
  Vec2 cone(-2, 0);
  bool profiled = false;
  if (point.light != ~0u) {
    const Light& light = mesh.scene().lights[point.light];
    profiled = light.profile >= 0;
    if (profiled) mesh.profile(point.light).bind(kLampProfile);
    program_.set("u_right", light.right);
    if (light.type == LightType::kSpot) {
      const float outer = std::cos(light.outer_cone_rad);
      cone = Vec2(outer, outer + std::max(kSharpestCone, std::cos(light.inner_cone_rad) - outer));
    }
  }
  program_.set("u_cone", cone);
  program_.set("u_profiled", profiled ? 1 : 0);
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

}  // namespace oriel
