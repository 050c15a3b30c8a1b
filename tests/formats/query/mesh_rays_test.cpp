// The hierarchy of boxes says what all triangles one after the other say.
#include "formats/query/mesh_rays.h"

#include <gtest/gtest.h>

#include <random>

namespace oriel {
namespace {

// Large and small triangles, some of them twice, some without area.
Mesh heap(std::uint32_t count) {
  Mesh mesh;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> at(-1, 1);
  const auto vec = [&] { return Vec3(at(random), at(random), at(random)); };
  for (std::uint32_t t = 0; t < count; ++t) {
    const Vec3 middle = vec(), size(t % 10 == 0 ? 1.0f : 0.05f);
    for (int c = 0; c < 3; ++c) mesh.positions.push_back(middle + (t % 17 == 0 ? 0.0f : 1.0f) * size * vec());
    const std::uint32_t first = t % 13 == 1 ? 3 * (t - 1) : 3 * t;
    for (std::uint32_t c = 0; c < 3; ++c) mesh.indices.push_back(first + c);
  }
  mesh.parts.push_back({"heap", 0, 3 * count, 0, -1});
  return mesh;
}

TEST(MeshRays, MeetWhatAllTrianglesSay) {
  for (const std::uint32_t count : {0u, 1u, 5u, 700u}) {
    const Mesh mesh = heap(count);
    const MeshRays rays(mesh);
    std::mt19937 random(3);
    std::uniform_real_distribution<float> at(-1.5f, 1.5f);
    std::uint32_t last = 12345;
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 from(at(random), at(random), at(random)), to(at(random), i % 5 == 0 ? from.y : at(random), at(random));
      const auto all = first_triangle(mesh, from, to - from), found = rays.first(from, to - from);
      ASSERT_EQ(found.has_value(), all.has_value());
      if (found) {
        EXPECT_EQ(found->first_index, all->first_index);
        EXPECT_EQ(found->distance, all->distance);
      }
      const bool between = all && all->distance < 1 - 1e-4f;
      met += between ? 1 : 0;
      EXPECT_EQ(rays.blocks(from, to, last), between);
    }
    EXPECT_EQ(met > 0, count > 5) << count;
  }
}

// The two sides of a sheet are two triangles in one place: a ray meets the one that it comes to from the front.
TEST(MeshRays, OfASheetsSidesMeetTheOneThatFaces) {
  Mesh mesh;
  mesh.positions = {{0.1f, 0.2f, 0.3f}, {1.3f, 0.1f, 0.37f}, {0.2f, 1.1f, 0.9f}};
  mesh.indices = {0, 1, 2, 0, 2, 1};
  mesh.parts = {{"front", 0, 3, 0, -1}, {"back", 3, 3, 0, -1}};
  const MeshRays rays(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<float> at(-3, 3);
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 from(at(random), at(random), at(random)), direction = Vec3(0.5f, 0.4f, 0.5f) - from;
    const auto all = first_triangle(mesh, from, direction), found = rays.first(from, direction);
    ASSERT_EQ(found.has_value(), all.has_value());
    if (!found) continue;
    ++met;
    EXPECT_LT(glm::dot(triangle_normal(mesh, found->first_index), direction), 0);
    EXPECT_EQ(found->first_index, all->first_index);
  }
  EXPECT_GT(met, 2000);
}

}  // namespace
}  // namespace oriel
