// What frosted panes spread of points, spots and suns, against closed forms.
#include <gtest/gtest.h>

#include "bake/brdf/microfacet.h"
#include "bake/trace/lights.h"
#include "bake/trace/shading.h"
#include "tests/bake/support/light_meter.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::LightMeter;
using test::point_light;
using test::SceneParts;

constexpr Vec3 kTint(0.9f, 0.6f, 0.3f);

SceneMaterial frosted(float roughness) {
  SceneMaterial m;
  m.base_color = kTint;
  m.metallic = 0, m.roughness = roughness, m.transmission = 1, m.specular = 0, m.double_sided = true;
  return m;
}
Light frosted_sun(const Vec3& towards, float lux = 1000) {
  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = -glm::normalize(towards);
  sun.intensity = Vec3(lux);
  return sun;
}

// Of a pane with normal +z: radiance towards wo (z > 0) for each lux from behind, from wi (z < 0). Written down again:
// D G1 / (4 cosθo) of both facets that turn wo there.
double spread_per_lux(double alpha, const DVec3& wo, const DVec3& wi) {
  const auto cosine_density = [&](const DVec3& mirrored) {
    const DVec3 h = glm::normalize(wo + mirrored);
    if (!(h.z > 0)) return 0.0;
    const double a2 = alpha * alpha, c2 = h.z * h.z;
    const double d = a2 / (kPiD * std::pow(c2 * (a2 - 1) + 1, 2));
    const double g1 = 2 * wo.z / (wo.z + std::sqrt(a2 + (1 - a2) * wo.z * wo.z));
    return d * g1 / (4 * wo.z);
  };
  return cosine_density({wi.x, wi.y, -wi.z}) + cosine_density(wi);
}

// In a black wall.
SceneParts small_pane(float roughness, float half = 0.1f) {
  SceneParts parts;
  const std::uint32_t black = parts.diffuse(Vec3(0));
  const float wide = 2e4f;
  parts.quad("pane", parts.add(frosted(roughness)), {-half, -half, 0}, {2 * half, 0, 0}, {0, 2 * half, 0});
  parts.quad("left", black, {-wide, -wide, 0}, {wide - half, 0, 0}, {0, 2 * wide, 0});
  parts.quad("right", black, {half, -wide, 0}, {wide - half, 0, 0}, {0, 2 * wide, 0});
  parts.quad("below", black, {-half, -wide, 0}, {2 * half, 0, 0}, {0, wide - half, 0});
  parts.quad("above", black, {-half, half, 0}, {2 * half, 0, 0}, {0, wide - half, 0});
  return parts;
}

// Behind an endless pane, for each lux that comes along its normal.
double lux_behind(double alpha) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double theta = (i + 0.5) / kSteps * kPiD / 2, sine = std::sin(theta), cosine = std::cos(theta);
    sum += spread_per_lux(alpha, {sine, 0, cosine}, {0, 0, -1}) * cosine * 2 * kPiD * sine * kPiD / 2 / kSteps;
  }
  return sum;
}

TEST(Frosted, WhatPanesSpreadHasItsDensity) {
  for (const float roughness : {0.15f, 0.4f, 1.0f})
    for (const float degrees : {5.0f, 45.0f, 80.0f}) {
      SurfacePoint s;
      s.normal = s.geometric_normal = {0, 0, 1};
      s.shade.alpha = roughness * roughness, s.shade.transmission = Vec3(1), s.shade.f0 = Vec3(0);
      const float a = degrees * kPi / 180;
      const Shading shading(s, {std::sin(a), 0, std::cos(a)});
      double below = 0, of_a_half = 0, sampled = 0;  // ∫ pdf, and that of what goes to y > 0.1
      constexpr int kSteps = 1000;
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          const double z = -(i + 0.5) / kSteps, phi = 2 * kPiD * (j + 0.5) / kSteps, r = std::sqrt(1 - z * z);
          const double part = shading.spread_pdf(Vec3(DVec3(r * std::cos(phi), r * std::sin(phi), z))) * 2 * kPiD /
                              (double(kSteps) * kSteps);
          below += part;
          if (r * std::sin(phi) > 0.1) of_a_half += part;
        }
      EXPECT_NEAR(below, 1, 0.01) << roughness << " " << degrees;
      for (std::uint32_t k = 0; k < 20000; ++k) {
        Sampler sampler(1, 0, k);
        const Vec3 w = shading.spread(sampler.next2());
        EXPECT_LT(w.z, 0);
        sampled += w.y > 0.1f ? 1.0 / 20000 : 0;
      }
      EXPECT_NEAR(sampled, of_a_half, 0.012) << roughness << " " << degrees;
      EXPECT_EQ(shading.spread_pdf({0, 0, 1}), 0);
    }
}

