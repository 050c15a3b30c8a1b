// Maps of a half space of as many texels each: octahedral, hemicube, paraboloid. How often they say that light passes
// what blocks it (a leak), or that it does not (Barczak 2006, section 4.2.1; docs/study/barczak2006.md).
#include <cstdio>
#include <functional>
#include <random>

#include "formats/query/mesh_rays.h"
#include "player/movers/hemisphere_map.h"

namespace oriel {
namespace {

constexpr int kLights = 64, kReceivers = 4000;
const Vec3 kRoom(5, 3, 4);  // metres; its corner is the origin

using Random = std::mt19937;
float uniform(Random& random) {
  return std::uniform_real_distribution<float>(0, 1)(random);
}

Mesh mesh_of(std::vector<Vec3> positions, std::vector<std::uint32_t> indices) {
  Mesh mesh;
  mesh.positions = std::move(positions);
  mesh.indices = std::move(indices);
  mesh.parts = {{"blocker", 0, static_cast<std::uint32_t>(mesh.indices.size()), 0, -1}};
  return mesh;
}

// A level board of 1.6 by 1 metres, of so many squares along each side.
Mesh board(std::uint32_t cuts) {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i <= cuts; ++i)
    for (std::uint32_t j = 0; j <= cuts; ++j)
      positions.emplace_back(1.7f + 1.6f * static_cast<float>(i) / static_cast<float>(cuts), 0.75f,
                             1.5f + static_cast<float>(j) / static_cast<float>(cuts));
  for (std::uint32_t i = 0; i < cuts; ++i)
    for (std::uint32_t j = 0; j < cuts; ++j) {
      const std::uint32_t a = i * (cuts + 1) + j, b = a + cuts + 1;
      indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  return mesh_of(std::move(positions), std::move(indices));
}

// A ball of 30 cm radius.
Mesh ball(std::uint32_t around) {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> indices;
  const std::uint32_t down = around / 2;
  for (std::uint32_t j = 0; j <= down; ++j)
    for (std::uint32_t i = 0; i <= around; ++i) {
      const float theta = kPi * static_cast<float>(j) / static_cast<float>(down);
      const float phi = 2 * kPi * static_cast<float>(i) / static_cast<float>(around);
      positions.push_back(Vec3(2.5f, 0.4f, 2) + 0.3f * Vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                                            std::sin(theta) * std::sin(phi)));
    }
  for (std::uint32_t j = 0; j < down; ++j)
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t a = j * (around + 1) + i, b = a + around + 1;
      indices.insert(indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  return mesh_of(std::move(positions), std::move(indices));
}

struct Place {
  Vec3 at{0}, normal{0};
};
Place on_walls(Random& random) {
  const auto wall = static_cast<int>(6 * uniform(random)), axis = wall / 2;
  Place out;
  for (int c = 0; c < 3; ++c) out.at[c] = kRoom[c] * uniform(random);
  out.at[axis] = wall % 2 == 0 ? 0 : kRoom[axis];
  out.normal[axis] = wall % 2 == 0 ? 1 : -1;
  return out;
}

// Distances by texel; which texel a direction of the light's axes (z > 0) falls on.
struct DepthMap {
  std::vector<float> distance;
  std::function<std::size_t(const Vec3& local)> texel;
};
using MakeMap = DepthMap (*)(const MeshRays& blocker, const HemisphereMap& light, int texels);

std::size_t texel_in(const Vec2& place, int width, int height) {  // place: [-1, 1]²
  const auto index = [](float at, int size) {
    return std::clamp(static_cast<int>((0.5f + 0.5f * at) * static_cast<float>(size)), 0, size - 1);
  };
  return static_cast<std::size_t>(index(place.y, height) * width + index(place.x, width));
}
Vec2 middle_of(int texel, int width, int height) {
  return {(static_cast<float>(texel % width) + 0.5f) / static_cast<float>(width) * 2 - 1,
          (static_cast<float>(texel / width) + 0.5f) / static_cast<float>(height) * 2 - 1};
}
float along(const MeshRays& blocker, const HemisphereMap& light, const Vec3& local) {
  const Vec3 way = light.frame * glm::normalize(local);
  const auto hit = blocker.first(light.from, way);
  return hit ? hit->distance : std::numeric_limits<float>::infinity();
}

// Projective maps: a triangle that is drawn covers a texel where a ray through the texel's middle meets it.
DepthMap octahedral(const MeshRays& blocker, const HemisphereMap& light, int texels) {
  const int side = static_cast<int>(std::lround(std::sqrt(texels)));
  DepthMap map;
  for (int t = 0; t < side * side; ++t) {
    const Vec2 m = middle_of(t, side, side), p(0.5f * (m.x + m.y), 0.5f * (m.x - m.y));
    map.distance.push_back(along(blocker, light, Vec3(p, 1 - std::abs(p.x) - std::abs(p.y))));
  }
  map.texel = [side](const Vec3& local) { return texel_in(hemisphere_place(local), side, side); };
  return map;
}

// A whole face and four halves: 3 side² texels.
DepthMap hemicube(const MeshRays& blocker, const HemisphereMap& light, int texels) {
  const int side = 2 * static_cast<int>(std::lround(std::sqrt(texels / 3.0) / 2)), half = side / 2;
  const auto direction = [](int face, const Vec2& m) {  // m: [-1, 1]²; of halves y is [0, 1] upwards
    if (face == 0) return Vec3(m, 1);
    const float s = face % 2 == 0 ? -1.0f : 1.0f;
    return face < 3 ? Vec3(s, m.x, 0.5f + 0.5f * m.y) : Vec3(m.x, s, 0.5f + 0.5f * m.y);
  };
  DepthMap map;
  for (int face = 0; face < 5; ++face)
    for (int t = 0; t < side * (face == 0 ? side : half); ++t)
      map.distance.push_back(along(blocker, light, direction(face, middle_of(t, side, face == 0 ? side : half))));
  map.texel = [side, half](const Vec3& d) -> std::size_t {
    const Vec3 size = glm::abs(d);
    if (size.z >= std::max(size.x, size.y)) return texel_in(Vec2(d) / d.z, side, side);
    const bool x = size.x >= size.y;
    const int face = x ? (d.x < 0 ? 2 : 1) : (d.y < 0 ? 4 : 3);
    const Vec2 at = (x ? Vec2(d.y, d.z) : Vec2(d.x, d.z)) / (x ? size.x : size.y);
    return static_cast<std::size_t>(side * side + (face - 1) * side * half) +
           texel_in({at.x, 2 * at.y - 1}, side, half);
  };
  return map;
}

// Vertices go where they belong, lines between them are straight: so triangles are drawn (Brabec et al. 2002).
DepthMap paraboloid(const MeshRays& blocker, const HemisphereMap& light, int texels) {
  const int side = static_cast<int>(std::lround(std::sqrt(texels)));
  DepthMap map;
  map.distance.assign(static_cast<std::size_t>(side * side), std::numeric_limits<float>::infinity());
  const auto place = [](const Vec3& local) {
    const Vec3 d = glm::normalize(local);
    return Vec2(d) / (1 + d.z);
  };
  const Mesh& mesh = blocker.mesh();
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::array<Vec2, 3> p;
    std::array<float, 3> far;
    bool before = true;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 local = light.local(mesh.positions[mesh.indices[i + c]]);
      before = before && local.z > 0;
      p[c] = place(local), far[c] = glm::length(local);
    }
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; };
    const float area = cross(p[1] - p[0], p[2] - p[0]);
    if (!before || area == 0) continue;
    for (int t = 0; t < side * side; ++t) {
      const Vec2 m = middle_of(t, side, side);
      const float u = cross(m - p[0], p[2] - p[0]) / area, v = cross(p[1] - p[0], m - p[0]) / area;
      if (u < 0 || v < 0 || u + v > 1) continue;
      float& known = map.distance[static_cast<std::size_t>(t)];
      known = std::min(known, (1 - u - v) * far[0] + u * far[1] + v * far[2]);
    }
  }
  map.texel = [side, place](const Vec3& local) { return texel_in(place(local), side, side); };
  return map;
}

