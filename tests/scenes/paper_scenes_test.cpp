// The scenes of Udeshi and Hansen's measurements.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/generators.h"
#include "tests/scenes/probe.h"

namespace oriel::sample {
namespace {

using namespace testing;

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
