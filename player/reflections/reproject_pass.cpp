#include "player/reflections/reproject_pass.h"

#include <algorithm>

#include "player/reflections/reflected_view.h"
#include "player/scene/surface.h"

namespace oriel {
namespace {

// Every step-th pixel of a map suffices where its pixels fall closer together than the image's (Step of eq. (3)).
int pixel_step(const RadianceMap& map, const Vec4& eye, float pixels_per_tangent, bool orthographic) {
  if (orthographic) return 1;
  const Vec2 size = map.upper - map.lower;
  const float per_tangent =
      -map.eye.z * std::min(static_cast<float>(map.width) / size.x, static_cast<float>(map.height) / size.y);
  const Vec3 center(0.5f * (map.lower + map.upper), 0);
  const float nearer =
      std::min(1.0f, glm::length(Vec3(eye) - center) / std::max(glm::length(map.eye - center), 1e-30f));
  const float step = 0.6f * nearer * per_tangent / pixels_per_tangent;
  return step >= 4 ? 4 : step >= 2 ? 2 : 1;
}

}  // namespace

Result<ReprojectPass> ReprojectPass::create(const gpu::Device& device) {
  ReprojectPass pass;
  ORIEL_TRY(pass.program_, gpu::Program::create("reproject", device.dialect));
  pass.no_vertices_ = gpu::make_vertex_array();
  pass.point_max_ = device.point_size_max;
  return pass;
}

Status ReprojectPass::draw(const FrameContext& context, const ReflectedImage& image) const {
  const auto& [scene, view, options, stats] = context;
  clear_image(image.target, image.rect);
  const ReflectedView reflected = reflect_view(image.reflector, view, image.rect, scene.bounds());
  const Mat4 image_from_reflector = reflected.image_from_view * reflected.view_from_reflector;
  program_.use();
  program_.set("u_clip_from_mirrored", reflected.image_from_view * reflected.view_from_mirrored);
  program_.set("u_mirrored_eye", reflected.mirrored_eye);
  program_.set("u_viewport", Vec2(static_cast<float>(image.rect.width), static_cast<float>(image.rect.height)));
  program_.set("u_point_max", point_max_);
  program_.set("u_bias_scale", view.orthographic ? scene.bounds().radius() : 1.0f);
  program_.set("u_closest", kClosest);
  program_.set("u_ortho", view.orthographic ? 1.0f : 0.0f);
  program_.set("u_depth_row", -glm::transpose(reflected.view_from_mirrored)[2]);
  program_.set("u_map", 0);
  glBindVertexArray(no_vertices_.name());
  for (const ReflectorElement& element : image.reflector.elements) {
    const Vec2 lower = element.lower, upper = element.upper;
    const std::array<Vec3, 4> corners{Vec3(lower, 0), Vec3(upper.x, lower.y, 0), Vec3(upper, 0),
                                      Vec3(lower.x, upper.y, 0)};
    if (project_polygon(image_from_reflector, corners).empty) continue;
    const auto maps = weigh_maps(element, scene.pack().radiance_maps, reflected.mirrored_eye, options.maps_per_element,
                                 options.selection);
    const std::size_t count = std::min(maps.size(), static_cast<std::size_t>(options.maps_per_element));
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t map = element.maps[maps[i].map];
      if (!scene.pack().radiance_maps[map].residual) ORIEL_TRY_VOID(draw_map(context, image.reflector, map));
    }
  }
  return {};
}

Status ReprojectPass::draw_map(const FrameContext& context, const GpuReflector& reflector, std::uint32_t index) const {
  const auto& [scene, view, options, stats] = context;
  const RadianceMap& map = scene.pack().radiance_maps[index];
  const float pixels_per_tangent = 0.5f * static_cast<float>(view.height) / view.tangents.y;
  const int step = pixel_step(map, eye_in_reflector(reflector, view), pixels_per_tangent, view.orthographic);
  const int width = static_cast<int>(map.width), height = static_cast<int>(map.height);
  const int columns = (width + step - 1) / step, rows = (height + step - 1) / step;
  ORIEL_TRY(const gpu::Texture2d* const points, scene.radiance_map(index));
  if (points == nullptr) return {};
  points->bind(0);
  program_.set("u_map_size", IVec2(width, height));
  program_.set("u_step", step);
  program_.set("u_columns", columns);
  program_.set("u_map_eye", map.eye);
  program_.set("u_lower", map.lower);
  program_.set("u_upper", map.upper);
  glDrawArrays(GL_POINTS, 0, columns * rows);
  ++stats.draws;
  ++stats.maps;
  stats.points += static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows);
  return {};
}

}  // namespace oriel
