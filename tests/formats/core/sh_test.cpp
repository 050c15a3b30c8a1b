// formats/core/sh.h: against closed forms, against themselves, and against published coefficients.
#include "formats/core/sh.h"
#include "formats/core/json.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <random>

namespace oriel {
namespace {

DVec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(DVec3(normal(random), normal(random), normal(random)));
}

std::vector<double> random_coefficients(std::mt19937& random, int bands) {
  std::normal_distribution<double> normal;
  std::vector<double> c(static_cast<std::size_t>(sh_count(bands)));
  for (double& x : c) x = normal(random);
  return c;
}

// Coefficient (l, 0) of radiance 1 inside the cone of that half angle around +z.
double cap_coefficient(int l, double half_angle_rad) {
  const double c = std::cos(half_angle_rad);
  const auto legendre = [&](int n) { return n < 0 ? 1 : std::legendre(static_cast<unsigned>(n), c); };
  return std::sqrt(kPiD / (2 * l + 1)) * (legendre(l - 1) - legendre(l + 1));
}

double value_at(std::span<const double> c, const DVec3& direction) {
  std::vector<double> y(c.size());
  evaluate_sh(direction, y);
  double sum = 0;
  for (std::size_t i = 0; i < y.size(); ++i) sum += c[i] * y[i];
  return sum;
}

DMat3 turn(const DVec3& axis, double angle_rad) {
  const DVec3 a = glm::normalize(axis);
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const DMat3 cross(0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0);
  return c * DMat3(1) + s * cross + (1 - c) * glm::outerProduct(a, a);
}

TEST(Sh, FirstBandsAreTheTextbooksPolynomials) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const DVec3 d = random_direction(random);
    std::vector<double> y(9);
    evaluate_sh(d, y);
    const double one = 0.4886025119029199, two = 1.0925484305920792;
    const double expected[9] = {0.28209479177387814,
                                one * d.y,
                                one * d.z,
                                one * d.x,
                                two * d.x * d.y,
                                two * d.y * d.z,
                                0.31539156525252005 * (3 * d.z * d.z - 1),
                                two * d.x * d.z,
                                0.5462742152960396 * (d.x * d.x - d.y * d.y)};
    for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(y[k], expected[k], 1e-14);
  }
}

TEST(Sh, SumOfSquaresIsTheSameEverywhere) {  // Unsöld's theorem, poles and all bands included
  for (const DVec3& d : {DVec3(0, 0, 1), DVec3(0, 0, -1), DVec3(1, 0, 0), DVec3(0.36, 0.48, -0.8)}) {
    std::vector<double> y(static_cast<std::size_t>(sh_count(kMaxShBands)));
    evaluate_sh(d, y);
    for (int l = 0; l < kMaxShBands; ++l) {
      double sum = 0;
      for (int m = -l; m <= l; ++m) sum += std::pow(y[static_cast<std::size_t>(sh_index(l, m))], 2);
      EXPECT_NEAR(sum, (2 * l + 1) / (4 * kPiD), 1e-12 * (2 * l + 1));
    }
  }
}

TEST(Sh, RotatedFunctionsAreReadFromTurnedDirections) {
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    const int bands = 1 + i % kMaxShBands;
    const DMat3 rotation = turn(random_direction(random), 6.0 * i);
    const std::vector<double> f = random_coefficients(random, bands);
    std::vector<double> turned(f.size());
    ShRotation(rotation, bands).apply(f, std::span(turned));
    for (int k = 0; k < 10; ++k) {
      const DVec3 d = random_direction(random);
      EXPECT_NEAR(value_at(turned, rotation * d), value_at(f, d), 1e-10);
    }
  }
}

TEST(Sh, AWholeTurnInStepsOfADegreeComesBack) {
  std::mt19937 random(3);
  for (const DVec3& axis : {DVec3(0, 0, 1), DVec3(0, 1, 0), DVec3(1, 2, 3)}) {
    const ShRotation step(turn(axis, kPiD / 180), 6);
    std::vector<double> coefficients = random_coefficients(random, 6);
    std::vector<float> f(coefficients.begin(), coefficients.end()), next(f.size());
    for (int i = 0; i < 360; ++i) {
      step.apply(std::span<const float>(f), std::span(next));
      f.swap(next);
    }
    for (std::size_t i = 0; i < f.size(); ++i)
      EXPECT_NEAR(f[i], coefficients[i], 1e-5 * std::max(1.0, std::abs(coefficients[i])));
  }
}

TEST(Sh, AHemisphereIsACapOfNinetyDegrees) {
  EXPECT_NEAR(cap_coefficient(0, kPiD), 2 * std::sqrt(kPiD), 1e-12);
  EXPECT_NEAR(cap_coefficient(3, kPiD), 0, 1e-12);
  EXPECT_NEAR(cap_coefficient(1, kPiD / 2), std::sqrt(3 * kPiD) / 2, 1e-12);
}

