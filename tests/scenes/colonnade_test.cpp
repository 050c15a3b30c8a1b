#include <gtest/gtest.h>

#include "scenes/generators.h"
#include "tests/scenes/probe.h"

namespace oriel::sample {
namespace {

using namespace testing;

TEST(Colonnade, IsSoundAndClosed) {
  const SampleScene scene = make_colonnade();
  const auto triangles = flatten(scene);
  for (const Triangle& t : triangles) EXPECT_EQ(fault(t), "") << scene.nodes[t.node].name;
  for (const Vec3& direction : directions(300)) {
    const auto seen = cast(triangles, Vec3(2, 1.7f, 10), direction);
    ASSERT_TRUE(seen);
    EXPECT_TRUE(seen->front) << scene.nodes[triangles[seen->triangle].node].name;
  }
}

TEST(Colonnade, HasTwoHundredColumnsAndEightLamps) {
  const SampleScene scene = make_colonnade();
  int columns = 0, lamps = 0;
  for (const auto& node : scene.nodes)
    columns += node.name.starts_with("column"), lamps += node.name.starts_with("lamp");
  EXPECT_EQ(columns, 200);
  EXPECT_EQ(lamps, 8);
}

}  // namespace
}  // namespace oriel::sample
