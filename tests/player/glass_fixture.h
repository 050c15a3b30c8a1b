// What tests of glass are made of.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tests/player/frame_fixture.h"

namespace oriel::testing {

// Material 0 is the glass; nothing reflects outside, so that what passes is all of the light.
inline Pack glass_pack(float ior, float roughness, const Vec3& absorption = Vec3(0)) {
  Pack pack;
  Material glass;
  glass.transmission = 1, glass.ior = ior, glass.roughness = roughness;
  pack.materials = {glass};
  pack.solids = {{0, Vec3(1), absorption}};
  return pack;
}

inline void add_box(Pack& pack, const Vec3& lower, const Vec3& upper, std::uint32_t material = 0) {
  const Vec3 x(upper.x - lower.x, 0, 0), y(0, upper.y - lower.y, 0), z(0, 0, upper.z - lower.z);
  add_quad(pack, lower, y, x, material, -1);
  add_quad(pack, lower + z, x, y, material, -1);
  add_quad(pack, lower, z, y, material, -1);
  add_quad(pack, lower + x, y, z, material, -1);
  add_quad(pack, lower, x, z, material, -1);
  add_quad(pack, lower + y, z, x, material, -1);
}

inline std::uint32_t add_lamp(Pack& pack, const Vec3& cd_m2) {
  Material lamp;
  lamp.base_color = Vec3(0);
  lamp.emission = cd_m2;
  pack.materials.push_back(lamp);
  return static_cast<std::uint32_t>(pack.materials.size() - 1);
}

// Walls around the origin, by side: -x, x, -y, …; gives their colours, cd/m².
inline std::array<Vec3, 6> add_room(Pack& pack, float half) {
  std::array<Vec3, 6> colors;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    Vec3& color = colors[static_cast<std::size_t>(side)];
    color = Vec3(20.0f * static_cast<float>(side + 1), 30.0f * static_cast<float>(side % 3),
                 40.0f * static_cast<float>(side % 2) + 10);
    Vec3 corner(-half), right(0), up(0);
    corner[axis] = side % 2 ? half : -half;
    right[side % 2 ? v : u] = 2 * half, up[side % 2 ? u : v] = 2 * half;
    add_quad(pack, corner, right, up, add_lamp(pack, color), -1);
  }
  return colors;
}

inline Camera glass_camera(const Vec3& eye, const Vec3& target, float fov = 0.8f) {
  Camera camera;
  camera.eye = eye;
  camera.forward = glm::normalize(target - eye);
  camera.vertical_fov_rad = fov;
  return camera;
}

inline Vec3 pixel_ray(const Camera& camera, int x, int y, int width, int height) {
  const Vec3 right = glm::normalize(glm::cross(camera.forward, Vec3(0, 1, 0))), up = glm::cross(right, camera.forward);
  const float half = std::tan(0.5f * camera.vertical_fov_rad);
  const float u = (2 * (static_cast<float>(x) + 0.5f) - static_cast<float>(width)) / static_cast<float>(height);
  const float v = 1 - 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
  return glm::normalize(camera.forward + half * (u * right + v * up));
}

// A slab and an edge behind it.
struct ShiftedEdge {
  static constexpr float kThick = 0.6f, kIor = 1.5f, kBehind = -1.5f;

