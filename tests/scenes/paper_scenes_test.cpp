// The scenes of Udeshi and Hansen's measurements.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/generators.h"
#include "tests/scenes/probe.h"

namespace oriel::sample {
namespace {

using namespace testing;

// A triangle and the next.
bool is_quadrilateral(const SampleMesh& mesh, std::size_t triangle) {
  const std::uint32_t* corners = mesh.indices.data() + 3 * triangle;
  const auto at = [&](int k) { return DVec3(mesh.positions[corners[k]]); };
  const auto common = std::count_if(corners + 3, corners + 6,
                                    [&](std::uint32_t c) { return std::find(corners, corners + 3, c) != corners + 3; });
  const DVec3 first = glm::cross(at(1) - at(0), at(2) - at(0)), second = glm::cross(at(4) - at(3), at(5) - at(3));
  return common == 2 && glm::dot(first, second) > 0.99999 * glm::length(first) * glm::length(second);
}

// Triangles drawn, as polygons: two in a row with a common side and a common plane are a quadrilateral.
std::uint64_t polygon_count(const SampleScene& scene) {
  std::uint64_t count = 0;
  for (const Node& node : scene.nodes) {
    const SampleMesh& mesh = scene.meshes[node.mesh];
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t, ++count)
      if (t + 1 < mesh.triangle_count() && is_quadrilateral(mesh, t)) ++t;
  }
  return count;
}

std::size_t lamps_of(const SampleScene& scene) {
  std::size_t lamps = 0;
  for (const Node& node : scene.nodes)
    lamps += scene.materials[scene.meshes[node.mesh].material].emission != Vec3(0) ? 1 : 0;
  return lamps;
}

TEST(PaperScenes, HaveAsManyPolygonsAndLamps) {
  const SampleScene office = make_office(), classroom = make_classroom(), box = make_glass_sphere();
  EXPECT_EQ(polygon_count(office), 4083u);
  EXPECT_EQ(polygon_count(classroom), 3135u);
  EXPECT_EQ(triangle_count(classroom), 2 * 3135u);  // all are rectangles
  EXPECT_EQ(polygon_count(box), 217u);
  EXPECT_EQ(lamps_of(office), 2u);
  EXPECT_EQ(lamps_of(classroom), 4u);
  EXPECT_EQ(lamps_of(box), 1u);
}

// Closed where eyes look: rays from the first camera's place meet fronts, and every triangle is sound.
TEST(PaperScenes, AreSound) {
  for (const SampleScene& scene : {make_office(), make_classroom(), make_glass_sphere()}) {
    const auto triangles = flatten(scene);
    for (const Triangle& t : triangles) EXPECT_EQ(fault(t), "") << scene.name << ": " << scene.nodes[t.node].name;
    EXPECT_THAT(coplanar_overlaps(scene), ::testing::IsEmpty()) << scene.name;
    const bool open = scene.cameras.front().eye.z < 0;  // the box, from before it
    for (const Vec3& direction : directions(500)) {
      const auto seen = cast(triangles, open ? Vec3(0.2f, 0.4f, 0.1f) : scene.cameras.front().eye, direction);
      if (open && !seen) continue;
      ASSERT_TRUE(seen) << scene.name;
      EXPECT_TRUE(seen->front) << scene.name << ": " << scene.nodes[triangles[seen->triangle].node].name;
    }
  }
}

TEST(PolygonCount, TellsQuadrilateralsFromTriangles) {
  SampleScene scene;
  SampleMesh mesh{"mesh", 0};
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 2, 0.5f}};
  mesh.indices = {0, 1, 2, 0, 2, 3, 3, 2, 4};  // a square, and what leans on it
  place(scene, std::move(mesh));
  EXPECT_EQ(polygon_count(scene), 2u);
}

}  // namespace
}  // namespace oriel::sample