struct Count {
  std::size_t blocked = 0, leaks = 0, shadows = 0;  // shadows: that are none
};
Count count(const Mesh& mesh, MakeMap make, int texels) {
  Random random(7);
  const MeshRays blocker(mesh);
  Count out;
  for (int l = 0; l < kLights; ++l) {
    const Place from = on_walls(random);
    LiveLight light;
    light.position = from.at, light.normal = from.normal;
    const HemisphereMap around = hemisphere_of(light, {Vec3(0), kRoom});
    const DepthMap map = make(blocker, around, texels);
    for (int r = 0; r < kReceivers; ++r) {
      const Place to = on_walls(random);
      const Vec3 local = around.local(to.at);
      if (!(local.z > 1e-3f)) continue;
      std::uint32_t last = ~0u;
      const bool truth = blocker.blocks(from.at, to.at, last);
      const bool said = map.distance[map.texel(local)] < glm::length(to.at - from.at);
      out.blocked += truth ? 1 : 0, out.leaks += truth && !said ? 1 : 0, out.shadows += !truth && said ? 1 : 0;
    }
  }
  return out;
}

int bench() {
  struct Named {
    const char* name;
    Mesh mesh;
  };
  const Named blockers[] = {{"board of 2 triangles", board(1)},
                            {"board of 6 x 6 squares", board(6)},
                            {"board of 60 x 60 squares", board(60)},
                            {"ball of 256 triangles", ball(16)},
                            {"ball of 4096 triangles", ball(64)}};
  const std::pair<const char*, MakeMap> maps[] = {
      {"octahedral", octahedral}, {"hemicube", hemicube}, {"paraboloid", paraboloid}};
  std::printf("Leaks, and shadows that are none, over what is blocked; %d lights on the walls of a room.\n\n", kLights);
  std::printf("| blocker | texels |");
  for (const auto& [name, make] : maps) std::printf(" %s |", name);
  std::printf("\n|---|---|---|---|---|\n");
  for (const Named& blocker : blockers)
    for (const int texels : {64 * 64, 128 * 128}) {
      std::printf("| %s | %d |", blocker.name, texels);
      for (const auto& [name, make] : maps) {
        const Count c = count(blocker.mesh, make, texels);
        const double over = 100.0 / static_cast<double>(c.blocked);
        std::printf(" %.2f %%, %.2f %% |", over * static_cast<double>(c.leaks), over * static_cast<double>(c.shadows));
        std::fflush(stdout);
      }
      std::printf("\n");
    }
  return 0;
}

}  // namespace
}  // namespace oriel

int main() {
  return oriel::bench();
}
