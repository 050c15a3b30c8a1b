#include <gtest/gtest.h>

#include "scenes/generators.h"
#include "tests/scenes/probe.h"

namespace oriel::sample {
namespace {

using namespace testing;

TEST(Studio, IsSoundAndClosed) {
  const SampleScene scene = make_studio();
  const auto triangles = flatten(scene);
  for (const Triangle& t : triangles) EXPECT_EQ(fault(t), "") << scene.nodes[t.node].name;
  EXPECT_TRUE(coplanar_overlaps(scene).empty());
  for (const Vec3& direction : directions(1000)) {
    const auto seen = cast(triangles, Vec3(2.1f, 1.1f, 4.6f), direction);
    ASSERT_TRUE(seen);
    EXPECT_TRUE(seen->front) << scene.nodes[triangles[seen->triangle].node].name;
  }
}

TEST(Studio, HoldsWhatCurvedReflectorsNeed) {
  const SampleScene scene = make_studio();
  int metals = 0, lamps = 0;
  for (const SampleMaterial& material : scene.materials) {
    metals += material.metallic > 0;
    lamps += material.emission.r > 0;
  }
  EXPECT_EQ(metals, 3);
  EXPECT_EQ(lamps, 2);
  EXPECT_EQ(scene.cameras.size(), 3u);
}

}  // namespace
}  // namespace oriel::sample
