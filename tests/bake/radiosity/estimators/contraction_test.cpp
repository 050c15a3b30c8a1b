// Bounces die away or end, and samples that are no numbers stay out, whatever the scene.
#include <gtest/gtest.h>

#include "bake/radiosity/estimators/patches.h"
#include "tests/bake/radiosity/baked.h"
#include "tests/bake/radiosity/listed.h"

namespace oriel {
namespace {

using test::Listed;
using test::SceneParts;

// Sweeps over a scene with so much direct light everywhere.
struct Swept {
  std::vector<std::string> warnings;
  Sweeps sweeps;

  Swept(Listed& scene, const SweepOptions& options, int max_bounces, float direct = 1) {
    Transport transport = scene.transport();
    transport.options.max_bounces = max_bounces;
    scene.context.warn = [this](const Warning& said) { warnings.push_back(said.text); };
    const TexelGraph graph = *find_neighbours(transport, scene.texels, scene.context);
    const CacheQuery query(transport, scene.texels, true, scene.context.seed);
    const std::vector<Vec3> light(scene.texels.count(), Vec3(direct));
    sweeps = *sweep({scene.texels, graph, query, light}, options, scene.context);
  }
  float largest() const {
    float most = 0;
    for (const Vec3& e : sweeps.gathered)
      if (!(max_component(e) <= most)) most = max_component(e);
    return most;
  }
};

// A third is mirrored, the rest scattered: nothing is absorbed, and what a ray finds is different each time.
SceneMaterial white_gloss() {
  SceneMaterial m;
  m.name = "white";
  m.base_color = Vec3(1);
  m.metallic = 0;
  m.ior = 4;
  m.specular = 1;
  m.roughness = 0.3f;
  return m;
}

// Nothing is absorbed, and few rays from few patches: by their noise half of such boxes hand on more than they get.
TEST(Contraction, NoiseInAWhiteBoxDoesNotGrow) {
  constexpr int kBounces = 2000;
  std::size_t bounded = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SceneParts parts;
    parts.box("box", parts.add(white_gloss()), Vec3(-1), Vec3(1), true);
    Listed box(parts.finish(), 1, seed);
    const Swept swept(box, {.rays_per_patch = 8}, kBounces);
    bounded += swept.sweeps.bounded;
    // E₀ a bounce at most.
    EXPECT_LE(swept.largest(), 1.01f * static_cast<float>(swept.sweeps.count)) << seed;
    EXPECT_LE(swept.sweeps.growth, 1.001) << seed;
  }
  EXPECT_GT(bounded, 0u) << "no patch hands on too much: the test shows nothing";
}

// A grey cube in a box of rough metal: light comes back to its few patches by way of many reflections, and few rays
// tell poorly how much: up to 20 times as much is found without any bound, 20 000 times where all that came is handed
// on. (Four rays, where bakes trace 64: with eight no patch is found to hand on too much.)
TEST(Contraction, NoiseAmongFewPatchesDoesNotTrapLight) {
  const auto largest = [](std::uint32_t rays, std::uint64_t seed, std::size_t& bounded) {
    SceneParts parts;
    SceneMaterial metal;
    metal.name = "metal";
    metal.base_color = Vec3(0.947f);
    metal.metallic = 1;
    metal.roughness = 0.93f;
    parts.box("box", parts.add(metal), Vec3(-0.24f), Vec3(0.24f), true);
    parts.box("cube", parts.diffuse(Vec3(0.48f)), Vec3(-0.08f), Vec3(0.08f));
    Listed box(parts.finish(), 0.16f, seed);
    const Swept swept(box, {.rays_per_patch = rays}, 4096);
    bounded += swept.sweeps.bounded;
    return swept.largest();
  };
  std::size_t bounded = 0;
  const float truth = largest(4096, 1, bounded);
  EXPECT_EQ(bounded, 0u);
  for (std::uint64_t seed = 1; seed <= 40; ++seed) EXPECT_LT(largest(4, seed, bounded), 25 * truth) << seed;
  EXPECT_GT(bounded, 0u) << "no patch hands on too much: the test shows nothing";
}

// E = E₀ ρ / (1 - ρ): patches that hand on no more than they get are left as they are.
TEST(Contraction, ASaneRoomIsNotTouched) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.9f)), Vec3(-1), Vec3(1), true);
  Listed room(parts.finish(), 0.2f);
  const Swept swept(room, {.rays_per_patch = 16, .tolerance = 1e-4}, 4096);
  EXPECT_EQ(swept.sweeps.bounded, 0u);
  EXPECT_NEAR(swept.largest(), 9, 0.02);
  EXPECT_NEAR(swept.sweeps.growth, 0.9, 1e-3);
  EXPECT_TRUE(swept.warnings.empty());
}

