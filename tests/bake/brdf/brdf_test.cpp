// Reflection models: energy, reciprocity, samplers against their pdfs, extremes.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "bake/brdf/quadrature.h"
#include "bake/brdf/specular.h"
#include "bake/trace/bsdf.h"
#include "tests/bake/support/chi2.h"

namespace oriel {
namespace {

using test::chi2_excess;

constexpr double kCosines[] = {1e-4, 1e-3, 0.01, 0.05, 0.1, 0.3, 0.7, 1};
constexpr double kAlphas[] = {1e-4, 0.001, 0.01, 0.05, 0.1, 0.25, 0.5, 1};

LobeFunction function_of(const Microfacet& facets) {
  return [=](const DVec3& wo, const DVec3& wi, const DVec3& h) { return facets.f_cos(wo, wi, h); };
}

double albedo(const LobeFunction& f_cos, double width, double cos_theta, int order = 24) {
  double sum = 0;
  for_each_reflection(cos_theta, width, order, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
    sum += f_cos(direction_at(cos_theta), wi, h) * solid_angle;
  });
  return sum;
}

// The rule itself: 2π of solid angle above the horizon, π of projected one, for any width and view.
TEST(Quadrature, CoversTheHemisphere) {
  for (const double cos_theta : {0.01, 0.3, 1.0})
    for (const double width : {0.3, 1.0}) {
      double angle = 0, projected = 0;
      for_each_reflection(cos_theta, width, 200, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
        EXPECT_NEAR(glm::length(wi), 1, 1e-9);
        EXPECT_NEAR(glm::length(glm::normalize(direction_at(cos_theta) + wi) - h), 0, 1e-6);
        angle += solid_angle, projected += solid_angle * wi.z;
      });
      EXPECT_NEAR(angle, 2 * kPiD, 2e-3) << cos_theta << " " << width;
      EXPECT_NEAR(projected, kPiD, 1e-3) << cos_theta << " " << width;
    }
}

TEST(Microfacet, SingleScatteringNeverGainsEnergyAndIsFinite) {
  for (const FacetModel model : {FacetModel::kGgx, FacetModel::kBeckmann})
    for (const double alpha : kAlphas)
      for (const double cos_theta : kCosines) {
        const double e = albedo(function_of({model, alpha}), alpha, cos_theta);
        EXPECT_GT(e, 0.3) << alpha << " " << cos_theta;
        EXPECT_LT(e, 1 + 1e-6) << alpha << " " << cos_theta;
      }
  // GGX, α = 1, normal incidence.
  EXPECT_NEAR(albedo(function_of({FacetModel::kGgx, 1}), 1, 1), 1 - std::log(2.0), 1e-9);
}

TEST(Microfacet, DistributionIsNormalised) {
  for (const FacetModel model : {FacetModel::kGgx, FacetModel::kBeckmann})
    for (const double alpha : kAlphas) {
      const Microfacet facets(model, alpha);
      double sum = 0;
      constexpr int kSteps = 4000;
      for (int i = 0; i < kSteps; ++i) {  // slope = α tanψ
        const double psi = kPiD / 2 * (i + 0.5) / kSteps, slope = alpha * std::tan(psi);
        const double cos_h = 1 / std::sqrt(1 + slope * slope);
        const double dslope = alpha / std::pow(std::cos(psi), 2) * kPiD / 2 / kSteps;
        sum += facets.d({slope * cos_h, 0, cos_h}) * std::pow(cos_h, 4) * 2 * kPiD * slope * dslope;
      }
      EXPECT_NEAR(sum, 1, 1e-5) << alpha;
    }
}

// The weak white furnace of Heitz 2014: without shadowing of the outgoing ray every visible facet reflects.
// GGX's D ends at α² / π, Beckmann's at 0.
TEST(Microfacet, DistributionHasItsLimitAtTheHorizon) {
  for (const double alpha : kAlphas) {
    const Microfacet ggx(FacetModel::kGgx, alpha), beckmann(FacetModel::kBeckmann, alpha);
    EXPECT_NEAR(ggx.d({1, 0, 0}), alpha * alpha / kPiD, 1e-12 * alpha * alpha);
    EXPECT_NEAR(ggx.d({1, 0, 1e-9}), alpha * alpha / kPiD, 1e-6 * alpha * alpha);
    EXPECT_EQ(ggx.d({1, 0, -1e-9}), 0);
    EXPECT_EQ(beckmann.d({1, 0, 0}), 0);
  }
}

