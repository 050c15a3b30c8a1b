#include "study/bastos1999/points_pass.h"

#include <algorithm>

#include "player/gpu/buffer.h"
#include "player/reflections/reflected_view.h"
#include "player/scene/surface.h"

namespace oriel::study {
namespace {

// A node as the shader draws it.
struct NodeInstance {
  Vec4 node;
  Vec2 step, box;
};

// The nodes that the image may show, by the number of their points.
using Instances = std::map<int, std::vector<NodeInstance>>;

Instances place_nodes(const std::vector<PointNode>& nodes, const MapFrame& map, const SplatView& view) {
  Instances out;
  for (const PointNode& node : nodes) {
    if (is_culled(map, node, view)) continue;
    const Vec2 size = point_size(map, node, view);
    const UVec2 step = point_step(size), count = (UVec2(node.width, node.height) + step - 1u) / step;
    out[static_cast<int>(count.x * count.y)].push_back({Vec4(node.x, node.y, node.width, node.height), Vec2(step),
                                                        glm::max(splat_box(size * Vec2(step), view), Vec2(1))});
  }
  return out;
}

void set_attribute(GLuint location, int components, std::size_t offset) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, sizeof(NodeInstance),
                        reinterpret_cast<const void*>(offset));
  glVertexAttribDivisor(location, 1);
}

}  // namespace

gpu::Texture2d upload_points(const RadianceMap& map) {
  std::vector<Vec4> texels(map.radiance.size());
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const bool usable =
        map.valid[i] != 0 && is_finite(map.radiance[i]) && map.disparity[i] >= 0 && map.disparity[i] <= 1;
    texels[i] = usable ? Vec4(map.radiance[i], map.valid[i] == 2 ? 0.0f : map.disparity[i]) : Vec4(0, 0, 0, -1);
  }
  return {gpu::kRgba32f, static_cast<int>(map.width), static_cast<int>(map.height), texels.data()};
}

Result<PointsPass> PointsPass::create(const gpu::Device& device) {
  PointsPass pass;
  ORIEL_TRY(pass.program_, gpu::Program::create("bastos1999_points", device.dialect));
  pass.instances_ = gpu::make_vertex_array();
  pass.point_max_ = device.point_size_max;
  return pass;
}

void PointsPass::draw(const FrameContext& context, const PointImage& image) {
  const auto& [scene, view, options, stats] = context;
  clear_image(image.target, image.rect);
  const ReflectedView reflected = reflect_view(image.reflector, view, image.rect, scene.bounds());
  const Mat4 image_from_reflector = reflected.image_from_view * reflected.view_from_reflector;
  const SplatView splats{reflected.view_from_mirrored, reflected.image_from_view * reflected.view_from_mirrored,
                         0.5f * static_cast<float>(view.height) / view.tangents.y, view.orthographic};
  program_.use();
  program_.set("u_clip_from_mirrored", splats.clip_from_mirrored);
  program_.set("u_mirrored_eye", reflected.mirrored_eye);
  program_.set("u_point_max", point_max_);
  program_.set("u_closest", kClosest);
  program_.set("u_ortho", view.orthographic ? 1.0f : 0.0f);
  program_.set("u_depth_row", -glm::transpose(reflected.view_from_mirrored)[2]);
  program_.set("u_map", 0);
  glBindVertexArray(instances_.name());
  for (const ReflectorElement& element : image.elements) {
    const Vec2 lower = element.lower, upper = element.upper;
    const std::array<Vec3, 4> corners{Vec3(lower, 0), Vec3(upper.x, lower.y, 0), Vec3(upper, 0),
                                      Vec3(lower.x, upper.y, 0)};
    if (project_polygon(image_from_reflector, corners).empty) continue;
    const auto chosen = maps_by_angle(element, image.maps, reflected.mirrored_eye);
    const std::size_t count = std::min(chosen.size(), static_cast<std::size_t>(options.maps_per_element));
    for (std::size_t i = 0; i < count; ++i) {
      const RadianceMap& map = image.maps[element.maps[chosen[i]]];
      const auto [at, is_new] = points_.try_emplace(&map);
      if (is_new) at->second = {upload_points(map), divide_points(map)};
      draw_map(map, at->second, splats, stats);
    }
  }
}

void PointsPass::draw_map(const RadianceMap& map, const MapPoints& points, const SplatView& view,
                          FrameStats& stats) const {
  points.texels.bind(0);
  program_.set("u_map_size", IVec2(points.texels.width(), points.texels.height()));
  program_.set("u_map_eye", map.eye);
  program_.set("u_lower", map.lower);
  program_.set("u_upper", map.upper);
  for (const auto& [count, nodes] : place_nodes(points.nodes, map_frame(map), view)) {
    const gpu::Buffer buffer(GLenum{GL_ARRAY_BUFFER}, std::span<const NodeInstance>(nodes));
    set_attribute(0, 4, offsetof(NodeInstance, node));
    set_attribute(1, 2, offsetof(NodeInstance, step));
    set_attribute(2, 2, offsetof(NodeInstance, box));
    glDrawArraysInstanced(GL_POINTS, 0, count, static_cast<GLsizei>(nodes.size()));
    ++stats.draws;
  }
  ++stats.maps;
}

}  // namespace oriel::study
