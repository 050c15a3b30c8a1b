// Closed-form irradiance of polygons against published configuration factors, and against its own samples.
#include "bake/trace/polygon_light.h"

#include <gtest/gtest.h>

#include "bake/trace/sampler.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

PolygonLight quad_light(const Vec3& o, const Vec3& u, const Vec3& v, bool double_sided = false) {
  test::SceneParts parts;
  const auto material = parts.diffuse(Vec3(0), Vec3(1));
  parts.scene().materials[material].double_sided = double_sided;
  parts.quad("light", material, o, u, v);
  const Scene scene = parts.finish();
  const auto lights = find_polygon_lights(scene);
  EXPECT_EQ(lights.size(), 1u);
  return lights.at(0);
}

// A parallel rectangle a × b at distance c, over its corner (Howell B-3), as irradiance over radiance: π F.
double corner_factor(double a, double b, double c) {
  const double x = a / c, y = b / c, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return 0.5 * (x / p * std::atan(y / p) + y / q * std::atan(x / q));
}

double sampled(const PolygonLight& light, const Receiver& r, std::uint32_t n) {
  double sum = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    Sampler sampler(1, 2, i);
    if (const auto s = sample_polygon(light, r, sampler.next2())) sum += incidence(r, s->direction) * s->solid_angle;
  }
  return sum / n;
}

TEST(PolygonLight, IsARectangleFromItsTwoTriangles) {
  const PolygonLight light = quad_light(Vec3(0, 1, 0), Vec3(2, 0, 0), Vec3(0, 0, 3));
  EXPECT_EQ(light.triangles.size(), 2u);
  EXPECT_EQ(light.boundary.size(), 4u);
  EXPECT_NEAR(light.area_m2(), 6, 1e-6);
}

TEST(PolygonLight, EqualsTheConfigurationFactorOverACorner) {
  for (const double c : {0.001, 0.1, 1.0, 10.0, 1000.0}) {
    const PolygonLight light =
        quad_light(Vec3(0, static_cast<float>(c), 0), Vec3(1, 0, 0), Vec3(0, 0, 0.5f));  // front: -y
    const double expected = corner_factor(1, 0.5, c);
    EXPECT_NEAR(polygon_irradiance(light, {Vec3(0), Vec3(0, 1, 0), Vec3(0, 1, 0)}), expected, 2e-4 * expected + 1e-6)
        << c;
  }
}

TEST(PolygonLight, ClipsAtTheHorizon) {
  // A receiver on a wall sees the half of the ceiling light on its side.
  const PolygonLight whole = quad_light(Vec3(-1, 1, -1), Vec3(2, 0, 0), Vec3(0, 0, 2));
  const PolygonLight half = quad_light(Vec3(0, 1, -1), Vec3(1, 0, 0), Vec3(0, 0, 2));
  const Receiver wall{Vec3(0), Vec3(1, 0, 0), Vec3(1, 0, 0)};
  EXPECT_NEAR(polygon_irradiance(whole, wall), polygon_irradiance(half, wall), 1e-6);
  EXPECT_GT(polygon_irradiance(half, wall), 0.1);
}

TEST(PolygonLight, BackAndBelowAreDark) {
  const PolygonLight light = quad_light(Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1));
  const Vec3 up(0, 1, 0);
  EXPECT_EQ(polygon_irradiance(light, {Vec3(0.5f, 2, 0.5f), -up, -up}), 0);  // behind it
  EXPECT_EQ(polygon_irradiance(light, {Vec3(0.5f, 0, 0.5f), -up, -up}), 0);  // below the horizon
  EXPECT_EQ(polygon_irradiance(light, {Vec3(0.5f, 1, 0.5f), up, up}), 0);    // in its plane
  const PolygonLight both = quad_light(Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 1), true);
  EXPECT_NEAR(polygon_irradiance(both, {Vec3(0.5f, 2, 0.5f), -up, -up}),
              polygon_irradiance(both, {Vec3(0.5f, 0, 0.5f), up, up}), 1e-6);
}

TEST(PolygonLight, AFaceInTouchGivesAtMostPi) {
  const PolygonLight light = quad_light(Vec3(-50, 1, -50), Vec3(100, 0, 0), Vec3(0, 0, 100));
  EXPECT_NEAR(polygon_irradiance(light, {Vec3(0, 0.999f, 0), Vec3(0, 1, 0), Vec3(0, 1, 0)}), kPi, 1e-3);
}

TEST(PolygonLight, SamplesAgreeWithTheClosedForm) {
  const Vec3 g(0, 1, 0);
  for (const Vec3& o : {Vec3(-0.3f, 0.5f, -0.4f), Vec3(0.1f, 0.02f, 0.1f), Vec3(3, 8, -2), Vec3(-1, -0.5f, 2)})
    for (const Vec3& n : {g, glm::normalize(Vec3(0.6f, 1, -0.3f)), glm::normalize(Vec3(-2, 1, 0.5f))}) {
      const PolygonLight light = quad_light(o, Vec3(1, 0.3f, 0), Vec3(0, 0, 1.5f));
      const Receiver r{Vec3(0), n, g};
      const double closed = polygon_irradiance(light, r);
      EXPECT_NEAR(sampled(light, r, 1 << 16), closed, 2e-3 * closed + 1e-5);
    }
}

TEST(PolygonLight, ATiltedNormalLosesNothingUnderAUniformHemisphere) {
  // Under light from everywhere the fold of the lobe gives π for every shading normal.
  test::SceneParts parts;
  const auto material = parts.diffuse(Vec3(0), Vec3(1));
  parts.box("sky", material, Vec3(-1), Vec3(1), true);
  const Scene scene = parts.finish();
  for (const Vec3& n : {Vec3(0, 1, 0), glm::normalize(Vec3(1, 1, 0)), glm::normalize(Vec3(3, 1, 1))}) {
    double sum = 0;
    for (const PolygonLight& light : find_polygon_lights(scene))
      sum += polygon_irradiance(light, {Vec3(0.2f, 0.1f, -0.3f), n, Vec3(0, 1, 0)});
    EXPECT_NEAR(sum, kPi, 1e-4);
  }
}

}  // namespace
}  // namespace oriel
