// Which maps a scene needs, and what is shared.
#include "bake/material/materials.h"

#include <gtest/gtest.h>

#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

SceneMaterial glossy(float roughness, float metallic = 0) {
  SceneMaterial m;
  m.name = "glossy";
  m.base_color = Vec3(0.8f);
  m.roughness = roughness;
  m.metallic = metallic;
  return m;
}

TEST(Materials, ShareMapsThatAreTheSame) {
  test::SceneParts parts;
  parts.add(glossy(0.1f));
  parts.add(glossy(0.1f, 1));  // same kernel, other reflectance
  parts.add(glossy(0.1f));     // both the same
  parts.add(glossy(0.5f));     // still narrow enough
  parts.add(glossy(0.9f));     // too rough for a kernel
  parts.diffuse(Vec3(0.5f));   // no specular lobe... but a Lambert surface
  SceneMaterial unlit = glossy(0);
  unlit.unlit = true;
  parts.add(unlit);
  parts.add(glossy(0.8f, 1));  // a metal's lobe shows highlights
  for (std::uint32_t m = 0; m < 8; ++m) parts.quad("q", m, {0, 0, static_cast<float>(m)}, {1, 0, 0}, {0, 2, 0});
  const Scene scene = parts.finish();
  Context context;
  const auto maps = bake_materials(scene, {}, context);
  ASSERT_TRUE(maps);
  EXPECT_EQ(maps->kernels.size(), 3u);
  EXPECT_EQ(maps->fresnel_maps.size(), 5u);
  EXPECT_EQ(maps->kernel, (std::vector<std::int32_t>{0, 0, 0, 1, -1, -1, -1, 2}));
  EXPECT_EQ(maps->fresnel_map, (std::vector<std::int32_t>{0, 1, 0, 2, 3, -1, -1, 4}));
  EXPECT_NEAR(maps->kernels[0].alpha, 0.01f, 1e-6);
  EXPECT_NEAR(maps->fresnel_maps[0].table.back().r, 0.04f, 2e-3);
  EXPECT_NEAR(maps->fresnel_maps[1].table.back().r, 0.8f, 3e-3);
  EXPECT_DOUBLE_EQ(maps->summaries[0].area_m2, 2);
}

TEST(Materials, FactorsFollowTheConventions) {
  test::SceneParts parts;
  SceneMaterial m = glossy(0.3f, 0.25f);
  m.ior = 2;
  m.specular = 0.5f;
  m.transmission = 0.5f;
  parts.add(m);
  const Scene scene = parts.finish();
  const MaterialSummary s = summarize_materials(scene).front();
  const float dielectric = 0.5f / 9;
  EXPECT_NEAR(s.f0.r, 0.75f * dielectric + 0.25f * 0.8f, 1e-6);
  EXPECT_NEAR(s.f90, 0.75f * 0.5f + 0.25f, 1e-6);
  EXPECT_NEAR(s.alpha, 0.09f, 1e-6);
  EXPECT_NEAR(s.diffuse.r, 0.75f * 0.5f * 0.8f, 1e-6);
  EXPECT_EQ(s.area_m2, 0);
}

// How far an isotropic lobe is from an anisotropic one.
struct LobeDifference {
  double moved = 0;  // share of K that lies elsewhere, seen from above: half of L1
  double in_r = 0;   // largest difference of the single-scattering albedo, over angles and azimuths
};

LobeDifference difference_of(const Microfacet& truth, const Microfacet& used) {
  constexpr int kSide = 400;  // half vectors, drawn from D cosθ of the used lobe
  const double alpha = used.alpha_x, share = 1.0 / (kSide * kSide);
  LobeDifference out;
  for (const double cos_theta : {0.1, 0.2, 0.4, 0.7, 1.0})
    for (const double azimuth : {0.0, 0.25 * kPiD, 0.5 * kPiD}) {
      const DVec2 in_plane = std::sqrt(1 - cos_theta * cos_theta) * DVec2(std::cos(azimuth), std::sin(azimuth));
      const DVec3 wo(in_plane, cos_theta);
      double l1 = 0, in_r = 0;
      for (int i = 0; i < kSide * kSide; ++i) {
        const double u = (i / kSide + 0.5) / kSide, phi = 2 * kPiD * (i % kSide + 0.5) / kSide;
        const double slope = alpha * std::sqrt(u / (1 - u)), cos_h = 1 / std::sqrt(1 + slope * slope);
        const DVec3 h = cos_h * DVec3(slope * std::cos(phi), slope * std::sin(phi), 1), wi = reflect_at(wo, h);
        const double ratio = truth.d(h) / used.d(h), weight = std::max(0.0, glm::dot(wo, h)) / (cos_theta * cos_h);
        l1 += std::abs(ratio - 1) * share;
        if (wi.z > 0) in_r += weight * (ratio * truth.g2(wo, wi) - used.g2(wo, wi)) * share;
      }
      if (cos_theta == 1) out.moved = 0.5 * l1;
      out.in_r = std::max(out.in_r, std::abs(in_r));
    }
  return out;
}

