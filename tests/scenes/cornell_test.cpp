#include <gtest/gtest.h>

#include "scenes/generators.h"
#include "tests/scenes/probe.h"

namespace oriel::sample {
namespace {

using namespace testing;

TEST(Cornell, HasThePublishedMeasurements) {
  const SampleScene scene = make_cornell();
  EXPECT_EQ(triangle_count(scene), 38u);
  Vec3 low(1e9f), high(-1e9f);
  double light_area = 0, short_top = 0;
  for (const Triangle& t : flatten(scene)) {
    for (const Vec3& p : t.p) low = glm::min(low, p), high = glm::max(high, p);
    const std::string& name = scene.nodes[t.node].name;
    if (name == "light") light_area += 0.5 * glm::length(t.cross());
    if (name == "short block" && t.p[0].y > 0.16f && t.p[1].y > 0.16f && t.p[2].y > 0.16f)
      short_top += 0.5 * t.cross().y;
  }
  EXPECT_LT(glm::length(low - Vec3(0)), 1e-6f);
  EXPECT_LT(glm::length(high - Vec3(0.556f, 0.5488f, 0.5592f)), 1e-6f);
  EXPECT_NEAR(light_area, 0.130 * 0.105, 1e-7);
  EXPECT_NEAR(short_top, 0.160 * 0.167, 0.002);  // about 16.5 cm squared
}

TEST(Cornell, InMillimetresItHasThePublishedNumbers) {
  SampleScene scene = make_cornell();
  scale_scene(scene, 1000);
  Vec3 high(0);
  for (const Triangle& t : flatten(scene))
    for (const Vec3& p : t.p) high = glm::max(high, p);
  EXPECT_LT(glm::length(high - Vec3(556, 548.8f, 559.2f)), 1e-3f);
  EXPECT_LT(glm::length(scene.cameras[0].eye - Vec3(278, 273, -800)), 1e-3f);
}

TEST(Cornell, IsSoundAndDiffuse) {
  const SampleScene scene = make_cornell();
  for (const Triangle& t : flatten(scene)) EXPECT_EQ(fault(t), "") << scene.nodes[t.node].name;
  for (const SampleMaterial& material : scene.materials) {
    EXPECT_EQ(material.metallic, 0);
    EXPECT_EQ(material.roughness, 1);
    EXPECT_EQ(material.specular, 0);
  }
  EXPECT_TRUE(coplanar_overlaps(scene).empty());
}

TEST(Cornell, ShowsOnlyFrontsAndIsOpenOnlyToTheCamera) {
  const SampleScene scene = make_cornell();
  const auto triangles = flatten(scene);
  int hits = 0;
  for (const Vec3& eye : {Vec3(0.278f, 0.45f, 0.28f), Vec3(0.06f, 0.3f, 0.4f), Vec3(0.278f, 0.273f, 0.05f)}) {
    for (const Vec3& direction : directions(2000)) {
      const auto seen = cast(triangles, eye, direction);
      if (!seen) {
        const double t = -eye.z / direction.z;  // where it leaves through the opening
        EXPECT_LT(direction.z, 0);
        EXPECT_GT(eye.x + t * direction.x, -1e-4);
        continue;
      }
      ++hits;
      EXPECT_TRUE(seen->front) << scene.nodes[triangles[seen->triangle].node].name;
    }
  }
  EXPECT_GT(hits, 4000);
  const auto centre = cast(triangles, scene.cameras[0].eye, Vec3(0, 0, 1));
  ASSERT_TRUE(centre);
  // The camera's centre line meets the back wall, past the blocks' edges, or the tall block.
  EXPECT_GT(centre->distance, 0.8);
}

}  // namespace
}  // namespace oriel::sample
