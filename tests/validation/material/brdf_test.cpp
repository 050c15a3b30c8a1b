// Every number that the suite gives for Fresnel, microfacets, Cook and Torrance. ORIEL_VALIDATION names the suite's
// folder; without it these tests are skipped.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/validation/material/brdf_cases.h"

namespace oriel::validation {
namespace {

class BrdfValidation : public ::testing::Test {
 protected:
  void SetUp() override {
    suite_ = Suite::open();
    if (!suite_) GTEST_SKIP() << "ORIEL_VALIDATION names no folder with the validation suite";
  }
  // Prints the reading that uses up most of its tolerance.
  static void check(const std::vector<FunctionReading>& readings, std::size_t at_least) {
    EXPECT_GE(readings.size(), at_least);
    const FunctionReading* worst = nullptr;
    double most = -1;
    for (const FunctionReading& r : readings) {
      const double error = std::abs(r.value - r.expected);
      EXPECT_LE(error, r.tolerance) << r.name << ": " << r.value << ", expected " << r.expected;
      if (r.tolerance > 0 && error / r.tolerance > most) most = error / r.tolerance, worst = &r;
    }
    if (worst)
      std::printf("%zu readings; nearest its tolerance: %s, %.7g for %.7g, %.2g of it\n", readings.size(),
                  worst->name.c_str(), worst->value, worst->expected, most);
  }
  std::optional<Suite> suite_;
};

TEST_F(BrdfValidation, Fresnel) {
  check(fresnel_readings(*suite_), 400);
}
TEST_F(BrdfValidation, Microfacets) {
  check(microfacet_readings(*suite_), 250);
}
TEST_F(BrdfValidation, Grooves) {
  check(groove_readings(*suite_), 90);
}

}  // namespace
}  // namespace oriel::validation
