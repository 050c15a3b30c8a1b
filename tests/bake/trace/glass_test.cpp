// Solid glass against closed forms.
#include "bake/trace/glass.h"

#include <gtest/gtest.h>

#include "tests/bake/support/glass_slab.h"
#include "tests/bake/support/light_meter.h"

namespace oriel {
namespace {

using test::SceneParts, test::solid_glass, test::slab_transmittance;

class World : public test::LightMeter {
 public:
  using LightMeter::LightMeter;

  // Radiance along a ray.
  Vec3 look(const Vec3& from, const Vec3& direction, std::uint32_t samples) const {
    DVec3 sum(0);
    for (std::uint32_t k = 0; k < samples; ++k) {
      Sampler sampler(3, 1, k);
      const PathLight light = trace_path({accel(), lights(), {}}, {from, glm::normalize(direction)}, 0, sampler, rays);
      sum += DVec3(light.emitted + light.sky + light.scattered);
    }
    return Vec3(sum / double(samples));
  }
  // Irradiance at a point in the air.
  Vec3 lux(const Vec3& p, const Vec3& n, std::uint32_t samples) const { return Vec3(at(p, n, samples)); }
};

// Glass between y = 0 and its thickness, so wide that nobody meets its sides.
SceneParts slab_of(const SceneMaterial& material, float thickness, float half_width = 50) {
  SceneParts parts;
  parts.box("slab", parts.add(material), {-half_width, 0, -half_width}, {half_width, thickness, half_width});
  return parts;
}
void add_sun(SceneParts& parts, float height_deg) {
  Light sun;
  sun.type = LightType::kDirectional;
  const float h = height_deg * kPi / 180;
  sun.direction = {std::cos(h), -std::sin(h), 0};
  sun.intensity = Vec3(1000);
  parts.scene().lights.push_back(sun);
}
Vec3 down_at(double angle_deg) {
  const double a = angle_deg * kPiD / 180;
  return Vec3(DVec3(std::sin(a), -std::cos(a), 0));
}

TEST(Glass, SnellsLaw) {
  for (const double eta : {1.0, 1.0001, 1.33, 1.5, 2.4, 1 / 1.33, 1 / 1.5})
    for (const double cosine : {1.0, 0.9, 0.5, 0.1, 1e-4, 0.0}) {
      const double sine = std::sqrt(1 - cosine * cosine) / eta;
      const auto found = refracted_cosine(eta, cosine);
      ASSERT_EQ(found.has_value(), sine <= 1 || std::abs(sine - 1) < 1e-12) << eta << " " << cosine;
      if (!found) continue;
      EXPECT_NEAR(*found, std::sqrt(std::max(0.0, 1 - sine * sine)), 1e-6) << eta << " " << cosine;
      if (cosine == 0) continue;
      const DVec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
      const auto wi = refract_about(wo, {0, 0, 1}, eta);
      ASSERT_TRUE(wi);
      EXPECT_NEAR(wi->x, -sine, 1e-9);
      EXPECT_NEAR(wi->z, -*found, 1e-9);
    }
}

TEST(Glass, ASurfaceReflectsAlikeFromBothSides) {
  ShadePoint outside;
  outside.f0 = Vec3(static_cast<float>(dielectric_f0(1.5)));
  outside.curve = {.ior = 1.5f, .schlick = 0};
  outside.alpha = 0, outside.transmission = Vec3(1), outside.eta = 1.5f;
  ShadePoint inside = outside;
  turn_inside(inside);
  EXPECT_FLOAT_EQ(inside.eta, 1 / 1.5f);
  for (const double cosine : {1.0, 0.9, 0.8, 0.75}) {
    EXPECT_NEAR(reflectance(inside, static_cast<float>(cosine)).g, fresnel_dielectric(1 / 1.5, cosine), 1e-5);
  }
  const double critical = std::sqrt(1 - 1 / 2.25);
  EXPECT_LT(reflectance(inside, static_cast<float>(critical + 1e-3)).g, 0.8f);
  for (const double cosine : {critical - 1e-6, 0.5, 0.1, 1e-4, 0.0}) {
    EXPECT_EQ(reflectance(inside, static_cast<float>(cosine)), Vec3(1)) << cosine;
    if (cosine == 0) continue;
    const Vec3 wo(static_cast<float>(std::sqrt(1 - cosine * cosine)), 0, static_cast<float>(cosine));
    for (const float u : {0.0f, 0.5f, 0.9999f}) {
      const auto s = Bsdf(inside, wo).sample(u, Vec2(0.3f, 0.7f));
      ASSERT_TRUE(s);
      EXPECT_EQ(s->lobe, Lobe::kSpecular);
      EXPECT_EQ(s->weight, Vec3(1)) << "total internal reflection";
      EXPECT_NEAR(glm::distance(s->wi, Vec3(-wo.x, 0, wo.z)), 0, 1e-6f);
    }
  }
}

TEST(Glass, ASlabShiftsWhatIsBehindIt) {
  constexpr double kThick = 0.3, kFrom = 1, kFloor = -0.5;
  for (const double angle : {0.0, 30.0, 60.0, 80.0}) {
    const double a = angle * kPiD / 180, within = std::asin(std::sin(a) / 1.5);
    // Where the ray meets the floor that goes through once.
    const double x = (kFrom - kThick - kFloor) * std::tan(a) + kThick * std::tan(within);
    SceneParts parts = slab_of(solid_glass(), kThick, 10);
    const auto bright = parts.diffuse(Vec3(0), Vec3(1));
    const auto lower = static_cast<float>(kFloor);
    // From there to 1 mm beyond.
    parts.quad("bright", bright, {static_cast<float>(x), lower, 5}, {1e-3f, 0, 0}, {0, 0, -10});
    const World world(parts.finish());
    const double once = std::pow(1 - fresnel_dielectric(1.5, std::cos(a)), 2);
    const auto seen = [&](float beside) { return world.look({beside, kFrom, 0}, down_at(angle), 4096).g; };
    const auto to_and_fro =
        static_cast<float>(slab_transmittance(1.5, std::cos(a)) - once);  // at 0° it falls on the same place
    EXPECT_NEAR(seen(5e-4f), once + (angle == 0 ? to_and_fro : 0), 0.02) << angle;
    EXPECT_EQ(seen(-5e-4f), 0) << angle;
    EXPECT_EQ(seen(15e-4f), 0) << angle;
  }
}

TEST(Glass, ASlabPassesWhatTheClosedFormSays) {
  const Vec3 absorption(0, 1, 4);
  for (const double angle : {0.0, 40.0, 70.0, 85.0}) {
    SceneParts parts = slab_of(solid_glass(1.5f, absorption), 0.5f);
    parts.quad("floor", parts.diffuse(Vec3(0), Vec3(1)), {-40, -1, 40}, {80, 0, 0}, {0, 0, -80});
    const World world(parts.finish());
    const Vec3 seen = world.look({0, 1, 0}, down_at(angle), 1 << 16);
    const double cosine = std::cos(angle * kPiD / 180);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(seen[c] / slab_transmittance(1.5, cosine, 0.5 * double{absorption[c]}), 1, 0.01)
          << angle << " channel " << c;
  }
}

// The sun is met by no path: its light goes straight, and is what it would be bent.
TEST(Glass, TheSunThroughASlab) {
  for (const float height : {90.0f, 50.0f, 20.0f, 5.0f}) {
    SceneParts parts = slab_of(solid_glass(1.5f, Vec3(0, 1, 4)), 0.5f);
    add_sun(parts, height);
    const World world(parts.finish());
    const double sine = std::sin(double{height} * kPiD / 180);
    const Vec3 lux = world.lux({0, -1, 0}, {0, 1, 0}, 1);
    for (int c = 0; c < 3; ++c) {
      const double expected =
          1000 * sine * slab_transmittance(1.5, sine, 0.5 * std::array{0, 1, 4}[static_cast<std::size_t>(c)]);
      EXPECT_NEAR(lux[c] / expected, 1, 1e-3) << height << " channel " << c;
    }
  }
}

TEST(Glass, ShadowRaysToWhatPathsMeetEndAtIt) {
  SceneParts parts = slab_of(solid_glass(1.5f, Vec3(1)), 0.5f);
  const World world(parts.finish());
  const Ray down{{0, 2, 0}, {0, -1, 0}, 5, false};
  EXPECT_EQ(world.accel().transmittance(down), Vec3(0));
  Ray past = down;
  past.past_solids = true;
  EXPECT_NEAR(world.accel().transmittance(past).g, slab_transmittance(1.5, 1, 0.5), 1e-4);
  past.max_distance = 1.75f;  // it ends within: after one face and 25 cm
  EXPECT_NEAR(world.accel().transmittance(past).g, 0.96 * std::exp(-0.25), 1e-4);
  past.origin.y = 0.25f, past.max_distance = 5;  // it begins within
  EXPECT_NEAR(world.accel().transmittance(past).g, 0.96 * std::exp(-0.25), 1e-4);
  std::vector<Ray> both{down, past};
  std::vector<Vec3> passed(2);
  world.accel().transmittance(both, passed);
  EXPECT_EQ(passed[0], Vec3(0));
  EXPECT_GT(passed[1].g, 0.7f);
}

// A bright ceiling over a slab: light sampling and paths share it, neither counts it twice.
TEST(Glass, ALampBehindASlabCountsOnce) {
  SceneParts parts = slab_of(solid_glass(1.5f, Vec3(0, 0, 2)), 0.2f);
  parts.quad("ceiling", parts.diffuse(Vec3(0), Vec3(1)), {-40, 0.5f, -40}, {80, 0, 0}, {0, 0, 80});
  const World world(parts.finish());
  const Vec3 lux = world.lux({0, -0.3f, 0}, {0, 1, 0}, 1 << 16);
  for (const int c : {0, 2})
    EXPECT_NEAR(lux[c] / test::slab_irradiance(1.5, c == 2 ? 0.4 : 0.0), 1, 0.01) << "channel " << c;
}

// Under an even sky a body that absorbs nothing cannot be seen; no body is ever brighter.
TEST(Glass, FurnaceOfBodies) {
  for (const float roughness : {0.0f, 0.1f, 0.5f, 1.0f})
    for (const float ior : {1.0f, 1.0001f, 1.33f, 1.5f, 2.4f})
      for (const bool ball : {true, false}) {
        SceneParts parts;
        const auto m = parts.add(solid_glass(ior, Vec3(0, 0, 3), roughness));
        if (ball)
          parts.sphere("ball", m, Vec3(0), 1, 4);
        else
          parts.box("box", m, Vec3(-1), Vec3(1));
        parts.scene().sky = Vec3(1);
        const World world(parts.finish());
        for (const float beside : {0.01f, 0.5f, 0.9f}) {
          const Vec3 seen = world.look({beside, 0.3f, 5}, {0.05f, -0.04f, -1}, 2048);
          EXPECT_NEAR(seen.r, 1, roughness > 0 ? 0.03 : 0.015) << roughness << " " << ior << " " << ball;
          EXPECT_LE(seen.b, seen.r + 0.02);
        }
      }
}

// The eye in the glass: radiance is n² as dense there, and light from beyond the critical angle never left.
TEST(Glass, TheEyeWithin) {
  SceneParts parts = slab_of(solid_glass(), 1);
  parts.scene().sky = Vec3(1);
  const World world(parts.finish());
  EXPECT_NEAR(world.look({0, 0.5f, 0}, {0.3f, -1, 0.1f}, 1 << 14).g, 2.25, 0.02);
  EXPECT_NEAR(world.look({0, 0.5f, 0}, {3, -1, 0}, 64).g, 2.25, 1e-3) << "reflected totally, to the far sides";
  EXPECT_TRUE(is_finite(world.look({0, 0.5f, 0}, {1, 0, 0}, 16))) << "along the slab";
}

TEST(Glass, WhatLiesInGlassIsSeenThroughIt) {
  SceneParts parts = slab_of(solid_glass(1.5f, Vec3(1, 0, 0)), 1);
  parts.quad("within", parts.diffuse(Vec3(0), Vec3(1)), {-40, 0.5f, 40}, {80, 0, 0}, {0, 0, -80});
  const World world(parts.finish());
  const Vec3 seen = world.look({0, 2, 0}, {0, -1, 0}, 1 << 14);
  EXPECT_NEAR(seen.g, 0.96 / 2.25, 0.005);
  EXPECT_NEAR(seen.r / seen.g, std::exp(-0.5), 0.005);
}

TEST(Glass, ScenesWithoutItTraceAsManyRays) {
  const auto rays = [](bool solid) {
    SceneParts parts;
    parts.quad("floor", parts.diffuse(Vec3(0.5f)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    if (solid) parts.add(solid_glass());  // that no surface has
    parts.scene().sky = Vec3(1);
    const World world(parts.finish());
    world.lux({0, 0.5f, 0}, {0, -1, 0}, 64);
    return world.rays;
  };
  EXPECT_EQ(rays(false), rays(true));
}

}  // namespace
}  // namespace oriel