TEST(Microfacet, MaskingSeesTheProjectedArea) {
  for (const FacetModel model : {FacetModel::kGgx, FacetModel::kBeckmann})
    for (const double alpha : {0.1, 0.5, 1.0})
      for (const double cos_theta : {0.05, 0.4, 1.0}) {
        const Microfacet facets(model, alpha);
        const DVec3 wo = direction_at(cos_theta);
        double sum = 0;
        constexpr int kSteps = 400;
        for (int i = 0; i < kSteps; ++i)
          for (int j = 0; j < kSteps; ++j) {
            const double psi = kPiD / 2 * (i + 0.5) / kSteps, phi = 2 * kPiD * (j + 0.5) / kSteps;
            const double slope = alpha * std::tan(psi), cos_h = 1 / std::sqrt(1 + slope * slope);
            const DVec3 h(slope * cos_h * std::cos(phi), slope * cos_h * std::sin(phi), cos_h);
            const double area = slope * alpha / std::pow(std::cos(psi), 2) * std::pow(cos_h, 3);
            sum += facets.d(h) * std::max(0.0, glm::dot(wo, h)) * area * kPiD / 2 * 2 * kPiD / (kSteps * kSteps);
          }
        EXPECT_NEAR(sum * facets.g1(wo) / wo.z, 1, 2e-3) << alpha << " " << cos_theta;
      }
}

// With compensation a lobe without absorption reflects all it receives.
TEST(Compensation, WhiteFurnace) {
  for (const FacetModel model : {FacetModel::kGgx, FacetModel::kBeckmann})
    for (const double alpha : kAlphas) {
      const CosineLobe lobe{function_of({model, alpha}), alpha};
      const Compensation compensation(lobe, 24);
      for (const double cos_theta : kCosines) {
        const Albedo e = lobe_albedo(lobe, compensation, {[](double) { return DVec3(1); }, DVec3(1)}, cos_theta, 32);
        EXPECT_NEAR(e.compensated.r, 1, 2e-3) << alpha << " " << cos_theta;
        EXPECT_LE(e.single.r, 1 + 1e-6) << alpha << " " << cos_theta;
        EXPECT_NEAR(compensation.albedo(cos_theta), e.single.r, 2e-3) << alpha << " " << cos_theta;
      }
    }
}

// The same through the tables that paths use, at widths between their rows.
TEST(Compensation, WhiteFurnaceOfThePathsTable) {
  for (double roughness = 0.0105; roughness <= 1; roughness += 0.0331) {
    const double alpha = roughness * roughness;
    const Microfacet facets(FacetModel::kGgx, alpha);
    for (const double cos_theta : kCosines) {
      double sum = 0;
      for_each_reflection(cos_theta, alpha, 16, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
        sum += facets.f_cos(direction_at(cos_theta), wi, h) * ggx_scale(alpha, wi.z) * solid_angle;
      });
      EXPECT_NEAR(sum * ggx_scale(alpha, cos_theta), 1, 2e-3) << alpha << " " << cos_theta;
    }
  }
}

// R of paths beside the exact one, and never more than all.
TEST(Reflectance, TableOfPathsIsNearTheExactOne) {
  for (const FresnelCurve curve : {FresnelCurve{}, FresnelCurve{.ior = 1.5f, .schlick = 0},
                                   FresnelCurve{.ior = 1.5f, .schlick = 0.4f}, FresnelCurve{.metal = Metal::kChromium}})
    for (const float alpha : {0.0f, 0.003f, 0.1f, 0.4f, 1.0f}) {
      const Vec3 f0 = curve.metal == Metal::kNone ? Vec3(0.04f, 0.3f, 1) : Vec3(metal_f0(curve.metal));
      const SpecularLobe lobe{f0, 1, alpha, curve};
      const ExactReflectance exact(lobe);
      for (const double cos_theta : kCosines) {
        const Vec3 found = specular_reflectance(lobe, static_cast<float>(cos_theta)), wanted = exact(cos_theta);
        EXPECT_LT(max_component(glm::abs(found - wanted)), 6e-3) << alpha << " " << cos_theta;
        EXPECT_LE(max_component(found), 1);
      }
    }
}

