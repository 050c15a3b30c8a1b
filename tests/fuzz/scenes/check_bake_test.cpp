// The checker of random scenes can fail, and the scenes are what they are said to be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/fuzz/scenes/check_bake.h"
#include "tests/fuzz/scenes/parts.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_pack.h"

namespace oriel::fuzz {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(FuzzScenes, OneSeedGivesOneScene) {
  EXPECT_EQ(random_scene(7).glb, random_scene(7).glb);
  EXPECT_NE(random_scene(7).glb, random_scene(8).glb);
}

TEST(FuzzScenes, APartLeftOutLeavesTheOthersAsTheyAre) {
  const RandomScene whole = random_scene(12);
  ASSERT_GT(whole.parts.size(), 1u);
  std::vector<std::string> rest(whole.parts.begin() + 1, whole.parts.end());
  EXPECT_EQ(random_scene(12, {whole.parts[0]}).parts, rest);
}

TEST(FuzzScenes, EveryPartIsInSomeScene) {
  std::set<std::string> seen;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    for (const std::string& part : random_scene(seed, {"many triangles"}).parts) seen.insert(part);
  EXPECT_EQ(seen.size(), all_parts().size() - 1);
}

TEST(FuzzScenes, ThePackCheckerFindsAPlantedFault) {
  Pack pack = oriel::testing::tiny_pack();
  ASSERT_FALSE(pack.lightmaps.empty());
  ASSERT_THAT(check_pack_numbers(pack, 1e6), IsEmpty());
  Vec3& texel = pack.lightmaps[0].irradiance[1];
  const Vec3 good = texel;
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0f, 2e6f}) {
    texel.y = bad;
    EXPECT_THAT(check_pack_numbers(pack, 1e6), Contains(HasSubstr("irradiance of texel 1"))) << bad;
    texel = good;
  }
  std::vector<Vec3>& pixels = pack.surround_maps.emplace_back().radiance;
  pixels.resize(64 * 64);
  const float sun = 1e6f * 64 * 64 / 4;
  pixels[3] = Vec3(0.99f * sun);
  EXPECT_THAT(check_pack_numbers(pack, 1e6), IsEmpty());
  pixels[3] = Vec3(1.01f * sun);
  EXPECT_THAT(check_pack_numbers(pack, 1e6), Contains(HasSubstr("surround map's pixel 3")));
}

TEST(FuzzScenes, TheRunCheckerFindsAPlantedFault) {
  const Limits limits{.time_s = 10, .late_s = 1, .memory_MiB = 100};
  const Ran good{0, 11, 1, 90, "light: 5 texels, information, 0 %\n"};
  EXPECT_THAT(check_run(good, limits), IsEmpty());
  const auto with = [&](auto change) {
    Ran ran = good;
    change(ran);
    return check_run(ran, limits);
  };
  EXPECT_THAT(with([](Ran& r) { r.code = 4; }), Contains(HasSubstr("exit code 4")));
  EXPECT_THAT(with([](Ran& r) { r.code = -11; }), Contains(HasSubstr("exit code -11")));
  EXPECT_THAT(with([](Ran& r) { r.seconds = 12.1; }), Contains(HasSubstr("took 12.1 s")));
  EXPECT_THAT(check_run({0, 100, 1, 90, ""}, {.by_cpu = true}), IsEmpty());
  EXPECT_THAT(check_run({0, 100, 1e6, 90, ""}, {.by_cpu = true}), Contains(HasSubstr("took")));
  EXPECT_THAT(with([](Ran& r) { r.memory_MiB = 101; }), Contains(HasSubstr("MiB")));
  EXPECT_THAT(with([](Ran& r) { r.log = "measured -nan % off"; }), Contains(HasSubstr("nan")));
}

TEST(FuzzScenes, AProgramThatRunsTooLongIsKilled) {
  const oriel::testing::TemporaryFolder folder;
  const Ran ran = run_limited({"/bin/sleep", "60"}, folder.path() / "log", 0.1);
  EXPECT_EQ(ran.code, -9);
}

// L = L_e / (1 - ρ) in a closed furnace, n² times that in glass there, and all of a lamp's power on one texel.
TEST(FuzzScenes, TheBoundHoldsAFurnace) {
  EXPECT_GE(irradiance_bound({.radiance = 10, .lamp_albedo = 0.75, .albedo = 0.75}, 0.1), kPiD * 10 / 0.25);
  EXPECT_GE(irradiance_bound({.radiance = 10, .lamp_albedo = 0.75, .index = 2}, 0.1), kPiD * 4 * 10 / 0.25);
  EXPECT_GE(irradiance_bound({.power_lm = 100, .albedo = 0.5}, 0.1), 100 / 0.01 / 0.5);
  EXPECT_LT(irradiance_bound({.radiance = 10, .albedo = 1}, 0.1), 1e4);
}

}  // namespace
}  // namespace oriel::fuzz