// K and R of a brushed metal are those of the isotropic lobe of the same area in slopes: nearer than the width that the
// roughness alone gives.
TEST(Materials, BrushedMetalsTakeTheMeanWidth) {
  for (const float strength : {0.1f, 0.3f, 0.6f}) {
    test::SceneParts parts;
    SceneMaterial brushed = glossy(0.3f, 1);
    brushed.anisotropy = strength;
    parts.add(brushed);
    const double narrow = 0.09, wide = narrow + (1 - narrow) * strength * strength, mean = std::sqrt(narrow * wide);
    EXPECT_NEAR(summarize_materials(parts.finish()).front().alpha, mean, 1e-6);
    const Microfacet truth(FacetModel::kGgx, wide, narrow);
    const LobeDifference found = difference_of(truth, {FacetModel::kGgx, mean});
    const LobeDifference without = difference_of(truth, {FacetModel::kGgx, narrow});
    std::printf(
        "brushed, alpha 0.09, strength %.1f: %.1f %% of K elsewhere (%.1f %% with alpha 0.09), R off by at most "
        "%.4f (%.4f)\n",
        strength, 100 * found.moved, 100 * without.moved, found.in_r, without.in_r);
    EXPECT_LT(found.moved, without.moved);
    EXPECT_LT(found.in_r, without.in_r);
  }
}

// A texture counts by the area that shows it: three quarters of the quad's surface is black, a quarter white.
TEST(Materials, TexturesAreAveragedOverTheSurface) {
  test::SceneParts parts;
  SceneMaterial m = glossy(1, 1);
  m.base_color = Vec3(1);
  m.base_color_texture.image = 0;
  m.base_color_texture.nearest = true;
  m.metallic_roughness_texture.image = 1;
  parts.add(m);
  parts.quad("q", 0, Vec3(0), {3, 0, 0}, {0, 2, 0});
  parts.scene().images.push_back({"colour", 2, 2, {255, 255, 255, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255}});
  parts.scene().images.push_back({"mr", 1, 1, {0, 51, 128, 255}});  // roughness 0.2, metallic 0.502
  const Scene scene = parts.finish();
  const MaterialSummary s = summarize_materials(scene).front();
  EXPECT_NEAR(s.base_color.r, 0.25f, 0.01);
  EXPECT_NEAR(s.roughness, 0.2f, 1e-3);
  EXPECT_NEAR(s.alpha, 0.04f, 1e-3);
  EXPECT_NEAR(s.metallic, 128.0f / 255, 1e-3);
  EXPECT_NEAR(s.f0.r, 0.498f * 0.04f + 0.502f * 0.25f, 0.01);
  EXPECT_DOUBLE_EQ(s.area_m2, 6);
  EXPECT_EQ(summarize_materials(scene)[0].f0, s.f0);
}

TEST(Materials, SameBytesForAnyNumberOfThreads) {
  test::SceneParts parts;
  for (int i = 0; i < 8; ++i) parts.add(glossy(0.05f * static_cast<float>(i), 0.1f * static_cast<float>(i)));
  const Scene scene = parts.finish();
  Context one, two;
  one.threads = 1;
  two.threads = 2;
  const auto a = bake_materials(scene, {}, one), b = bake_materials(scene, {}, two);
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->kernels.size(), b->kernels.size());
  for (std::size_t i = 0; i < a->kernels.size(); ++i) EXPECT_EQ(a->kernels[i].weights, b->kernels[i].weights);
  ASSERT_EQ(a->fresnel_maps.size(), b->fresnel_maps.size());
  for (std::size_t i = 0; i < a->fresnel_maps.size(); ++i)
    EXPECT_EQ(a->fresnel_maps[i].table, b->fresnel_maps[i].table);
}

TEST(Materials, StopIsObeyed) {
  test::SceneParts parts;
  parts.add(glossy(0.1f));
  const Scene scene = parts.finish();
  Context context;
  context.stop = true;
  const auto maps = bake_materials(scene, {}, context);
  ASSERT_FALSE(maps);
  EXPECT_EQ(maps.error().code, ErrorCode::kStopped);
}

TEST(Materials, AnEmptySceneNeedsNothing) {
  Context context;
  const auto maps = bake_materials(Scene{}, {}, context);
  ASSERT_TRUE(maps);
  EXPECT_TRUE(maps->kernels.empty() && maps->fresnel_maps.empty() && maps->summaries.empty());
}

}  // namespace
}  // namespace oriel
