#include "trade/measures.h"
#include "formats/core/json.h"

#include <gmock/gmock.h>

#include <cmath>

namespace oriel::trade {
namespace {
using ::testing::HasSubstr;

Measures full() {
  Measures m;
  m.bake = BakeCost{1.0 / 3, 2.0 / 3, 123'456'789'012};
  m.frame_ms = 0.1;
  m.renderer = "a \"device\"";
  m.texels = TexelError{7, 0.1, 0.2, -0.3, 0.4};
  m.frames = {{"entrance", 0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, {"1,2,3,4,5,6", 0.7, 0.8, {}, 0.9, 1, 1.1}};
  return m;
}

TEST(Measures, GoThroughJsonUnchanged) {
  for (const Measures& m : {full(), Measures{}}) {
    const std::string text = as_json(m).dump();
    const auto back = measures_from_json(text);
    ASSERT_TRUE(back) << back.error().text();
    EXPECT_EQ(as_json(*back).dump(), text);
    EXPECT_EQ(back->empty(), m.empty());
  }
  const auto back = *measures_from_json(as_json(full()).dump());
  EXPECT_EQ(back.bake->seconds, 1.0 / 3) << "every digit";
  EXPECT_EQ(back.frames[0].specular, 0.3);
  EXPECT_FALSE(back.frames[1].specular);
}

TEST(Measures, RefuseBrokenJson) {
  for (const char* text :
       {"", "{", "[]", "{\"bake\": 1}", "{\"bake\": {}}", "{\"frames\": [{}]}", "{\"frame_ms\": \"x\"}"}) {
    const auto read = measures_from_json(text);
    if (std::string(text) == "[]") continue;  // holds nothing, and nothing wrong
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, ErrorCode::kInvalid);
  }
}

TEST(Measures, ReadWhatThePlayerWrites) {
  const auto e = read_comparison("door", R"({"regions": {"frame": {"flip": 0.5, "mse": 0.25,
    "sum": {"net": 0.1, "noise": 0.2}, "D": {"net": 0.3}}, "reflectors": {"S": {"net": 0.4}}}})");
  ASSERT_TRUE(e) << e.error().text();
  EXPECT_EQ(e->camera, "door");
  EXPECT_EQ(e->sum, 0.1);
  EXPECT_EQ(e->noise, 0.2);
  EXPECT_EQ(e->diffuse, 0.3);
  EXPECT_EQ(e->specular, 0.4);
  EXPECT_FALSE(read_comparison("door", "{}"));
  Measures m;
  ASSERT_TRUE(read_frame_times(R"({"renderer": "r", "frames": [{"ms": 1}, {"ms": 4}]})", m));
  EXPECT_EQ(m.frame_ms, 2.5);
  EXPECT_EQ(m.renderer, "r");
  EXPECT_FALSE(read_frame_times("{}", m));
  EXPECT_EQ(*read_bake_seconds(R"({"stages": [{"seconds": 1}, {"seconds": 0.5}]})"), 1.5);
}

// One page; `light` in every texel but the last, which is not baked.
Pack page(std::uint32_t width, float light, float error) {
  LightmapPage p{width, 2, {}, {}, {}};
  p.irradiance.assign(2 * width, Vec3(light));
  p.standard_error.assign(2 * width, Vec3(error));
  p.state.assign(2 * width, TexelState::kValid);
  p.irradiance.back() = Vec3(1e6f);
  p.state.back() = TexelState::kDilated;
  Pack pack;
  pack.lightmaps = {p};
  return pack;
}

TEST(TexelError, IsNetOfTheReferencesNoise) {
  // 10 % too bright everywhere, beside a reference with a standard error of 6 %: √(0.1² − 0.06²) = 0.08, but for the
  // floor of 1 % of the mean in the denominator.
  const auto e = texel_error(page(4, 110, 0), page(4, 100, 6));
  ASSERT_TRUE(e) << e.error().text();
  EXPECT_EQ(e->texels, 7u) << "what is not baked does not count";
  EXPECT_NEAR(e->rel_rmse, 0.08, 1e-5);
  EXPECT_NEAR(e->n_rmse, 0.08, 1e-6);
  EXPECT_NEAR(e->bias, 0.1, 1e-6);
  EXPECT_NEAR(e->noise, 0.06, 1e-5);
  EXPECT_EQ(texel_error(page(4, 100, 0), page(4, 100, 6))->rel_rmse, 0) << "lost in the noise, not below 0";
}

TEST(TexelError, TellsClouds) {
  const auto wall = [](float contrast) {
    Pack pack;
    for (const Vec2& uv : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)})
      pack.mesh.positions.emplace_back(uv.x, uv.y, 0), pack.mesh.lightmap_uvs.push_back(uv);
    pack.mesh.indices = {0, 1, 2, 0, 2, 3};
    pack.mesh.parts.push_back({"wall", 0, 6, 0, 0});
    LightmapPage p{32, 32, {}, {}, {}};
    for (int i = 0; i < 1024; ++i) p.irradiance.emplace_back((i % 32 / 8 + i / 256) % 2 ? 1 + contrast : 1 - contrast);
    p.standard_error.resize(1024), p.state.assign(1024, TexelState::kValid);
    pack.lightmaps = {p};
    return pack;
  };
  const auto e = texel_error(wall(0.1f), wall(0));
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->clouds, 0.1 / std::sqrt(1.01), 1e-5);
  EXPECT_GT(e->visible, 1);
  Measures measures;
  measures.texels = *e;
  const auto read = measures_from_json(as_json(measures).dump());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->texels->clouds, e->clouds);
  EXPECT_EQ(read->texels->visible, e->visible);
}

TEST(TexelError, RefusesAnotherAtlas) {
  const auto e = texel_error(page(4, 1, 0), page(5, 1, 0));
  ASSERT_FALSE(e);
  EXPECT_THAT(e.error().text(), HasSubstr("same atlas"));
  EXPECT_FALSE(texel_error(page(4, 1, 0), Pack{}));
  EXPECT_FALSE(texel_error(Pack{}, Pack{})) << "nothing to compare";
}

}  // namespace
}  // namespace oriel::trade
