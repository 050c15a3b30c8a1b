// Quadtrees of a map's points, and equation (3) of Bastos et al. 1999 for their nodes.
#include "study/bastos1999/point_tree.h"

#include <gtest/gtest.h>

#include <random>

namespace oriel::study {
namespace {

// Of the square [-1, 1]² seen from 1 m behind it; height(on_plane): of what a pixel saw over the plane, negative: the
// sky, NaN: nothing.
template <class Height>
RadianceMap map_of(std::uint32_t size, const Height& height) {
  RadianceMap map;
  map.lower = Vec2(-1), map.upper = Vec2(1);
  map.width = map.height = size;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      const float z = height((Vec2(x, y) + 0.5f) / static_cast<float>(size) * 2.0f - 1.0f);
      map.radiance.emplace_back(1);
      map.valid.push_back(std::isnan(z) ? 0 : z < 0 ? 2 : 1);
      map.disparity.push_back(z >= 0 ? 1 / (z + 1) : 0.0f);
    }
  return map;
}
RadianceMap wall(std::uint32_t size, float z) {
  return map_of(size, [=](const Vec2&) { return z; });
}

// An eye before the plane that looks straight at it, turned about up, over `pixels`² of 90°.
SplatView look(const Vec3& eye, float pixels, float turned_rad = 0, float roll_rad = 0) {
  SplatView view;
  const auto turn = [](int a, int b, float angle) {
    Mat4 m(1);
    m[a][a] = m[b][b] = std::cos(angle);
    m[a][b] = std::sin(angle), m[b][a] = -std::sin(angle);
    return m;
  };
  Mat4 move(1);
  move[3] = Vec4(-eye, 1);
  Mat4 mirror(1);
  mirror[2][2] = -1;
  view.view_from_mirrored = turn(0, 1, roll_rad) * turn(0, 2, turned_rad) * move * mirror;
  Mat4 project(1);
  project[2] = Vec4(0, 0, -1, -1), project[3] = Vec4(0, 0, -1, 0);
  view.clip_from_mirrored = project * view.view_from_mirrored;
  view.pixels_per_tangent = 0.5f * pixels;
  return view;
}

// Where a pixel's point lies on the image, pixels from its middle; w: whether it is before the eye.
Vec3 seen_at(const RadianceMap& map, const Vec2& pixel, float disparity, const SplatView& view) {
  const Vec2 on_plane = map.lower + pixel / Vec2(map.width, map.height) * (map.upper - map.lower);
  const Vec4 p = view.view_from_mirrored * Vec4(disparity * map.eye + Vec3(on_plane, 0) - map.eye, disparity);
  return {Vec2(p) / -p.z * view.pixels_per_tangent, p.z < 0 ? 1 : 0};
}

TEST(PointSize, IsEquationThree) {
  const RadianceMap map = wall(64, 3);
  const std::vector<PointNode> nodes = divide_points(map);
  ASSERT_EQ(nodes.size(), 1u) << "a wall of one depth";
  EXPECT_NEAR(glm::length(nodes[0].mean - Vec4(0, 0, 3, 1)), 0, 1e-5);
  const auto size = [&](const SplatView& view) { return point_size(map_frame(map), nodes[0], view); };
  // 64 pixels of 90° in the map, 4 m from its eye. From opposite the map's eye they are as many of the image's.
  EXPECT_NEAR(size(look({0, 0, 1}, 64)).x, 1, 1e-6);
  EXPECT_NEAR(size(look({0, 0, 1}, 128)).y, 2, 1e-6) << "Window";
  EXPECT_NEAR(size(look({0.7f, -0.2f, 5}, 64)).x, 0.5f, 1e-6) << "DistanceScale: 4 m over 8 m";
  const Vec2 turned = size(look({0, 0, 1}, 64, 0.5f));
  EXPECT_NEAR(turned.x, std::cos(0.5f) / std::cos(0.5f), 1e-5)
      << "Angular, and the mean is cos 0.5 nearer along the view";
  EXPECT_NEAR(turned.y, 1 / std::cos(0.5f), 1e-5);
  // Straight before a wall it is what its pixels are apart, to the last bit of it.
  const SplatView view = look({0.3f, 0.4f, 2}, 100);
  const Vec3 a = seen_at(map, {10.5f, 20.5f}, 0.25f, view), b = seen_at(map, {11.5f, 21.5f}, 0.25f, view);
  EXPECT_NEAR(size(view).x, std::abs(b.x - a.x), 1e-5);
  EXPECT_NEAR(size(view).y, std::abs(b.y - a.y), 1e-5);
}

TEST(PointSize, IsAnisotropicAsTheMapsPixels) {
  RadianceMap map = wall(64, 3);
  map.upper.y = 0;  // half as high a square of as many pixels
  const std::vector<PointNode> nodes = divide_points(map);
  const SplatView view = look({0, 0, 1}, 64);
  const Vec2 size = point_size(map_frame(map), nodes[0], view);
  EXPECT_NEAR(size.x, 1, 1e-6);
  EXPECT_NEAR(size.y, 0.5f, 1e-6);
  EXPECT_EQ(point_step(size), UVec2(1, 2));
  EXPECT_EQ(point_step({0.34f, 1.7f}), UVec2(2, 1));
  EXPECT_NEAR(glm::length(splat_box({3, 1}, view) - Vec2(3, 1)), 0, 1e-6);
  const Vec2 rolled = splat_box({3, 1}, look({0, 0, 1}, 64, 0, 0.5f * static_cast<float>(kPiD)));
  EXPECT_NEAR(glm::length(rolled - Vec2(1, 3)), 0, 1e-5) << "on its side";
}

TEST(PointSize, OfTheSkyHasNoDistance) {
  const std::vector<PointNode> nodes = divide_points(wall(64, -1));
  ASSERT_EQ(nodes.size(), 1u);
  EXPECT_EQ(nodes[0].mean.w, 0);
  for (const float eye : {0.1f, 1.0f, 50.0f})
    EXPECT_NEAR(point_size(map_frame(wall(64, -1)), nodes[0], look({0, 0, eye}, 64)).x, 1, 1e-5);
}

TEST(PointTree, NodesHaveAllPointsOnceAndFewDepths) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> height(0, 20);
  const std::vector<RadianceMap> maps{
      wall(64, 2), map_of(50, [](const Vec2& p) { return p.x < 0.3f ? 1.0f : 7.0f; }),
      map_of(33, [](const Vec2& p) { return p.x + p.y < 0 ? -1.0f
                                            : p.x < 0.5f  ? std::nanf("")
                                                          : 3 + 2 * p.x; }),
      map_of(17, [&](const Vec2&) { return height(random); }), map_of(8, [](const Vec2&) { return std::nanf(""); })};
  for (const RadianceMap& map : maps) {
    std::vector<int> times(map.valid.size());
    for (const PointNode& node : divide_points(map)) {
      EXPECT_TRUE(node.most <= 1.1f * node.least + 1e-6f || std::max(node.width, node.height) <= 4);
      for (std::uint32_t y = node.y; y < node.y + node.height; ++y)
        for (std::uint32_t x = node.x; x < node.x + node.width; ++x) ++times[y * map.width + x];
    }
    for (std::size_t i = 0; i < times.size(); ++i) EXPECT_LE(map.valid[i] != 0 ? 1 - times[i] : 0, 0);
    EXPECT_LE(*std::max_element(times.begin(), times.end()), 1);
  }
  EXPECT_LT(divide_points(maps[1]).size(), 100u) << "fine along the edge only";
}

