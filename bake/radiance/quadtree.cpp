#include "bake/radiance/quadtree.h"

#include <array>
#include <limits>
#include <optional>

namespace oriel {
namespace {

constexpr int kLargest = 64;    // pixels of a square's side
constexpr float kFlat = 0.05f;  // in pixels of shift (SurfaceGrid::pixels_of_disparity): off a square's plane
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

struct Square {
  IVec2 at{0};
  int side = 1;
};

// Grid points around a square, counter-clockwise from its lower left.
template <class Each>
void walk_around(const Square& s, const Each& each) {
  constexpr std::array<IVec2, 4> kSteps{IVec2(1, 0), IVec2(0, 1), IVec2(-1, 0), IVec2(0, -1)};
  IVec2 offset(0);
  for (const IVec2& step : kSteps)
    for (int i = 0; i < s.side; ++i, offset += step) {
      // The square's own pixel there, and the corner of it.
      const IVec2 pixel = glm::min(offset, IVec2(s.side - 1));
      each(s.at + pixel, offset - pixel, i == 0);
    }
}

class Squares {
 public:
  explicit Squares(const SurfaceGrid& grid) : grid_(grid), vertex_(grid.vertex_slots(), kNone) {}

  GridMesh make() {
    for (int y = 0; y < grid_.size().y; y += kLargest)
      for (int x = 0; x < grid_.size().x; x += kLargest) divide({IVec2(x, y), kLargest});
    for (const Square& s : squares_)
      walk_around(s, [&](const IVec2& pixel, const IVec2& corner, bool is_corner) {
        if (is_corner) take_vertex(pixel, corner);
      });
    for (const Square& s : squares_) triangulate(s);
    return std::move(mesh_);
  }

 private:
  // The plane of a square that is one; none where it is not, and then its planar parts are among squares_.
  std::optional<PixelPlane> divide(const Square& s) {
    if (s.at.x >= grid_.size().x || s.at.y >= grid_.size().y) return {};
    if (s.side == 1) return grid_.plane(s.at).seen() ? std::optional(grid_.plane(s.at)) : std::nullopt;
    const int half = s.side / 2;
    std::array<std::optional<PixelPlane>, 4> parts;
    std::array<Square, 4> quarters;
    for (std::size_t i = 0; i < 4; ++i) {
      quarters[i] = {s.at + half * IVec2(i & 1, i >> 1), half};
      parts[i] = divide(quarters[i]);
    }
    if (is_flat(s, parts)) {
      if (s.side < kLargest) return of_square(s);
      squares_.push_back(s);
      return {};
    }
    for (std::size_t i = 0; i < 4; ++i)
      if (parts[i]) squares_.push_back(quarters[i]);
    return {};
  }

  // That of a pixel, carried to the square's lower left one.
  PixelPlane of_square(const Square& s) const { return grid_.plane(s.at); }

  bool is_flat(const Square& s, const std::array<std::optional<PixelPlane>, 4>& parts) const {
    for (const auto& part : parts)
      if (!part) return false;
    const int half = s.side / 2;
    const float most = kFlat / grid_.pixels_of_disparity();
    for (int i = 1; i < 4; ++i) {
      const IVec2 from = half * IVec2(i & 1, i >> 1);
      for (const IVec2& to : {IVec2(0), IVec2(s.side - 1, 0), IVec2(0, s.side - 1), IVec2(s.side - 1)})
        if (std::abs(parts[0]->at(Vec2(to)) - parts[static_cast<std::size_t>(i)]->at(Vec2(to - from))) > most)
          return false;
    }
    for (int i = 0; i < s.side; ++i)
      if (!grid_.connected(s.at + IVec2(half - 1, i), 0) || !grid_.connected(s.at + IVec2(i, half - 1), 1))
        return false;
    return true;
  }

  std::uint32_t take_vertex(const IVec2& pixel, const IVec2& corner) {
    std::uint32_t& vertex = vertex_[grid_.vertex_slot(pixel, corner)];
    if (vertex != kNone) return vertex;
    const SurfaceGrid::Vertex v = grid_.vertex(pixel, corner);
    const float unit = grid_.pixels_of_disparity();
    vertex = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.emplace_back(v.at, unit * v.disparity);
    mesh_.slopes.push_back(unit * v.slope);
    mesh_.behind.push_back(v.behind);
    return vertex;
  }

  void triangulate(const Square& s) {
    std::vector<std::uint32_t> around;
    walk_around(s, [&](const IVec2& pixel, const IVec2& corner, bool) {
      const std::uint32_t vertex = vertex_[grid_.vertex_slot(pixel, corner)];
      if (vertex != kNone) around.push_back(vertex);
    });
    if (around.size() == 4) {
      mesh_.indices.insert(mesh_.indices.end(), {around[0], around[1], around[2], around[0], around[2], around[3]});
      return;
    }
    const std::uint32_t middle = take_vertex(s.at + s.side / 2, IVec2(0));
    for (std::size_t i = 0; i < around.size(); ++i)
      mesh_.indices.insert(mesh_.indices.end(), {middle, around[i], around[(i + 1) % around.size()]});
  }

  const SurfaceGrid& grid_;
  std::vector<std::uint32_t> vertex_;  // by slot
  std::vector<Square> squares_;
  GridMesh mesh_;
};

}  // namespace

GridMesh mesh_squares(const SurfaceGrid& grid) {
  return Squares(grid).make();
}

}  // namespace oriel