DVec3 direction(double cos_theta, double phi) {
  const double s = std::sqrt((1 - cos_theta) * (1 + cos_theta));
  return {s * std::cos(phi), s * std::sin(phi), cos_theta};
}

// f(wo, wi) = f(wi, wo), compensation included, to 1e-5 of the value.
TEST(Reciprocity, OfAllLobes) {
  const std::vector<LobeFunction> lobes{function_of({FacetModel::kGgx, 0.05}),
                                        function_of({FacetModel::kBeckmann, 0.4}),
                                        function_of({FacetModel::kGgx, 0.3, 0.05})};
  for (const LobeFunction& f : lobes)
    for (const double a : {0.01, 0.3, 0.9})
      for (const double b : {0.05, 0.5, 1.0})
        for (const double phi : {0.1, 2.0, 3.1}) {
          const DVec3 wo = direction(a, 0), wi = direction(b, phi), h = glm::normalize(wo + wi);
          const double there = f(wo, wi, h) / wi.z, back = f(wi, wo, h) / wo.z;
          EXPECT_NEAR(there, back, 1e-9 * std::max(there, back));
        }
}

TEST(Reciprocity, OfTheCompensatedSpecularLobeOfPaths) {
  ShadePoint point;
  point.diffuse = Vec3(0);
  point.f0 = Vec3(metal_f0(Metal::kGold));
  point.curve = {.metal = Metal::kGold};
  for (const float alpha : {0.01f, 0.2f, 1.0f}) {
    point.alpha = alpha;
    for (const double a : {0.05, 0.3, 0.9})
      for (const double b : {0.1, 0.5, 1.0}) {
        const Vec3 wo(direction(a, 0)), wi(direction(b, 3.1));
        const Vec3 there = Bsdf(point, wo).eval(wi) / wi.z, back = Bsdf(point, wi).eval(wo) / wo.z;
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(there[c], back[c], 1e-5f * std::max(there[c], back[c]));
      }
  }
}

// χ² of directions reflected at sampled half vectors.
struct SamplerCase {
  const char* name;
  std::function<DVec3(const DVec3& wo, const DVec2& u)> half_vector;
  std::function<double(const DVec3& wo, const DVec3& h)> pdf;
};

SamplerCase visible(const char* name, const Microfacet& facets) {
  return {name, [=](const DVec3& wo, const DVec2& u) { return facets.sample_visible_normal(wo, u); },
          [=](const DVec3& wo, const DVec3& h) { return facets.reflected_pdf(wo, h); }};
}
double excess(const SamplerCase& c, double cos_theta, double pdf_factor = 1) {
  const DVec3 wo = direction(cos_theta, 0.7);
  return chi2_excess(
      [&](float, const Vec2& v) -> std::optional<Vec3> {
        const DVec3 h = c.half_vector(wo, DVec2(v));
        if (glm::dot(wo, h) <= 0) return std::nullopt;
        return Vec3(reflect_at(wo, h));
      },
      [&](const Vec3& wi) { return pdf_factor * c.pdf(wo, glm::normalize(wo + DVec3(wi))); });
}

TEST(Samplers, MatchTheirPdfs) {
  const SamplerCase cases[] = {visible("ggx", {FacetModel::kGgx, 0.35}),
                               visible("ggx rough", {FacetModel::kGgx, 1}),
                               visible("ggx anisotropic", {FacetModel::kGgx, 0.8, 0.3}),
                               visible("beckmann", {FacetModel::kBeckmann, 0.4}),
                               visible("beckmann rough", {FacetModel::kBeckmann, 1}),
                               visible("beckmann anisotropic", {FacetModel::kBeckmann, 0.8, 0.35})};
  for (const SamplerCase& c : cases)
    for (const double cos_theta : {0.9, 0.4}) EXPECT_LT(excess(c, cos_theta), 6) << c.name << " " << cos_theta;
  EXPECT_GT(excess(cases[0], 0.9, 0.9), 20) << "the checker must see a wrong pdf";
  EXPECT_GT(excess({"mixed", cases[0].half_vector, cases[3].pdf}, 0.9), 20);
}

