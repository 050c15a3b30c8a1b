// Fresnel maps against the exact reflectance that they approximate.
#include <fmt/format.h>
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

// R of one texel's f0 and f90 out of an entry of a split table, as shaders/lib/fresnel.glsl has it.
Vec3 split_reflectance(const Vec2& entry, const Vec3& f0, float f90) {
  const float whole = entry.x + entry.y;
  return glm::clamp((f0 * entry.x + Vec3(f90 * entry.y)) * (Vec3(1) + f0 * (1 / std::max(whole, 1e-6f) - 1)), Vec3(0),
                    Vec3(1));
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

// The largest difference of any channel from the exact R over angles that are dense at grazing; and the mean one over
// the sphere map's disk.
struct FresnelMapErrors {
  double table = 0, sphere = 0, sphere_mean = 0;
};
FresnelMapErrors measure_errors(const FresnelMap& map, const SpecularLayers& layers) {
  const ExactLayers exact(layers);
  FresnelMapErrors errors;
  for (int i = 0; i <= kProbes; ++i) {
    const double root = static_cast<double>(i) / kProbes;
    const auto cos_theta = static_cast<float>(root * root * root);
    const Vec3 r = exact(cos_theta);
    errors.table = std::max(errors.table, max_difference(r, fresnel_lookup(map, cos_theta)));
    if (!map.sphere.empty()) errors.sphere = std::max(errors.sphere, max_difference(r, sphere_lookup(map, cos_theta)));
  }
  for (int i = 0; i < kProbes && !map.sphere.empty(); ++i) {
    const auto cos_theta = static_cast<float>((i + 0.5) / kProbes);  // even in cosθ = even in the disk's area
    errors.sphere_mean += max_difference(exact(cos_theta), sphere_lookup(map, cos_theta)) / kProbes;
  }
  return errors;
}

void print(const std::string& name, float alpha, const FresnelMapErrors& errors) {
  std::printf("%-12s alpha %-4g  1-D table %.1e  sphere map %.1e (mean %.1e)\n", name.c_str(),
              static_cast<double>(alpha), errors.table, errors.sphere, errors.sphere_mean);
}

// The table that the player reads keeps its error for all metals and from an index that hardly reflects to diamond.
TEST(FresnelMap, TableIsWithinAThousandthOfExact) {
  double worst_sphere = 0;
  for (const float alpha : {0.0f, 0.01f, 0.1f, 0.5f}) {
    for (int m = 0; m < kMetalCount; ++m) {
      const SpecularLayers layers = metal(static_cast<Metal>(m), alpha);
      const FresnelMapErrors errors = measure_errors(make_fresnel_map(layers), layers);
      print(constants_of(static_cast<Metal>(m)).name, alpha, errors);
      EXPECT_LT(errors.table, 1e-3) << constants_of(static_cast<Metal>(m)).name << " " << alpha;
      worst_sphere = std::max(worst_sphere, errors.sphere);
    }
    for (const double eta : {1.0001, 1.33, 1.5, 2.5}) {
      const SpecularLayers layers = dielectric(eta, alpha);
      const FresnelMapErrors errors = measure_errors(make_fresnel_map(layers), layers);
      print(fmt::format("index {}", eta), alpha, errors);
      EXPECT_LT(errors.table, 1e-3) << eta << " " << alpha;
      if (eta > 1.1) worst_sphere = std::max(worst_sphere, errors.sphere);
    }
  }
  EXPECT_GT(worst_sphere, 1e-3) << "the trade: a sphere map of 64² has few texels at the rim";
  // The checker sees a table that is too small.
  const SpecularLayers thin = dielectric(1.0001, 0);
  const FresnelMap coarse = make_fresnel_map(thin, {.max_entries = 65});
  EXPECT_GT(measure_errors(coarse, thin).table, 1e-3);
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

// One table for every colour: the split form with compensation beside the exact R.
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

TEST(FresnelMap, SplitTableServesAnyF0) {
  const FresnelCurve curves[] = {{}, {.ior = 1.5f, .schlick = 0}};
  for (const FresnelCurve& curve : curves)
    for (const float alpha : {0.0f, 0.01f, 0.2f, 1.0f}) {
      const std::vector<Vec2> table = make_split_table(curve, alpha);
      const Vec3 f0(0.04f, 0.5f, 1);
      const ExactReflectance exact({f0, 1, alpha, curve});
      for (std::size_t i = 0; i < table.size(); i += 8) {
        const double root = static_cast<double>(i) / static_cast<double>(table.size() - 1);
        EXPECT_LT(max_component(glm::abs(split_reflectance(table[i], f0, 1) - exact(root * root))), 5e-3)
            << alpha << " " << root * root;
      }
    }
}

// Figure 6 of Bastos et al.: gold is red-yellow from above and white at the rim.
TEST(FresnelMap, GoldTurnsWhiteAtGrazing) {
  const FresnelMap map = make_fresnel_map(metal(Metal::kGold, 0.01f));
  const Vec3 centre = map.sphere[32 * 64 + 32], rim = map.table.front();
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
  EXPECT_EQ(sphere_lookup(FresnelMap{}, 0.5f), Vec3(0));
}

// Centre = normal, rim = grazing, and equal area: cosθ = 1 - r².
TEST(FresnelMap, SphereMapHoldsTheSameReflectanceAsTheTable) {
  const FresnelMap map = make_fresnel_map(schlick(Vec3(0.04f), 1, 0.04f));
  ASSERT_EQ(map.sphere.size(), 64u * 64u);
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      const double px = (x + 0.5) / 32 - 1, py = (y + 0.5) / 32 - 1, r = std::min(1.0, std::hypot(px, py));
      const double theta = 2 * std::asin(r / std::sqrt(2.0));
      EXPECT_NEAR(map.sphere[y * 64 + x].r, fresnel_lookup(map, static_cast<float>(std::cos(theta))).r, 1e-3);
    }
  EXPECT_EQ(map.sphere[0], map.sphere[64 * 64 - 1]);  // corners: the rim's value
  EXPECT_EQ(sphere_map_cos_theta(0), 1);
  EXPECT_EQ(sphere_map_cos_theta(1.3f), 0);
}

// Bastos et al. 1999, equation (4): π F / (π N·L N·V), which is F seen straight, four times that at 60°, and 1 where it
// would be more.
TEST(FresnelMap, SphereMapHoldsEquationFourWhereAsked) {
  const FresnelMap map = make_fresnel_map(schlick(Vec3(0.04f), 1, 0.3f), {.sphere_size = 256, .equation_4 = true});
  const auto at = [&](double cos_theta) { return sphere_lookup(map, static_cast<float>(cos_theta)).g; };
  EXPECT_NEAR(at(1), 0.04, 1e-3);
  for (const double c : {0.9, 0.7, 0.5, 0.4})
    EXPECT_NEAR(at(c), (0.04 + 0.96 * std::pow(1 - c, 5)) / (c * c), 5e-3) << c;
  EXPECT_EQ(at(0.1), 1);
  EXPECT_GT(at(0.5), 3 * fresnel_lookup(map, 0.5f).g) << "the table stays the directional albedo";
}

TEST(FresnelMap, BadNumbersAreClamped) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const FresnelMap map =
      make_fresnel_map(schlick({nan, inf, -1}, nan, nan), {.min_entries = 0, .max_entries = 2, .sphere_size = 3});
  EXPECT_EQ(map.table.size(), 2u);
  EXPECT_EQ(map.sphere.size(), 9u);
  for (const Vec3& r : map.table) {
    EXPECT_TRUE(is_finite(r));
    EXPECT_LE(max_component(r), 1);
  }
  EXPECT_TRUE(make_fresnel_map(schlick(Vec3(0.5f), 1, 0.1f), {.sphere_size = 0}).sphere.empty());
}

}  // namespace
}  // namespace oriel
