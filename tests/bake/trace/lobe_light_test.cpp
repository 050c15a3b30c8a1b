// Polygons of light in glossy lobes: the closed form against quadrature, and the fits against the lobes themselves.
#include "formats/query/lobe_light.h"

#include <gtest/gtest.h>

#include "bake/brdf/quadrature.h"
#include "bake/trace/lobe_fit.h"
#include "bake/trace/sampler.h"
#include "tests/player/twins/reflected_polygon.h"

namespace oriel {
namespace {

LobeFunction lobe_of(FacetModel model, double alpha) {
  return [facets = Microfacet(model, alpha)](const DVec3& wo, const DVec3& wi, const DVec3& h) {
    return facets.f_cos(wo, wi, h);
  };
}

// A random triangle or quad before the surface, counter-clockwise as seen from the origin; it may reach below it.
std::vector<Vec3> polygon(std::uint32_t i) {
  Sampler sampler(3, 0, i);
  const auto number = [&](float low, float high) { return low + (high - low) * sampler.next1(); };
  const Vec3 centre(number(-4, 1), number(-1.5f, 1.5f), number(0, 3));
  const Vec3 u = Vec3(number(-1, 1), number(-1, 1), number(-1, 1)) * number(0.2f, 2);
  const Vec3 v = glm::cross(Vec3(number(-1, 1), number(-1, 1), number(-1, 1)), u);
  std::vector<Vec3> corners = {centre - u - v, centre + u - v, centre + u + v};
  if (i % 2 == 0) corners.push_back(centre - u + v);
  if (glm::dot(glm::cross(u, v), centre) > 0) std::reverse(corners.begin() + 1, corners.end());
  return corners;
}

bool inside(const std::vector<Vec3>& corners, const DVec3& w) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (glm::dot(glm::cross(DVec3(corners[i]), DVec3(corners[(i + 1) % corners.size()])), w) > 0) return false;
  return true;
}

// Integral of a density over the part of a polygon above the surface, by points on the polygon.
template <class Density>
double integrated(const std::vector<Vec3>& corners, const Density& density) {
  constexpr int kSide = 400;
  double sum = 0;
  for (std::size_t t = 2; t < corners.size(); ++t) {
    const DVec3 o(corners[0]), a = DVec3(corners[t - 1]) - o, b = DVec3(corners[t]) - o;
    const DVec3 normal = glm::cross(a, b);  // its length is twice the area
    for (int i = 0; i < kSide * kSide; ++i) {
      DVec2 at = (DVec2(i % kSide, i / kSide) + 0.5) / double(kSide);
      if (at.x + at.y > 1) at = 1.0 - at;
      const DVec3 p = o + at.x * a + at.y * b;
      const double d2 = glm::dot(p, p);
      if (p.z > 0) sum += density(p / std::sqrt(d2)) * std::abs(glm::dot(normal, p)) / (d2 * std::sqrt(d2));
    }
  }
  return sum / (2.0 * kSide * kSide);
}

TEST(LobeLight, WithoutTransformIsTheCosine) {
  // A square of half side 1 at height 1, from below its centre: 4 / (π √2) atan(1 / √2) (Howell B-3, four corners).
  const std::vector<Vec3> square = {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}};
  const double expected = 4 / kPiD / std::sqrt(2.0) * std::atan(1 / std::sqrt(2.0));
  EXPECT_NEAR(reflected_polygon({}, square), expected, 1e-6);
  EXPECT_NEAR(reflected_polygon({}, std::vector<Vec3>(square.rbegin(), square.rend())), -expected, 1e-6);
  LobeFit half;
  half.amplitude = 0.5f;
  EXPECT_NEAR(reflected_polygon(half, square), 0.5 * expected, 1e-6);
}

TEST(LobeLight, ClosedFormIsTheIntegralOfTheDensity) {
  for (std::uint32_t i = 0; i < 24; ++i) {
    const auto corners = polygon(i);
    const LobeFit fit = fit_lobe(lobe_of(FacetModel::kGgx, 0.3), 0.3, 0.2 + 0.03 * i);
    const double expected = integrated(corners, [&](const DVec3& w) { return fit.amplitude * lobe_density(fit, w); });
    EXPECT_NEAR(reflected_polygon(fit, corners), expected, 2e-3) << i;
  }
}

TEST(LobeLight, PolygonsThatAreNoneGiveNothing) {
  const LobeFit fit = fit_lobe(lobe_of(FacetModel::kGgx, 0.1), 0.1, 0.5);
  EXPECT_EQ(reflected_polygon(fit, std::vector<Vec3>{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}), 0);
  EXPECT_EQ(reflected_polygon(fit, std::vector<Vec3>{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}}), 0);
  EXPECT_EQ(reflected_polygon(fit, std::vector<Vec3>{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}), 0);
  const float touching = reflected_polygon(fit, std::vector<Vec3>{{0, 0, 0}, {0, 1, 1}, {1, 0, 1}});
  EXPECT_TRUE(std::isfinite(touching));
  for (const float scale : {1e-4f, 1e4f}) {
    auto corners = polygon(2);
    const float before = reflected_polygon(fit, corners);
    for (Vec3& c : corners) c *= scale;
    EXPECT_NEAR(reflected_polygon(fit, corners), before, 1e-4f * std::abs(before));
  }
}

// The density integrates to 1 over the sphere; what of it lies below the surface is lost.
TEST(LobeFit, KeepsTheLobesLight) {
  for (const double cos_theta : {1.0, 0.5, 0.1}) {
    const LobeFit fit = fit_lobe(lobe_of(FacetModel::kGgx, 0.2), 0.2, cos_theta);
    double above = 0;
    for_each_reflection(cos_theta, 0.2, 64, [&](const DVec3& wi, const DVec3&, double solid_angle) {
      above += lobe_density(fit, wi) * solid_angle;
    });
    EXPECT_LE(above, 1 + 1e-3);
    EXPECT_GE(above, 0.9) << cos_theta;
  }
}

