// A radiance map's pixels as points in a quadtree, and how large the points of a node are on the screen: reconstruction
// as Bastos et al. 1999 have it (section 8.1.3, "Reconstruction").
#pragma once

#include <vector>

#include "formats/assets/radiance_map.h"

namespace oriel::study {

// A square of a map's pixels, cut off at the map's edge, whose points lie in a small range of depths, or that is as
// small as nodes get. Reflector space.
struct PointNode {
  std::uint32_t x = 0, y = 0, width = 1, height = 1;  // pixels of the map
  Vec4 mean{0};                                       // of its points (w = 1); of nothing but sky the direction (w = 0)
  float least = 0, most = 0;                          // of their disparities
};

// The leaves of the map's quadtree, row by row of the squares above them; none for squares without a usable pixel. A
// square is divided while the depths in it differ by more than a tenth, or some are sky and some are not, and it has
// more than 4² pixels.
std::vector<PointNode> divide_points(const RadianceMap& map);

// Of a map: what sizes of its points follow from.
struct MapFrame {
  Vec3 eye{0, 0, -1};
  Vec2 lower{0}, upper{1};
  Vec2 size{1};  // pixels
};
MapFrame map_frame(const RadianceMap& map);

// An image of the mirrored world, which is reflector space with z negated.
struct SplatView {
  Mat4 view_from_mirrored{1};  // rigid; looks along -z
  Mat4 clip_from_mirrored{1};
  float pixels_per_tangent = 1;  // of the image; orthographic: per metre
  bool orthographic = false;
};

// Equation (3): pixels of the image that a pixel of the map covers along the map's x and y axes, for all points of a
// node. DistanceScale is the depth of the mean in the map over that in the image, Angular the sine of the angle between
// the image's view direction and the axis, Window the map's pixels a tangent over the image's. A node behind the eye:
// 0.
Vec2 point_size(const MapFrame& map, const PointNode& node, const SplatView& view);

// Every so many points of a node are drawn, along x and y: Step = 1 / PointSize where that is less than a pixel.
UVec2 point_step(const Vec2& size);

// Width and height of a box aligned with the screen that covers a footprint of that size along the map's axes, as these
// are turned on the screen.
Vec2 splat_box(const Vec2& size, const SplatView& view);

// Whether all points that the node may have lie beyond one of the image's planes. Exact for the frustum of its pixels
// between its depths.
bool is_culled(const MapFrame& map, const PointNode& node, const SplatView& view);

}  // namespace oriel::study