TEST(Sh, TheLeastWindowTakesAwayWhatRingsAndKeepsTheEnergy) {
  std::vector<double> zonal(5), lamp(25);
  for (int l = 0; l < 5; ++l) zonal[static_cast<std::size_t>(l)] = 1e4 * cap_coefficient(l, 0.05);
  turn_zonal(zonal, glm::normalize(DVec3(1, 2, -0.5)), lamp);
  double least = 0;
  std::mt19937 random(5);
  for (int i = 0; i < 1000; ++i) least = std::min(least, value_at(lamp, random_direction(random)));
  const double mean = lamp[0] * std::sqrt(0.25 / kPiD);
  ASSERT_LT(least, -0.5 * mean);  // it rings
  const double lambda = window_without_ringing(lamp);
  std::vector<double> windowed = lamp, weaker = lamp;
  window_sh(lambda, windowed);
  window_sh(0.9 * lambda, weaker);
  EXPECT_EQ(windowed[0], lamp[0]);
  least = 0;
  double least_weaker = 0;
  for (int i = 0; i < 20000; ++i) {
    const DVec3 d = random_direction(random);
    least = std::min(least, value_at(windowed, d));
    least_weaker = std::min(least_weaker, value_at(weaker, d));
  }
  EXPECT_GT(least, -2e-3 * mean);
  EXPECT_LT(least_weaker, -1e-3 * mean);
  EXPECT_EQ(window_without_ringing(std::vector<double>{1, 0, 0.1, 0}), 0);
  EXPECT_EQ(window_without_ringing(std::vector<double>{0, 0, 0, 0}), 0);
}

// Published coefficients; their file is not part of the project.
class ShCases : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("ORIEL_VALIDATION");
    if (!folder) GTEST_SKIP() << "ORIEL_VALIDATION is not set";
    std::ifstream in(std::string(folder) + "/sh_prt.json");
    ASSERT_TRUE(in) << folder;
    cases_ = Json::parse(std::string(std::istreambuf_iterator<char>(in), {})).value()["cases"];
  }
  std::vector<Json> with_prefix(const std::string& prefix) const {
    std::vector<Json> found;
    for (const Json& c : cases_)
      if (c["id"].get<std::string>().rfind(prefix, 0) == 0) found.push_back(c);
    EXPECT_FALSE(found.empty()) << prefix;
    return found;
  }
  static DVec3 vec(const Json& j) { return {j[0].get<double>(), j[1].get<double>(), j[2].get<double>()}; }
  static void expect_near(std::span<const double> found, const Json& expected, double tolerance) {
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(found[i], expected[i].get<double>(), tolerance) << i;
  }
  Json cases_;
};

TEST_F(ShCases, CosineFactors) {
  for (const Json& c : with_prefix("SH-cos")) {
    const double tolerance = c["tolerance"]["abs"].get<double>();
    for (std::size_t i = 0; i < c["inputs"]["l"].size(); ++i)
      EXPECT_NEAR(cosine_factor(c["inputs"]["l"][i].get<int>()), c["expected"]["A_l"][i].get<double>(), tolerance);
    if (!c["inputs"].contains("n")) continue;
    std::vector<double> zonal(4), turned(16);
    for (int l = 0; l < 4; ++l)
      zonal[static_cast<std::size_t>(l)] = cosine_factor(l) * std::sqrt((2 * l + 1) / (4 * kPiD));
    turn_zonal(zonal, vec(c["inputs"]["n"]), turned);
    expect_near(turned, c["expected"]["coeffs_l0to3"], tolerance);
  }
}

TEST_F(ShCases, DirectionsAndCaps) {
  for (const Json& c : with_prefix("SH-dir")) {
    std::vector<double> y(25);
    evaluate_sh(vec(c["inputs"]["direction"]), y);
    expect_near(y, c["expected"]["L_lm"], c["tolerance"]["abs"].get<double>());
  }
  for (const Json& c : with_prefix("SH-disk"))
    for (const auto& [degrees, expected] : c["expected"]["L_l0"].items())
      for (int l = 0; l < static_cast<int>(expected.size()); ++l)
        EXPECT_NEAR(cap_coefficient(l, std::stod(degrees) * kPiD / 180),
                    expected[static_cast<std::size_t>(l)].get<double>(), c["tolerance"]["abs"].get<double>());
}

TEST_F(ShCases, Rotations) {
  for (const Json& c : with_prefix("ROT")) {
    DMat3 rotation;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        rotation[column][row] =
            c["inputs"]["R"][static_cast<std::size_t>(row)][static_cast<std::size_t>(column)].get<double>();
    const auto from = c["inputs"]["c"].get<std::vector<double>>();
    std::vector<double> turned(from.size());
    ShRotation(rotation, 5).apply(from, std::span(turned));
    expect_near(turned, c["expected"]["c_rotated"], c["tolerance"]["abs"].get<double>());
  }
}

// ∫ Y_i Y_j Y_k dω of three bands, by a rule that is exact for them: four Gauss points by eight.
double triple_product(const std::vector<int>& of) {
  double sum = 0;
  std::array<double, 9> y;
  for (const double sign : {-1.0, 1.0}) {
    const double x = std::sqrt(3.0 / 7 + sign * 2.0 / 7 * std::sqrt(1.2)), weight = (18 - sign * std::sqrt(30)) / 36;
    for (const double z : {-x, x})
      for (int k = 0; k < 8; ++k) {
        const double s = std::sqrt(1 - z * z), phi = kPiD / 4 * k;
        evaluate_sh(DVec3(s * std::cos(phi), s * std::sin(phi), z), y);
        double product = weight * kPiD / 4;
        for (const int i : of) product *= y[static_cast<std::size_t>(i)];
        sum += product;
      }
  }
  return sum;
}

TEST_F(ShCases, Triples) {
  for (const Json& c : with_prefix("SH-triple"))
    for (std::size_t n = 0; n < c["inputs"]["entries"].size(); ++n)
      EXPECT_NEAR(triple_product(c["inputs"]["entries"][n].get<std::vector<int>>()),
                  c["expected"]["values"][n].get<double>(), c["tolerance"]["abs"].get<double>());
}

}  // namespace
}  // namespace oriel
