#include <gtest/gtest.h>

#include "scenes/generators.h"
#include "tests/scenes/probe.h"

namespace oriel::sample {
namespace {

using namespace testing;

TEST(House, CountsAreWithinTenPercent) {
  for (const std::uint64_t wanted : {10'000u, 12'345u, 20'000u, 50'000u, 100'000u, 1'000'000u, 2'000'000u}) {
    for (const int reflectors : {0, 5, kMaxHouseReflectors}) {
      const auto house = make_house({wanted, reflectors});
      ASSERT_TRUE(house) << house.error().text();
      EXPECT_NEAR(static_cast<double>(triangle_count(*house)) / static_cast<double>(wanted), 1, 0.1) << wanted;
    }
  }
}

TEST(House, HasTheReflectorsAskedFor) {
  for (const int reflectors : {0, 1, 5, 12, 13, kMaxHouseReflectors}) {
    const auto house = make_house({20'000, reflectors});
    ASSERT_TRUE(house) << house.error().text();
    int found = 0;
    for (const Node& node : house->nodes) {
      const SampleMaterial& material = house->materials[house->meshes[node.mesh].material];
      if (material.specular > 0 && material.roughness < 0.5f) ++found;
    }
    EXPECT_EQ(found, reflectors);
  }
}

TEST(House, RefusesWhatItCannotMake) {
  for (const HouseOptions& options : {HouseOptions{0, 5}, HouseOptions{1000, 5}, HouseOptions{1'000'000'000, 5},
                                      HouseOptions{20'000, -1}, HouseOptions{20'000, kMaxHouseReflectors + 1}}) {
    const auto house = make_house(options);
    ASSERT_FALSE(house);
    EXPECT_EQ(house.error().code, ErrorCode::kUsage);
    EXPECT_NE(house.error().message.find("expected"), std::string::npos);
  }
}

TEST(House, IsSoundAtEverySize) {
  for (const std::uint64_t wanted : {10'000u, 60'000u, 1'000'000u}) {
    const auto house = make_house({wanted, 5});
    ASSERT_TRUE(house);
    // Instances repeat their mesh: one of each is enough.
    SampleScene once = *house;
    once.nodes.clear();
    for (std::uint32_t i = 0; i < once.meshes.size(); ++i) place(once, i, once.meshes[i].name, Vec3(0));
    for (const Triangle& t : flatten(once)) ASSERT_EQ(fault(t), "") << once.nodes[t.node].name << " of " << wanted;
  }
}

TEST(House, HasNoCoplanarOverlapsAndIsClosed) {
  const auto house = make_house({20'000, kMaxHouseReflectors});
  ASSERT_TRUE(house);
  EXPECT_EQ(coplanar_overlaps(*house), std::vector<std::string>{});
  const auto triangles = flatten(*house);
  for (std::size_t i = 0; i < 600; i += 60) {
    for (const Vec3& direction : directions(100)) {
      const auto seen = cast(triangles, house->paths[0].eyes[i], direction);
      ASSERT_TRUE(seen) << "a hole seen from key " << i;
      EXPECT_TRUE(seen->front) << "the back of " << house->nodes[triangles[seen->triangle].node].name;
    }
  }
}

TEST(House, TheWalkIsClearAndReachesBothFloors) {
  const auto house = make_house({30'000, 5});
  ASSERT_TRUE(house);
  const auto triangles = flatten(*house);
  ASSERT_EQ(house->paths.size(), 1u);
  const Path& path = house->paths[0];
  ASSERT_EQ(path.eyes.size(), 600u);
  EXPECT_FLOAT_EQ(path.eyes.front().y, 1.6f);
  EXPECT_FLOAT_EQ(path.eyes.back().y, 4.6f);
  for (std::size_t i = 0; i < path.eyes.size(); i += 5) EXPECT_GT(clearance(triangles, path.eyes[i]), 0.25) << i;
}

}  // namespace
}  // namespace oriel::sample