// The L1 distance that fit_lobe() makes least, [0, 2], by a quadrature of that order.
double fit_distance(const LobeFunction& lobe, double alpha, double cos_theta, const LobeFit& fit, int order = 20) {
  const DVec3 wo = direction_at(cos_theta);
  double albedo = 0, distance = 0;
  for_each_reflection(cos_theta, alpha, order, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
    albedo += lobe(wo, wi, h) * solid_angle;
  });
  for_each_reflection(cos_theta, alpha, order, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
    distance += std::abs(lobe(wo, wi, h) / albedo - lobe_density(fit, wi)) * solid_angle;
  });
  return distance;
}

// The error of a fit as the L1 distance, and of what polygons give as a share of the lobe.
TEST(LobeFit, IsNearTheLobe) {
  std::printf("model     alpha  cos   L1     largest polygon error\n");
  for (const FacetModel model : {FacetModel::kGgx, FacetModel::kBeckmann})
    for (const double alpha : {0.03, 0.1, 0.2, 0.5})
      for (const double cos_theta : {1.0, 0.7, 0.4, 0.1}) {
        const LobeFunction lobe = lobe_of(model, alpha);
        const LobeFit fit = fit_lobe(lobe, alpha, cos_theta);
        const double distance = fit_distance(lobe, alpha, cos_theta, fit);
        double largest = 0;
        for (std::uint32_t i = 0; i < 40; ++i) {
          const auto corners = polygon(i);
          double expected = 0;
          const DVec3 wo = direction_at(cos_theta);
          for_each_reflection(cos_theta, alpha, 48, [&](const DVec3& wi, const DVec3& h, double solid_angle) {
            const double half = 0.5 * lobe(wo, wi, h) * solid_angle;
            expected += half * (inside(corners, wi) + inside(corners, {wi.x, -wi.y, wi.z}));
          });
          largest = std::max(largest, std::abs(reflected_polygon(fit, corners) - expected) / fit.amplitude);
        }
        std::printf("%s  %5.2f  %.1f  %5.3f  %5.3f\n", model == FacetModel::kGgx ? "GGX     " : "Beckmann", alpha,
                    cos_theta, distance, largest);
        constexpr double kQuadrature = 0.01;  // steps of the polygons' edges
        EXPECT_LE(largest, distance + kQuadrature);
        if (model == FacetModel::kGgx && cos_theta >= 0.4) {
          EXPECT_LE(distance, 0.17);
        }
      }
}

// The fit's own quadrature is coarse: a finer one must not find it farther from the lobe.
TEST(LobeFit, HidesNothingBetweenNodes) {
  for (const double alpha : {1e-4, 0.01, 0.1, 0.3, 1.0})
    for (const double cos_theta : {1e-3, 0.016, 0.14, 0.56, 1.0}) {
      const LobeFunction lobe = lobe_of(FacetModel::kGgx, alpha);
      const LobeFit fit = fit_lobe(lobe, alpha, cos_theta);
      const double finer = fit_distance(lobe, alpha, cos_theta, fit, 200);
      EXPECT_NEAR(fit_distance(lobe, alpha, cos_theta, fit), finer, 0.02) << alpha << " " << cos_theta;
    }
}

// Between the incidences that kernels are stored at, an interpolated fit is as near to the lobe as its own fit would
// be.
TEST(LobeFit, Interpolates) {
  for (const double alpha : {0.01, 0.03, 0.1, 0.2})
    for (int i = 1; i < 8; ++i) {
      const auto cosine = [](double row) { return static_cast<float>(row * row / 64); };
      const LobeFunction lobe = lobe_of(FacetModel::kGgx, alpha);
      const auto fit = [&](float c) { return fit_lobe(lobe, alpha, c); };
      const float below = cosine(i), above = cosine(i + 1), between = cosine(i + 0.5);
      const Vec4 low = in_mirror_frame(fit(below), below), high = in_mirror_frame(fit(above), above);
      const float amplitude = 0.5f * (fit(below).amplitude + fit(above).amplitude);
      const LobeFit found = in_surface_frame(mix_lobes(low, high, 0.5f), between, amplitude);
      EXPECT_LE(fit_distance(lobe, alpha, between, found), fit_distance(lobe, alpha, between, fit(between)) + 0.03)
          << alpha << " " << between;
      EXPECT_NEAR(found.amplitude, fit(between).amplitude, 0.03);  // as of any albedo from nine incidences
      const LobeFit same = in_surface_frame(mix_lobes(low, high, 0), below, 1);
      EXPECT_NEAR(same.m22, fit(below).m22, 1e-3f * same.m22);
      EXPECT_NEAR(same.m31, fit(below).m31, 1e-3f * (1 - same.m31));
    }
}

TEST(LobeFit, GrazingAndNarrowAreFinite) {
  for (const double alpha : {1e-5, 1e-3, 1.0})
    for (const double cos_theta : {1e-3, 0.01, 1.0}) {
      const LobeFit f = fit_lobe(lobe_of(FacetModel::kGgx, alpha), alpha, cos_theta);
      EXPECT_TRUE(std::isfinite(f.m11) && std::isfinite(f.m13) && std::isfinite(f.m22) && std::isfinite(f.m31));
      EXPECT_GT(f.m11 - f.m13 * f.m31, 0) << alpha << " " << cos_theta;
      EXPECT_GE(f.m11, 0);
      EXPECT_GT(f.m22, 0);
      EXPECT_LE(f.amplitude, 1);
    }
}

}  // namespace
}  // namespace oriel
