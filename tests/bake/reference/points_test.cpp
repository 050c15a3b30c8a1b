// Tables of points and grids over floors.
#include <gtest/gtest.h>

#include "bake/reference/points.h"
#include "bake/reference/table.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

TEST(Points, TableIsReadWithItsLines) {
  const auto points =
      parse_points("\xef\xbb\xbfx, y, z, nx, ny, nz\r\n\r\n# a comment\n 1,2,3, 0,-2,0 \r\n4,5e-1,-6,1,0,0", "t");
  ASSERT_TRUE(points) << points.error().text();
  ASSERT_EQ(points->size(), 2u);
  EXPECT_EQ((*points)[0].position, DVec3(1, 2, 3));
  EXPECT_EQ((*points)[0].normal, DVec3(0, -2, 0));
  EXPECT_EQ((*points)[0].line, 4u);
  EXPECT_EQ((*points)[1].position, DVec3(4, 0.5, -6));
  EXPECT_EQ((*points)[1].line, 5u);
}

TEST(Points, ErrorsNameTheLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"1,2,3,0,1,0\n1,2,3\n", "t.csv:2: found 3 values"},
      {"1,2,3,0,1,0,7\n", "t.csv:1: found 7 values"},
      {"x,y,z,nx,ny,nz\n1,2,3,0,one,0\n", "t.csv:2: found 'one'"},
      {"x,y,z,nx,ny,nz\nx,y,z,nx,ny,nz\n", "t.csv:2: found 'x'"},
      {"1,2,3,0,1,\n", "t.csv:1: found ''"},
      {"1,2,inf,0,1,0\n", "t.csv:1: found 'inf'"},
      {"1,2,1e999,0,1,0\n", "t.csv:1: found '1e999'"},
      {"1,2,3,0,1,0\n\n1,2,3,0,-0,0\n", "t.csv:3: found the normal 0,0,0"},
      {"1;2;3;0;1;0\n", "t.csv: found no point"},  // taken for the header
      {"x,y,z,nx,ny,nz\n", "t.csv: found no point"},
      {"", "t.csv: found no point"},
  };
  for (const auto& [table, message] : cases) {
    const auto points = parse_points(table, "t.csv");
    ASSERT_FALSE(points) << table;
    EXPECT_EQ(points.error().code, ErrorCode::kInvalid);
    EXPECT_EQ(points.error().text().rfind(message, 0), 0u) << points.error().text();
  }
}

// An L-shaped floor with a step and a ceiling over it.
Scene l_shape() {
  SceneParts parts;
  const auto grey = parts.diffuse(Vec3(0.5f));
  const std::vector<Vec3> up(4, Vec3(0, 1, 0));
  parts.mesh("floor", grey,
             {{0, 0, 0}, {0, 0, 4}, {4, 0, 4}, {4, 0, 0}, {0, 1, 4}, {0, 1, 8}, {2, 1, 8}, {2, 1, 4}, {0, -1, 0}},
             std::vector<Vec3>(9, Vec3(0, 1, 0)), {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}, {0, 2, 8}});
  parts.quad("ceiling", grey, {0, 3, 0}, {4, 0, 0}, {0, 0, 8});
  Scene scene = parts.finish();
  scene.origin = {100, 0, 0};
  return scene;
}

TEST(Grid, CoversTheUpwardFacesOnly) {
  const auto points = grid_points(l_shape(), {"floor", 1, 0.5});
  ASSERT_TRUE(points) << points.error().text();
  ASSERT_EQ(points->size(), 16u + 8u);
  for (const MeasurePoint& p : *points) {
    const DVec3 local = p.position - DVec3(100, 0, 0);
    EXPECT_EQ(p.normal, DVec3(0, 1, 0));
    EXPECT_NEAR(std::fmod(local.x, 1), 0.5, 1e-12);
    EXPECT_NEAR(local.y, local.z < 4 ? 0.5 : 1.5, 1e-12);
    EXPECT_TRUE(local.z < 4 || local.x < 2);
  }
}

TEST(Grid, SpacingThatDoesNotDivideIsCentred) {
  const auto floor = grid_points(l_shape(), {"floor", 1.9, 0});
  ASSERT_TRUE(floor);
  ASSERT_EQ(floor->size(), 2u * 2 + 2) << "two by four cells, less two in the corner that is missing";
  EXPECT_NEAR((*floor)[0].position.x, 100 + 2 - 0.95, 1e-12);
  EXPECT_NEAR((*floor)[0].position.z, 4 - 1.5 * 1.9, 1e-12);
  const auto wide = grid_points(l_shape(), {"floor", 100, 0});
  ASSERT_TRUE(wide);
  EXPECT_EQ(wide->size(), 1u) << "at least the middle";
}

TEST(Grid, RefusesWhatCannotBe) {
  for (const GridSpec& grid : {GridSpec{"flor", 1, 0}, GridSpec{"ceiling", 1, 0}, GridSpec{"floor", 1e-4, 0}}) {
    const auto points = grid_points(l_shape(), grid);
    ASSERT_FALSE(points) << grid.node;
    EXPECT_EQ(points.error().code, ErrorCode::kUsage);
    EXPECT_NE(points.error().text().find("--grid " + grid.node), std::string::npos) << points.error().text();
  }
}

TEST(Table, HasALineAPoint) {
  const std::vector<MeasurePoint> points{{{0.1, 2, -3}, {0, 1, 0}, 0}};
  std::vector<PointIlluminance> results(1);
  results[0].direct = DVec3(1, 2, 3);
  results[0].indirect = DVec3(10);
  results[0].standard_error = DVec3(0.1);
  results[0].luminance_error = 0.05;
  EXPECT_EQ(lux_csv(points, results),
            "x,y,z,nx,ny,nz,E,E_r,E_g,E_b,direct,direct_r,direct_g,direct_b,indirect,indirect_r,indirect_g,indirect_b,"
            "error,error_r,error_g,error_b\n"
            "0.1,2,-3,0,1,0,11.8596,11,12,13,1.8596,1,2,3,10,10,10,10,0.05,0.1,0.1,0.1\n");
}

}  // namespace
}  // namespace oriel