// By hand at alpha 1: D is even, and what facets hide leaves 1 - ln 2.
TEST(Frosted, RoughPanesPassLessAlongTheirNormal) {
  EXPECT_NEAR(lux_behind(1), 1 - std::log(2.0), 1e-4);
  EXPECT_NEAR(lux_behind(0.16), 0.97, 0.005);
  SceneParts parts;
  parts.quad("pane", parts.add(frosted(1)), {-50, -50, 0}, {100, 0, 0}, {0, 100, 0});
  parts.scene().lights = {frosted_sun({0, 0, -1}, 100)};
  EXPECT_NEAR(LightMeter(parts.finish()).at({0, 0, 0.1f}, {0, 0, -1}, 20000).g / (60 * lux_behind(1)), 1, 0.03);
}

TEST(Frosted, ASmallPaneFarAwayShinesAsItsFacetsSay) {
  for (const float roughness : {0.2f, 0.5f, 1.0f})
    for (const DVec3& to_light : {DVec3(0, 0, -1), DVec3(0.5, 0.2, -1), DVec3(2, 0, -1)})
      for (const DVec3& receiver : {DVec3(0, 0, 2), DVec3(-1, -0.3, 2), DVec3(1, 1, 1)}) {
        for (const bool sun : {true, false}) {
          SceneParts parts = small_pane(roughness);
          parts.scene().lights = {sun ? frosted_sun(Vec3(to_light)) : point_light(Vec3(to_light))};
          const LightMeter meter(parts.finish());
          const DVec3 facing = glm::normalize(-receiver);
          double expected = 0;
          constexpr int kCells = 64;
          for (int x = 0; x < kCells; ++x)
            for (int y = 0; y < kCells; ++y) {
              const DVec3 p(0.2 * (x + 0.5) / kCells - 0.1, 0.2 * (y + 0.5) / kCells - 0.1, 0);
              const double far = glm::distance(receiver, p), away = glm::distance(to_light, p);
              const DVec3 wo = (receiver - p) / far;
              const DVec3 wi = sun ? glm::normalize(to_light) : (to_light - p) / away;
              expected += spread_per_lux(double{roughness} * roughness, wo, wi) * (sun ? 1000 : 100 / (away * away)) *
                          0.04 / (kCells * kCells) * wo.z * -glm::dot(facing, wo) / (far * far);
            }
          const DVec3 found = meter.at(Vec3(receiver), Vec3(facing), 20000);
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c] / (expected * double{kTint[c]}), 1, 0.04)
                << roughness << (sun ? " sun " : " lamp ") << to_light.x << " from " << receiver.x << " " << receiver.z;
        }
      }
}

// What is far from a large pane's edges gets as much as if light passed straight; a patch's edge is blurred.
TEST(Frosted, ALargePaneKeepsTheLightAndBlursItsEdge) {
  SceneParts parts = small_pane(0.3f, 1);
  parts.scene().lights = {frosted_sun({0, 0, -1})};
  const LightMeter meter(parts.finish());
  const Vec3 n(0, 0, -1);
  const double wide = 600 * lux_behind(0.09);
  EXPECT_NEAR(meter.at({0, 0, 0.1f}, n, 4000).g / wide, 1, 0.01);
  EXPECT_NEAR(meter.at({1, 0, 0.1f}, n, 8000).g / wide, 0.5, 0.015);
  const double inside = meter.at({0.94f, 0, 0.3f}, n, 20000).g, outside = meter.at({1.06f, 0, 0.3f}, n, 20000).g;
  EXPECT_LT(inside, 590);
  EXPECT_GT(outside, 30);
  EXPECT_NEAR((inside + outside) / wide, 1, 0.02);  // the lobe is even
}

// One sheet spreads, the other lets pass: as bright as one of its colour squared.
TEST(Frosted, SheetsBehindEachOtherSpreadOnce) {
  SceneParts parts;
  for (const float z : {0.0f, -0.01f})
    parts.quad("pane", parts.add(frosted(0.4f)), {-50, -50, z}, {100, 0, 0}, {0, 100, 0});
  parts.scene().lights = {frosted_sun({0, 0, -1}, 100)};
  EXPECT_NEAR(LightMeter(parts.finish()).at({0, 0, 1}, {0, 0, -1}, 80000).g / (36 * lux_behind(0.16)), 1, 0.01);
}

