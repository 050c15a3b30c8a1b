// K by incidence against closed forms and independent quadrature.
#include "bake/material/slices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "bake/material/kernel.h"
#include "formats/core/half.h"

namespace oriel {
namespace {

// The direction of stereographic coordinates around the mirror direction.
DVec3 from_mirror_coordinates(double cos_theta, const DVec2& u) {
  const MirrorFrame frame(cos_theta);
  const double q = 0.25 * glm::dot(u, u);
  return ((1 - q) * frame.mirror + u.x * frame.across + u.y * frame.along) / (1 + q);
}

constexpr FacetModel kModels[] = {FacetModel::kBeckmann, FacetModel::kGgx};

double sum(const std::vector<float>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// What every slice promises; the reason it does not, or nothing.
std::string broken_promise(const KernelSlice& s, std::uint32_t size) {
  if (s.weights.size() != std::size_t{size} * size) return "wrong number of weights";
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x) {
      const float w = s.weights[y * size + x];
      if (!(w >= 0) || !std::isfinite(w)) return "a weight is negative or not finite";
      if (w != s.weights[y * size + size - 1 - x]) return "left and right differ";
    }
  if (!(std::abs(sum(s.weights) - 1) <= 1e-5)) return "the sum is not 1";
  if (!(s.width.x > 0 && s.width.y > 0 && s.lower.y < s.upper.y && s.lower.x == -s.upper.x)) return "box";
  if (!(s.albedo >= 0 && s.albedo <= 1 && s.energy_kept >= 0 && s.energy_kept <= 1)) return "albedo or energy";
  if (!std::isfinite(s.shift) || !std::isfinite(s.tilt_rad)) return "shift or tilt";
  for (std::size_t i = 1; i < s.radial.size(); ++i)
    if (!(s.radial[i] >= s.radial[i - 1] && s.radial[i] <= 1)) return "radial shares do not rise";
  return {};
}

// Share within a cone of half angle gamma around the mirror direction, from the table.
double encircled(const KernelSlice& s, double gamma_rad) {
  const double at = std::sqrt(2 * std::tan(gamma_rad / 2) / s.radial_extent) * static_cast<double>(s.radial.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), s.radial.size() - 2);
  return s.radial[i] + (std::min(at, s.radial.size() - 1.0) - static_cast<double>(i)) * (s.radial[i + 1] - s.radial[i]);
}

TEST(Slices, HoldTheirPromisesAtEveryExtreme) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float alpha : {0.0f, 1e-6f, 1.1e-5f, 1e-4f, 1e-2f, 0.3f, 1.0f, nan}) {
    BrdfKernel kernel = make_kernel(alpha);
    add_slices(kernel);
    EXPECT_EQ(kernel.slices.empty(), alpha < 1e-5) << alpha;
    float before = 0;
    for (const KernelSlice& slice : kernel.slices) {
      EXPECT_EQ(broken_promise(slice, kernel.slice_size), "") << alpha << " at " << slice.cos_theta;
      EXPECT_GT(slice.cos_theta, before);
      EXPECT_GE(slice.energy_kept, 0.985) << alpha << " at " << slice.cos_theta;
      before = slice.cos_theta;
    }
  }
}

// Packs hold halves. Rounded one by one they added up to 0.9999 for some lobes, and such packs were refused.
TEST(Slices, WeightsAreHalvesThatAddUpToOne) {
  for (int k = 1; k <= 60; ++k) {
    const float alpha = std::pow(10.0f, -0.05f * static_cast<float>(k));
    for (const double cosine : {0.05, 0.3, 1.0}) {
      const KernelSlice slice = make_slice(microfacet_lobe(FacetModel::kGgx, alpha), alpha, cosine);
      double sum = 0;
      for (const float w : slice.weights) sum += float_from_half(half_from_float(w));
      EXPECT_NEAR(sum, 1, 1e-6) << alpha << " at " << cosine;
    }
  }
}

TEST(Slices, PromisesCanBeSeenToBreak) {
  KernelSlice slice = make_slice(microfacet_lobe(FacetModel::kGgx, 0.1), 0.1, 0.5);
  EXPECT_EQ(broken_promise(slice, 31), "");
  slice.weights[3] += 0.01f;
  EXPECT_EQ(broken_promise(slice, 31), "left and right differ");
  slice.weights[27] += 0.01f;
  EXPECT_EQ(broken_promise(slice, 31), "the sum is not 1");
}

// At normal incidence a half vector of slope s reflects to u = 2 s, and narrow lobes have D's closed forms: within a
// slope s lies s² / (s² + α²) of GGX and 1 - exp(-s² / α²) of Beckmann.
TEST(Slices, NarrowLobesHaveTheDistributionsShares) {
  for (const double alpha : {1e-5, 1e-3, 1e-2}) {
    const KernelSlice ggx = make_slice(microfacet_lobe(FacetModel::kGgx, alpha), alpha, 1);
    const KernelSlice beckmann = make_slice(microfacet_lobe(FacetModel::kBeckmann, alpha), alpha, 1);
    for (const double t : {0.3, 1.0, 1.7}) {
      const double gamma = 2 * std::atan(t * alpha);
      EXPECT_NEAR(encircled(ggx, gamma), t * t / (1 + t * t), 5e-3);
      EXPECT_NEAR(encircled(beckmann, gamma), 1 - std::exp(-t * t), 5e-3);
    }
    EXPECT_NEAR(beckmann.radial_extent, 2 * alpha * std::sqrt(std::log(100.0)), 0.02 * beckmann.radial_extent);
    EXPECT_NEAR(beckmann.tilt_rad, 0, 1e-9);
    EXPECT_NEAR(beckmann.albedo, 1, 1e-3);
    EXPECT_NEAR(beckmann.width.x, 0.4769 * 2 * alpha, 0.02 * beckmann.width.x);  // erf(0.4769) = 1/2
    EXPECT_NEAR(beckmann.width.y, beckmann.width.x, 0.02 * beckmann.width.x);
  }
}

