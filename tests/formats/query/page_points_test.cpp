// Where texels and finer points lie.
#include "formats/query/page_points.h"

#include <gtest/gtest.h>

namespace oriel {
namespace {

// A square of 2 m in the plane y = 0 on the texels 1 to 2 of 4, one way and the other.
Mesh square() {
  Mesh mesh;
  for (const Vec2& at : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
    mesh.positions.emplace_back(2 * at.x, 0, 2 * at.y);
    mesh.normals.emplace_back(0, 1, 0);
    mesh.lightmap_uvs.push_back(0.25f + 0.5f * at);
  }
  mesh.indices = {0, 2, 1, 0, 3, 2};
  mesh.parts.push_back({"square", 0, 6, 0, 0});
  return mesh;
}

LightmapPage page_of_square() {
  LightmapPage page;
  page.width = page.height = 4;
  page.irradiance.assign(16, Vec3(1));
  page.state.assign(16, TexelState::kDilated);
  for (const std::size_t texel : {5u, 6u, 9u, 10u}) page.state[texel] = TexelState::kValid;
  return page;
}

TEST(PagePoints, TexelsAreAtTheirCentres) {
  const auto points = page_points(square(), {}, 0, page_of_square());
  ASSERT_EQ(points.size(), 4u);
  const Vec3 expected[] = {{0.5f, 0, 0.5f}, {1.5f, 0, 0.5f}, {0.5f, 0, 1.5f}, {1.5f, 0, 1.5f}};
  const std::uint32_t texels[] = {5, 6, 9, 10};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(points[i].index, texels[i]);
    EXPECT_LT(glm::length(points[i].position - expected[i]), 0.02f);
    EXPECT_EQ(points[i].normal, Vec3(0, 1, 0));
  }
  EXPECT_TRUE(page_points(square(), {}, 1, page_of_square()).empty());
  EXPECT_TRUE(page_points(square(), std::vector<std::uint32_t>{0}, 0, page_of_square()).empty());
}

TEST(PagePoints, FinerPointsAreBetweenTexels) {
  LightmapPage page = page_of_square();
  page.cell.assign(16, 0);
  page.cell[5] = DetailBlock{2, 1, 1}.code();
  page.detail_width = 8, page.detail_height = 8;
  page.detail.assign(64, Vec3(0));
  const auto points = page_points(square(), {}, 0, page);
  ASSERT_EQ(points.size(), 4u + 9u);
  EXPECT_EQ(points[4].index, 16u + 8 + 2);
  EXPECT_LT(glm::length(points[4].position - Vec3(0.5f, 0, 0.5f)), 0.02f);
  EXPECT_EQ(points[12].index, 16u + 24 + 4);
  EXPECT_LT(glm::length(points[12].position - Vec3(1.5f, 0, 1.5f)), 0.02f);
}

TEST(PagePoints, WhatNoSurfaceNeedsTakesItsNeighbours) {
  const LightmapPage page = page_of_square();
  std::vector<std::uint8_t> known(16, 0);
  std::vector<Vec3> values(16, Vec3(0));
  for (const std::size_t texel : {5u, 6u, 9u, 10u}) known[texel] = 1, values[texel] = Vec3(texel < 8 ? 1 : 3);
  fill_from_neighbours(page, known, values);
  EXPECT_EQ(values[0], Vec3(1));
  EXPECT_EQ(values[4], Vec3(2));  // beside one of each
  EXPECT_EQ(values[15], Vec3(3));
  EXPECT_EQ(values[5], Vec3(1));
}

TEST(PagePoints, SurfacesThatAreLeftOutTakeNothing) {
  const LightmapPage page = page_of_square();
  std::vector<std::uint8_t> known(16, 0);
  std::vector<Vec3> values(16, Vec3(0));
  known[5] = 1, values[5] = Vec3(1);
  fill_from_neighbours(page, known, values);
  EXPECT_EQ(values[0], Vec3(1));
  for (const std::size_t texel : {6u, 9u, 10u}) EXPECT_EQ(values[texel], Vec3(0)) << texel;
}

}  // namespace
}  // namespace oriel