// A node is left out where no point of it can be in the image, whatever the view; and half of a wall is where the image
// ends in its middle.
TEST(PointTree, CullingIsThatOfTheFrustum) {
  const RadianceMap map = map_of(64, [](const Vec2& p) { return p.x * p.y > 0 ? 1.0f : 6.0f; });
  const MapFrame frame = map_frame(map);
  const std::vector<PointNode> nodes = divide_points(map);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(-1, 1);
  int culled = 0, kept = 0;
  for (int i = 0; i < 300; ++i) {
    const SplatView view =
        look({2 * unit(random), 2 * unit(random), 2.2f + 2 * unit(random)}, 64, 3 * unit(random), unit(random));
    for (const PointNode& node : nodes) {
      int inside = 0;
      for (std::uint32_t y = node.y; y < node.y + node.height; ++y)
        for (std::uint32_t x = node.x; x < node.x + node.width; ++x) {
          const Vec3 at = seen_at(map, Vec2(x, y) + 0.5f, map.disparity[y * map.width + x], view);
          inside += at.z > 0 && std::abs(at.x) <= 32 && std::abs(at.y) <= 32;
        }
      const bool is_out = is_culled(frame, node, view);
      EXPECT_FALSE(is_out && inside > 0);
      culled += is_out && inside == 0, kept += !is_out && inside == 0;
    }
  }
  EXPECT_GT(culled, 5 * kept) << "few are kept for nothing";

  const RadianceMap even = map_of(64, [](const Vec2& p) { return p.x < 0 ? 3.0f : 2.5f; });
  const SplatView left = look({-4.0f, 0, 1}, 64);  // its right edge goes through x = 0 at the farther half
  int shown = 0;
  for (const PointNode& node : divide_points(even))
    shown += is_culled(map_frame(even), node, left) ? 0 : static_cast<int>(node.width * node.height);
  EXPECT_EQ(shown, 64 * 32);
}

}  // namespace
}  // namespace oriel::study
