// What flat frosted panes show of lights behind them, against the density of their facets.
#include <cmath>

#include "tests/player/glass_fixture.h"

namespace oriel {
namespace {

using namespace testing;

constexpr Vec3 kTint(0.9f, 0.6f, 0.3f);
constexpr float kRadiance = 1e6f, kHalf = 0.005f;  // of a square light

// A pane of 4 m² in z = 0, lit from z < 0 by a square about `light` that faces it; its nodes see those shares of it.
Pack lit_pane(float roughness, const Vec3& light, std::uint8_t left = 255, std::uint8_t right = 255) {
  Pack pack = glass_pack(1.5f, roughness);
  pack.solids.clear();
  pack.materials[0].base_color = kTint, pack.materials[0].double_sided = true;
  add_quad(pack, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0, -1);
  const Vec3 z = glm::normalize(-light), x = glm::normalize(glm::cross(Vec3(0, 1, 0), z)), y = glm::cross(z, x);
  pack.emitters = {
      {{light - kHalf * (x + y), light + kHalf * (x - y), light + kHalf * (x + y), light - kHalf * (x - y)},
       Vec3(kRadiance),
       false}};
  Reflector side;
  side.pack_from_reflector = Mat4(Vec4(-1, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, -1, 0), Vec4(0, 0, 0, 1));
  side.lower = Vec2(-1), side.upper = Vec2(1), side.area_m2 = 4;
  side.indices = pack.mesh.indices;
  side.emitters = {0};
  side.visibility_x = side.visibility_y = 2;
  side.visibility = {left, right, left, right};
  pack.frosted_panes = {side};
  return pack;
}

// D G1 / (4 cosθo) of both facets that turn wo to wi, times the light's irradiance at p.
// n: unit, on the eye's side.
double expected_glow(double roughness, const DVec3& eye, const DVec3& p, const DVec3& light,
                     const DVec3& n = {0, 0, 1}) {
  const DVec3 wo = glm::normalize(eye - p), wi = glm::normalize(light - p);
  const double alpha = roughness * roughness, a2 = alpha * alpha;
  const double cos_o = glm::dot(wo, n);
  double density = 0;
  for (const DVec3& turned : {wi - 2 * glm::dot(wi, n) * n, wi}) {
    const double cos_h = glm::dot(wo + turned, n) / glm::length(wo + turned);
    if (!(cos_h > 0)) continue;
    const double d = a2 / (kPiD * std::pow(cos_h * cos_h * (a2 - 1) + 1, 2));
    density += d * 2 * cos_o / (cos_o + std::sqrt(a2 + (1 - a2) * cos_o * cos_o)) / (4 * cos_o);
  }
  const DVec3 way = light - p;
  return density * kRadiance * 4 * kHalf * kHalf / glm::dot(way, way);
}

class PaneGlowTest : public FrameTest {
 protected:
  // In the middle of a picture of what lies around p.
  Vec3 glow(const Pack& pack, const Vec3& eye, const Vec3& p, const FrameOptions& options = {}) {
    return draw(pack, glass_camera(eye, p, 0.01f), 9, 9, options).at(4, 4);
  }
};

TEST_F(PaneGlowTest, IsWhatFacetsSend) {
  for (const float roughness : {0.2f, 0.5f, 1.0f})
    for (const Vec3& light : {Vec3(0, 0, -2), Vec3(1, 0.5f, -1), Vec3(0, -30, -20)})
      for (const Vec3& eye : {Vec3(0, 0, 1.5f), Vec3(-0.8f, 0.3f, 1), Vec3(0.2f, 1, 0.3f)})
        for (const Vec3& p : {Vec3(0), Vec3(0.7f, -0.4f, 0)}) {
          const double expected = expected_glow(roughness, DVec3(eye), DVec3(p), DVec3(light));
          const Vec3 found = glow(lit_pane(roughness, light), eye, p);
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], expected * double{kTint[c]}, 0.02 * expected + 1e-4)
                << roughness << " light " << light.z << " eye " << eye.z << " at " << p.x;
        }
}

