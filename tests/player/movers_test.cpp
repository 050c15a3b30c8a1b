// Movers under known light, read back as cd/m², beside the same maths on the CPU.
#include "bake/trace/sampler.h"
#include "formats/core/octahedral.h"
#include "formats/core/sh.h"
#include "formats/query/camera.h"
#include "formats/query/mover_pose.h"
#include "player/movers/light_samples.h"
#include "player/movers/shadow_shaft.h"
#include "player/navigation/drag.h"
#include "tests/player/mover_fixture.h"

namespace oriel {
namespace {
using namespace testing;

class Movers : public FrameTest {};

TEST_F(Movers, EvenLightShowsTheAlbedo) {
  const Picture p = draw(mover_pack(even_field({8, 16, 4})), camera_at({0, 0, 3}), 16, 16);
  expect_near(p.at(8, 8), Vec3(4, 4, 4), 1e-4f);
}

// What light from one side makes of a plane depends on how the plane is turned, not on where it stands.
TEST_F(Movers, LightTurnsAgainstTheObject) {
  const Pack pack = mover_pack(even_field(Vec3(8), 3));
  std::vector<float> y(4);
  for (const float yaw : {0.0f, 0.7f, 1.5f, -1.0f}) {
    FrameOptions options;
    options.poses = {moved({}, {"leaf", DVec3(0.5, 0.25, -1), yaw}, DVec3(0))};
    const Vec3 normal(std::sin(yaw), 0, std::cos(yaw)), at = options.poses[0].position;
    evaluate_sh(Vec3(1, 0, 0), y);
    const float irradiance = 8 * (kPi + 3 * static_cast<float>(cosine_factor(1)) * y[3] * normal.x);
    expect_near(draw(pack, camera_at(at + 3.0f * normal, at), 16, 16, options).at(8, 8),
                Vec3(0.5f, 0.25f, 1) * irradiance / kPi, 1e-3f);
  }
}

// Components, clusters and weights in the shader, beside CompressedTransfer::expand at the four corners.
TEST_F(Movers, TheShaderExpandsTransferAsTheCpuDoes) {
  Pack pack = mover_pack(even_field({8, 16, 4}, 0.5f));
  Mover& mover = pack.movers[0];
  CompressedTransfer& t = mover.transfer;
  t.channels = 3;
  t.clusters = 3;
  t.components = 6;
  t.basis.clear();
  std::uint32_t state = 1;
  const auto random = [&] { return static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) / 0x1p24f; };
  for (int row = 0; row < 3 * 7; ++row)
    for (std::size_t k = 0; k < t.stride(); ++k) t.basis.push_back(row % 7 == 0 ? 0.5f + random() : random() - 0.5f);
  for (int i = 0; i < 18; ++i) t.weight_scale.push_back(0.3f * random());
  t.cluster = {0, 2, 1, 2};
  for (int i = 0; i < 24; ++i) t.weight.push_back(static_cast<std::int16_t>(65534 * random() - 32767));
  const LightProbe& probe = pack.light_field.probes[0];
  std::vector<float> expanded(t.stride());
  const Vec3 corners[] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  for (std::size_t v = 0; v < 4; ++v) {
    t.expand(v, expanded);
    Vec3 expected(0);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 4; ++k) expected[static_cast<int>(c)] += expanded[4 * c + k] * probe.sh[4 * c + k];
    expected = Vec3(0.5f, 0.25f, 1) * glm::max(expected, Vec3(0));
    const Vec3 near_corner = 0.999f * corners[v];
    const Camera camera = look_at(near_corner + Vec3(0, 0, 0.5f), near_corner, 1e-3f);
    expect_near(draw(pack, camera, 3, 3).at(1, 1), expected, 5e-3f);
  }
}

TEST_F(Movers, TheirShadowsTakeTheLampsLightAlone) {
  const Pack pack = shadow_scene();
  expect_near(draw(pack, above_floor(0.1f, 0.1f), 5, 5).at(2, 2), Vec3(60 / kPi), 1e-2f);
  expect_near(draw(pack, above_floor(1.8f, -1.7f), 5, 5).at(2, 2),
              Vec3(100 - 640 * 4 / std::pow(16.0f + 1.8f * 1.8f + 1.7f * 1.7f, 1.5f)) / kPi, 1e-2f);
  expect_near(draw(pack, above_floor(2.3f, 0), 5, 5).at(2, 2), Vec3(100 / kPi), 1e-6f);
  // The mover itself: even light, and the lamp 2 m over it.
  expect_near(draw(pack, look_at({0, 1, 0.01f}, Vec3(0), 0.05f), 5, 5).at(2, 2),
              Vec3(0.5f, 0.25f, 1) * (kPi + 160) / kPi, 1e-2f);
}

