// Sharp light in packs: what goes in comes out, and damage is named.
#include <random>

#include "tests/formats/pack/hostile.h"

namespace oriel {
namespace {

using namespace testing;

TEST(Pack, SharpLightComesBack) {
  const Pack in = tiny_mapped_pack(), out = decode_pack(tiny_file()).value();
  ASSERT_EQ(out.sharp_light.lamps.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const SharpLamp &a = out.sharp_light.lamps[i], &b = in.sharp_light.lamps[i];
    EXPECT_EQ(std::tie(a.sun, a.position, a.direction, a.intensity, a.cos_outer, a.inverse_falloff,
                       a.angular_radius_rad, a.light_group),
              std::tie(b.sun, b.position, b.direction, b.intensity, b.cos_outer, b.inverse_falloff,
                       b.angular_radius_rad, b.light_group));
  }
  EXPECT_EQ(out.sharp_light.words, in.sharp_light.words);
  EXPECT_EQ(out.sharp_light.triangles, in.sharp_light.triangles);
  const LightmapPage &a = out.lightmaps[1], &b = in.lightmaps[1];
  EXPECT_EQ(a.sharp_at, b.sharp_at);
  for (std::size_t i = 0; i < a.irradiance.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(a.irradiance[i][c], b.irradiance[i][c], b.irradiance[i][c] * 0x1p-11f);
      EXPECT_NEAR(a.sharp[i][c], b.sharp[i][c], b.sharp[i][c] * 0x1p-11f);
      // Little light beside much is as accurate as alone.
      EXPECT_NEAR(a.irradiance[i][c] - a.sharp[i][c], b.irradiance[i][c] - b.sharp[i][c], 90 * 0x1p-11f);
    }
  EXPECT_NEAR(without_sharp(a)[7].r, 0.03f, 3e-4f);
  EXPECT_TRUE(out.lightmaps[0].sharp.empty() && out.lightmaps[0].sharp_at.empty());
}

// Reading and writing changes no byte, however much of a texel's light is sharp.
TEST(Pack, SharpLightIsWrittenAsItWasRead) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> octave(-16, 17);
  Pack pack = tiny_mapped_pack();
  LightmapPage& page = pack.lightmaps[1];
  page.width = page.height = 64;
  page.sharp_at.assign(4096, 1);
  page.standard_error.assign(4096, Vec3(0));
  page.state.assign(4096, TexelState::kValid);
  page.sharp.clear(), page.irradiance.clear();
  const auto light = [&] {
    return Vec3(std::exp2(octave(random)), std::exp2(octave(random)), std::exp2(octave(random)));
  };
  for (int i = 0; i < 4096; ++i) page.sharp.push_back(light()), page.irradiance.push_back(page.sharp.back() + light());
  const Bytes once = encode_pack(pack).value();
  EXPECT_EQ(once, encode_pack(decode_pack(once).value()).value());
}

// Two lamps of one profile, and one of another.
Pack profiled_pack() {
  Pack pack = tiny_mapped_pack();
  SharpLamp lamp = pack.sharp_light.lamps[0];
  lamp.profile = 1, lamp.right = {0, 0, 1}, lamp.over = {1, 0, 0};
  pack.sharp_light.lamps = {lamp, lamp, lamp};
  pack.sharp_light.lamps[1].profile = 0;
  pack.sharp_light.profiles = {{0, 90, 2, 1, {5, 3}}, {22.5f, 180, 3, 2, {1, 2, 3, 4, 5, 0}}};
  return pack;
}

TEST(Pack, ProfilesOfLampsComeBack) {
  const Pack in = profiled_pack();
  EXPECT_TRUE(validate(in).empty());
  const Bytes bytes = encode_pack(in).value();
  const Pack out = decode_pack(bytes).value();
  ASSERT_EQ(out.sharp_light.profiles.size(), 2u);
  for (std::size_t i = 0; i < 3; ++i) {
    const SharpLamp &a = out.sharp_light.lamps[i], &b = in.sharp_light.lamps[i];
    EXPECT_EQ(std::tie(a.sun, a.profile, a.right, a.over), std::tie(b.sun, b.profile, b.right, b.over));
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const LampProfile &a = out.sharp_light.profiles[i], &b = in.sharp_light.profiles[i];
    EXPECT_EQ(std::tie(a.first_deg, a.last_deg, a.rows, a.columns, a.candela),
              std::tie(b.first_deg, b.last_deg, b.rows, b.columns, b.candela));
  }
  EXPECT_EQ(encode_pack(out).value(), bytes);
}

TEST(Pack, RefusesProfilesThatMakeNoSense) {
  const auto expect_issue = [](auto&& damage) {
    Pack pack = profiled_pack();
    damage(pack.sharp_light);
    const auto issues = validate(pack);
    ASSERT_FALSE(issues.empty());
    EXPECT_EQ(issues[0].number, 312);
  };
  expect_issue([](SharpLight& light) { light.lamps[2].profile = 2; });
  expect_issue([](SharpLight& light) { light.lamps[0].over = Vec3(0); });
  expect_issue([](SharpLight& light) { light.profiles[0].candela.pop_back(); });
  expect_issue([](SharpLight& light) { light.profiles[0].candela[1] = -1; });
  expect_issue([](SharpLight& light) { light.profiles[1].last_deg = 22.5f; });
  expect_issue([](SharpLight& light) { light.profiles[1].last_deg = std::numeric_limits<float>::quiet_NaN(); });
  expect_issue([](SharpLight& light) {
    light.profiles[0].columns = kMostProfileSteps + 1, light.profiles[0].candela.resize(2 * kMostProfileSteps + 2);
  });
  Pack pack = profiled_pack();
  pack.sharp_light.profiles.pop_back();
  EXPECT_FALSE(encode_pack(pack));
}

TEST(Hostile, SharpLight) {
  const std::string sharp = "section SHRP (sharp light): ", page = "section LMAP 0 (lightmap page): ";
  for (const std::size_t count : {4u, 8u})
    expect_refusal(with_raw(kSharpLightSection, count, ~0u), sharp + "its counts need more");
  expect_refusal(with_raw(kSharpLightSection, 12, std::uint8_t{3}), sharp + "found kind of lamp 3");
  expect_refusal(with_raw(kSharpLightSection, 13, std::uint8_t{1}), sharp + "found reserved byte 1");
  // The first page has no places.
  expect_refusal(with_raw(kLightmapSection, 8, 3u), page);
}

}  // namespace
}  // namespace oriel
