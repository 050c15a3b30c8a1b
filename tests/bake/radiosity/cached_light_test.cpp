// Light that varies over a texel is found where it is met.
#include "bake/radiosity/gather/cached_light.h"

#include <gtest/gtest.h>

#include "tests/bake/support/scene_parts.h"

namespace oriel::test {
namespace {

// A floor of 2 m × 2 m in texels of 10 cm, with the light that falls on it.
struct Floor {
  Scene scene;
  Context context;
  Atlas atlas;
  std::vector<TexelMapPage> map;
  std::optional<Accel> accel;
  std::optional<LightSet> lights;
  Texels texels;
  TexelGraph graph;
  std::vector<Vec3> irradiance;

  explicit Floor(const std::function<Vec3(const Vec3&)>& light) {
    SceneParts parts;
    parts.quad("floor", parts.diffuse(Vec3(0.5f)), {0, 0, 0}, {0, 0, 2}, {2, 0, 0});
    scene = parts.finish();
    AtlasOptions options;
    options.texel_m = 0.1f;
    atlas = *build_atlas(scene, options, context);
    map = *build_texel_map(atlas, context);
    accel.emplace(*Accel::build(scene));
    lights.emplace(scene);
    std::atomic<std::uint64_t> rays{0};
    const Transport transport{*accel, *lights, {}};
    texels = *list_texels(transport, atlas, map, context, rays);
    graph = *find_neighbours(transport, texels, context, rays);
    for (std::size_t i = 0; i < texels.count(); ++i) {
      Vec3 centre(0);
      for (const TexelSite& site : texels.site[i]) centre += site.origin / static_cast<float>(kSites);
      irradiance.push_back(light(centre));
    }
  }
};

TEST(CachedLight, LinearLightIsMetExactly) {
  const auto light = [](const Vec3& p) { return Vec3(5 + p.x, 5 - p.z, 5 + p.x + 2 * p.z); };
  Floor floor(light);
  const CachedLight cached = cache_light(floor.texels, floor.graph, floor.irradiance, floor.context);
  for (std::size_t i = 0; i < floor.texels.count(); ++i)
    for (const TexelSite& site : floor.texels.site[i]) {
      const Vec3 expected = light(site.origin) * (0.5f / kPi), found = cached.texels[i].at(site.origin);
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 2e-3f * expected[c]);
    }
}

TEST(CachedLight, AStepBringsNoLightBelowZero) {
  Floor floor([](const Vec3& p) { return Vec3(p.x < 1 ? 0.0f : 1000.0f); });
  const CachedLight cached = cache_light(floor.texels, floor.graph, floor.irradiance, floor.context);
  for (std::size_t i = 0; i < floor.texels.count(); ++i)
    for (const TexelSite& site : floor.texels.site[i]) {
      const Vec3 found = cached.texels[i].at(site.origin);
      EXPECT_GE(found.g, 0);
      EXPECT_LE(found.g, 2 * 500 / kPi + 1e-3f);
      EXPECT_EQ(found.g == 0, floor.irradiance[i].g == 0);
    }
}

}  // namespace
}  // namespace oriel::test