// Bright lights are known by pixel, edges by sample: a mover has their light wherever it is seen, however it is turned.
TEST_F(Movers, TiltedOnesHaveTheirLightWithSeveralSamples) {
  const Pack pack = shadow_scene();
  for (const Vec3& eye : {Vec3(3, 0.7f, 0.5f), Vec3(-3, 0.7f, 0.5f), Vec3(0.5f, 0.7f, 3), Vec3(0.4f, 0.7f, -3)}) {
    const Camera camera = look_at(eye, Vec3(0), 0.6f);
    FrameOptions options;
    const Picture plain = draw(pack, camera, 48, 48, options);
    options.samples = 4;
    const Picture smooth = draw(pack, camera, 48, 48, options);
    float darkest = 1e9f, least = 1e9f;  // of the mover, which is brighter in blue than what lies around it is in any
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 48; ++x) {
        const auto is_mover = [](const Vec3& c) { return c.b > 1.5f * c.r && c.r > 0; };
        if (is_mover(plain.at(x, y))) darkest = std::min(darkest, plain.at(x, y).b);
        if (is_mover(smooth.at(x, y))) least = std::min(least, smooth.at(x, y).b);
      }
    EXPECT_GT(darkest, 10) << "the lamp is on it";
    EXPECT_GT(least, 0.2f * darkest) << "a pixel, of which it covers a quarter or more, has lost the lamp";
  }
}

TEST_F(Movers, WhatTheSceneShadesIsNotTakenTwice) {
  Pack pack = shadow_scene();
  add_quad(pack, {-3, 1, -3}, {6, 0, 0}, {0, 0, 6}, 1, 0);  // between lamp and mover, seen from above and below
  add_quad(pack, {-3, 1, 3}, {6, 0, 0}, {0, 0, -6}, 1, 0);
  expect_near(draw(pack, above_floor(0.1f, 0.1f), 5, 5).at(2, 2), Vec3(100 / kPi), 1e-6f);
  expect_near(draw(pack, look_at({0, 0.5f, 0.01f}, Vec3(0), 0.05f), 5, 5).at(2, 2), Vec3(0.5f, 0.25f, 1), 1e-4f);
}

TEST_F(Movers, NothingElseChanges) {
  Pack pack = shadow_scene();
  const Camera camera = look_at({3, 1, 3.5f}, {3.2f, -2, 0}, 0.4f);
  const Picture with = draw(pack, camera, 32, 32);
  pack.movers.clear();
  const Picture without = draw(pack, camera, 32, 32);
  EXPECT_EQ(with.rgb, without.rgb);
}

TEST_F(Movers, ExtremesStayFinite) {
  Pack pack = shadow_scene();
  const Camera camera = look_at({0, 1, 3}, Vec3(0), 1.0f);
  std::vector<MoverPose> poses;
  for (const Vec3& at : {Vec3(0, 2, 0), Vec3(0, -2, 0), Vec3(0, -3, 0), Vec3(1e4f, 0, 0), Vec3(-4, 0, 4)})
    poses.push_back({at, {0, 0, 0, 1}});
  for (const float scale : {1e-4f, 1.0f, 1e4f}) {
    Pack scaled = pack;
    for (Vec3& p : scaled.movers[0].mesh.positions) p *= scale;
    for (const MoverPose& pose : poses)
      for (const MoverLights lights : {MoverLights::kShadowed, MoverLights::kUnshadowed, MoverLights::kHarmonics}) {
        FrameOptions options;
        options.poses = {pose};
        options.mover_lights = lights;
        EXPECT_TRUE(draw(scaled, camera, 8, 8, options).finite()) << scale << " " << pose.position.y;
      }
  }
  pack.light_field = {};
  expect_near(draw(pack, camera, 9, 9).at(4, 4), Vec3(0), 1e-6f);
  for (LightProbe& probe : (pack = shadow_scene()).light_field.probes) probe.valid = false;
  EXPECT_TRUE(draw(pack, camera, 8, 8).finite());
}

