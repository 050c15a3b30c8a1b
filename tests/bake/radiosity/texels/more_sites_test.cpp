// Points of texels beyond those that are kept.
#include "bake/radiosity/texels/more_sites.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/bake/support/scene_parts.h"

namespace oriel::test {
namespace {

// A floor of one texel of 1 m, of which all but the strip x > 0.8 m lies under a block that stands in it.
struct Strip {
  Scene scene;
  Context context;
  Atlas atlas;
  std::vector<TexelMapPage> map;
  std::optional<Accel> accel;
  std::optional<LightSet> lights;
  Texels texels;
  std::uint32_t floor = kNoTexel;

  Strip() {
    SceneParts parts;
    parts.quad("floor", parts.diffuse(Vec3(0.5f)), {0, 0, 0}, {0, 0, 1}, {1, 0, 0});
    parts.box("block", parts.diffuse(Vec3(0.5f)), {-1, -1, -1}, {0.8f, 1, 2});
    scene = parts.finish();
    AtlasOptions options;
    options.texel_m = 1;
    atlas = *build_atlas(scene, options, context);
    map = *build_texel_map(atlas, context);
    accel.emplace(*Accel::build(scene));
    lights.emplace(scene);
    std::atomic<std::uint64_t> rays{0};
    texels = *list_texels(transport(), atlas, map, context, rays);
    for (std::uint32_t i = 0; i < texels.count(); ++i)
      if (scene.triangle_surface[map[texels.page[i]].fragments[map[texels.page[i]].first[texels.index[i]]].triangle] ==
          0)
        floor = i;
  }
  Transport transport() const { return {*accel, *lights, {}}; }
};

TEST(MoreSites, LieInThePartThatSeesLight) {
  const Strip strip;
  ASSERT_NE(strip.floor, kNoTexel);
  ASSERT_NEAR(strip.texels.visible[strip.floor], 0.2, 0.08);
  const Transport transport = strip.transport();
  const MoreSites sites(transport, strip.atlas, strip.map, strip.texels, strip.context.seed);
  constexpr std::uint32_t kPoints = 512;
  for (int half = 0; half < kHalves; ++half) {
    const std::uint32_t kept = strip.texels.kept_sites(strip.floor, half);
    ASSERT_LT(kept, kPoints / 4);
    std::set<std::pair<float, float>> points;
    double x = 0, z = 0;
    std::uint64_t rays = 0;
    for (std::uint32_t k = 0; k < kPoints; ++k) {
      const TexelSite site = sites.at(strip.floor, half, k, rays);
      if (k < kept) {
        EXPECT_EQ(site.origin, strip.texels.site_for(strip.floor, half, k).origin);
      }
      EXPECT_GT(site.origin.x, 0.8f);
      points.emplace(site.origin.x, site.origin.z);
      x += site.origin.x / kPoints, z += site.origin.z / kPoints;
    }
    EXPECT_EQ(points.size(), kPoints) << "none comes twice";
    EXPECT_NEAR(x, 0.9, 4 * 0.2 / std::sqrt(12.0 * kPoints));
    EXPECT_NEAR(z, 0.5, 4 * 1.0 / std::sqrt(12.0 * kPoints));
    EXPECT_GT(rays, kPoints - kept);
  }
}

}  // namespace
}  // namespace oriel::test