TEST(Frosted, CurvedBumpyAndClearPanesAreStraight) {
  SceneMaterial clear = frosted(0.005f), solid = frosted(0.4f), masked = frosted(0.4f);
  solid.solid = true;
  masked.alpha_mode = AlphaMode::kMask;
  for (const SceneMaterial& m : {clear, solid, masked}) {
    SceneParts parts;
    parts.quad("pane", parts.add(m), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    parts.scene().lights = {frosted_sun({0, 0, -1})};
    EXPECT_TRUE(LightMeter(parts.finish()).lights().frosted().empty());
  }
  SceneParts ball;
  ball.sphere("globe", ball.add(frosted(0.4f)), Vec3(0), 0.5f, 3);
  ball.scene().lights = {point_light(Vec3(0))};
  const LightMeter meter(ball.finish());
  EXPECT_TRUE(meter.lights().frosted().empty());
  EXPECT_NEAR(meter.at({0, 0, 2}, {0, 0, -1}, 64).g, 25 * 0.6, 0.3);
}

TEST(Frosted, WithoutLightsPanesAreAsAnyOther) {
  SceneParts parts = small_pane(0.4f, 1);
  const LightMeter meter(parts.finish());
  EXPECT_TRUE(meter.lights().frosted().empty());
  EXPECT_NEAR(meter.accel().transmittance({{0, 0, 1}, {0, 0, -1}, 2, true, false}).g, 0.6f, 1e-3f);
}

TEST(Frosted, APanesOwnSurfaceGetsNoneOfIt) {
  SceneParts parts = small_pane(0.4f, 1);
  parts.scene().lights = {frosted_sun({0, 0, -1})};
  const LightMeter meter(parts.finish());
  EXPECT_EQ(meter.at({0, 0, 0}, {0, 0, 1}, 256), DVec3(0));
  EXPECT_GT(meter.at({0, 0, 0}, {0, 0, -1}, 256).g, 999);
}

// Two surfaces in one place are one pane, and let through what two do.
TEST(Frosted, SurfacesInOnePlaceSpreadOnce) {
  double found[2];
  for (const bool twice : {false, true}) {
    SceneParts parts = small_pane(1.0f);
    if (twice) parts.quad("again", 0, {-0.1f, -0.1f, 0}, {0.2f, 0, 0}, {0, 0.2f, 0});
    parts.scene().lights = {frosted_sun({0, 0, -1})};
    found[twice] = LightMeter(parts.finish()).at({0.5f, 0, 2}, {0, 0, -1}, 20000).g;
  }
  EXPECT_GT(found[0], 0.1);
  EXPECT_LT(found[1], 1.05 * found[0]);
}

// The sheets of a pane of 6 mm in a scene of a kilometre.
TEST(Frosted, SheetsStayApartInLargeScenes) {
  SceneParts parts;
  const std::uint32_t glass = parts.add(frosted(0.4f));
  for (const float z : {0.0f, -0.006f}) parts.quad("pane", glass, {-50, -50, z}, {100, 0, 0}, {0, 100, 0});
  parts.quad("ground", parts.diffuse(Vec3(0)), {-1000, -60, -1000}, {0, 0, 2000}, {2000, 0, 0});
  parts.scene().lights = {frosted_sun({0, 0, -1}, 100)};
  const LightMeter meter(parts.finish());
  EXPECT_EQ(meter.lights().frosted().panes().size(), 4u);
  EXPECT_NEAR(meter.at({0, 0, 1}, {0, 0, -1}, 20000).g / (36 * lux_behind(0.16)), 1, 0.02);
}

TEST(Frosted, ExtremesStayFinite) {
  for (const float roughness : {0.0101f, 0.3f, 1.0f})
    for (const Vec3& light : {Vec3(0, 0, -1e-7f), Vec3(0, 0, -1e-3f), Vec3(1e4f, 0, -1e-2f), Vec3(0, 0, -1e6f)})
      for (const Vec3& p : {Vec3(0, 0, 1e-7f), Vec3(0, 0, 1e-3f), Vec3(1e4f, 0, 1e-2f), Vec3(0.2f, 0, 1)})
        for (const bool sun : {false, true}) {
          SceneParts parts = small_pane(roughness, 1);
          parts.quad("sliver", parts.add(frosted(roughness)), {-1, -1, 0.5f}, {2, 0, 0}, {0, 0, 0});
          parts.scene().lights = {sun ? frosted_sun(light) : point_light(light)};
          const DVec3 found = LightMeter(parts.finish()).at(p, {0, 0, -1}, 256);
          EXPECT_TRUE(std::isfinite(found.x + found.y + found.z)) << roughness << " " << light.z << " " << p.z;
          EXPECT_GE(std::min({found.x, found.y, found.z}), 0);
          EXPECT_LE(found.x, sun ? 1100 : 1e12) << roughness << " " << light.z << " " << p.z;
        }
}

TEST(Frosted, ManyLightsAreChosenWithoutBias) {
  SceneParts few, many;
  for (SceneParts* parts : {&few, &many}) {
    parts->quad("pane", parts->add(frosted(0.6f)), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
    parts->quad("beside", parts->add(frosted(0.6f)), {1, -1, 0}, {1, 0, 1}, {0, 2, 0});
  }
  few.scene().lights = {point_light({1, 0, -1}, 40)};
  many.scene().lights.assign(40, point_light({1, 0, -1}, 1));
  for (int i = 0; i < 60; ++i) many.scene().lights.push_back(point_light({0, 0, 1}, 0));
  const double one = LightMeter(few.finish()).at({0.3f, 0, 1}, {0, 0, -1}, 20000).g;
  EXPECT_NEAR(LightMeter(many.finish()).at({0.3f, 0, 1}, {0, 0, -1}, 4000).g / one, 1, 0.03);
}

}  // namespace
}  // namespace oriel
