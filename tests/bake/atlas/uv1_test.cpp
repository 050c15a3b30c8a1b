#include "bake/atlas/uv1.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bake/radiosity/dilate.h"
#include "tests/bake/atlas/checks.h"
#include "tests/bake/atlas/shapes.h"

namespace oriel {
namespace {

using shapes::add;
using shapes::add_quad;
using shapes::add_quad_uv1;
using ::testing::AllOf;
using ::testing::HasSubstr;

AtlasOptions uv1_options(int resolution = 128) {
  AtlasOptions options;
  options.source = AtlasOptions::Source::kUv1;
  options.resolution = resolution;
  return options;
}

const Vec3 kX(2, 0, 0), kY(0, 2, 0);

TEST(Uv1, SharesPageZeroRowZeroIsVZero) {
  Scene scene = shapes::empty_scene();
  add_quad_uv1(scene, "left", {0, 0, 0}, kX, kY, {0, 0}, {0.5f, 1});
  add_quad_uv1(scene, "right", {3, 0, 0}, kX, kY, {0.5f, 0}, {1, 0.5f});
  add_quad(scene, "none", {6, 0, 0}, kX, kY);
  const Built built = build(scene, uv1_options());
  expect_sound(scene, built);
  ASSERT_EQ(built.atlas.pages.size(), 2u);
  EXPECT_TRUE(built.atlas.pages[0].from_uv1);
  EXPECT_EQ(built.atlas.pages[0].width, 128u);
  EXPECT_EQ(built.atlas.pages[0].height, 128u);
  EXPECT_FALSE(built.atlas.pages[1].from_uv1);
  EXPECT_EQ(built.atlas.page[4], 1);
  EXPECT_EQ(built.atlas.chart_count, 3u);
  EXPECT_EQ(built.map[0].texel.size(), 64u * 128 + 64 * 64);
  EXPECT_EQ(built.map[0].texel.back() / 128, 127u);
  EXPECT_LT(built.map[0].texel.back() % 128, 64u);  // the right one ends at v = ½
  EXPECT_EQ(built.atlas.uv[0][0], Vec2(0, 0));
}

TEST(Uv1, OnOnePageAnOverlapNamesBothMeshesAndAllIsPacked) {
  Scene scene = shapes::empty_scene();
  add_quad_uv1(scene, "east", {0, 0, 0}, kX, kY, {0.1f, 0.1f}, {0.5f, 0.5f});
  add_quad_uv1(scene, "west", {3, 0, 0}, kX, kY, {0.4f, 0.4f}, {0.8f, 0.8f});
  const Built built = build(scene, uv1_options());
  expect_sound(scene, built);
  ASSERT_EQ(built.warnings.size(), 1u);
  EXPECT_THAT(built.warnings[0], AllOf(HasSubstr("'east' (mesh 'east-mesh')"), HasSubstr("'west' (mesh 'west-mesh')"),
                                       HasSubstr("at uv (0.4")));
  ASSERT_EQ(built.atlas.pages.size(), 1u);
  EXPECT_EQ(built.atlas.pages[0].width, 128u);
  EXPECT_FALSE(built.atlas.pages[0].from_uv1);
}

TEST(Uv1, EachMeshMayOwnAllOfThePage) {
  Scene scene = shapes::empty_scene();
  add_quad_uv1(scene, "wide", {0, 0, 0}, {4, 0, 0}, kY, {0, 0}, {1, 0.5f});
  add_quad_uv1(scene, "high", {5, 0, 0}, {1, 0, 0}, {0, 3, 0}, {0, 0}, {0.3f, 0.9f});
  AtlasOptions options = uv1_options(0);
  options.texel_m = 0.1f;
  const Built built = build(scene, options);
  expect_sound(scene, built);
  EXPECT_THAT(built.warnings, ::testing::IsEmpty());
  EXPECT_EQ(built.map[0].texel.size(), 40u * 20 + 10 * 30) << "at the texel asked for";
  EXPECT_NEAR(built.atlas.report.l2_stretch, 1, 1e-6);
  EXPECT_GT(built.atlas.covered_share, 0.7);
}

TEST(Uv1, OverlapWithinAMeshGetsChartsOfOurs) {
  Scene scene = shapes::empty_scene();
  add(scene, "folded", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}, {3, 4, 5}},
      {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {0, 1}, {1, 0}});  // the second mirrored: winding does not matter
  add_quad_uv1(scene, "sound", {3, 0, 0}, kX, kY, {0, 0}, {1, 1});
  add_quad(scene, "bare", {6, 0, 0}, kX, kY);
  const Built built = build(scene, uv1_options(0));
  expect_sound(scene, built);
  EXPECT_THAT(built.warnings, ::testing::ElementsAre(HasSubstr("overlaps itself, triangles 0 and 1 at uv"),
                                                     HasSubstr("'bare' (mesh 'bare-mesh'): has no TEXCOORD_1")));
  const AtlasOptions options = uv1_options(0);
  Context context;
  const Uv1Check check = check_uv1(scene, {0, 1, 2}, options, context);
  EXPECT_THAT(check.own, ::testing::ElementsAre(1));
  EXPECT_THAT(check.faulty, ::testing::ElementsAre(0, 2));
}

