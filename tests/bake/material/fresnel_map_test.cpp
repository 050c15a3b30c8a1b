// Fresnel maps against the exact reflectance that they approximate.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bake/material/reflectance.h"

namespace oriel {
namespace {

SpecularLayers schlick(const Vec3& f0, float f90, float alpha) {
  return {{f0, f90, alpha, {}}, 0, 0};
}

SpecularLayers metal(Metal which, float alpha) {
  return {{Vec3(metal_f0(which)), 1, alpha, {.metal = which}}, 0, 0};
}

SpecularLayers dielectric(double eta, float alpha) {
  const auto ior = static_cast<float>(eta);
  return {{Vec3(static_cast<float>(dielectric_f0(ior))), 1, alpha, {.ior = ior, .schlick = 0}}, 0, 0};
}

TEST(FresnelMap, IsMonotonicInF0AndNeverAboveOne) {
  for (const float alpha : {0.0f, 0.01f, 0.25f, 1.0f}) {
    const FresnelMap black = make_fresnel_map(schlick(Vec3(0), 0, alpha)),
                     glass = make_fresnel_map(schlick(Vec3(0.04f), 1, alpha)),
                     gold = make_fresnel_map(schlick({1.0f, 0.78f, 0.34f}, 1, alpha)),
                     white = make_fresnel_map(schlick(Vec3(1), 1, alpha));
    for (int i = 0; i <= 100; ++i) {
      const float cosine = static_cast<float>(i * i) / 10000;
      EXPECT_EQ(fresnel_lookup(black, cosine), Vec3(0));
      EXPECT_LE(fresnel_lookup(glass, cosine).g, fresnel_lookup(gold, cosine).g + 1e-6f);
      EXPECT_LE(fresnel_lookup(gold, cosine).b, fresnel_lookup(gold, cosine).r + 1e-6f);
      EXPECT_LE(fresnel_lookup(gold, cosine).r, fresnel_lookup(white, cosine).r + 1e-6f);
      EXPECT_NEAR(fresnel_lookup(white, cosine).r, 1, 2e-3) << alpha << " " << cosine;
    }
  }
}

constexpr int kProbes = 400;

double max_difference(const Vec3& a, const Vec3& b) {
  return max_component(glm::abs(a - b));
}

// The largest difference of any channel from the exact R over angles that are dense at grazing.
double measure_error(const FresnelMap& map, const SpecularLayers& layers) {
  const ExactLayers exact(layers);
  double error = 0;
  for (int i = 0; i <= kProbes; ++i) {
    const double root = static_cast<double>(i) / kProbes;
    const auto cos_theta = static_cast<float>(root * root * root);
    const Vec3 r = exact(cos_theta);
    error = std::max(error, max_difference(r, fresnel_lookup(map, cos_theta)));
  }
  return error;
}

// The table that the player reads keeps its error for all metals and from an index that hardly reflects to diamond.
TEST(FresnelMap, TableIsWithinAThousandthOfExact) {
  for (const float alpha : {0.0f, 0.01f, 0.1f, 0.5f}) {
    for (int m = 0; m < kMetalCount; ++m) {
      const SpecularLayers layers = metal(static_cast<Metal>(m), alpha);
      EXPECT_LT(measure_error(make_fresnel_map(layers), layers), 1e-3)
          << constants_of(static_cast<Metal>(m)).name << " " << alpha;
    }
    for (const double eta : {1.0001, 1.33, 1.5, 2.5}) {
      const SpecularLayers layers = dielectric(eta, alpha);
      EXPECT_LT(measure_error(make_fresnel_map(layers), layers), 1e-3) << eta << " " << alpha;
    }
  }
  // The checker sees a table that is too small.
  const SpecularLayers thin = dielectric(1.0001, 0);
  EXPECT_GT(measure_error(make_fresnel_map(thin, {.max_entries = 65}), thin), 1e-3);
}

TEST(FresnelMap, MirrorFollowsTheExactEquationsTo90Degrees) {
  const FresnelMap map = make_fresnel_map(dielectric(1.5, 0));
  EXPECT_NEAR(map.table.back().r, 0.04f, 1e-6);
  EXPECT_EQ(map.table.front().r, 1);
  for (int i = 0; i <= 100; ++i) {
    const double cosine = i / 100.0;
    EXPECT_NEAR(fresnel_lookup(map, static_cast<float>(cosine)).r, fresnel_dielectric(1.5, cosine), 1e-3);
  }
}

TEST(FresnelMap, FactorsAreTheFacets) {
  const FresnelMap glass = make_fresnel_map(dielectric(1.5, 0.1f));
  ASSERT_EQ(glass.factor.size(), 65u);
  EXPECT_NEAR(glass.factor.back().g, 0.04, 1e-6);
  EXPECT_NEAR(glass.factor.front().g, 1, 1e-6);
  const double cosine = 0.25, inside = std::sqrt(1 - (1 - cosine * cosine) / 2.25);  // entry 32 of 65
  const double s = (cosine - 1.5 * inside) / (cosine + 1.5 * inside),
               p = (1.5 * cosine - inside) / (1.5 * cosine + inside);
  EXPECT_NEAR(glass.factor[32].g, 0.5 * (s * s + p * p), 1e-6);
  EXPECT_TRUE(make_fresnel_map(dielectric(1.5, 0)).factor.empty()) << "a mirror has one direction";
}

// Figure 6 of Bastos et al.: gold is red-yellow from above and white at the rim.
TEST(FresnelMap, GoldTurnsWhiteAtGrazing) {
  const FresnelMap map = make_fresnel_map(metal(Metal::kGold, 0.01f));
  const Vec3 centre = map.table.back(), rim = map.table.front();
  EXPECT_NEAR(centre.r, 0.94f, 0.01);
  EXPECT_NEAR(centre.g, 0.70f, 0.01);
  EXPECT_NEAR(centre.b, 0.40f, 0.01);
  EXPECT_GT(rim.b, 0.9f);
  EXPECT_LT(rim.r - rim.b, 0.1f);
}

// kd + ks <= 1: the lobe and what it leaves to the diffuse one, by construction at most 1; here that R itself is.
TEST(FresnelMap, LayersNeverExceedOne) {
  for (const float coat : {0.0f, 0.5f, 1.0f}) {
    SpecularLayers layers = schlick(Vec3(1), 1, 0.3f);
    layers.coat = coat;
    layers.coat_alpha = 0.01f;
    for (const Vec3& r : make_fresnel_map(layers).table) EXPECT_LE(max_component(r), 1);
  }
}

TEST(FresnelMap, LookupInterpolatesTheTable) {
  const FresnelMap map = make_fresnel_map(schlick(Vec3(0.04f, 0.2f, 0.6f), 1, 0.01f));
  for (const float cosine : {0.01f, 0.3f, 0.77f, 1.0f})
    EXPECT_NEAR(fresnel_lookup(map, cosine).g, specular_reflectance({Vec3(0.04f, 0.2f, 0.6f), 1, 0.01f, {}}, cosine).g,
                2e-3);
  EXPECT_EQ(fresnel_lookup(map, 2), map.table.back());
  EXPECT_EQ(fresnel_lookup(map, std::numeric_limits<float>::quiet_NaN()), map.table.front());
  EXPECT_EQ(fresnel_lookup(FresnelMap{}, 0.5f), Vec3(0));
}

TEST(FresnelMap, BadNumbersAreClamped) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const FresnelMap map = make_fresnel_map(schlick({nan, inf, -1}, nan, nan), {.min_entries = 0, .max_entries = 2});
  EXPECT_EQ(map.table.size(), 2u);
  for (const Vec3& r : map.table) {
    EXPECT_TRUE(is_finite(r));
    EXPECT_LE(max_component(r), 1);
  }
}

}  // namespace
}  // namespace oriel
