#include "study/bastos1999/point_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace oriel::study {
namespace {

constexpr std::uint32_t kLeastSide = 4;  // pixels
constexpr float kDepths = 1.1f;          // the farthest over the nearest point of a node

// The scene point of a position in pixels, homogeneous: see lib/reprojection.glsl.
Vec4 map_point(const MapFrame& map, const Vec2& pixel, float disparity) {
  const Vec2 on_plane = map.lower + pixel / map.size * (map.upper - map.lower);
  return {disparity * map.eye + Vec3(on_plane, 0) - map.eye, disparity};
}

class Divider {
 public:
  explicit Divider(const RadianceMap& map) : map_(map), frame_(map_frame(map)) {}

  void divide(std::uint32_t x, std::uint32_t y, std::uint32_t side, std::vector<PointNode>& nodes) const {
    if (x >= map_.width || y >= map_.height) return;
    PointNode node{x, y, std::min(side, map_.width - x), std::min(side, map_.height - y)};
    bool sky = false;
    if (!gather(node, sky)) return;
    const bool even = node.least == 0 ? node.most == 0 : !sky && node.most <= kDepths * node.least;
    if (even || side <= kLeastSide) {
      nodes.push_back(node);
      return;
    }
    for (std::uint32_t k = 0; k < 4; ++k) divide(x + k % 2 * side / 2, y + k / 2 * side / 2, side / 2, nodes);
  }

 private:
  // Mean and depths of the node; false where it has no usable pixel. The sky counts where there is nothing else.
  bool gather(PointNode& node, bool& sky) const {
    DVec3 points(0), directions(0);
    std::uint32_t solid = 0, open = 0;
    node.least = 1, node.most = 0;
    for (std::uint32_t j = node.y; j < node.y + node.height; ++j)
      for (std::uint32_t i = node.x; i < node.x + node.width; ++i) {
        const std::size_t at = std::size_t{j} * map_.width + i;
        if (map_.valid[at] == 0) continue;
        const float disparity = map_.valid[at] == 2 ? 0 : std::clamp(map_.disparity[at], 0.0f, 1.0f);
        const DVec4 p(map_point(frame_, Vec2(i, j) + 0.5f, disparity));
        node.least = std::min(node.least, disparity);
        node.most = std::max(node.most, disparity);
        if (disparity > 0) {
          points += DVec3(p) / p.w, ++solid;
        } else {
          directions += DVec3(p), ++open;
        }
      }
    sky = open > 0;
    if (solid > 0) {
      node.mean = Vec4(Vec3(points / double{1.0 * solid}), 1);
    } else if (open > 0) {
      node.mean = Vec4(Vec3(directions / double{1.0 * open}), 0);
    }
    return solid + open > 0;
  }

  const RadianceMap& map_;
  MapFrame frame_;
};

}  // namespace

std::vector<PointNode> divide_points(const RadianceMap& map) {
  std::vector<PointNode> nodes;
  const std::uint32_t side = std::bit_ceil(std::max({map.width, map.height, 1u}));
  Divider(map).divide(0, 0, side, nodes);
  return nodes;
}

MapFrame map_frame(const RadianceMap& map) {
  return {map.eye, map.lower, map.upper, Vec2(map.width, map.height)};
}

Vec2 point_size(const MapFrame& map, const PointNode& node, const SplatView& view) {
  const float in_map = node.mean.z - node.mean.w * map.eye.z;
  const float in_image = -(view.view_from_mirrored * node.mean).z;
  if (!view.orthographic && !(in_image > 0)) return Vec2(0);
  const float distance_scale = view.orthographic ? in_map / std::max(node.mean.w, 1e-12f) : in_map / in_image;
  const Vec2 window = map.size * -map.eye.z / (map.upper - map.lower) / view.pixels_per_tangent;
  const Vec3 forward = -Vec3(glm::transpose(Mat3(view.view_from_mirrored))[2]);
  const Vec2 angular = glm::sqrt(glm::max(1.0f - Vec2(forward) * Vec2(forward), Vec2(0)));
  return distance_scale * angular / window;
}

UVec2 point_step(const Vec2& size) {
  return UVec2(glm::max(glm::floor(1.0f / glm::max(size, Vec2(1e-6f))), Vec2(1)));
}

Vec2 splat_box(const Vec2& size, const SplatView& view) {
  const auto on_screen = [](const Vec3& axis) {
    return glm::abs(Vec2(axis)) / std::max(glm::length(Vec2(axis)), 1e-12f);
  };
  return size.x * on_screen(Vec3(view.view_from_mirrored[0])) + size.y * on_screen(Vec3(view.view_from_mirrored[1]));
}

bool is_culled(const MapFrame& map, const PointNode& node, const SplatView& view) {
  std::array<bool, 5> beyond;
  beyond.fill(true);
  for (int k = 0; k < 8; ++k) {
    const Vec2 pixel = Vec2(node.x, node.y) + Vec2(k & 1, k >> 1 & 1) * Vec2(node.width, node.height);
    const Vec4 p = view.clip_from_mirrored * map_point(map, pixel, k & 4 ? node.most : node.least);
    for (int axis = 0; axis < 2; ++axis) {
      beyond[static_cast<std::size_t>(2 * axis)] &= p[axis] < -p.w;
      beyond[static_cast<std::size_t>(2 * axis + 1)] &= p[axis] > p.w;
    }
    beyond[4] &= p.w <= 0;
  }
  return std::any_of(beyond.begin(), beyond.end(), [](bool all) { return all; });
}

}  // namespace oriel::study
