// Large triangles in pieces: the same surface, without gaps.
#include "bake/visibility/divide.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

// A ground of 1000 m with a step in its middle, two surfaces that share an edge, and a small box far from it.
Scene ground() {
  SceneParts parts;
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  parts.quad("west", m, {-500, 0, -500}, {0, 0, 1000}, {500, 0, 0});
  parts.quad("east", m, {0, 0, -500}, {0, 0, 1000}, {500, 100, 0});
  parts.box("box", m, {200, 50, 200}, {201, 51, 201});
  return parts.finish();
}

double area_of(const Scene& scene, std::uint32_t surface) {
  double area = 0;
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    if (scene.triangle_surface[t] == surface) area += triangle_area(scene, t);
  return area;
}

// Edges that only one triangle has, by place: the outline. A gap or a corner in the middle of an edge adds some.
double outline_m(const Scene& scene) {
  using Place = std::tuple<float, float, float>;
  std::map<std::pair<Place, Place>, int> count;
  const auto place = [&](std::uint32_t v) {
    return Place(scene.positions[v].x, scene.positions[v].y, scene.positions[v].z);
  };
  for (const UVec3& t : scene.triangles)
    for (int k = 0; k < 3; ++k) ++count[std::minmax(place(t[k]), place(t[(k + 1) % 3]))];
  double sum = 0;
  for (const auto& [edge, n] : count) {
    const auto& [a, b] = edge;
    const Vec3 d(std::get<0>(a) - std::get<0>(b), std::get<1>(a) - std::get<1>(b), std::get<2>(a) - std::get<2>(b));
    if (n == 1) sum += glm::length(d);
  }
  return sum;
}

TEST(Divide, SmallerNearAPlaceAndNoGaps) {
  Scene scene = ground();
  const double outline = outline_m(scene), west = area_of(scene, 0), east = area_of(scene, 1);
  const auto far_and_near = [](const std::array<Vec3, 3>& c) {
    const float longest = std::max({glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
    const float away = std::min({glm::length(c[0]), glm::length(c[1]), glm::length(c[2])});
    return longest > 2 * std::max(away, 8.0f);
  };
  ASSERT_TRUE(divide_triangles(scene, 8, far_and_near));
  EXPECT_NEAR(area_of(scene, 0), west, 1e-4 * west);
  EXPECT_NEAR(area_of(scene, 1), east, 1e-4 * east);
  EXPECT_NEAR(outline_m(scene), outline, 1e-3 * outline);
  EXPECT_GT(scene.triangles.size(), 60u);
  EXPECT_LT(scene.triangles.size(), 1000u);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const UVec3& v = scene.triangles[t];
    const std::array<Vec3, 3> corners{scene.positions[v.x], scene.positions[v.y], scene.positions[v.z]};
    EXPECT_FALSE(far_and_near(corners)) << t;
    const Surface& surface = scene.surfaces[scene.triangle_surface[t]];
    EXPECT_GE(t, surface.first_triangle);
    EXPECT_LT(t, surface.first_triangle + surface.triangle_count);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(v[k], surface.first_vertex);
      EXPECT_LT(v[k], surface.first_vertex + surface.vertex_count);
    }
    EXPECT_NEAR(glm::dot(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), geometric_normal(scene, t)),
                2 * triangle_area(scene, t), 1e-3 * triangle_area(scene, t));
  }
  EXPECT_EQ(scene.surfaces[2].triangle_count, 12u);
}

TEST(Divide, CoordinatesGoAlong) {
  Scene scene = ground();
  ASSERT_TRUE(divide_triangles(scene, 100, [](const auto&) { return true; }));
  for (std::uint32_t v = 0; v < scene.surfaces[0].vertex_count; ++v) {  // uv0 = (z, x) / (1000, 500) from the corner
    const Vec3& p = scene.positions[v];
    EXPECT_NEAR(scene.uv0[v].x, (p.z + 500) / 1000, 1e-5);
    EXPECT_NEAR(scene.uv0[v].y, (p.x + 500) / 500, 1e-5);
    EXPECT_NEAR(glm::length(scene.normals[v]), 1, 1e-5);
  }
}

TEST(Divide, NothingIsCutWhereNothingIsWanted) {
  Scene scene = ground();
  const std::size_t before = scene.triangles.size();
  EXPECT_FALSE(divide_triangles(scene, 8, [](const auto&) { return false; }));
  EXPECT_FALSE(divide_triangles(scene, 1e4f, [](const auto&) { return true; }));
  EXPECT_EQ(scene.triangles.size(), before);
}

// Where float has a metre, the middle of a short edge is one of its ends.
TEST(Divide, EndsFarFromTheOrigin) {
  Scene scene = ground();
  for (Vec3& p : scene.positions) p.x += 1e7f;
  const UVec3 first = scene.triangles[0];
  scene.positions[first.z] = scene.positions[first.x];  // two corners in one place
  EXPECT_TRUE(divide_triangles(scene, 0, [](const auto&) { return true; }));
  EXPECT_LT(scene.triangles.size(), 100000u);
}

}  // namespace
}  // namespace oriel
