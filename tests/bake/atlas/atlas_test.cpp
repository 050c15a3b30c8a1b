#include "bake/atlas/atlas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bake/atlas/checks.h"
#include "tests/bake/atlas/shapes.h"

namespace oriel {
namespace {

using shapes::add;
using shapes::add_quad;
using testing::HasSubstr;

TEST(Atlas, WallCoversWholeTexels) {
  Scene scene = shapes::empty_scene();
  add_quad(scene, "wall", {-2, 0, 1}, {4, 0, 0}, {0, 3, 0});
  const Built built = build(scene);
  expect_sound(scene, built);
  ASSERT_EQ(built.atlas.pages.size(), 1u);
  EXPECT_EQ(built.atlas.chart_count, 1u);
  EXPECT_EQ(built.map[0].texel.size(), 40u * 30u);
  EXPECT_NEAR(fragment_area(built.map), 1200, 0.1);
  EXPECT_EQ(built.atlas.pages[0].width, 40u);
  EXPECT_EQ(built.atlas.pages[0].height, 32u);
  EXPECT_NEAR(built.atlas.covered_share, 1200.0 / (40 * 32), 1e-12);
}

TEST(Atlas, TiltedWallCoversWholeTexels) {
  Scene scene = shapes::empty_scene();
  const Vec3 x = 4.0f * glm::normalize(Vec3(1, 2, 3)), y = 3.0f * glm::normalize(glm::cross(Vec3(1, 2, 3), Vec3(0, 1, 0)));
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
  add(scene, "wall", {{0, 0, 5}, {4, 0, 5}, {4, 2, 5}, {2, 2, std::nextafter(5.0f, 6.0f)}, {0, 2, 5}, {2, 2.000001f, 5}},
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

TEST(Atlas, TexelFarTooLargeGivesOneTexelACharts) {
  Scene scene = shapes::empty_scene();
  shapes::add_box(scene, "cube", Vec3(0), Vec3(1));
  AtlasOptions options;
  options.texel_m = 1e6f;
  const Built built = build(scene, options);
  expect_sound(scene, built);
  EXPECT_EQ(texel_count(built.map), 6u);
}

TEST(Atlas, ChartLargerThanAPageIsCoarsened) {
  Scene scene = shapes::empty_scene();
  add_quad(scene, "floor", {0, 0, 0}, {0, 0, 100}, {50, 0, 0});
  AtlasOptions options;
  options.max_page = 256;
  const Built built = build(scene, options);
  expect_sound(scene, built);
  ASSERT_EQ(built.warnings.size(), 1u);
  EXPECT_THAT(built.warnings[0], HasSubstr("1 of 1 charts"));
  EXPECT_THAT(built.warnings[0], HasSubstr("0.3906 m"));
  EXPECT_EQ(texel_count(built.map), 256u * 128u);
}

TEST(Atlas, SeveralPages) {
  Scene scene = shapes::empty_scene();
  for (int i = 0; i < 40; ++i) add_quad(scene, "wall", {0, 0, static_cast<float>(i)}, {5, 0, 0}, {0, 4, 0});
  AtlasOptions options;
  options.max_page = 128;
  const Built built = build(scene, options);
  expect_sound(scene, built);
  EXPECT_GE(built.atlas.pages.size(), 6u);
  for (const AtlasPage& page : built.atlas.pages) {
    EXPECT_LE(page.width, 128u);
    EXPECT_LE(page.height, 128u);
    EXPECT_EQ(page.width % 4 + page.height % 4, 0u);
  }
}

TEST(Atlas, PaddingIsKept) {
  Scene scene = shapes::empty_scene();
  for (int i = 0; i < 30; ++i) add_quad(scene, "q", {0, 0, static_cast<float>(i)}, {0.35f + 0.1f * i, 0, 0}, {0, 0.72f, 0});
  AtlasOptions options;
  options.padding = 3;
  const Built built = build(scene, options);
  expect_sound(scene, built);
  const TexelMapPage& page = built.map[0];
  std::vector<std::int64_t> chart(page.width * page.height, -1);
  for (std::size_t i = 0; i < page.texel.size(); ++i)
    chart[page.texel[i]] = built.atlas.chart[page.fragments[page.first[i]].triangle];
  for (std::uint32_t y = 0; y < page.height; ++y)
    for (std::uint32_t x = 0; x < page.width; ++x)
      for (std::uint32_t d = 1; d <= 3; ++d) {
        const std::int64_t own = chart[y * page.width + x];
        if (own < 0) continue;
        if (x + d < page.width) {
          const std::int64_t other = chart[y * page.width + x + d];
          ASSERT_TRUE(other < 0 || other == own);
        }
        if (y + d < page.height) {
          const std::int64_t other = chart[(y + d) * page.width + x];
          ASSERT_TRUE(other < 0 || other == own);
        }
      }
}

TEST(Atlas, ResolutionFillsOnePage) {
  Scene scene = shapes::empty_scene();
  shapes::add_box(scene, "room", Vec3(0), Vec3(6, 3, 5));
  shapes::add_icosphere(scene, "sphere", 1, 3);
  AtlasOptions options;
  for (const int n : {64, 500, 2048}) {
    options.resolution = n;
    const Built built = build(scene, options);
    expect_sound(scene, built);
    ASSERT_EQ(built.atlas.pages.size(), 1u);
    EXPECT_EQ(built.atlas.pages[0].width, static_cast<std::uint32_t>(n));
    EXPECT_EQ(built.atlas.pages[0].height, static_cast<std::uint32_t>(n));
    EXPECT_GT(built.atlas.covered_share, 0.4) << n;
    EXPECT_GT(built.atlas.texel_m, 0);
  }
}

TEST(Atlas, ResolutionTooSmallSaysWhatFits) {
  Scene scene = shapes::empty_scene();
  for (int i = 0; i < 100; ++i) add_quad(scene, "q", {0, 0, static_cast<float>(i)}, {1, 0, 0}, {0, 1, 0});
  AtlasOptions options;
  options.resolution = 16;
  const Error error = build_error(scene, options);
  EXPECT_EQ(error.code, ErrorCode::kRuntime);
  EXPECT_THAT(error.text(), HasSubstr("100 charts do not fit into one page of 16x16 texels; about 32x32"));
}

TEST(Atlas, TooManyPagesSaysWhichTexelFits) {
  Scene scene = shapes::empty_scene();
  for (int i = 0; i < 5000; ++i) add_quad(scene, "q", {0, 0, static_cast<float>(i)}, {1, 0, 0}, {0, 1, 0});
  AtlasOptions options;
  options.max_page = 16;
  options.texel_m = 0.0625f;
  const Error error = build_error(scene, options);
  EXPECT_EQ(error.code, ErrorCode::kRuntime);
  EXPECT_THAT(error.text(), HasSubstr("more than 4096 pages of 16x16 texels; a texel of"));
}

TEST(Atlas, UnlitSurfacesHaveNoPlace) {
  Scene scene = shapes::empty_scene();
  scene.materials.emplace_back().unlit = true;
  add_quad(scene, "lit", {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add_quad(scene, "sign", {0, 0, 1}, {1, 0, 0}, {0, 1, 0}).material = 1;
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_EQ(built.atlas.chart[2], ~0u);
  const Built nothing = build(shapes::empty_scene());
  EXPECT_TRUE(nothing.atlas.pages.empty());
  EXPECT_EQ(nothing.atlas.covered_share, 0);
}

TEST(Atlas, OptionsAreChecked) {
  const Scene scene = shapes::empty_scene();
  const auto refused = [&](auto change) {
    AtlasOptions options;
    change(options);
    EXPECT_EQ(build_error(scene, options).code, ErrorCode::kUsage);
  };
  refused([](AtlasOptions& o) { o.texel_m = 0; });
  refused([](AtlasOptions& o) { o.texel_m = std::nanf(""); });
  refused([](AtlasOptions& o) { o.resolution = -1; });
  refused([](AtlasOptions& o) { o.max_page = 8; });
  refused([](AtlasOptions& o) { o.padding = 0; });
  refused([](AtlasOptions& o) { o.flat_angle_deg = 90; });
  refused([](AtlasOptions& o) { o.curved_angle_deg = 90; });
  refused([](AtlasOptions& o) { o.source = AtlasOptions::Source::kUv1; });
}

Scene mixed_scene() {
  Scene scene = shapes::empty_scene();
  shapes::add_box(scene, "room", Vec3(0), Vec3(6, 3, 5));
  shapes::add_icosphere(scene, "sphere", 1, 4);
  shapes::add_cylinder(scene, "column", 0.3f, 3, 24, 8);
  shapes::add_spiral(scene, "ramp", 1, 2, 3, 40);
  return scene;
}

TEST(Atlas, SameBytesFromOneAndTwoThreads) {
  const Scene scene = mixed_scene();
  for (const int resolution : {0, 256}) {
    AtlasOptions options;
    options.resolution = resolution;
    const Built one = build(scene, options, 1), two = build(scene, options, 2), again = build(scene, options, 2);
    for (const Built* other : {&two, &again}) {
      EXPECT_EQ(one.atlas.uv, other->atlas.uv);
      EXPECT_EQ(one.atlas.page, other->atlas.page);
      EXPECT_EQ(one.atlas.chart, other->atlas.chart);
      ASSERT_EQ(one.map.size(), other->map.size());
      for (std::size_t p = 0; p < one.map.size(); ++p) {
        EXPECT_EQ(one.map[p].texel, other->map[p].texel);
        EXPECT_EQ(one.map[p].first, other->map[p].first);
        ASSERT_EQ(one.map[p].fragments.size(), other->map[p].fragments.size());
        for (std::size_t f = 0; f < one.map[p].fragments.size(); ++f) {
          ASSERT_EQ(one.map[p].fragments[f].triangle, other->map[p].fragments[f].triangle);
          ASSERT_EQ(one.map[p].fragments[f].area, other->map[p].fragments[f].area);
        }
      }
    }
  }
}

TEST(Atlas, SoupOfManyTriangles) {
  Scene scene = shapes::empty_scene();
  std::vector<Vec3> p;
  std::vector<UVec3> t;
  std::uint32_t state = 12345;
  const auto random = [&] { return static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-24f; };
  for (std::uint32_t i = 0; i < 200000; ++i) {
    const Vec3 c(random() * 50, random() * 50, random() * 50);
    for (int k = 0; k < 3; ++k) p.push_back(c + Vec3(random(), random(), random()) * 0.2f);
    t.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  add(scene, "soup", p, t);
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_EQ(built.atlas.chart_count, 200000u);
  EXPECT_LE(built.atlas.pages.size(), 3u);
}

TEST(Atlas, StopIsObeyed) {
  const Scene scene = mixed_scene();
  Context context;
  context.stop = true;
  const auto atlas = build_atlas(scene, {}, context);
  ASSERT_FALSE(atlas.has_value());
  EXPECT_EQ(atlas.error().code, ErrorCode::kStopped);
}

}  // namespace
}  // namespace oriel