  static void add(Pack& pack) {
    add_box(pack, Vec3(-3, -3, -kThick), Vec3(3, 3, 0));
    add_quad(pack, {0, -4, kBehind}, {4, 0, 0}, {0, 8, 0}, add_lamp(pack, Vec3(100)), -1);
  }
  // That the edge lies where the closed form of the parallel shift has it, as eyes see it from before the slab.
  static void expect_in(const Picture& picture, const Camera& camera) {
    const int size = picture.width;
    int wrong = 0, unshifted = 0, seen = 0;
    for (int x = 0; x < size; ++x) {
      const auto x_behind = [&](int pixel, bool bent) {
        const Vec3 d = pixel_ray(camera, pixel, size / 2, size, size);
        const float cosine = -d.z, within = std::sqrt(1 - (1 - cosine * cosine) / (kIor * kIor));
        const float slope = d.x / cosine, slope_within = d.x / kIor / within;
        return camera.eye.x + slope * (camera.eye.z - kThick - kBehind) + (bent ? slope_within : slope) * kThick;
      };
      // Beyond the screen the surroundings show it, which are coarser.
      const Vec3 hit = Vec3(x_behind(x, true), 0, kBehind) - camera.eye;
      const float along = glm::dot(hit, camera.forward);
      const float aside = glm::dot(hit, glm::normalize(glm::cross(camera.forward, Vec3(0, 1, 0))));
      if (std::abs(aside) > 0.99f * along * std::tan(0.5f * camera.vertical_fov_rad)) continue;
      const bool lit = picture.at(x, size / 2).x > 50;
      seen += lit;
      // The frame behind is known by pixel, and so is where on it the ray meets the edge.
      const bool at_edge = (x_behind(x - 2, true) > 0) != (x_behind(x + 2, true) > 0);
      wrong += !at_edge && lit != (x_behind(x, true) > 0);
      unshifted += lit != (x_behind(x, false) > 0);
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(unshifted, 3) << "a thin pane would show it there";
    EXPECT_GT(seen, 20);
  }
};

// That nothing of the picture differs from the sky.
inline void expect_even(const Picture& picture, const Vec3& sky, const std::string& what) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(picture.at(x, y)[c] / sky[c], 1, 0.01) << what << x << ", " << y;
}

// An even light seen through slabs that are so thick together, by Beer and Lambert along the bent rays.
struct AbsorbedLight {
  static constexpr Vec3 kAbsorption{0.5f, 2, 10};  // 1/m
  static constexpr float kThick = 0.2f, kLight = 100;

  static void add(Pack& pack) {
    add_quad(pack, {-9, -9, -2}, {18, 0, 0}, {0, 18, 0}, add_lamp(pack, Vec3(kLight)), -1);
  }
  static Camera camera() { return glass_camera({0.8f, 0.3f, 1.5f}, Vec3(0)); }
  static void expect_in(const Picture& picture) {
    for (int y = 0; y < picture.height; y += 5)
      for (int x = 0; x < picture.width; x += 5) {
        const float cosine = -pixel_ray(camera(), x, y, picture.width, picture.height).z;
        const float within = std::sqrt(1 - (1 - cosine * cosine) / 2.25f);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(picture.at(x, y)[c], kLight * std::exp(-kAbsorption[c] * kThick / within), 0.3) << x << ", " << y;
      }
  }
};

inline void add_ball(Pack& pack, const Vec3& centre, float radius, bool inwards = false) {
  constexpr int kRings = 24, kSides = 48;
  Mesh& mesh = pack.mesh;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int r = 0; r <= kRings; ++r)
    for (int s = 0; s <= kSides; ++s) {
      const float theta = kPi * static_cast<float>(r) / kRings;
      const float phi = 2 * kPi * static_cast<float>(s % kSides) / kSides;
      const Vec3 n = r == 0 ? Vec3(0, 1, 0)
                     : r == kRings
                         ? Vec3(0, -1, 0)
                         : Vec3(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
      mesh.positions.push_back(centre + radius * n);
      mesh.normals.push_back(inwards ? -n : n);
      mesh.uvs.emplace_back(0);
      mesh.lightmap_uvs.emplace_back(0);
    }
  MeshPart part;
  part.first_index = static_cast<std::uint32_t>(mesh.indices.size());
  for (std::uint32_t r = 0; r < kRings; ++r)
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const std::uint32_t a = first + r * (kSides + 1) + s, b = a + kSides + 1;
      for (const std::uint32_t i : {a, b, b + 1, a, b + 1, a + 1}) mesh.indices.push_back(i);
      if (inwards)
        for (int t = 0; t < 2; ++t) std::swap(mesh.indices.end()[-3 * t - 1], mesh.indices.end()[-3 * t - 2]);
    }
  part.index_count = static_cast<std::uint32_t>(mesh.indices.size()) - part.first_index;
  mesh.parts.push_back(part);
}

