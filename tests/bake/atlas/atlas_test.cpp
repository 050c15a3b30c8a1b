#include "bake/atlas/atlas.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/bake/atlas/checks.h"
#include "tests/bake/atlas/shapes.h"

namespace oriel {
namespace {

using shapes::add;
using shapes::add_quad;

TEST(Atlas, WallCoversWholeTexels) {
  Scene scene = shapes::empty_scene();
  add_quad(scene, "wall", {-2, 0, 1}, {4, 0, 0}, {0, 3, 0});
  const Built built = build(scene);
  expect_sound(scene, built);
  ASSERT_EQ(built.atlas.pages.size(), 1u);
  EXPECT_EQ(built.atlas.chart_count, 1u);
  EXPECT_EQ(built.map[0].texel.size(), 40u * 30u);
  EXPECT_NEAR(fragment_area(built.map), 1200, 0.1);
  EXPECT_EQ(std::max(built.atlas.pages[0].width, built.atlas.pages[0].height), 40u);
  EXPECT_EQ(std::min(built.atlas.pages[0].width, built.atlas.pages[0].height), 32u);
  EXPECT_NEAR(built.atlas.covered_share, 1200.0 / (40 * 32), 1e-12);
}

TEST(Atlas, TiltedWallCoversWholeTexels) {
  Scene scene = shapes::empty_scene();
  const Vec3 x = 4.0f * glm::normalize(Vec3(1, 2, 3)),
             y = 3.0f * glm::normalize(glm::cross(Vec3(1, 2, 3), Vec3(0, 1, 0)));
  add_quad(scene, "wall", {17, -3, 1}, x, y);
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_EQ(built.map[0].texel.size(), 40u * 30u);
}

TEST(Atlas, BordersAreCoveredByMoreThanHalf) {
  for (const float width : {1.01f, 1.05f, 1.09f, 3.333f}) {
    Scene scene = shapes::empty_scene();
    add_quad(scene, "wall", {0, 0, 0}, {width, 0, 0}, {0, 1, 0});
    const Built built = build(scene);
    const TexelMapPage& page = built.map[0];
    for (std::size_t i = 0; i < page.texel.size(); ++i) {
      float covered = 0;
      for (std::uint32_t f = page.first[i]; f < page.first[i + 1]; ++f) covered += page.fragments[f].area;
      EXPECT_GT(covered, 0.5f) << width;
    }
  }
}

TEST(Atlas, CubeHasSixCharts) {
  Scene scene = shapes::empty_scene();
  shapes::add_box(scene, "cube", Vec3(-0.5f), Vec3(1));
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_EQ(built.atlas.chart_count, 6u);
  EXPECT_EQ(texel_count(built.map), 600u);
}

TEST(Atlas, SmallCubeKeepsSixCharts) {
  Scene scene = shapes::empty_scene();
  shapes::add_box(scene, "cube", Vec3(0), Vec3(0.2f));  // below the size at which flat regions come first
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_EQ(built.atlas.chart_count, 6u);
}

TEST(Atlas, ConcaveFloorIsOneChartToScale) {
  Scene scene = shapes::empty_scene();
  add(scene, "floor", {{0, 0, 0}, {0, 0, 5}, {2, 0, 5}, {2, 0, 2}, {6, 0, 2}, {6, 0, 0}},
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_EQ(built.atlas.chart_count, 1u);
  EXPECT_NEAR(fragment_area(built.map) * 0.01, shapes::area_of(scene), 1e-4 * shapes::area_of(scene));
}

TEST(Atlas, VerticesSplitByNormalsStillJoin) {
  Scene scene = shapes::empty_scene();
  std::vector<Vec3> p;
  std::vector<UVec3> t;
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) {
      const auto b = static_cast<std::uint32_t>(p.size());
      const float x = static_cast<float>(i), z = static_cast<float>(j);
      p.insert(p.end(), {{x, -0.0f, z}, {x, 0, z + 1}, {x + 1, 0, z + 1}, {x + 1, 0, z}});
      t.push_back({b, b + 1, b + 2}), t.push_back({b, b + 2, b + 3});
    }
  add(scene, "tiles", p, t);
  EXPECT_EQ(build(scene).atlas.chart_count, 1u);
}

TEST(Atlas, MirroredOrderOfCornersIsTheOtherSide) {
  Scene scene = shapes::empty_scene();
  add(scene, "a", {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}});
  add(scene, "b", {{0, 0, 0}, {-3, 0, 0}, {-3, 2, 0}, {0, 2, 0}}, {{0, 2, 1}, {0, 3, 2}});
  const Built built = build(scene);
  expect_sound(scene, built);
  for (std::uint32_t t = 0; t < 4; ++t) {
    const auto p = texel_triangle(built.atlas, t);
    EXPECT_GT((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x), 0) << t;
  }
}

// Rounding of places decides nothing: faces of these shapes are alike in many ways.
TEST(Atlas, WhatIsMovedKeepsItsCharts) {
  Scene scene = shapes::empty_scene();
  shapes::add_icosphere(scene, "sphere", 0.7f, 3);
  const Built here = build(scene);
  for (const Vec3& by : {Vec3(0.4f, 0, -0.3f), Vec3(7.3f, 1.1f, -5.9f)}) {
    Scene moved = scene;
    for (Vec3& p : moved.positions) p += by;
    const Built there = build(moved);
    EXPECT_EQ(there.atlas.chart, here.atlas.chart);
    ASSERT_EQ(there.atlas.pages.size(), here.atlas.pages.size());
    EXPECT_EQ(there.atlas.pages[0].width, here.atlas.pages[0].width);
    EXPECT_EQ(there.atlas.pages[0].height, here.atlas.pages[0].height);
  }
}

TEST(Atlas, SpheresAndCylindersTakeFewCharts) {
  for (const float radius : {0.2f, 2.0f, 40.0f}) {
    Scene scene = shapes::empty_scene();
    shapes::add_icosphere(scene, "sphere", radius, 4);
    const Built built = build(scene);
    expect_sound(scene, built);
    EXPECT_LE(built.atlas.chart_count, 40u) << radius;
    EXPECT_LT(fragment_area(built.map) * 0.01, shapes::area_of(scene) * 1.001);
    EXPECT_GT(fragment_area(built.map) * 0.01, shapes::area_of(scene) * 0.766);  // cos 40°
  }
  Scene scene = shapes::empty_scene();
  shapes::add_cylinder(scene, "column", 1, 3, 128);
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_LE(built.atlas.chart_count, 8u);
}

TEST(Atlas, FacetedColumnKeepsItsWideSidesToScale) {
  Scene scene = shapes::empty_scene();
  shapes::add_cylinder(scene, "column", 2, 4, 12);  // sides of 1 m, 30° apart
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_EQ(built.atlas.chart_count, 12u);
  EXPECT_NEAR(fragment_area(built.map) * 0.01, shapes::area_of(scene), 1e-4 * shapes::area_of(scene));
}

TEST(Atlas, RampAboveItselfIsCut) {
  Scene scene = shapes::empty_scene();
  shapes::add_spiral(scene, "ramp", 1, 3, 4, 32);
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_GE(built.atlas.chart_count, 4u);
  EXPECT_LE(built.atlas.chart_count, 16u);
}

TEST(Atlas, RoughGroundIsNotTorn) {
  Scene scene = shapes::empty_scene();
  std::vector<Vec3> p;
  std::vector<UVec3> t;
  std::uint32_t state = 3;
  const auto random = [&] { return static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-24f; };
  constexpr std::uint32_t kSide = 60;
  for (std::uint32_t i = 0; i <= kSide; ++i)
    for (std::uint32_t j = 0; j <= kSide; ++j) p.push_back({0.1f * i, 0.05f * random(), 0.1f * j});
  for (std::uint32_t i = 0; i < kSide; ++i)
    for (std::uint32_t j = 0; j < kSide; ++j) {
      const std::uint32_t a = i * (kSide + 1) + j;
      t.insert(t.end(), {{a, a + 1, a + kSide + 2}, {a, a + kSide + 2, a + kSide + 1}});
    }
  add(scene, "ground", p, t);
  AtlasOptions options;
  options.texel_m = 0.03f;
  const Built built = build(scene, options);
  expect_sound(scene, built);
  std::map<std::uint32_t, int> sizes;
  int largest = 0;
  for (const std::uint32_t chart : built.atlas.chart) largest = std::max(largest, ++sizes[chart]);
  EXPECT_GT(largest, 5000);  // of 7200
}

TEST(Atlas, NonManifoldEdges) {
  Scene scene = shapes::empty_scene();
  add(scene, "fan", {{0, 0, 0}, {0, 2, 0}, {2, 1, 0}, {-1, 1, 2}, {-1, 1, -2}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  const Built built = build(scene);
  expect_sound(scene, built);
}

TEST(Atlas, DuplicatedTrianglesGetPlacesOfTheirOwn) {
  Scene scene = shapes::empty_scene();
  add(scene, "twice", {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 1, 2}, {0, 2, 3}});
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_EQ(built.atlas.chart_count, 2u);
}

TEST(Atlas, SheetModelledFromBothSidesIsTwoCharts) {
  Scene scene = shapes::empty_scene();
  std::vector<Vec3> p;
  std::vector<UVec3> t;
  for (std::uint32_t i = 0; i <= 8; ++i)
    for (std::uint32_t j = 0; j <= 8; ++j) p.push_back({static_cast<float>(i), static_cast<float>(j), 0});
  for (std::uint32_t i = 0; i < 8; ++i)
    for (std::uint32_t j = 0; j < 8; ++j) {
      const std::uint32_t a = i * 9 + j;
      t.insert(t.end(), {{a, a + 9, a + 10}, {a, a + 10, a + 9}, {a, a + 10, a + 1}, {a, a + 1, a + 10}});
    }
  add(scene, "sheet", p, t);
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_EQ(built.atlas.chart_count, 2u);
}

TEST(Atlas, OneTriangleAndSlivers) {
  for (const Vec3& third : {Vec3(0, 1, 0), Vec3(0.5f, 1e-7f, 0), Vec3(1e-7f, 1e-7f, 0)}) {
    Scene scene = shapes::empty_scene();
    add(scene, "one", {{0, 0, 0}, {1, 0, 0}, third}, {{0, 1, 2}});
    const Built built = build(scene);
    expect_sound(scene, built);
    EXPECT_GE(texel_count(built.map), 10u);
  }
  Scene scene = shapes::empty_scene();
  add(scene, "speck", {{0, 0, 0}, {1e-6f, 0, 0}, {0, 1e-6f, 0}}, {{0, 1, 2}});
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_EQ(texel_count(built.map), 1u);
  EXPECT_EQ(built.atlas.pages[0].width, 4u);
}

TEST(Atlas, SliverInAWallStaysInItsChart) {
  Scene scene = shapes::empty_scene();
  // The middle corner is off the wall's plane by rounding alone, yet turns the sliver's normal by far.
  add(scene, "wall",
      {{0, 0, 5}, {4, 0, 5}, {4, 2, 5}, {2, 2, std::nextafter(5.0f, 6.0f)}, {0, 2, 5}, {2, 2.000001f, 5}},
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {3, 2, 5}, {4, 3, 5}});
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_LE(built.atlas.chart_count, 2u);
}

TEST(Atlas, TinyAndHugeScenes) {
  for (const float scale : {1e-4f, 1e6f}) {
    Scene scene = shapes::empty_scene();
    shapes::add_box(scene, "box", Vec3(-scale), Vec3(2 * scale, scale, 3 * scale));
    shapes::add_icosphere(scene, "sphere", scale * 0.5f, 2);
    AtlasOptions options;
    options.texel_m = scale * 0.05f;
    const Built built = build(scene, options);
    expect_sound(scene, built);
    EXPECT_TRUE(built.warnings.empty());
    const double share = fragment_area(built.map) * options.texel_m * options.texel_m / shapes::area_of(scene);
    EXPECT_GT(share, 0.9);
    EXPECT_LT(share, 1.001);
  }
}

}  // namespace
}  // namespace oriel
