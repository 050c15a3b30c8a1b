// Kernels and Fresnel maps against closed forms and independent quadrature.
#include "bake/material/kernel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "tests/bake/material/lobe_integrals.h"

namespace oriel {
namespace {

double sum(const BrdfKernel& k) {
  return std::accumulate(k.weights.begin(), k.weights.end(), 0.0);
}

double weight(const BrdfKernel& k, std::uint32_t x, std::uint32_t y) {
  return k.weights[y * k.size + x];
}

// What every kernel promises; the reason it does not, or nothing.
std::string broken_promise(const BrdfKernel& k) {
  if (k.size % 2 == 0) return "even side";
  if (k.weights.size() != std::size_t{k.size} * k.size) return "wrong number of weights";
  for (const float w : k.weights)
    if (!(w >= 0) || !std::isfinite(w)) return "a weight is negative or not finite";
  if (std::abs(sum(k) - 1) > 1e-5) return "the sum is not 1";
  if (!std::isfinite(k.half_extent) || k.half_extent < 0) return "half_extent";
  if (!(k.energy_kept >= 0 && k.energy_kept <= 1)) return "energy_kept";
  return {};
}

TEST(Kernel, PromisesCanBeSeenToBreak) {
  BrdfKernel k = make_kernel(0.1f);
  EXPECT_EQ(broken_promise(k), "");
  k.weights[3] += 0.1f;
  EXPECT_EQ(broken_promise(k), "the sum is not 1");
  k.weights[3] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(broken_promise(k), "");
}

TEST(Kernel, HoldsItsPromisesFromMirrorToMatteAtEveryIncidence) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const FacetModel model : {FacetModel::kBeckmann, FacetModel::kGgx})
    for (const float alpha : {-1.0f, 0.0f, 1e-30f, 1e-5f, 1e-4f, 1e-3f, 0.01f, 0.1f, 0.35f, 1.0f, 7.0f, nan})
      for (const float cos_theta : {1.0f, 0.7f, 0.1f, 1e-3f, 0.0f, -1.0f, nan}) {
        const BrdfKernel k = make_kernel(alpha, lobe_of(model), cos_theta);
        EXPECT_EQ(broken_promise(k), "") << "alpha " << alpha << ", cos " << cos_theta;
        EXPECT_LE(k.size, 31u);
      }
}

TEST(Kernel, MirrorIsOnePixel) {
  const BrdfKernel k = make_kernel(0);
  EXPECT_EQ(k.size, 1u);
  EXPECT_EQ(k.weights, std::vector<float>{1.0f});
  EXPECT_EQ(k.half_extent, 0);
  EXPECT_EQ(k.energy_kept, 1);
}

TEST(Kernel, IsSymmetricAtNormalIncidenceAndPeaksInTheMiddle) {
  for (const FacetModel model : {FacetModel::kBeckmann, FacetModel::kGgx}) {
    const BrdfKernel k = make_kernel(0.1f, lobe_of(model));
    const std::uint32_t n = k.size, c = n / 2;
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x) {
        EXPECT_NEAR(weight(k, x, y), weight(k, y, x), 1e-7);
        EXPECT_NEAR(weight(k, x, y), weight(k, n - 1 - x, y), 1e-7);
        EXPECT_LE(weight(k, x, y), weight(k, c, c));
      }
    EXPECT_NEAR(k.half_extent, make_kernel(0.1f, lobe_of(model)).half_extent, 0);
  }
}

// A narrow lobe at normal incidence has a closed form: half vectors with density D cosθ, tan of the reflected angle
// twice that of the half vector's. Its share inside the disk of tangent 2 tanθh is 1 - exp(-tan²θh/α²) for Beckmann.
TEST(Kernel, NarrowBeckmannLobeMatchesTheGaussian) {
  const float alpha = 1e-3f;
  const BrdfKernel k = make_kernel(alpha, lobe_of(FacetModel::kBeckmann));
  // In the limit the lobe is a Gaussian of exp(-t² / (2α)²); a square of half side s holds erf(s / (2α))².
  const double held = std::pow(std::erf(k.half_extent / (2 * alpha)), 2);
  EXPECT_NEAR(held, 0.99, 4e-3);
  EXPECT_NEAR(k.energy_kept, held, 4e-3);
  const double width = 2 * k.half_extent / k.size, a2 = 2 * alpha;
  for (std::uint32_t x = 0; x < k.size; ++x) {
    const double t0 = x * width - k.half_extent;
    const double in_x = 0.5 * (std::erf((t0 + width) / a2) - std::erf(t0 / a2));
    const double in_y = std::erf(0.5 * width / a2);
    EXPECT_NEAR(weight(k, x, k.size / 2), in_x * in_y / held, 2e-3 * weight(k, k.size / 2, k.size / 2) + 1e-6);
  }
}

// energy_kept against direct integration of the density over the square, and the whole lobe against its albedo.
TEST(Kernel, EnergyKeptIsTheLobesShareInTheSquare) {
  for (const FacetModel model : {FacetModel::kBeckmann, FacetModel::kGgx})
    for (const double alpha : {0.01, 0.1, 0.3})
      for (const double cos_theta : {1.0, 0.5}) {
        const BrdfKernel k = make_kernel(static_cast<float>(alpha), lobe_of(model), static_cast<float>(cos_theta));
        const int n = 1200;
        const double step = 2.0 * k.half_extent / n;
        double inside = 0;
        for (int y = 0; y < n; ++y)
          for (int x = 0; x < n; ++x)
            inside += lobe_density(model, k.alpha, cos_theta,
                                   {(x + 0.5) * step - k.half_extent, (y + 0.5) * step - k.half_extent});
        inside *= step * step;
        EXPECT_NEAR(inside / lobe_albedo(model, k.alpha, cos_theta), k.energy_kept, 4e-3) << alpha << " " << cos_theta;
        if (alpha < 0.15) {
          EXPECT_GE(k.energy_kept, 0.985) << alpha << " " << cos_theta;
        }
      }
}

TEST(Kernel, WideLobesSayWhatTheyLose) {
  const BrdfKernel k = make_kernel(0.8f);
  EXPECT_FLOAT_EQ(k.half_extent, 2.0f);
  EXPECT_LT(k.energy_kept, 0.95f);
  EXPECT_GT(k.energy_kept, 0.3f);
}

TEST(Kernel, ExtentGrowsWithTheLobe) {
  float before = 0;
  for (const float alpha : {1e-4f, 1e-3f, 1e-2f, 0.05f, 0.1f}) {
    const float extent = make_kernel(alpha).half_extent;
    EXPECT_GT(extent, before);
    before = extent;
  }
}

TEST(Kernel, TinyAlphasScaleExactly) {
  const BrdfKernel a = make_kernel(1e-4f), b = make_kernel(1e-3f);
  ASSERT_EQ(a.size, b.size);
  EXPECT_NEAR(b.half_extent / a.half_extent, 10, 0.02);
  for (std::size_t i = 0; i < a.weights.size(); ++i) EXPECT_NEAR(a.weights[i], b.weights[i], 2e-5);
}

}  // namespace
}  // namespace oriel