TEST(LightSamples, GiveThePolygonsIrradiance) {
  BrightLight light;
  light.kind = BrightLightKind::kPolygon;
  light.intensity = Vec3(100);
  light.direction = {0, -1, 0};
  light.corners = {{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, -1}, {1, 2, 1}, {-1, 2, 1}};
  const LightSamples samples = sample_light(light);
  float lux = 0;
  for (std::size_t i = 0; i < samples.at.size(); ++i) {
    Vec3 towards;
    const Vec3 facing = facing_irradiance(samples, i, Vec3(0), towards);
    lux += facing.x * towards.y / static_cast<float>(samples.at.size());
  }
  // A square over a point, by Lambert: four quarters of side 1 at distance 2.
  const float x = 1 / std::sqrt(5.0f), expected = 100 * 4 * 2 * 0.5f * x * std::atan(x);
  EXPECT_NEAR(lux, expected, 0.02f * expected);
}

// Of a square of side 2 the mean square off its middle is 1/3 along each axis, of a disk of radius 1 it is 1/4.
TEST(LightSamples, AreEvenOverManyLooks) {
  BrightLight square, sun;
  square.kind = BrightLightKind::kPolygon;
  square.direction = {0, -1, 0};
  square.corners = {{-1, 2, -1}, {1, 2, -1}, {1, 2, 1}, {-1, 2, -1}, {1, 2, 1}, {-1, 2, 1}};
  sun.kind = BrightLightKind::kDirectional;
  sun.direction = {0, -1, 0};
  sun.angular_radius_rad = 0.1f;
  for (const int points : {1, 4}) {
    Vec2 of_square(0), of_sun(0), mean(0);
    constexpr int kLooks = 256;
    for (std::uint32_t look = 0; look < kLooks; ++look) {
      for (const Vec4& at : sample_light(square, points, look).at) {
        of_square += Vec2(at.x * at.x, at.z * at.z) / static_cast<float>(kLooks * points);
        mean += Vec2(at.x, at.z) / static_cast<float>(kLooks * points);
      }
      for (const Vec4& at : sample_light(sun, points, look).at) {
        const Vec2 off = Vec2(at.x, at.z) / at.y / std::tan(0.1f);
        of_sun += off * off / static_cast<float>(kLooks * points);
      }
    }
    EXPECT_LT(glm::length(mean), 0.02f);
    for (int c = 0; c < 2; ++c) {
      EXPECT_NEAR(of_square[c], 1 / 3.0f, 0.01f);
      EXPECT_NEAR(of_sun[c], 0.25f, 0.01f);
    }
  }
}

// Shadows of points all over the light stay within the cone and its box, as far as the bounds go.
TEST(ShadowCone, HoldsTheShadow) {
  const Bounds bounds{Vec3(-4, -2, -4), Vec3(4, 3, 4)};
  const Vec4 sphere(0.5f, -0.5f, -0.25f, 0.6f);
  for (const Vec4& light : {Vec4(0, 2.5f, 0, 0.8f), Vec4(3, 0, 1, 0), Vec4(-3, 2, 2, 1.5f)}) {
    const ShadowCone cone = make_shadow_cone(sphere, Vec3(light), light.w, false);
    ASSERT_FALSE(cone.everywhere);
    const ShadowBox box = make_shadow_box(cone, bounds);
    Sampler sampler(1, 2, 3);
    for (int i = 0; i < 2000; ++i) {
      const auto on_sphere = [&] { return sphere_from_square(sampler.next2()); };
      const Vec3 from = Vec3(light) + light.w * on_sphere(), by = Vec3(sphere) + sphere.w * on_sphere();
      const Vec3 p = by + 8 * sampler.next1() * (by - from);
      EXPECT_TRUE(may_meet(cone, Vec4(p, 0))) << i;
      if (glm::any(glm::lessThan(p, bounds.lower)) || glm::any(glm::greaterThan(p, bounds.upper))) continue;
      const Vec3 off = (p - cone.center) * cone.frame;
      const float start = ((box[0] - cone.center) * cone.frame).z, end = ((box[4] - cone.center) * cone.frame).z;
      EXPECT_TRUE(off.z >= start && off.z <= end) << i;
    }
  }
  EXPECT_FALSE(may_meet(make_shadow_cone(sphere, Vec3(0.5f, 3, -0.25f), 0.1f, false), Vec4(3, -0.5f, 0, 0.1f)));
  EXPECT_TRUE(make_shadow_cone(sphere, Vec3(0.5f, 0, 0), 0.5f, false).everywhere);
}

