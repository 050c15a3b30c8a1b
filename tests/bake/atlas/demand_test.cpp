// Texels as fine as people's views want them.
#include <gtest/gtest.h>

#include "tests/bake/atlas/checks.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

// Four walls of 8 x 4 m apart from one another; what eyes see of each is the test's.
Scene walls() {
  SceneParts parts;
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  for (int i = 0; i < 4; ++i) parts.quad("wall", m, {0, 0, -3.0f * static_cast<float>(i)}, {8, 0, 0}, {0, 4, 0});
  return parts.finish();
}

TexelDemand demand(std::initializer_list<float> distances, float pixels = 100) {
  TexelDemand demand;
  demand.angle_rad = 0.05;
  for (const float d : distances)
    for (int half = 0; half < 2; ++half)
      demand.triangles.push_back(d > 0 ? TriangleDemand{pixels, pixels / (d * d), d} : TriangleDemand{0, 0, 1});
  return demand;
}

// Covered texels of each surface.
std::vector<std::size_t> texels_of(const Scene& scene, const AtlasOptions& options, const TexelDemand& demand) {
  Context context;
  const auto atlas = build_atlas(scene, options, context, demand);
  EXPECT_TRUE(atlas) << (atlas ? "" : atlas.error().text());
  const auto map = *build_texel_map(*atlas, context);
  std::vector<std::size_t> count(scene.surfaces.size());
  for (const TexelMapPage& page : map)
    for (std::size_t i = 0; i < page.texel.size(); ++i)
      ++count[scene.triangle_surface[page.fragments[page.first[i]].triangle]];
  return count;
}

TEST(TexelDemand, ChartsGetTheTexelOfTheirDistance) {
  // 0.05 rad from 1, 2, 8 m, and one that nobody sees: 5 cm would be finer than asked for.
  const auto count = texels_of(walls(), {.texel_m = 0.1f}, demand({1, 2, 8, 0}));
  EXPECT_EQ(count, (std::vector<std::size_t>{80 * 40, 80 * 40, 20 * 10, 20 * 10}));
}

TEST(TexelDemand, ASurfaceThatAsksForATexelGetsIt) {
  Scene scene = walls();
  scene.surfaces[1].texel_m = 0.05f;  // finer than any
  scene.surfaces[3].texel_m = 0.4f;
  const auto count = texels_of(scene, {.texel_m = 0.1f}, demand({1, 1, 8, 1}));
  EXPECT_EQ(count, (std::vector<std::size_t>{80 * 40, 160 * 80, 20 * 10, 20 * 10}));
}

TEST(TexelDemand, AnArtistsSurfaceHasOneTexelForAllItsCharts) {
  Scene scene = walls();
  for (std::size_t i = 0; i < 4; ++i) scene.surfaces[i].has_uv1 = i == 2;
  for (const std::uint32_t t : {4u, 5u})
    for (int k = 0; k < 3; ++k) scene.uv1[scene.triangles[t][k]] = 0.1f * Vec2(scene.positions[scene.triangles[t][k]]);
  TexelDemand seen = demand({1, 1, 4, 1});
  seen.triangles[5] = {0, 0, 1};  // half of it is seen by nobody
  const auto count = texels_of(scene, {.source = AtlasOptions::Source::kUv1, .texel_m = 0.1f}, seen);
  EXPECT_EQ(count[2], 40u * 20) << "0.05 rad from 4 m";
  EXPECT_EQ(count[0], 80u * 40) << "charts of ours are as they were";
}

TEST(TexelDemand, WhatIsSeenLittleGetsLargerTexels) {
  TexelDemand seen = demand({1, 1, 1, 1});
  for (int t = 6; t < 8; ++t) seen.triangles[t].pixels /= 1000, seen.triangles[t].inverse_square /= 1000;
  const auto count = texels_of(walls(), {.texel_m = 0.1f}, seen);
  EXPECT_EQ(count[0], 80u * 40);
  EXPECT_EQ(count[3], 27u * 14);  // three times as large
}

TEST(TexelDemand, MemoryTakesFromWhatIsSeenLeast) {
  TexelDemand seen = demand({1, 1, 1, 1});
  for (int t = 2; t < 8; ++t) seen.triangles[t].pixels /= 100, seen.triangles[t].inverse_square /= 100;
  AtlasOptions options{.texel_m = 0.1f, .memory_bytes = 5000 * 800, .coarsen = true};
  const auto count = texels_of(walls(), options, seen);
  EXPECT_EQ(count[0], 80u * 40);  // nobody's is finer than what is seen a hundred times as much
  EXPECT_LT(count[0] + count[1] + count[2] + count[3], 5000u);
  EXPECT_GT(count[1], 150u);
}

TEST(TexelDemand, ChartsEndWhereTheDistanceDoubles) {
  SceneParts parts;
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  for (int i = 0; i < 8; ++i)  // one strip of 320 m, of eight squares
    parts.quad("strip", m, {40.0f * static_cast<float>(i), 0, 0}, {40, 0, 0}, {0, 40, 0});
  Scene scene = parts.finish();
  scene.surfaces.resize(1);  // all in one
  scene.surfaces[0].triangle_count = 16,
  scene.surfaces[0].vertex_count = static_cast<std::uint32_t>(scene.positions.size());
  for (auto& s : scene.triangle_surface) s = 0;
  TexelDemand rings;
  rings.angle_rad = 0.05;
  for (std::uint32_t t = 0; t < 16; ++t)
    rings.triangles.push_back({100, 100 / ((20.0f + 20 * t) * (20 + 20 * t)), 20.0f * static_cast<float>(t / 2 * 2)});
  Context context;
  const auto atlas = build_atlas(scene, {.texel_m = 0.5f}, context, rings);
  ASSERT_TRUE(atlas);
  for (std::uint32_t a = 0; a < 16; ++a)
    for (std::uint32_t b = 0; b < 16; ++b)
      EXPECT_TRUE(atlas->chart[a] != atlas->chart[b] || rings.ring(a) == rings.ring(b)) << a << ' ' << b;
  EXPECT_GT(atlas->chart_count, 3u);
}

TEST(TexelDemand, BlackThingsThatShineHaveNoTexels) {
  SceneParts parts;
  parts.quad("wall", parts.diffuse(Vec3(0.5f)), Vec3(0), {8, 0, 0}, {0, 4, 0});
  SceneMaterial dome;
  dome.base_color = Vec3(0), dome.metallic = 0, dome.emission = Vec3(10);
  parts.quad("dome", parts.add(dome), {0, 0, 5}, {800, 0, 0}, {0, 400, 0});
  SceneMaterial screen = dome;
  screen.emission = Vec3(0);  // its gloss shows
  parts.quad("screen", parts.add(screen), {0, 0, 6}, {1, 0, 0}, {0, 1, 0});
  const Scene scene = parts.finish();
  Context context;
  const auto atlas = build_atlas(scene, {}, context, demand({1, 1, 1}));
  ASSERT_TRUE(atlas);
  EXPECT_GE(atlas->page[0], 0);
  EXPECT_EQ(atlas->page[2], -1);
  EXPECT_GE(atlas->page[4], 0);
}

}  // namespace
}  // namespace oriel
