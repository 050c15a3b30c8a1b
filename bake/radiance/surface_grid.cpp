#include "bake/radiance/surface_grid.h"

#include <algorithm>
#include <array>

namespace oriel {
namespace {

// In pixels of shift (SurfaceGrid::pixels_of_disparity): a gap that nobody sees is none, and between planes that meet a
// step is a silhouette seen at a grazing angle.
constexpr float kGap = 0.5f, kSteep = 4;
constexpr float kOvershoot = 0.05f;  // relative, of disparities beyond those of all pixels around a corner

constexpr std::array<IVec2, 4> kAround{IVec2(-1, -1), IVec2(0, -1), IVec2(0, 0), IVec2(-1, 0)};

int number_around(const IVec2& corner) {  // of the pixel whose own corner it is
  return corner.y == 1 ? (corner.x == 1 ? 0 : 1) : (corner.x == 1 ? 3 : 2);
}

}  // namespace

SurfaceGrid::SurfaceGrid(std::span<const PixelPlane> planes, const IVec2& size)
    : planes_(planes), size_(size), connected_(2 * planes.size()) {
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      for (int axis = 0; axis < 2; ++axis) {
        const IVec2 pixel(x, y), next = pixel + IVec2(1 - axis, axis);
        if (inside(next)) connected_[2 * index(pixel) + axis] = are_connected(plane(pixel), plane(next), axis);
      }
}

bool SurfaceGrid::are_connected(const PixelPlane& a, const PixelPlane& b, int axis) const {
  if (!a.seen() || !b.seen()) return false;
  const float unit = pixels_of_disparity();
  const float first = unit * (a.disparity - (b.disparity - b.slope[axis]));
  const float second = unit * (a.disparity + a.slope[axis] - b.disparity);
  if (std::max(std::abs(first), std::abs(second)) <= kGap) return true;
  const bool meet = (first <= 0) != (second <= 0) || std::min(std::abs(first), std::abs(second)) <= kGap;
  return meet && unit * std::abs(a.disparity - b.disparity) <= kSteep;
}

unsigned SurfaceGrid::around(const IVec2& point, int from) const {
  const auto joined = [&](int i) {  // of numbers i and i + 1
    const IVec2 a = point + kAround[static_cast<std::size_t>(i)],
                b = point + kAround[static_cast<std::size_t>((i + 1) % 4)];
    if (!inside(a) || !inside(b)) return false;
    return a.y == b.y ? connected(a.x < b.x ? a : b, 0) : connected(a.y < b.y ? a : b, 1);
  };
  unsigned found = 1u << from;
  for (int i = from; i < from + 3 && joined(i % 4); ++i) found |= 1u << ((i + 1) % 4);
  for (int i = from + 3; i > from && joined(i % 4); --i) found |= 1u << (i % 4);
  return found;
}

std::size_t SurfaceGrid::vertex_slot(const IVec2& pixel, const IVec2& corner) const {
  const IVec2 point = pixel + corner;
  const unsigned found = around(point, number_around(corner));
  std::size_t first = 0;
  while ((found >> first & 1u) == 0) ++first;
  return 4 * (static_cast<std::size_t>(point.y) * static_cast<std::size_t>(size_.x + 1) +
              static_cast<std::size_t>(point.x)) +
         first;
}

SurfaceGrid::Vertex SurfaceGrid::vertex(const IVec2& pixel, const IVec2& corner) const {
  const IVec2 point = pixel + corner;
  const unsigned found = around(point, number_around(corner));
  float least = 1, most = 0, beside = 0, count = 0;
  Vertex out{Vec2(point), 0, Vec2(0), false};
  for (std::size_t i = 0; i < kAround.size(); ++i) {
    const IVec2 at = point + kAround[i];
    if (!inside(at) || !plane(at).seen()) continue;
    least = std::min(least, plane(at).disparity), most = std::max(most, plane(at).disparity);
    if ((found >> i & 1u) == 0) {
      beside = std::max(beside, plane(at).disparity);
      continue;
    }
    out.disparity += plane(at).at(Vec2(point) - (Vec2(at) + 0.5f));
    out.slope += plane(at).slope;
    ++count;
  }
  // Half a pixel beyond a surface's end its plane may be anywhere; what lies beside it bounds it.
  out.disparity = std::clamp(out.disparity / count, (1 - kOvershoot) * least, std::min(1.0f, (1 + kOvershoot) * most));
  out.slope /= count;
  out.behind = pixels_of_disparity() * (beside - out.disparity) > kGap;
  return out;
}

}  // namespace oriel
