// What fails a pack's own checks is left out, and the rest is kept.
#include <gtest/gtest.h>

#include <limits>

#include "bake/run/assemble.h"
#include "formats/pack/validate.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

void expect_sound(const Pack& pack) {
  for (const Issue& issue : validate(pack)) EXPECT_NE(issue.severity, Severity::kError) << issue.message;
}

TEST(SoundPack, NothingIsLeftOutOfAGoodOne) {
  Pack pack = testing::tiny_mapped_pack();
  std::vector<std::string> left_out;
  ASSERT_TRUE(leave_out_unsound(pack, left_out));
  EXPECT_TRUE(left_out.empty());
  EXPECT_FALSE(pack.surround_maps.empty());
}

TEST(SoundPack, ASurroundMapThatFailsGoesAlone) {
  Pack pack = testing::tiny_mapped_pack();
  pack.surround_maps[0].inverse_distance[1] = 8.5e37f;
  std::vector<std::string> left_out;
  ASSERT_TRUE(leave_out_unsound(pack, left_out));
  ASSERT_EQ(left_out.size(), 1u);
  EXPECT_NE(left_out[0].find("surround maps: left out"), std::string::npos) << left_out[0];
  EXPECT_NE(left_out[0].find("8.5e+37"), std::string::npos) << left_out[0];
  EXPECT_TRUE(pack.surround_maps.empty() && pack.curved_reflectors.empty());
  EXPECT_FALSE(pack.radiance_maps.empty());
  expect_sound(pack);
}

TEST(SoundPack, EachPartGoesWithWhatDependsOnIt) {
  const auto without = [](auto spoil) {
    Pack pack = testing::tiny_mapped_pack();
    spoil(pack);
    std::vector<std::string> left_out;
    EXPECT_TRUE(leave_out_unsound(pack, left_out));
    EXPECT_FALSE(left_out.empty());
    expect_sound(pack);
    EXPECT_FALSE(pack.lightmaps.empty());
    return left_out.empty() ? "" : left_out[0].substr(0, left_out[0].find(':'));
  };
  EXPECT_EQ(without([](Pack& p) { p.radiance_maps[0].radiance[0].x = kNaN; }), "radiance maps");
  EXPECT_EQ(without([](Pack& p) { p.lightmaps[0].direction[0].x = kNaN; }), "directions of the lightmap");
  EXPECT_EQ(without([](Pack& p) { p.cameras[0].eye.x = kNaN; }), "cameras");
  EXPECT_EQ(without([](Pack& p) { p.paths[0].keys[0].time_s = kNaN; }), "camera paths");
  EXPECT_EQ(without([](Pack& p) { p.light_field.probes[0].position.x = kNaN; }), "movers");
  EXPECT_EQ(without([](Pack& p) { p.textures[0].texels.clear(); }), "textures");
}

TEST(SoundPack, WithoutALightmapThereIsNone) {
  Pack pack = testing::tiny_mapped_pack();
  pack.lightmaps[0].irradiance[3].y = kNaN;
  std::vector<std::string> left_out;
  const Status status = leave_out_unsound(pack, left_out);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kRuntime);
  EXPECT_NE(status.error().text().find("LMAP"), std::string::npos) << status.error().text();
}

}  // namespace
}  // namespace oriel
