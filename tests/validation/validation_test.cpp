// Every case of the suite inside its tolerance, by each way that Oriel gives a number; and the stated error covers the
// difference. ORIEL_VALIDATION names the suite's folder; without it these tests are skipped.
#include <gtest/gtest.h>

#include <functional>

#include "tests/validation/measure.h"
#include "tests/validation/suite.h"

namespace oriel::validation {
namespace {

constexpr std::uint64_t kSeed = 1;

struct Method {
  const char* name;
  bool texture;
  std::function<Measurements(const Case&)> measure;
};

// Names it in messages, where bytes of a function would change from run to run.
std::ostream& operator<<(std::ostream& out, const Method& method) {
  return out << method.name;
}

const Method kMethods[] = {
    {"Lux", false, [](const Case& c) { return measure_by_lux(c, kSeed); }},
    {"Cached", true,
     [](const Case& c) {
       return measure_by_texture(c, {.estimator = Estimator::kCached, .samples = 4096, .error = 0.005}, kSeed);
     }},
};

class Validation : public ::testing::TestWithParam<Method> {
 protected:
  void SetUp() override {
    suite_ = Suite::open();
    if (!suite_) GTEST_SKIP() << "ORIEL_VALIDATION names no folder with the validation suite";
  }
  // Inside the tolerance; and within four standard errors, of ours and of the reference, and what rounding, quadrature
  // and interpolation between texels add (a texture states its noise, not its resolution).
  void expect_inside(const Reading& r, const Measured& m) const {
    EXPECT_LE(std::abs(m.value - r.expected), r.tolerance) << r.name << ": " << m.value << ", expected " << r.expected;
    if (GetParam().texture) return;
    EXPECT_LE(std::abs(m.value - r.expected), 4 * std::hypot(m.error, r.reference_error) + 5e-4 * std::abs(r.expected))
        << r.name << ": " << m.value << " ± " << m.error << ", expected " << r.expected;
  }
  static void expect_grid(const Case& c, const Measurements& m) {
    double sum = 0, reference = 0, squares = 0;
    for (std::size_t i = 0; i < m.size(); ++i) {
      if (std::isnan(m[i].value)) continue;
      sum += m[i].value;
      reference += c.readings[i].expected;
      squares += std::pow(m[i].value - c.readings[i].expected, 2);
    }
    EXPECT_LE(std::abs(sum / reference - 1), c.grid.mean);
    EXPECT_LE(std::sqrt(squares * static_cast<double>(m.size())) / reference, c.grid.nrmse);
  }
  void run(const std::vector<Case>& cases) const {
    int read = 0;
    for (const Case& c : cases) {
      if (GetParam().texture && c.texel_m == 0) continue;
      SCOPED_TRACE(c.id + " " + c.label);
      const Measurements m = GetParam().measure(c);
      for (std::size_t i = 0; i < m.size(); ++i) {
        if (std::isnan(m[i].value) && GetParam().texture) continue;
        expect_inside(c.readings[i], m[i]);
        ++read;
      }
      if (c.grid.mean > 0) expect_grid(c, m);
    }
    EXPECT_GT(read, 0);
  }
  std::optional<Suite> suite_;
};

TEST_P(Validation, Factors) {
  if (GetParam().texture) GTEST_SKIP() << "view factors are functions: they are measured at points";
  run(factor_cases(*suite_));
}
TEST_P(Validation, Enclosures) {
  run(enclosure_cases(*suite_, false));
}
TEST_P(Validation, Lamps) {
  run(lamp_cases(*suite_));
}
TEST_P(Validation, Skies) {
  if (GetParam().texture) GTEST_SKIP() << "measured at points: a metre of floor under a point of sky";
  run(sky_cases(*suite_, false));
}
TEST_P(Validation, Peers) {
  run(peer_cases(*suite_, false));
}

INSTANTIATE_TEST_SUITE_P(By, Validation, ::testing::ValuesIn(kMethods),
                         [](const ::testing::TestParamInfo<Method>& method) { return method.param.name; });

}  // namespace
}  // namespace oriel::validation
