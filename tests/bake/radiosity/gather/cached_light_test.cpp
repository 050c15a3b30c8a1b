// Light that varies over a texel is found where it is met.
#include "bake/radiosity/gather/cached_light.h"

#include <gtest/gtest.h>

#include "bake/radiosity/gather/cache_query.h"
#include "tests/bake/radiosity/listed.h"

namespace oriel::test {
namespace {

Scene plain_floor() {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0.5f)), {0, 0, 0}, {0, 0, 2}, {2, 0, 0});
  return parts.finish();
}

// A floor of 2 m × 2 m in texels of 10 cm, with the light that falls on it.
struct Floor : Listed {
  TexelGraph graph;
  std::vector<Vec3> irradiance;

  explicit Floor(const std::function<Vec3(const Vec3&)>& light) : Listed(plain_floor(), 0.1f) {
    graph = *find_neighbours(transport(), texels, context);
    for (std::size_t i = 0; i < texels.count(); ++i) {
      Vec3 centre(0);
      for (const SamplePoint& point : texels.sample_points[i])
        centre += point.origin / static_cast<float>(kSamplePoints);
      irradiance.push_back(light(centre));
    }
  }
};

TEST(CachedLight, LinearLightIsMetExactly) {
  const auto light = [](const Vec3& p) { return Vec3(5 + p.x, 5 - p.z, 5 + p.x + 2 * p.z); };
  Floor floor(light);
  const CachedLight cached = cache_light(floor.texels, floor.graph, floor.irradiance, floor.context);
  for (std::size_t i = 0; i < floor.texels.count(); ++i)
    for (const SamplePoint& point : floor.texels.sample_points[i]) {
      const Vec3 expected = light(point.origin) * (0.5f / kPi), found = cached.texels[i].at(point.origin);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 2e-3f * expected[c]);
    }
}

TEST(CachedLight, AStepBringsNoLightBelowZero) {
  Floor floor([](const Vec3& p) { return Vec3(p.x < 1 ? 0.0f : 1000.0f); });
  const CachedLight cached = cache_light(floor.texels, floor.graph, floor.irradiance, floor.context);
  for (std::size_t i = 0; i < floor.texels.count(); ++i)
    for (const SamplePoint& point : floor.texels.sample_points[i]) {
      const Vec3 found = cached.texels[i].at(point.origin);
      EXPECT_GE(found.g, 0);
      EXPECT_LE(found.g, 2 * 500 / kPi + 1e-3f);
      EXPECT_EQ(found.g == 0, floor.irradiance[i].g == 0);
    }
}

// Light that is a difference of two estimates may be a little below zero.
TEST(CachedLight, LightBelowZeroIsMetAsNone) {
  for (const float step : {0.0f, 5e-4f}) {
    Floor floor([&](const Vec3& p) { return Vec3(-1e-3f + (p.x < 1 ? 0 : step)); });
    const CachedLight cached = cache_light(floor.texels, floor.graph, floor.irradiance, floor.context);
    for (std::size_t i = 0; i < floor.texels.count(); ++i)
      for (const SamplePoint& point : floor.texels.sample_points[i]) EXPECT_EQ(cached.texels[i].at(point.origin).g, 0);
  }
}

// Rays that meet a floor of 10 cm texels: from within a texel's side they are followed to where they see the sky.
TEST(CacheQuery, WhatIsNearIsFollowed) {
  Listed listed(plain_floor(), 0.1f);
  listed.scene.sky = Vec3(2);
  listed.accel.emplace(*Accel::build(listed.scene));
  const Transport transport = listed.transport();
  const CacheQuery query(transport, listed.texels, true, 1);
  const std::array info{GatherRay{.incidence = 1, .follows_near = true}};
  for (const float height : {0.08f, 0.12f}) {
    const std::array ray{Ray{{1.02f, height, 1.03f}, {0, -1, 0}}};
    QueryResults results;
    query.evaluate(ray, info, results);
    EXPECT_EQ(results.texel[0] == kNoTexel, height < 0.1f) << height;
    EXPECT_FLOAT_EQ(results.light[0].g, height < 0.1f ? 2 * 0.5f : 0) << "the sky on an albedo of a half";
  }
}

}  // namespace
}  // namespace oriel::test