TEST(Drag, TakesWhatIsSeenFirst) {
  Pack pack;
  pack.movers = {plane_mover(), plane_mover()};
  pack.movers[1].name = "other";
  const std::vector<MoverPose> poses{{{0, 0, -2}, {0, 0, 0, 1}}, {{0.5f, 0, 1}, {0, 0, 0, 1}}};
  const Bounds all{Vec3(-2), Vec3(2)};
  const View view = make_view(look_at({0, 0, 5}, {0, 0, 0}, 1.0f), 100, 100, all);
  const auto middle = grip_mover(pack, poses, ray_through(view, {0.5f, 0.5f}));
  ASSERT_TRUE(middle);
  EXPECT_EQ(middle->mover, 1u);
  EXPECT_NEAR(glm::distance(middle->at, Vec3(0, 0, 1)), 0, 1e-3f);
  const auto left = grip_mover(pack, poses, ray_through(view, {0.375f, 0.5f}));
  ASSERT_TRUE(left);
  EXPECT_EQ(left->mover, 0u);
  EXPECT_LT(left->at.x, -0.5f);
  EXPECT_FALSE(grip_mover(pack, poses, ray_through(view, {0.02f, 0.02f})));
  add_quad(pack, {-1, -1, 3}, {2, 0, 0}, {0, 2, 0}, 0, -1);  // stands still, before both
  EXPECT_FALSE(grip_mover(pack, poses, ray_through(view, {0.5f, 0.5f})));
}

TEST(Drag, FollowsTheLevel) {
  const PickRay down{{0, 2, 0}, glm::normalize(Vec3(1, -1, 0))};
  const auto at = on_level(down, 0.5f, 10);
  ASSERT_TRUE(at);
  EXPECT_NEAR(glm::distance(*at, Vec3(1.5f, 0.5f, 0)), 0, 1e-6f);
  EXPECT_FALSE(on_level(down, 3, 10));
  EXPECT_FALSE(on_level(down, 0.5f, 1));
  EXPECT_FALSE(on_level({{0, 2, 0}, {1, 0, 0}}, 0.5f, 10));
  std::vector<MoverMove> moves;
  move_of(moves, plane_mover().name, DVec3(11, 2, 3)).yaw_rad = kPiD / 2;
  EXPECT_EQ(text_of(move_of(moves, plane_mover().name, DVec3(0))), "leaf=11.000,2.000,3.000,90.0");
  EXPECT_EQ(moves.size(), 1u);
}

TEST(Shaft, HoldsItsSphere) {
  for (const Vec4& at : {Vec4(0, 5, 0, 1), Vec4(0, 1, 0, 0), Vec4(3, -2, 1, 1)}) {
    const Vec4 sphere(0.5f, 0, -0.25f, 0.75f);
    const Shaft shaft = make_shaft(at, sphere);
    const Mat4 clip = clip_from_pack(shaft, mover_range(shaft, sphere.w));
    for (int i = 0; i < 26; ++i) {
      const Vec3 way = glm::normalize(Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1) + 1e-4f);
      const Vec4 p = clip * Vec4(Vec3(sphere) + 0.999f * sphere.w * way, 1);
      for (int axis = 0; axis < 3; ++axis) EXPECT_LE(std::abs(p[axis] / p.w), 1.0f) << i;
    }
  }
}

TEST(MoverPoses, FollowTheirKeysAgainAndAgain) {
  const float half = std::sqrt(0.5f);
  const std::vector<MoverKey> keys{{1, {{0, 0, 0}, {0, 0, 0, 1}}}, {3, {{4, 0, 0}, {0, half, 0, half}}}};
  EXPECT_EQ(pose_at({}, keys, 0.5).position, Vec3(0));
  EXPECT_NEAR(pose_at({}, keys, 2).position.x, 2, 1e-6f);
  EXPECT_NEAR(pose_at({}, keys, 2).rotation.y, std::sin(kPi / 8), 1e-6f);
  EXPECT_NEAR(pose_at({}, keys, 5).position.x, 2, 1e-6f);
  EXPECT_EQ(pose_at({{7, 0, 0}, {0, 0, 0, 1}}, {}, 2).position, Vec3(7, 0, 0));
  EXPECT_TRUE(is_finite(pose_at({}, keys, NAN).position));
}

TEST(MoverPoses, AreReadFromText) {
  const auto move = parse_move("a=b=1,-2.5,3e1,90");
  ASSERT_TRUE(move);
  EXPECT_EQ(move->node, "a=b");
  EXPECT_EQ(move->position, DVec3(1, -2.5, 30));
  EXPECT_NEAR(move->yaw_rad, kPiD / 2, 1e-12);
  for (const char* bad :
       {"", "a", "a=", "=1,2,3", "a=1,2", "a=1,2,3,4,5", "a=1,2,x", "a=1,2,3,", "a=nan,0,0", "a=1,2,inf"})
    EXPECT_FALSE(parse_move(bad)) << bad;
}

}  // namespace
}  // namespace oriel
