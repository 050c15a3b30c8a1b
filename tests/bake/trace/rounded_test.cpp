// Light of one direction on coarse bodies with smooth normals: no facet shows.
#include <gtest/gtest.h>

#include "bake/trace/path.h"
#include "bake/trace/rounded.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

constexpr float kSun_lux = 1000;

Light sun(const Vec3& direction) {
  Light light;
  light.type = LightType::kDirectional;
  light.direction = direction;
  light.intensity = Vec3(kSun_lux);
  return light;
}

struct Lit {
  Vec3 normal{0}, facet{0};
  float lux = 0, rounded = 0;
  bool turned_away = false;
};

// Direct light at points of the scene's first triangles, from outside.
std::vector<Lit> lit_points(test::SceneParts& parts, std::uint32_t triangles) {
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const Transport transport{accel, lights, {}};
  std::vector<Lit> found;
  std::uint64_t rays = 0;
  for (std::uint32_t t = 0; t < triangles; ++t)
    for (const Vec2& at : {Vec2(0.3f, 0.4f), Vec2(0.05f, 0.05f), Vec2(0.1f, 0.8f), Vec2(0.49f, 0.49f)}) {
      const SurfacePoint p = point_on_side(accel, t, at);
      Sampler sampler(1, t, 0);
      found.push_back({p.normal, p.geometric_normal, sample_irradiance(transport, p, sampler, rays).direct.g, p.rounded,
                       glm::dot(p.geometric_normal, scene.lights[0].direction) >= 0});
    }
  return found;
}

TEST(Rounded, BodiesOfFewFacetsAreLitByTheirNormals) {
  for (const int levels : {0, 1, 2, 4}) {
    test::SceneParts parts;
    parts.sphere("ball", parts.diffuse(Vec3(0)), {0, 0, 0}, 0.4f, levels);
    parts.scene().lights = {sun(glm::normalize(Vec3(-1, -0.4f, 0.3f)))};
    int turned_away = 0;
    for (const Lit& p : lit_points(parts, 20u << (2 * levels))) {
      const float cosine = glm::dot(p.normal, -parts.scene().lights[0].direction);
      if (levels == 0 && p.turned_away) continue;  // 37° from its corners: such edges are meant
      EXPECT_NEAR(p.lux, kSun_lux * std::max(0.0f, cosine), 0.5f) << levels << " levels, cosine " << cosine;
      turned_away += p.turned_away && cosine > 0 ? 1 : 0;
    }
    EXPECT_GE(turned_away, levels == 0 ? 0 : 10) << "facets turned away that their normals light";
  }
}

TEST(Rounded, ALampIsNotHiddenByItself) {
  test::SceneParts parts;
  parts.sphere("ball", parts.diffuse(Vec3(0)), {0, 0, 0}, 0.4f, 1);
  parts.quad("panel", parts.diffuse(Vec3(0), Vec3(100)), {-0.5f, 0.45f, -0.5f}, {1, 0, 0}, {0, 0, 1});
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  for (std::uint32_t t = 0; t < 80; ++t) {
    const Receiver r = receiver_of(point_on_side(accel, t, Vec2(0.3f)));
    const Vec3 to = Vec3(0.45f, 0.4499f, 0.45f) - r.position;
    const float distance = glm::length(to);
    if (glm::dot(r.geometric_normal, to) >= 0 || glm::dot(r.normal, to) <= 0) continue;
    EXPECT_EQ(accel.transmittance(leaving(r, {r.position, to / distance, distance})), Vec3(1)) << t;
  }
}

TEST(Rounded, WhatIsCloseStillShades) {
  test::SceneParts parts;
  parts.sphere("ball", parts.diffuse(Vec3(0)), {0, 0, 0}, 0.4f, 1);
  parts.box("shell", parts.diffuse(Vec3(0)), Vec3(-0.401f), Vec3(0.401f), true);
  parts.scene().lights = {sun({-1, 0, 0})};
  for (const Lit& p : lit_points(parts, 80)) EXPECT_EQ(p.lux, 0);
}

// A shell of the same facets, which lie under the ball's rounded surface.
TEST(Rounded, NoRayLeavesPastALining) {
  test::SceneParts parts;
  parts.sphere("ball", parts.diffuse(Vec3(0)), {0, 0, 0}, 0.4f, 1);
  parts.sphere("shell", parts.diffuse(Vec3(0)), {0, 0, 0}, 0.405f, 1, true);
  parts.scene().sky = Vec3(1000);
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const Transport transport{accel, lights, {}};
  std::uint64_t rays = 0;
  for (std::uint32_t t = 0; t < 80; ++t) {
    const SurfacePoint p = point_on_side(accel, t, Vec2(0.3f, 0.35f));
    for (std::uint32_t k = 0; k < 256; ++k) {
      Sampler sampler(1, t, k);
      ASSERT_EQ(sample_irradiance(transport, p, sampler, rays).direct, Vec3(0)) << t;
    }
  }
}

// A sun shines on a mirrored floor beside the ball.
TEST(Rounded, LightOfMirrorsGoesAsLightDoes) {
  test::SceneParts parts;
  parts.sphere("ball", parts.diffuse(Vec3(0)), {0, 3, 0}, 0.4f, 1);
  SceneMaterial mirror;
  mirror.metallic = 1, mirror.roughness = 0;
  parts.quad("mirror", parts.add(mirror), {-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  parts.scene().lights = {sun(glm::normalize(Vec3(-1, -1, 0)))};
  const Vec3 from = -parts.scene().lights[0].direction, mirrored(from.x, -from.y, 0);
  int turned_away = 0;
  for (const Lit& p : lit_points(parts, 80)) {
    const float cosine = std::max(0.0f, glm::dot(p.normal, mirrored));
    EXPECT_NEAR(p.lux, kSun_lux * (std::max(0.0f, glm::dot(p.normal, from)) + cosine), 0.5f) << cosine;
    turned_away += glm::dot(p.facet, mirrored) <= 0 && cosine > 0 ? 1 : 0;
  }
  EXPECT_GE(turned_away, 10);
}

TEST(Rounded, HollowsAndEdgesAreNot) {
  test::SceneParts hollow;
  hollow.sphere("bowl", hollow.diffuse(Vec3(0)), {0, 0, 0}, 0.4f, 2, true);
  hollow.scene().lights = {sun({-1, 0, 0})};
  for (const Lit& p : lit_points(hollow, 320)) EXPECT_EQ(p.rounded, 0);
  // A box whose corners share their normals.
  test::SceneParts box;
  box.box("box", box.diffuse(Vec3(0)), Vec3(-1), Vec3(1));
  Scene& scene = box.scene();
  for (std::size_t i = 0; i < scene.positions.size(); ++i) scene.normals[i] = glm::normalize(scene.positions[i]);
  scene.lights = {sun(glm::normalize(Vec3(-1, -0.2f, 0.1f)))};
  for (const Lit& p : lit_points(box, 12)) {
    EXPECT_EQ(p.rounded, 0);
    EXPECT_TRUE(p.lux == 0 || !p.turned_away);
  }
}

}  // namespace
}  // namespace oriel