TEST(Uv1, TouchingChartsAndAWrongScaleAreSaidAndMended) {
  Scene scene = shapes::empty_scene();
  add(scene, "pair", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}, {3, 4, 5}},
      {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0, 1}, {1, 0}});
  for (const float x : {3.f, 6.f}) add_quad_uv1(scene, "sound", {x, 0, 0}, kX, kY, {0, 0}, {1, 1});
  add_quad_uv1(scene, "tiny", {9, 0, 0}, kX, kY, {0, 0}, {0.01f, 0.01f});
  const Built built = build(scene, uv1_options(0));
  expect_sound(scene, built);
  EXPECT_THAT(built.warnings,
              ::testing::ElementsAre(
                  AllOf(HasSubstr("'tiny'"), HasSubstr("100 times larger")),
                  AllOf(HasSubstr("'pair'"), HasSubstr("by their first triangles: 0 and 1"), HasSubstr("from mip 0"))));
  EXPECT_EQ(built.atlas.texel_m, 0.1f);
  EXPECT_NEAR(static_cast<double>(built.map[0].texel.size()), 3 * 400 + 2 * 55, 10) << "a diagonal may touch more";
}

float of_chart(const Atlas& atlas, std::uint32_t triangle) {
  return static_cast<float>(atlas.chart[triangle] % 2);
}

// The light of a page's mip, a mean of 4^mip texels each, as bilinear filters read it.
float filtered(const LightmapPage& page, int mip, const Vec2& uv) {
  const int step = 1 << mip, width = static_cast<int>(page.width) / step, height = static_cast<int>(page.height) / step;
  const auto texel = [&](int x, int y) {
    float sum = 0;
    for (int i = 0; i < step * step; ++i) {
      const int column = std::clamp(x, 0, width - 1) * step + i % step,
                row = std::clamp(y, 0, height - 1) * step + i / step;
      sum += page.irradiance[static_cast<std::size_t>(row * static_cast<int>(page.width) + column)].x;
    }
    return sum / static_cast<float>(step * step);
  };
  const Vec2 at = uv * Vec2(width, height) - 0.5f, low = glm::floor(at), t = at - low;
  const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
  return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), t.x), glm::mix(texel(x, y + 1), texel(x + 1, y + 1), t.x),
                  t.y);
}

// What the manual says of --padding: so many texels keep white and black neighbours apart in the first two mips.
TEST(Uv1, PaddingKeepsChartsApartInMips) {
  for (const auto& [padding, mips] : {std::pair(2, 0), {5, 1}, {11, 2}}) {
    Scene scene = shapes::empty_scene();
    for (int i = 0; i < 12; ++i)
      add_quad_uv1(scene, "q", {3.f * static_cast<float>(i), 0, 0}, {0.9f + 0.1f * static_cast<float>(i % 5), 0, 0},
                   {0, 0.7f + 0.1f * static_cast<float>(i % 3), 0}, {0, 0}, {1, 1});
    AtlasOptions options = uv1_options(0);
    options.padding = padding;
    const Built built = build(scene, options);
    ASSERT_EQ(built.atlas.pages.size(), 1u);
    const AtlasPage& size = built.atlas.pages[0];
    LightmapPage page;
    page.width = size.width, page.height = size.height;
    page.irradiance.resize(std::size_t{size.width} * size.height, Vec3(0));
    page.state.resize(page.irradiance.size(), TexelState::kEmpty);
    for (std::size_t i = 0; i < built.map[0].texel.size(); ++i) {
      const std::uint32_t texel = built.map[0].texel[i];
      page.irradiance[texel] = Vec3(of_chart(built.atlas, built.map[0].fragments[built.map[0].first[i]].triangle));
      page.state[texel] = TexelState::kValid;
    }
    dilate((padding + 1) / 2, page);
    for (int mip = 0; mip <= mips; ++mip)
      for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
        for (const Vec2& uv : built.atlas.uv[t])
          EXPECT_NEAR(filtered(page, mip, uv), of_chart(built.atlas, t), 1e-4f) << padding << ", mip " << mip;
  }
}