// Of a part of a bent pane, whose normals are not its plane's.
TEST_F(PaneGlowTest, GoesByNormals) {
  const DVec3 n = glm::normalize(DVec3(0.3, -0.1, 1));
  for (const bool turned : {false, true})
    for (const Vec3& light : {Vec3(0, 0, -2), Vec3(1, 0.5f, -1)})
      for (const Vec3& eye : {Vec3(0, 0, 1.5f), Vec3(-0.8f, 0.3f, 1)}) {
        Pack pack = lit_pane(0.5f, light);
        for (Vec3& normal : pack.mesh.normals) normal = Vec3(turned ? -n : n);
        const double expected = expected_glow(0.5, DVec3(eye), DVec3(0), DVec3(light), n);
        EXPECT_NEAR(glow(pack, eye, Vec3(0)).g, expected * double{kTint.g}, 0.02 * expected) << light.z << " " << eye.z;
      }
}

TEST_F(PaneGlowTest, GoesByWhatNodesSee) {
  const Vec3 light(0, 0, -2), eye(0, 0, 1.5f);
  const float all = glow(lit_pane(0.5f, light), eye, Vec3(0)).g;
  ASSERT_GT(all, 1);
  EXPECT_NEAR(glow(lit_pane(0.5f, light, 255, 0), eye, Vec3(0)).g / all, 0.5, 0.01);
  EXPECT_EQ(glow(lit_pane(0.5f, light, 0, 0), eye, Vec3(0)).g, 0);
}

// The lamp behind it is switched, dimmed and coloured; another one is not the pane's.
TEST_F(PaneGlowTest, FollowsTheLampsThatAreSwitched) {
  Pack pack = lit_pane(0.5f, {0, 0, -2});
  pack.light_groups.resize(2);
  pack.light_groups[0].name = "behind", pack.light_groups[0].emitters = {0};
  pack.light_groups[1].name = "other";
  const Vec3 eye(0, 0, 1.5f), all = glow(pack, eye, Vec3(0));
  ASSERT_GT(all.g, 1);
  for (const Vec3& factor : {Vec3(0), Vec3(0.5f, 1, 2), Vec3(1)})
    for (const float other : {0.0f, 1.0f}) {
      const Vec3 found = glow(pack, eye, Vec3(0), {.lights = {factor, Vec3(other)}});
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], factor[c] * all[c], 1e-3f * all[c]) << factor.x << " " << c;
    }
}

TEST_F(PaneGlowTest, IsNotSeenFromTheLitSideNorInClearGlass) {
  const Vec3 light(0.3f, 0, -2);
  EXPECT_EQ(glow(lit_pane(0.5f, light), {0, 0, -1.5f}, Vec3(0)).g, 0);
  EXPECT_EQ(glow(lit_pane(0.5f, light), {0, 0, 1.5f}, Vec3(0), {.blur = Blur::kOff}).g, 0);
  Pack hidden = lit_pane(0.5f, light);
  add_quad(hidden, {-1, -1, 0.5f}, {2, 0, 0}, {0, 2, 0}, add_lamp(hidden, Vec3(7)), -1);
  EXPECT_NEAR(glow(hidden, {0, 0, 1.5f}, Vec3(0)).g, 7, 0.01);
}

TEST_F(PaneGlowTest, StaysFinite) {
  for (const float roughness : {0.03f, 1.0f})
    for (const Vec3& light : {Vec3(0, 0.001f, -1e-5f), Vec3(0, 1, -1e5f), Vec3(50, 0, -1e-3f)})
      for (const Vec3& eye : {Vec3(0, 0.01f, 1e-4f), Vec3(3, 0, 1e-3f), Vec3(0, 0.5f, 100)}) {
        const Vec3 found = glow(lit_pane(roughness, light), eye, Vec3(0));
        EXPECT_TRUE(is_finite(found)) << roughness << " " << light.z << " " << eye.z;
        EXPECT_GE(found.g, 0);
      }
}

}  // namespace
}  // namespace oriel
