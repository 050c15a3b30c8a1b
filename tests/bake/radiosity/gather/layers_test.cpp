// Specular layers over texels: what they leave to the diffuse reflection, and how often paths go on from them.
#include <gtest/gtest.h>

#include "bake/radiosity/gather/gather_point.h"
#include "bake/radiosity/gather/survival.h"
#include "bake/trace/albedo.h"
#include "tests/bake/radiosity/listed.h"

namespace oriel::test {
namespace {

SceneMaterial gloss(const Vec3& albedo, float roughness) {
  SceneMaterial m;
  m.name = "gloss";
  m.base_color = albedo;
  m.metallic = 0;
  m.roughness = roughness;
  return m;
}

TEST(DiffuseShare, IsWhatLayersLeave) {
  for (const float alpha : {0.0f, 0.01f, 0.25f, 1.0f})
    for (const float coat : {0.0f, 1.0f}) {
      ShadePoint point;
      point.alpha = alpha, point.coat = coat, point.curve = {.ior = 1.5f, .schlick = 0};
      const DiffuseShare share(std::array{point});
      for (float cosine = 0; cosine <= 1; cosine += 0.01f) {
        const float expected = 1 - max_component(reflectance(point, cosine));
        const float tolerance = cosine > 0.2f ? 0.003f : cosine > 0.03f ? 0.01f : 0.05f;
        EXPECT_NEAR(share.at(cosine), expected, tolerance) << alpha << ' ' << coat << ' ' << cosine;
      }
    }
}

TEST(DiffuseShare, IsTheMeanOverPoints) {
  ShadePoint mirror, matt;
  mirror.f0 = Vec3(1);
  matt.f0 = Vec3(0), matt.f90 = 0;
  EXPECT_NEAR(DiffuseShare(std::array{mirror, matt}).at(1), 0.5f * (2 - max_component(reflectance(mirror, 1))), 1e-3f);
  EXPECT_EQ(DiffuseShare().at(0.3f), 1);
}

// The mean light, and its variance, of rays that fall on a glossy floor of albedo 0.5 under a sky of radiance 1, the
// irradiance being π.
struct Seen {
  double mean = 0, variance = 0;
};
Seen look_down(float roughness, float cosine, float survival) {
  SceneParts parts;
  parts.quad("floor", parts.add(gloss(Vec3(0.5f), roughness)), {0, 0, 0}, {0, 0, 2}, {2, 0, 0});
  Listed listed(parts.finish(), 0.25f);
  listed.scene.sky = Vec3(1);
  listed.accel.emplace(*Accel::build(listed.scene));
  const Transport transport = listed.transport();
  CacheQuery query(transport, listed.texels, true, 1);
  query.set_survival({survival});
  constexpr int kRays = 40000;
  const Vec3 direction(std::sqrt(1 - cosine * cosine), -cosine, 0);
  const std::vector<Ray> rays(kRays, Ray{Vec3(1.02f, 0, 1.03f) - 0.5f * direction, direction});
  std::vector<GatherRay> info(kRays, GatherRay{.incidence = 1});
  for (std::uint32_t i = 0; i < kRays; ++i) info[i].sample = i;
  QueryResults results;
  query.evaluate(rays, info, results);
  double sum = 0, squares = 0;
  for (int i = 0; i < kRays; ++i) {
    const double light = results.light[i].g + results.share[i] * listed.texels.albedo[results.texel[i]].g;
    sum += light, squares += light * light;
  }
  return {sum / kRays, squares / kRays - sum * sum / kRays / kRays};
}

// In a furnace the light is R + (1 - R) / 2.
TEST(CacheQuery, GlossInAFurnaceWhateverTheSurvival) {
  for (const float roughness : {0.1f, 0.5f, 1.0f})
    for (const float cosine : {0.9f, 0.4f}) {
      ShadePoint point;
      point.alpha = roughness * roughness;
      point.curve = {.ior = 1.5f, .schlick = 0};
      const double expected = 0.5 * (1 + max_component(reflectance(point, cosine)));
      const Seen seldom = look_down(roughness, cosine, 0.5f), often = look_down(roughness, cosine, 64);
      EXPECT_NEAR(seldom.mean, expected, 0.006 * expected) << roughness << ' ' << cosine;
      EXPECT_NEAR(often.mean, expected, 0.006 * expected) << roughness << ' ' << cosine;
      EXPECT_LT(often.variance, 0.3 * seldom.variance) << roughness << ' ' << cosine;
    }
}

// A polished floor before a window, once far brighter than what else there is, once far darker.
TEST(Survival, IsHigherWhereLayersReflectBrightThings) {
  const auto learnt = [](float window) {
    SceneParts parts;
    const std::uint32_t polished = parts.add(gloss(Vec3(0.3f), 0.1f)), wall = parts.diffuse(Vec3(0.5f));
    parts.quad("floor", polished, {0, 0, 0}, {0, 0, 4}, {4, 0, 0});
    parts.quad("wall", wall, {0, 0, 0}, {0, 3, 0}, {0, 0, 4});
    parts.quad("window", parts.diffuse(Vec3(0), Vec3(window)), {3, 1, 0}, {0.6f, 0, 0}, {0, 1, 0});
    Listed room(parts.finish(), 0.25f);
    const Transport transport = room.transport();
    const TexelGraph graph = *find_neighbours(transport, room.texels, room.context);
    CacheQuery query(transport, room.texels, true, 1);
    std::vector<std::uint32_t> order = coherent_order(room.texels);
    const std::vector<Vec3> irradiance(room.texels.count(), Vec3(1));
    const CachedLight cached = cache_light(room.texels, graph, irradiance, room.context);
    EXPECT_TRUE(learn_survival(room.texels, query, order, cached, room.context));
    return query.survival();
  };
  const std::vector<float> bright = learnt(1000), dull = learnt(0.01f);
  EXPECT_GE(bright[0], 16);
  EXPECT_LE(dull[0], 2);
  EXPECT_EQ(bright[1], 1) << "the wall has no layers";
  EXPECT_EQ(bright, learnt(1000.5f)) << "a small change changes nothing";
}

}  // namespace
}  // namespace oriel::test
