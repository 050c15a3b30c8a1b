// Ward's and Phong's lobes by themselves, and beside the numbers of the validation suite (ORIEL_VALIDATION).
#include "study/diefenbach1997/ward.h"

#include <gtest/gtest.h>

#include "bake/brdf/quadrature.h"
#include "tests/validation/suite.h"

namespace oriel::study {
namespace {

constexpr WardNorm kNorms[] = {WardNorm::kOriginal, WardNorm::kDuer, WardNorm::kBounded};

// The refit of Phong's lobe to Ward's: 2/α² and 1/8π in the limit, where 1.999/α² and 0.0398 were published.
TEST(PhongFit, ApproachesTheAnalyticLimit) {
  for (const double alpha : {0.02, 0.1, 0.3}) {
    const PhongFit fit = fit_phong(alpha);
    EXPECT_LT(fit.chi2, fit.cited_chi2);
  }
  const PhongFit narrow = fit_phong(0.005);
  EXPECT_NEAR(narrow.phong.exponent * 0.005 * 0.005, 2, 1e-4);
  EXPECT_NEAR(narrow.phong.gain / narrow.phong.exponent, 1 / (8 * kPiD), 1e-6);
}

TEST(Ward, IsReciprocal) {
  const auto direction = [](double cos_theta, double phi) {
    const double s = std::sqrt((1 - cos_theta) * (1 + cos_theta));
    return DVec3(s * std::cos(phi), s * std::sin(phi), cos_theta);
  };
  for (const double a : {0.01, 0.3, 0.9})
    for (const double b : {0.05, 0.5, 1.0})
      for (const double phi : {0.1, 2.0, 3.1}) {
        const DVec3 wo = direction(a, 0), wi = direction(b, phi), h = glm::normalize(wo + wi);
        const auto expect = [&](const auto& lobe) {
          const double there = lobe.f_cos(wo, wi, h) / wi.z, back = lobe.f_cos(wi, wo, h) / wo.z;
          EXPECT_NEAR(there, back, 1e-9 * std::max(there, back));
        };
        for (const WardNorm norm : kNorms) expect(Ward{norm, 0.2});
        expect(cited_phong(0.2));
      }
}

class WardValidation : public ::testing::Test {
 protected:
  void SetUp() override {
    suite_ = validation::Suite::open();
    if (!suite_) GTEST_SKIP() << "ORIEL_VALIDATION names no folder with the validation suite";
  }
  std::optional<validation::Suite> suite_;
};

TEST_F(WardValidation, Albedos) {
  constexpr int kOrder = 200;
  const Json& c = suite_->find("WARD-a");
  const char* names[] = {"ward_original", "ward_duer", "ward_gmd"};
  for (std::size_t n = 0; n < std::size(kNorms); ++n)
    for (const auto& [alpha, values] : c["expected"][names[n]].items())
      for (std::size_t i = 0; i < values.size(); ++i) {
        const Ward ward{kNorms[n], std::stod(alpha)};
        const double mu = c["inputs"]["mu"][i].get<double>();
        double albedo = 0;
        for_each_reflection(mu, ward.alpha, kOrder, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
          albedo += ward.f_cos(direction_at(mu), wi, h) * solid_angle;
        });
        EXPECT_NEAR(albedo, values[i].get<double>(), c["tolerance"]["abs"].get<double>()) << names[n] << alpha << mu;
      }
}

TEST_F(WardValidation, FitsAndPoints) {
  const Json& fits = suite_->find("WPH-01");
  const double fit_rel = fits["tolerance"]["rel"].get<double>();
  for (const auto& [alpha, fit] : fits["expected"]["least_squares_fits"].items()) {
    const double a = std::stod(alpha);
    const Phong found = fit_phong(a).phong;
    const double exponent = fit["n_alpha2_2param"].get<double>(), factor = fit["factor_over_n_2param"].get<double>();
    EXPECT_NEAR(found.exponent * a * a, exponent, fit_rel * exponent) << alpha;
    EXPECT_NEAR(found.gain / found.exponent, factor, fit_rel * factor) << alpha;
  }
  const Json& points = suite_->find("WPH-02");
  const double rel = points["tolerance"]["rel"].get<double>();
  for (const auto& [alpha, values] : points["expected"]["ward"].items())
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double a = std::stod(alpha), cosine = std::cos(points["inputs"]["d_deg"][i].get<double>() * kPiD / 180);
      const double ward = values[i].get<double>(), phong = points["expected"]["phong_fit"][alpha][i].get<double>();
      // Printed with ten decimals.
      EXPECT_NEAR((Ward{WardNorm::kOriginal, a}.lobe(cosine)), ward, rel * ward + 1e-10) << alpha;
      EXPECT_NEAR(cited_phong(a).lobe(cosine), phong, rel * phong + 1e-10) << alpha;
    }
}

}  // namespace
}  // namespace oriel::study