TEST(Uv1, NeighboursThatOnlyTouchDoNotOverlap) {
  Scene scene = shapes::empty_scene();
  // A long border between one triangle and many, whose corners on it are rounded to float.
  const Vec2 a(0.1f, 0.137f), b(0.93f, 0.811f);
  add(scene, "one", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {a, b, {0.1f, 0.95f}});
  std::vector<Vec3> p{{0, 0, 0}};
  std::vector<Vec2> uv{{0.93f, 0.05f}};
  std::vector<UVec3> t;
  for (std::uint32_t i = 0; i <= 50; ++i) {
    const float s = static_cast<float>(i) / 50;
    p.push_back({1 + s, 0, 3});
    uv.push_back(a + (b - a) * s);
    if (i > 0) t.push_back({0, i + 1, i});
  }
  add(scene, "many", p, t, uv);
  expect_sound(scene, build(scene, uv1_options(2048)));
}

TEST(Uv1, ThinOverlapIsFound) {
  Scene scene = shapes::empty_scene();
  add_quad_uv1(scene, "a", {0, 0, 0}, kX, kY, {0, 0}, {0.5f, 1});
  add_quad_uv1(scene, "b", {3, 0, 0}, kX, kY, {0.5f - 0.01f / 128, 0}, {1, 1});  // 0.01 texels wide
  EXPECT_THAT(build(scene, uv1_options()).warnings, ::testing::Contains(HasSubstr("overlaps that of")));
}

TEST(Uv1, OutsideThePageIsPacked) {
  for (const float u : {1.5f, -0.01f, 1.00001f}) {
    Scene scene = shapes::empty_scene();
    add_quad_uv1(scene, "tiled", {0, 0, 0}, kX, kY, {0, 0}, {u, 1});
    const Built built = build(scene, uv1_options());
    expect_sound(scene, built);
    EXPECT_THAT(built.warnings, ::testing::ElementsAre(AllOf(HasSubstr("'tiled'"), HasSubstr("more than [0, 1]"))));
  }
  Scene scene = shapes::empty_scene();
  add_quad_uv1(scene, "rounded", {0, 0, 0}, kX, kY, {-5e-7f, 0}, {1 + 5e-7f, 1});
  const Built built = build(scene, uv1_options());
  expect_sound(scene, built);
  EXPECT_TRUE(built.atlas.pages[0].from_uv1);
}

TEST(Uv1, WhatIsNoNumberOrFarAwayIsSurvived) {
  for (const Vec2& upper : {Vec2(std::nanf(""), 1), Vec2(1, 0), Vec2(1e9f, 1), Vec2(1e-9f, 1e-9f)}) {
    Scene scene = shapes::empty_scene();
    add_quad_uv1(scene, "odd", {0, 0, 0}, kX, kY, {0, 0}, upper);
    add_quad_uv1(scene, "sound", {3, 0, 0}, kX, kY, {0, 0}, {1, 1});
    for (const int resolution : {0, 128}) expect_sound(scene, build(scene, uv1_options(resolution)));
  }
}

TEST(Uv1, WithoutArea) {
  Scene scene = shapes::empty_scene();
  add(scene, "flat", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}},
      {{0, 0}, {0, 0}, {0, 0}, {0.5f, 0.5f}});
  EXPECT_THAT(build_error(scene, uv1_options()).text(), HasSubstr("no mesh has TEXCOORD_1 of use"));
  add_quad_uv1(scene, "sound", {3, 0, 0}, kX, kY, {0, 0}, {1, 1});
  EXPECT_THAT(build(scene, uv1_options()).warnings,
              ::testing::ElementsAre(AllOf(HasSubstr("'flat'"), HasSubstr("2 of 2 triangles"))));

  Scene slivers = shapes::empty_scene();
  add(slivers, "wall", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 1e-8f, 0}},
      {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5f, 0}});
  const Built built = build(slivers, uv1_options());
  expect_sound(slivers, built);
  ASSERT_EQ(built.warnings.size(), 1u);
  EXPECT_THAT(built.warnings[0], HasSubstr("1 slivers"));
}

TEST(Uv1, NoMeshHasAny) {
  Scene scene = shapes::empty_scene();
  add_quad(scene, "plain", {0, 0, 0}, kX, kY);
  EXPECT_EQ(build_error(scene, uv1_options()).code, ErrorCode::kInvalid);
}

}  // namespace
}  // namespace oriel
