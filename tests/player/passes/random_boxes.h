// Scenes of boxes at random for the tests of shade cells, and points on them.
#pragma once

#include <random>
#include <vector>

#include "player/movers/shade_cells.h"

namespace oriel {

// Whose the point is; any leaf where it is not finite. cells: of make_shade_cells().
inline std::uint32_t leaf_at(std::span<const ShadeCell> cells, const Vec3& p) {
  std::uint32_t at = 0;
  while (cells[at].child != 0) {
    const std::uint32_t first = cells[at].child;
    at = glm::all(glm::lessThan(p, cells[first].cell.upper)) ? first : first + 1;
  }
  return at;
}

class RandomBoxes {
 public:
  explicit RandomBoxes(unsigned seed) : random_(seed) {}

  float uniform(float from, float to) { return std::uniform_real_distribution<float>(from, to)(random_); }
  Vec3 in(const Bounds& box) {
    const Vec3 share(uniform(0, 1), uniform(0, 1), uniform(0, 1));
    return box.lower + share * (box.upper - box.lower);
  }
  Vec3 direction() {
    std::normal_distribution<float> normal;
    const Vec3 d(normal(random_), normal(random_), normal(random_));
    return normalize_or(d, Vec3(0, 1, 0));
  }
  std::size_t index(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }

  // Twelve triangles that face outwards, or inwards.
  void add_box(const Bounds& box, bool inwards) {
    for (int axis = 0; axis < 3; ++axis)
      for (const bool above : {false, true}) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<Vec3, 4> c;
        for (std::size_t i = 0; i < 4; ++i) {
          c[i] = above ? box.upper : box.lower;
          c[i][u] = i == 1 || i == 2 ? box.upper[u] : box.lower[u];
          c[i][v] = i >= 2 ? box.upper[v] : box.lower[v];
        }
        if (above == inwards) std::swap(c[1], c[3]);
        Vec3 normal(0);
        normal[axis] = above == inwards ? -1.0f : 1.0f;
        triangles.push_back({{c[0], c[1], c[2]}, {normal, normal, normal}, false});
        triangles.push_back({{c[0], c[2], c[3]}, {normal, normal, normal}, false});
      }
  }
  // A room from -size to size, and boxes in it.
  void furnish(const Vec3& size, int boxes) {
    room = {-size, size};
    add_box(room, true);
    for (int i = 0; i < boxes; ++i) {
      const Vec3 center = in(room), half = 0.12f * size * Vec3(uniform(0.2f, 1), uniform(0.2f, 1), uniform(0.2f, 1));
      add_box({glm::max(center - half, room.lower), glm::min(center + half, room.upper)}, false);
    }
  }
  // Smooth: normals that differ by corner.
  void add_loose(int count, float size) {
    for (int i = 0; i < count; ++i) {
      const Vec3 at = in(room);
      ShadeTriangle t;
      for (Vec3& corner : t.corners) corner = at + size * direction();
      const Vec3 normal =
          normalize_or(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]), Vec3(0, 1, 0));
      for (Vec3& n : t.normals) n = normal + 0.3f * direction();
      t.two_sided = i % 5 == 0;
      triangles.push_back(t);
    }
  }

  struct Place {
    Vec3 position, normal, shading;
    bool two_sided;
  };
  Place place() {
    const ShadeTriangle& t = triangles[index(triangles.size())];
    float a = uniform(0, 1), b = uniform(0, 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const auto mixed = [&](const std::array<Vec3, 3>& v) { return v[0] + a * (v[1] - v[0]) + b * (v[2] - v[0]); };
    const Vec3 normal = glm::normalize(glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]));
    return {mixed(t.corners), normal, glm::normalize(mixed(t.normals)), t.two_sided};
  }

  Bounds room{Vec3(0), Vec3(0)};
  std::vector<ShadeTriangle> triangles;

 private:
  std::mt19937 random_;
};

}  // namespace oriel