// At the edges: finite, above the surface's facets, unit length.
TEST(Samplers, HoldAtTheExtremes) {
  for (const FacetModel model : {FacetModel::kGgx, FacetModel::kBeckmann})
    for (const double alpha : {1e-4, 1.0})
      for (const double cos_theta : {1e-4, 1.0})
        for (const double u : {0.0, 0.5, 1 - 1e-9})
          for (const double v : {0.0, 0.5, 1 - 1e-9}) {
            const Microfacet facets(model, alpha);
            const DVec3 wo = direction_at(cos_theta), h = facets.sample_visible_normal(wo, {u, v});
            EXPECT_NEAR(glm::length(h), 1, 1e-12);
            EXPECT_GE(glm::dot(wo, h), -1e-9) << alpha << " " << cos_theta << " " << u << " " << v;
            EXPECT_TRUE(std::isfinite(facets.reflected_pdf(wo, h)));
          }
}

TEST(Fresnel, LimitsAreExact) {
  for (const double cosine : {0.0, 0.5, 1.0}) EXPECT_EQ(fresnel_conductor({1, 0}, cosine), 0);
  for (const ComplexIndex index : {ComplexIndex{1.0001, 0}, {1.5, 0}, {0.2, 3.4}, {1e-3, 10}, {10, 1e-6}, {0, 2}}) {
    EXPECT_EQ(fresnel_conductor(index, 0), 1) << index.n << " " << index.k;
    for (double cosine = 1e-4; cosine <= 1; cosine *= 1.3) {
      const double f = fresnel_conductor(index, cosine);
      EXPECT_TRUE(f >= 0 && f <= 1) << f;
    }
  }
  EXPECT_EQ(fresnel_dielectric(1 / 1.5, 0.7), 1) << "beyond the critical angle";
  // Absorption that vanishes gives the dielectric.
  EXPECT_NEAR(fresnel_conductor({1.5, 1e-9}, 0.3), fresnel_dielectric(1.5, 0.3), 1e-9);
}

// A coat takes its share and leaves the rest: a white base under it loses nothing.
TEST(Bsdf, CoatOverWhiteIsAFurnace) {
  ShadePoint point;
  point.diffuse = Vec3(1);
  point.f0 = Vec3(0.04f);
  point.curve = {.ior = 1.5f, .schlick = 0};
  point.alpha = 0.25f;
  point.coat = 1;
  point.coat_alpha = 0.04f;
  for (const float cos_o : {0.1f, 0.5f, 1.0f}) {
    const Vec3 wo(std::sqrt(1 - cos_o * cos_o), 0, cos_o);
    double sum = 0;
    constexpr std::uint32_t kSamples = 16384;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      Sampler sampler(5, 6, i);
      const float u = sampler.next1();
      if (const auto s = Bsdf(point, wo).sample(u, sampler.next2())) sum += s->weight.g;
    }
    EXPECT_NEAR(sum / kSamples, 1, 0.01) << cos_o;
  }
}

class BsdfOf : public ::testing::TestWithParam<std::pair<float, float>> {};

// χ² of a point with all that a material may have: coat, anisotropy, diffuse.
TEST_P(BsdfOf, LayersSampleTheirPdf) {
  const auto [anisotropy, coat] = GetParam();
  ShadePoint point;
  point.diffuse = Vec3(0.3f);
  point.f0 = Vec3(0.5f);
  point.alpha = 0.3f;
  point.anisotropy = anisotropy;
  point.coat = coat;
  point.coat_alpha = 0.3f;
  const Vec3 wo(0.5f, 0.3f, std::sqrt(1 - 0.34f));
  const auto draw = [&](float u, const Vec2& v) -> std::optional<Vec3> {
    const auto s = Bsdf(point, wo).sample(u, v);
    return s ? std::optional(s->wi) : std::nullopt;
  };
  EXPECT_LT(chi2_excess(draw, [&](const Vec3& wi) { return Bsdf(point, wo).pdf(wi); }), 6);
}
INSTANTIATE_TEST_SUITE_P(Layers, BsdfOf,
                         ::testing::Values(std::pair{0.7f, 0.0f}, std::pair{0.0f, 1.0f}, std::pair{0.5f, 0.6f}));

}  // namespace
}  // namespace oriel
