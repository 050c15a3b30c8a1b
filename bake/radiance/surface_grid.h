// Which neighbouring pixels of a map are one surface, and the corners that they share.
#pragma once

#include "bake/radiance/pixel_planes.h"

namespace oriel {

// A map's pixels as squares; at each of their corners those of up to four pixels that are connected around it meet in
// one vertex.
class SurfaceGrid {
 public:
  // planes: row by row; must outlive it.
  SurfaceGrid(std::span<const PixelPlane> planes, const IVec2& size);

  const IVec2& size() const { return size_; }
  // Pixels that their disparity times this shifts by, seen from as far away as the element is wide.
  float pixels_of_disparity() const { return static_cast<float>(std::max(size_.x, size_.y)); }
  const PixelPlane& plane(const IVec2& pixel) const { return planes_[index(pixel)]; }
  // With the pixel after it along the axis (0: x, 1: y), where there is one.
  bool connected(const IVec2& pixel, int axis) const { return connected_[2 * index(pixel) + axis] != 0; }

  // Numbers the vertex in which the pixel's corner (0 to 1 along each axis) takes part, below vertex_slots().
  std::size_t vertex_slot(const IVec2& pixel, const IVec2& corner) const;
  std::size_t vertex_slots() const {
    return 4 * static_cast<std::size_t>(size_.x + 1) * static_cast<std::size_t>(size_.y + 1);
  }
  // Of that vertex: pixels from the map's corner, disparity as the planes around have it on average.
  struct Vertex {
    Vec2 at{0};
    float disparity = 0;
    Vec2 slope{0};
    bool behind = false;  // something nearer begins there
  };
  Vertex vertex(const IVec2& pixel, const IVec2& corner) const;

 private:
  std::size_t index(const IVec2& pixel) const {
    return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size_.x) + static_cast<std::size_t>(pixel.x);
  }
  bool inside(const IVec2& pixel) const {
    return pixel.x >= 0 && pixel.y >= 0 && pixel.x < size_.x && pixel.y < size_.y;
  }
  bool are_connected(const PixelPlane& a, const PixelPlane& b, int axis) const;
  // Of the pixels around a grid point, numbered counter-clockwise from the lower left, a bit for each that is connected
  // with that of number `from`.
  unsigned around(const IVec2& point, int from) const;

  std::span<const PixelPlane> planes_;
  IVec2 size_;
  std::vector<std::uint8_t> connected_;
};

}  // namespace oriel