// A closed room that absorbs nothing: as many bounces as paths follow, one E₀ each, and a word about it.
TEST(Contraction, WhatAbsorbsNothingEndsWithAnAnswerAndAFinding) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(1)), Vec3(-1), Vec3(1), true);
  Listed room(parts.finish(), 0.5f);
  const Swept swept(room, {.rays_per_patch = 16}, 4096);
  EXPECT_EQ(swept.sweeps.count, 4096);
  EXPECT_NEAR(swept.largest(), 4096, 1);
  ASSERT_EQ(swept.warnings.size(), 1u);
  EXPECT_NE(swept.warnings[0].find("hardly dies away"), std::string::npos) << swept.warnings[0];
}

TEST(Contraction, SweepsEndWhenThereIsEnough) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(1)), Vec3(-1), Vec3(1), true);
  Listed room(parts.finish(), 0.5f);
  EXPECT_EQ(Swept(room, {.rays_per_patch = 16, .enough = [] { return true; }}, 4096).sweeps.count, 200);
}

// A lamp whose light no float holds once it is squared: its samples are dropped and told of, the other lamp is baked.
TEST(DroppedSamples, ALampBeyondAllNumbersIsLeftOut) {
  for (const Estimator estimator : {Estimator::kCached, Estimator::kReference}) {
    SceneParts parts;
    parts.box("room", parts.diffuse(Vec3(0.5f)), Vec3(-1), Vec3(1), true);
    Light lamp, absurd;
    lamp.type = absurd.type = LightType::kPoint;
    lamp.intensity = Vec3(10), absurd.intensity = Vec3(1e20f);
    absurd.position = Vec3(0.5f);
    parts.scene().lights = {lamp, absurd};
    Listed room(parts.finish(), 0.25f);
    RadiosityOptions options;
    options.estimator = estimator;
    options.samples = 64;
    options.verify = 0;
    const Radiosity baked = *bake_radiosity({room.transport(), room.atlas, room.map}, options, room.context);
    EXPECT_GT(room.accel->dropped().count(), 0u);
    EXPECT_LT(room.accel->dropped().first_triangle(), room.scene.triangles.size());
    for (const LightmapPage& page : baked.pages)
      for (const Vec3& e : page.irradiance) ASSERT_TRUE(is_finite(e) && max_component(e) < 1e4f) << max_component(e);
    EXPECT_TRUE(std::isfinite(baked.report.relative_error));
  }
}

TEST(DroppedSamples, KeepTheLowestTriangle) {
  DroppedSamples dropped;
  dropped.add(DroppedSamples::kNowhere);
  EXPECT_EQ(dropped.first_triangle(), DroppedSamples::kNowhere);
  for (const std::uint32_t t : {7u, 3u, 9u}) dropped.add(t);
  EXPECT_EQ(dropped.first_triangle(), 3u);
  EXPECT_EQ(dropped.count(), 4u);
  EXPECT_FALSE(is_usable(Vec3(0, std::nanf(""), 0)));
  EXPECT_FALSE(is_usable(Vec3(2 * kAbsurdLight)));
  EXPECT_TRUE(is_usable(Vec3(-1, 0, 1e12f)));
}

}  // namespace
}  // namespace oriel
