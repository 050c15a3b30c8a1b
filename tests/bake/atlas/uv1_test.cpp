#include "bake/atlas/uv1.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Uv1, OverlapNamesBothMeshes) {
  Scene scene = shapes::empty_scene();
  add_quad_uv1(scene, "east", {0, 0, 0}, kX, kY, {0.1f, 0.1f}, {0.5f, 0.5f});
  add_quad_uv1(scene, "west", {3, 0, 0}, kX, kY, {0.4f, 0.4f}, {0.8f, 0.8f});
  const Error error = build_error(scene, uv1_options());
  EXPECT_EQ(error.code, ErrorCode::kInvalid);
  EXPECT_THAT(error.text(), AllOf(HasSubstr("'east' (mesh 'east-mesh')"), HasSubstr("'west' (mesh 'west-mesh')"),
                                  HasSubstr("at uv (0.4")));
}

TEST(Uv1, OneMeshPlacedTwiceIsExplained) {
  Scene scene = shapes::empty_scene();
  add_quad_uv1(scene, "chair.1", {0, 0, 0}, kX, kY, {0, 0}, {1, 1}).mesh_name = "chair";
  add_quad_uv1(scene, "chair.2", {3, 0, 0}, kX, kY, {0, 0}, {1, 1}).mesh_name = "chair";
  EXPECT_THAT(build_error(scene, uv1_options()).text(), HasSubstr("a mesh placed twice needs a copy"));
}

TEST(Uv1, OverlapWithinAMesh) {
  Scene scene = shapes::empty_scene();
  add(scene, "folded", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {{0, 1, 2}, {3, 4, 5}},
      {{0, 0}, {1, 0}, {0, 1}, {0, 0}, {0, 1}, {1, 0}});  // the second mirrored: winding does not matter
  EXPECT_THAT(build_error(scene, uv1_options()).text(), HasSubstr("overlaps itself"));
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
  EXPECT_EQ(build_error(scene, uv1_options()).code, ErrorCode::kInvalid);
}

TEST(Uv1, OutsideThePage) {
  for (const float u : {1.5f, -0.01f, 1.00001f, std::nanf("")}) {
    Scene scene = shapes::empty_scene();
    add_quad_uv1(scene, "tiled", {0, 0, 0}, kX, kY, {0, 0}, {u, 1});
    const Error error = build_error(scene, uv1_options());
    EXPECT_EQ(error.code, ErrorCode::kInvalid);
    EXPECT_THAT(error.text(), AllOf(HasSubstr("'tiled'"), HasSubstr("expected lightmap coordinates in [0, 1]")));
  }
  Scene scene = shapes::empty_scene();
  add_quad_uv1(scene, "rounded", {0, 0, 0}, kX, kY, {-5e-7f, 0}, {1 + 5e-7f, 1});
  const Built built = build(scene, uv1_options());
  expect_sound(scene, built);
}

TEST(Uv1, WithoutArea) {
  Scene scene = shapes::empty_scene();
  add(scene, "flat", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}},
      {{0, 0}, {0, 0}, {0, 0}, {0.5f, 0.5f}});
  EXPECT_THAT(build_error(scene, uv1_options()).text(), AllOf(HasSubstr("'flat'"), HasSubstr("2 of 2 triangles")));

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
