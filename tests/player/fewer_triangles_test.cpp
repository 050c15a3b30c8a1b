// Fewer triangles for moving frames: off by no more than was asked for, open nowhere, and those drawn again are the
// same.
#include "player/scene/fewer_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace oriel {
namespace {

constexpr std::uint32_t kSide = 40;

// The half of a ball of radius 1 over z = 0, and beside it a flat square of the same vertices' numbers.
Mesh bumps() {
  Mesh mesh;
  for (int part = 0; part < 2; ++part) {
    const auto first_vertex = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t j = 0; j <= kSide; ++j)
      for (std::uint32_t i = 0; i <= kSide; ++i) {
        const Vec2 at = 2.0f * Vec2(i, j) / static_cast<float>(kSide) - 1.0f;
        const float height = part == 0 ? std::sqrt(std::max(0.0f, 2 - glm::dot(at, at))) : 0.0f;
        mesh.positions.emplace_back(at.x + 3.0f * static_cast<float>(part), at.y, height);
      }
    MeshPart added;
    added.first_index = static_cast<std::uint32_t>(mesh.indices.size());
    for (std::uint32_t j = 0; j < kSide; ++j)
      for (std::uint32_t i = 0; i < kSide; ++i) {
        const std::uint32_t a = first_vertex + j * (kSide + 1) + i, b = a + 1, c = a + kSide + 1, d = c + 1;
        mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
      }
    added.index_count = static_cast<std::uint32_t>(mesh.indices.size()) - added.first_index;
    added.material = static_cast<std::uint32_t>(part);
    mesh.parts.push_back(added);
  }
  return mesh;
}

View from_afar(float distance) {
  Camera camera;
  camera.eye = {0, 0, distance};
  camera.forward = {0, 0, -1};
  camera.up = {0, 1, 0};
  camera.vertical_fov_rad = 1;
  Bounds bounds;
  bounds.extend(Vec3(-1, -1, 0));
  bounds.extend(Vec3(4, 1, 1.5f));
  return make_view(camera, 640, 360, bounds);
}

std::size_t count(const std::vector<DrawRange>& ranges) {
  std::size_t indices = 0;
  for (const DrawRange& range : ranges) indices += range.index_count;
  return indices;
}

TEST(FewerTriangles, FarAwayThereAreFewAndNearAll) {
  const Mesh mesh = bumps();
  std::vector<std::uint32_t> indices;
  const auto ranges = sorted_ranges(mesh, indices);
  const FewerTriangles fewer(mesh, ranges, indices, {});
  const std::size_t near = count(fewer.choose(from_afar(1.6f), 0).ranges),
                    far = count(fewer.choose(from_afar(100), 1).ranges);
  EXPECT_LE(near, indices.size());
  EXPECT_GE(near, indices.size() / 2) << "the flat half may be few from anywhere";
  EXPECT_LE(far, indices.size() / 4);
  std::size_t last = near;
  for (const float away : {2.0f, 5.0f, 20.0f, 100.0f}) {
    const std::size_t now = count(fewer.choose(from_afar(away), 1).ranges);
    EXPECT_LE(now, last) << away;
    last = now;
  }
}

// Every vertex that is left lies on the surface, and each edge of the border is still there.
TEST(FewerTriangles, BordersStay) {
  const Mesh mesh = bumps();
  std::vector<std::uint32_t> indices;
  const auto ranges = sorted_ranges(mesh, indices);
  const FewerTriangles fewer(mesh, ranges, indices, {});
  std::set<std::uint32_t> used;
  for (const DrawRange& range : fewer.choose(from_afar(100), 1).ranges)
    used.insert(fewer.indices().begin() + range.first_index,
                fewer.indices().begin() + range.first_index + range.index_count);
  for (std::uint32_t i = 0; i <= kSide; ++i) {
    EXPECT_TRUE(used.contains(i));
    EXPECT_TRUE(used.contains(i * (kSide + 1)));
  }
}

TEST(FewerTriangles, WhatIsDrawnAgainIsTheSame) {
  const Mesh mesh = bumps();
  std::vector<std::uint32_t> indices;
  const auto ranges = sorted_ranges(mesh, indices);
  const std::span<const std::uint32_t> all(mesh.indices);
  const std::size_t half = mesh.parts[1].first_index;
  FewerTriangles::DrawnAgain again{all.subspan(half), {all.first(half / 2)}};
  const FewerTriangles fewer(mesh, ranges, indices, again);
  const auto chosen = fewer.choose(from_afar(100), 1);
  ASSERT_EQ(chosen.curved.size(), 1u);
  ASSERT_EQ(chosen.curved[0].size(), 1u);
  EXPECT_LT(chosen.curved[0][0].index_count, half / 4);
  bool found = false;
  std::size_t kept = 0;
  for (const DrawRange& range : chosen.ranges) {
    found |=
        range.first_index == chosen.curved[0][0].first_index && range.index_count == chosen.curved[0][0].index_count;
    if (range.material == 1) kept += range.index_count;
  }
  EXPECT_TRUE(found);
  EXPECT_EQ(kept, all.size() - half) << "planar reflectors are as they are";
}

}  // namespace
}  // namespace oriel