// D's solid angle shrinks across the plane of incidence as its mirror image foreshortens: a narrow lobe is wider along
// than across by 1 / cosθ.
TEST(Slices, NarrowLobesStretchByTheCosine) {
  for (const double c : {0.9, 0.5, 0.2}) {
    const KernelSlice s = make_slice(microfacet_lobe(FacetModel::kBeckmann, 1e-3), 1e-3, c);
    EXPECT_NEAR(s.width.x / s.width.y, c, 0.02 * c);
    EXPECT_NEAR(s.shift / s.width.y, 0, 0.02);
  }
}

// Beckmann's half vectors at oblique incidence, seen as slopes: no lobe is left of the horizon at 89°, and its mean
// rises above the mirror direction.
TEST(Slices, GrazingLobesRiseOverTheMirrorDirection) {
  for (const FacetModel model : kModels) {
    double before = 0;
    for (const double c : {0.9, 0.5, 0.2, 0.1}) {
      const KernelSlice s = make_slice(microfacet_lobe(model, 0.2), 0.2, c);
      EXPECT_GT(s.tilt_rad, before) << c;
      before = s.tilt_rad;
    }
  }
}

// The weights again: 16² pieces of each pixel, their solid angle from their corners on the sphere.
std::vector<double> integrated(const LobeFunction& lobe, double c, const KernelSlice& s) {
  constexpr int n = 31, pieces = 16;
  const DVec3 wo(std::sqrt(1 - c * c), 0, c);
  const auto direction = [&](double x, double y) {
    return from_mirror_coordinates(c, slice_point(s, DVec2(x, y) / double(n * pieces)));
  };
  std::vector<double> weights(n * n);
  double total = 0;
  for (int y = 0; y < n * pieces; ++y)
    for (int x = 0; x < n * pieces; ++x) {
      const DVec3 wi = direction(x + 0.5, y + 0.5);
      const DVec3 a = direction(x + 1, y + 1) - direction(x, y), b = direction(x, y + 1) - direction(x + 1, y);
      const double share = lobe(wo, wi, glm::normalize(wo + wi)) * 0.5 * glm::length(glm::cross(a, b));
      weights[static_cast<std::size_t>(y / pieces * n + x / pieces)] += share;
      total += share;
    }
  for (double& w : weights) w /= total;
  return weights;
}

double l1(const std::vector<double>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum;
}

TEST(Slices, WeightsAreTheIntegratedLobe) {
  double worst = 0;
  for (const FacetModel model : kModels)
    for (const double alpha : {1e-3, 0.01, 0.1, 0.3, 0.6, 1.0})
      for (const double c : {1.0, 0.7, 0.4, 0.2, 0.1, 0.05}) {
        const LobeFunction lobe = microfacet_lobe(model, alpha);
        const KernelSlice s = make_slice(lobe, alpha, c);
        const double off = l1(integrated(lobe, c, s), s.weights);
        worst = std::max(worst, off);
        EXPECT_LE(off, 0.01) << alpha << " at " << c;
      }
  std::printf("weights of K are off by at most %.2f %% (L1)\n", 100 * worst);
}

TEST(Slices, AnotherLobeIsSeen) {
  const KernelSlice s = make_slice(microfacet_lobe(FacetModel::kGgx, 0.2), 0.2, 0.2);
  EXPECT_GT(l1(integrated(microfacet_lobe(FacetModel::kGgx, 0.21), 0.2, s), s.weights), 0.01);
}

// Albedo, mean direction and shares by a rule over directions instead of half vectors.
TEST(Slices, EnergyAndCentreAreTheLobes) {
  for (const FacetModel model : kModels)
    for (const double alpha : {0.2, 0.6})
      for (const double c : {1.0, 0.4, 0.1}) {
        const LobeFunction lobe = microfacet_lobe(model, alpha);
        const KernelSlice s = make_slice(lobe, alpha, c);
        const DVec3 wo(std::sqrt(1 - c * c), 0, c), mirror(-wo.x, 0, c);
        const int n = 1000;
        double all = 0, kept = 0;
        DVec3 mean(0);
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j) {
            const double z = (i + 0.5) / n, phi = kPiD * (j + 0.5) / n, r = std::sqrt(1 - z * z);
            const DVec3 wi(r * std::cos(phi), r * std::sin(phi), z);
            const double share = lobe(wo, wi, glm::normalize(wo + wi)) * 2 * kPiD / (double(n) * n);
            const double to_mirror = 2 / (1 + glm::dot(wi, mirror));
            const DVec2 u(to_mirror * wi.y, to_mirror * glm::dot(wi, DVec3(c, 0, wo.x)));
            all += share;
            mean += share * DVec3(wi.x, 0, wi.z);
            const DVec2 low = slice_point(s, {0, 0}), high = slice_point(s, {1, 1});
            if (u.x <= high.x && u.y >= low.y && u.y <= high.y) kept += share;
          }
        EXPECT_NEAR(s.albedo, all, 3e-3) << alpha << " at " << c;
        EXPECT_NEAR(s.energy_kept, kept / all, 3e-3) << alpha << " at " << c;
        EXPECT_NEAR(s.tilt_rad, std::atan2(glm::dot(mean, DVec3(c, 0, wo.x)), glm::dot(mean, mirror)), 5e-3);
      }
}

}  // namespace
}  // namespace oriel
