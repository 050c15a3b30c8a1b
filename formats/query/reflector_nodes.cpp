#include "formats/query/reflector_nodes.h"

#include <algorithm>
#include <cmath>

namespace oriel {
namespace {

constexpr float kInwards = 0.02f;  // by which border nodes move in, in cells

}  // namespace

Vec3 reflector_from_pack(const Reflector& reflector, const Vec3& p) {
  const Mat4& m = reflector.pack_from_reflector;
  const DVec3 d = DVec3(p) - DVec3(Vec3(m[3]));
  return Vec3(DVec3(glm::dot(d, DVec3(Vec3(m[0]))), glm::dot(d, DVec3(Vec3(m[1]))), glm::dot(d, DVec3(Vec3(m[2])))));
}

Vec3 pack_from_reflector(const Reflector& reflector, const Vec3& p) {
  const Mat4& m = reflector.pack_from_reflector;
  return Vec3(DVec3(Vec3(m[3])) + double{p.x} * DVec3(Vec3(m[0])) + double{p.y} * DVec3(Vec3(m[1])) +
              double{p.z} * DVec3(Vec3(m[2])));
}

std::uint32_t nodes_along(float side_m, float distance_m, std::uint32_t most) {
  const float cells = std::ceil(side_m / distance_m);
  return 1 + static_cast<std::uint32_t>(std::clamp(cells, 1.0f, static_cast<float>(most - 1)));
}

ReflectorNodes lay_out_nodes(const Reflector& reflector, std::uint32_t x, std::uint32_t y) {
  const Vec2 size = reflector.upper - reflector.lower;
  ReflectorNodes nodes{x, y, 0, {}};
  const Vec3 normal(reflector.pack_from_reflector[2]), origin(reflector.pack_from_reflector[3]);
  nodes.lift_m = reflector.flatness_m + 1e-5f * (glm::length(size) + max_component(glm::abs(origin)));
  const Vec2 last(x - 1, y - 1);
  for (std::uint32_t j = 0; j < y; ++j)
    for (std::uint32_t i = 0; i < x; ++i) {
      const Vec2 at = glm::clamp(Vec2(i, j), Vec2(kInwards), last - kInwards) / last;
      nodes.points.push_back(pack_from_reflector(reflector, Vec3(reflector.lower + at * size, 0)) +
                             nodes.lift_m * normal);
    }
  return nodes;
}

void fill_uncovered(const ReflectorNodes& nodes, const std::vector<bool>& covered, std::vector<float>& shares) {
  std::vector<bool> known = covered;
  if (std::find(known.begin(), known.end(), true) == known.end()) return;
  while (std::find(known.begin(), known.end(), false) != known.end()) {
    const std::vector<bool> before = known;
    for (std::uint32_t j = 0; j < nodes.y; ++j)
      for (std::uint32_t i = 0; i < nodes.x; ++i) {
        const std::size_t at = std::size_t{j} * nodes.x + i;
        if (before[at]) continue;
        float sum = 0, count = 0;
        for (std::uint32_t y = j > 0 ? j - 1 : 0; y <= std::min(j + 1, nodes.y - 1); ++y)
          for (std::uint32_t x = i > 0 ? i - 1 : 0; x <= std::min(i + 1, nodes.x - 1); ++x)
            if (before[std::size_t{y} * nodes.x + x]) sum += shares[std::size_t{y} * nodes.x + x], count += 1;
        if (count == 0) continue;
        shares[at] = sum / count;
        known[at] = true;
      }
  }
}

}  // namespace oriel
