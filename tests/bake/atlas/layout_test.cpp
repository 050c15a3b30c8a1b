#include "bake/atlas/atlas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bake/atlas/checks.h"
#include "tests/bake/atlas/shapes.h"

namespace oriel {
namespace {

using shapes::add_quad;
using ::testing::HasSubstr;

TEST(AtlasLayout, TexelFarTooLargeGivesOneTexelACharts) {
  Scene scene = shapes::empty_scene();
  shapes::add_box(scene, "cube", Vec3(0), Vec3(1));
  AtlasOptions options;
  options.texel_m = 1e6f;
  const Built built = build(scene, options);
  expect_sound(scene, built);
  EXPECT_EQ(texel_count(built.map), 6u);
}

TEST(AtlasLayout, ChartLargerThanAPageIsCoarsened) {
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

TEST(AtlasLayout, SeveralPages) {
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

TEST(AtlasLayout, PaddingIsKept) {
  Scene scene = shapes::empty_scene();
  for (int i = 0; i < 30; ++i)
    add_quad(scene, "q", {0, 0, static_cast<float>(i)}, {0.35f + 0.1f * i, 0, 0}, {0, 0.72f, 0});
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

TEST(AtlasLayout, ResolutionFillsOnePage) {
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

TEST(AtlasLayout, ResolutionTooSmallSaysWhatFits) {
  Scene scene = shapes::empty_scene();
  for (int i = 0; i < 100; ++i) add_quad(scene, "q", {0, 0, static_cast<float>(i)}, {1, 0, 0}, {0, 1, 0});
  AtlasOptions options;
  options.resolution = 16;
  const Error error = build_error(scene, options);
  EXPECT_EQ(error.code, ErrorCode::kRuntime);
  EXPECT_THAT(error.text(), HasSubstr("100 charts do not fit into one page of 16x16 texels; about 32x32"));
}

TEST(AtlasLayout, TooManyPagesSaysWhichTexelFits) {
  Scene scene = shapes::empty_scene();
  for (int i = 0; i < 5000; ++i) add_quad(scene, "q", {0, 0, static_cast<float>(i)}, {1, 0, 0}, {0, 1, 0});
  AtlasOptions options;
  options.max_page = 16;
  options.texel_m = 0.0625f;
  const Error error = build_error(scene, options);
  EXPECT_EQ(error.code, ErrorCode::kRuntime);
  EXPECT_THAT(error.text(), HasSubstr("more than 4096 pages of 16x16 texels; a texel of"));
}

TEST(AtlasLayout, UnlitSurfacesHaveNoPlace) {
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

TEST(AtlasLayout, OptionsAreChecked) {
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
}

Scene mixed_scene() {
  Scene scene = shapes::empty_scene();
  shapes::add_box(scene, "room", Vec3(0), Vec3(6, 3, 5));
  shapes::add_icosphere(scene, "sphere", 1, 4);
  shapes::add_cylinder(scene, "column", 0.3f, 3, 24, 8);
  shapes::add_spiral(scene, "ramp", 1, 2, 3, 40);
  return scene;
}

TEST(AtlasLayout, SameBytesFromOneAndTwoThreads) {
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

TEST(AtlasLayout, SoupOfManyTriangles) {
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
  shapes::add(scene, "soup", p, t);
  const Built built = build(scene);
  expect_sound(scene, built);
  EXPECT_EQ(built.atlas.chart_count, 200000u);
  EXPECT_LE(built.atlas.pages.size(), 3u);
}

TEST(AtlasLayout, StopIsObeyed) {
  const Scene scene = mixed_scene();
  Context context;
  context.stop = true;
  const auto atlas = build_atlas(scene, {}, context);
  ASSERT_FALSE(atlas.has_value());
  EXPECT_EQ(atlas.error().code, ErrorCode::kStopped);
}

}  // namespace
}  // namespace oriel
