#include "study/udeshi1999/shadow_pass.h"

#include <cmath>
#include <utility>

#include "formats/assets/light_field.h"
#include "player/gpu/raster_state.h"

namespace oriel::study {
namespace {

void bind_seen(const gpu::Program& program, const SeenSurfaces& surfaces) {
  program.use();
  const std::pair<const char*, const gpu::Texture2d*> textures[] = {
      {"u_place", &surfaces.place}, {"u_normal", &surfaces.normal}, {"u_face", &surfaces.face}};
  for (int unit = 0; unit < 3; ++unit) textures[unit].second->bind(unit), program.set(textures[unit].first, unit);
}

void draw_over_frame(const gpu::VertexArray& no_vertices) {
  glBindVertexArray(no_vertices.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
}

}  // namespace

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
  ORIEL_TRY(pass.lamp_, gpu::Program::create("screen_udeshi1999_lamp", dialect));
  ORIEL_TRY(pass.elements_, gpu::Program::create("screen_udeshi1999_elements", dialect));
  pass.no_vertices_ = gpu::make_vertex_array();
  return pass;
}

void LampPass::draw(const LampPoint& point, const Scene& scene, const SeenSurfaces& surfaces) const {
  gpu::apply({.blend = gpu::Blend::kAdd, .stencil_func = GL_EQUAL});
  bind_seen(lamp_, surfaces);
  lamp_.set("u_kind", static_cast<int>(point.kind));
  lamp_.set("u_light", point.place);
  lamp_.set("u_front", point.normal);
  lamp_.set("u_power", point.power);
  Vec2 cone(-2, 0);
  if (point.light != ~0u && scene.lights[point.light].type == LightType::kSpot) {
    const Light& light = scene.lights[point.light];
    const float outer = std::cos(light.outer_cone_rad);
    cone = Vec2(outer, outer + std::max(kSharpestCone, std::cos(light.inner_cone_rad) - outer));
  }
  lamp_.set("u_cone", cone);
  draw_over_frame(no_vertices_);
}

void LampPass::draw_elements(std::span<const LampPoint> elements, const SeenSurfaces& surfaces) const {
  std::vector<Vec4> places;
  std::vector<Vec3> fronts, powers;
  for (const LampPoint& element : elements) {
    places.emplace_back(Vec3(element.place), element.soft);
    fronts.push_back(element.normal);
    powers.push_back(element.power);
  }
  gpu::apply({.blend = gpu::Blend::kAdd});
  bind_seen(elements_, surfaces);
  elements_.set("u_count", static_cast<int>(places.size()));
  elements_.set("u_elements", std::span<const Vec4>(places));
  elements_.set("u_fronts", std::span<const Vec3>(fronts));
  elements_.set("u_powers", std::span<const Vec3>(powers));
  draw_over_frame(no_vertices_);
}

}  // namespace oriel::study