inline void add_triangle(Pack& pack, const std::array<Vec3, 3>& corners, const std::array<Vec3, 3>& normals) {
  Mesh& mesh = pack.mesh;
  MeshPart part;
  part.first_index = static_cast<std::uint32_t>(mesh.indices.size());
  part.index_count = 3;
  for (std::size_t i = 0; i < 3; ++i) {
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(corners[i]);
    mesh.normals.push_back(normals[i]);
    mesh.uvs.emplace_back(0);
    mesh.lightmap_uvs.emplace_back(0);
  }
  mesh.parts.push_back(part);
}

inline void add_flat(Pack& pack, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = glm::normalize(glm::cross(b - a, c - a));
  add_triangle(pack, {a, b, c}, {n, n, n});
}

// A cup with walls of a tenth of its size, round about the y axis.
inline void add_cup(Pack& pack) {
  constexpr int kSides = 40;
  const Vec2 outline[] = {{0, -0.6f},   {0.5f, -0.6f},  {0.5f, 0.6f}, {0.45f, 0.65f},
                          {0.4f, 0.6f}, {0.4f, -0.45f}, {0, -0.45f}};
  const auto at = [&](std::size_t i, int side) {
    const float phi = 2 * kPi * static_cast<float>(side % kSides) / kSides;
    return Vec3(outline[i].x * std::cos(phi), outline[i].y, -outline[i].x * std::sin(phi));
  };
  for (std::size_t i = 0; i + 1 < std::size(outline); ++i)
    for (int side = 0; side < kSides; ++side) {
      const Vec3 a = at(i, side), b = at(i, side + 1), c = at(i + 1, side + 1), d = at(i + 1, side);
      if (outline[i].x > 0) add_flat(pack, a, b, c);
      if (outline[i + 1].x > 0) add_flat(pack, a, c, d);
    }
}

// Pixels that an edge takes from a quarter to three quarters. Neighbours of 4 x 4 look at parts of the lobe: their
// mean.
inline float edge_width(const Picture& picture, int size) {
  std::vector<float> profile;
  for (int x = 2; x + 1 < size; ++x) {
    float sum = 0;
    for (int i = 0; i < 64; ++i) sum += picture.at(x + i % 4 - 2, size / 2 + i / 4 - 8).x / 64;
    profile.push_back(sum);
  }
  const auto at = [&](float level) {
    std::size_t i = 0;
    while (i + 2 < profile.size() && profile[i + 1] < level) ++i;
    return static_cast<float>(i) + (level - profile[i]) / std::max(profile[i + 1] - profile[i], 1e-3f);
  };
  return at(75) - at(25);
}

// The same of a slope: what becomes of rays from above at facets of GGX. beyond(facet): gives one.
template <class Beyond>
float slope_width(float alpha, const Beyond& beyond) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0, 1);
  const auto facet = [&] {
    const float u = uniform(random), phi = 2 * kPi * uniform(random), slope = alpha * std::sqrt(u / (1 - u));
    return glm::normalize(Vec3(slope * std::cos(phi), slope * std::sin(phi), 1));
  };
  std::vector<float> slopes;
  for (int i = 0; i < 100000; ++i) {
    const Vec3 d = beyond(facet);
    if (d.z < 0) slopes.push_back(d.x / -d.z);
  }
  std::sort(slopes.begin(), slopes.end());
  return slopes[slopes.size() * 3 / 4] - slopes[slopes.size() / 4];
}

inline constexpr float kBoardsFov = 0.8f;
inline constexpr int kBoardsSize = 160;

// A bright and a dark board behind what is there, as eyes see them from 1 m above it.
inline void add_boards(Pack& pack, float z) {
  add_quad(pack, {0, -4, z}, {4, 0, 0}, {0, 8, 0}, add_lamp(pack, Vec3(100)), -1);
  add_quad(pack, {-4, -4, z}, {4, 0, 0}, {0, 8, 0}, add_lamp(pack, Vec3(0)), -1);
}

inline float pixels_of(float slopes, float behind) {
  return slopes * behind / (1 + behind) * 0.5f * kBoardsSize / std::tan(0.5f * kBoardsFov);
}

}  // namespace oriel::testing
