// Reflections on curved surfaces: a ball in a room against the reflection that it must show, lobes, extremes.
#include <cstdio>
#include <optional>
#include <random>

#include "tests/player/curved_scene.h"

namespace oriel {
namespace {

using namespace test;
using testing::FrameTest;
using testing::Picture;

// The ray through a pixel's centre, and where it meets the ball; false where it does not.
struct BallHit {
  Vec3 at{0}, normal{0}, mirror{0};
};
bool hit_ball(const Ball& ball, const Camera& camera, const Vec2& pixel, int width, int height, BallHit& out) {
  const Vec3 right = glm::normalize(glm::cross(camera.forward, camera.up)), up = glm::cross(right, camera.forward);
  const float t = std::tan(0.5f * camera.vertical_fov_rad);
  const Vec2 ndc = (pixel + 0.5f) / Vec2(width, height) * 2.0f - 1.0f;
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const Vec3 d = glm::normalize(camera.forward + t * aspect * ndc.x * right - t * ndc.y * up);
  const Vec3 to = ball.centre - camera.eye;
  const float b = glm::dot(to, d), disc = b * b - glm::dot(to, to) + ball.radius * ball.radius;
  if (disc <= 0) return false;
  out.at = camera.eye + (b - std::sqrt(disc)) * d;
  out.normal = (out.at - ball.centre) / ball.radius;
  out.mirror = glm::reflect(d, out.normal);
  return true;
}

using CurvedFrames = FrameTest;

// Each pixel of a mirror ball shows what its reflected rays meet: near to the mean over the pixel, and light that none
// of the pixels within two of it sees only where the filter reaches over an edge.
TEST_F(CurvedFrames, AMirrorBallShowsTheRoom) {
  const Ball ball;
  const Camera camera = looking_at({0.1f, 1.5f, 1.9f}, ball.centre);
  constexpr int kWidth = 240, kHeight = 200, kSub = 4;
  FrameOptions options;
  options.show = Show::kMKR;
  const Picture picture =
      draw(ball_pack(ball, room_map(ball.centre, 512, wall_light)), camera, kWidth, kHeight, options);
  ASSERT_TRUE(picture.finite());
  EXPECT_EQ(picture.stats.reflectors, 1u);
  EXPECT_EQ(renderer_->read_reflective()[kHeight / 2 * kWidth + kWidth / 2], 0);
  EXPECT_EQ(renderer_->read_reflective()[0], -1);
  // The light that a point of the picture shows; nothing outside the ball and in its rim, where all is squeezed.
  const auto light_at = [&](const Vec2& pixel) -> std::optional<Vec3> {
    BallHit hit;
    if (!hit_ball(ball, camera, pixel, kWidth, kHeight, hit)) return {};
    if (glm::dot(hit.normal, glm::normalize(camera.eye - hit.at)) < 0.25f) return {};
    return wall_light(exit_point(hit.at, hit.mirror));
  };
  int pixels = 0, strange = 0;
  double squared = 0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      Vec3 low(1e30f), high(0), mean(0);
      int seen = 0, within = 0;
      for (int k = 0; k < 25; ++k)
        if (const auto light = light_at(Vec2(x + k % 5 - 2, y + k / 5 - 2))) {
          low = glm::min(low, *light);
          high = glm::max(high, *light);
          ++seen;
        }
      for (int k = 0; k < kSub * kSub; ++k)
        if (const auto light = light_at(Vec2(x, y) + (Vec2(k % kSub, k / kSub) + 0.5f) / float(kSub) - 0.5f)) {
          mean += *light / float(kSub * kSub);
          ++within;
        }
      if (seen < 25 || within < kSub * kSub) continue;
      ++pixels;
      const Vec3 shown = picture.at(x, y);
      squared += glm::dot(shown - mean, shown - mean) / 3;
      strange += glm::any(glm::lessThan(shown, low - 1.0f)) || glm::any(glm::greaterThan(shown, high + 1.0f));
    }
  EXPECT_GT(pixels, 5000);
  EXPECT_LT(strange, 0.005 * pixels);
  const double psnr = 10 * std::log10(100.0 * 100.0 * pixels / squared);
  EXPECT_GT(psnr, 25) << "of squares with edges as sharp as can be";
  std::printf("mirror ball: %d pixels, PSNR %.1f dB\n", pixels, psnr);
}

Pack glossy(Pack pack) {
  BrdfKernel& kernel = pack.kernels[0];
  kernel.size = 9;
  kernel.alpha = 0.2f;
  kernel.half_extent = 0.5f;
  kernel.weights.assign(81, 1.0f / 81);
  return pack;
}

// The largest difference of neighbours in the middle of a picture of 120 by 100.
float roughest(const Picture& p) {
  float most = 0;
  for (int y = 30; y < 70; ++y)
    for (int x = 40; x < 80; ++x) most = std::max(most, glm::length(p.at(x, y) - p.at(x + 1, y)));
  return most;
}

// A flat side beside the map's centre, which it faces away from little more than towards.
Pack side_pack(const Vec3& centre, const SurroundMap& map) {
  Pack pack = glossy(ball_pack({}, map));
  for (std::size_t v = 0; v < pack.mesh.positions.size(); ++v) {
    const Vec3 n = pack.mesh.normals[v];
    pack.mesh.positions[v] = centre + Vec3(0.6f + 0.4f * n.x, 0.4f * n.y, 0.02f);
  }
  std::fill(pack.mesh.normals.begin(), pack.mesh.normals.end(), Vec3(0, 0, 1));
  return pack;
}

// Where a map shows things that are nearer to its centre than the surface that it is for, no distance fits: light is
// shown without creases, whatever those distances are.
TEST_F(CurvedFrames, WhatLiesWithinTheSurfaceMakesNoCreases) {
  const Vec3 centre(0, 1.5f, 0);
  const Camera camera = looking_at(centre + Vec3(1.6f, 0, 1), centre + Vec3(0.6f, 0, 0));
  SurroundMap map = room_map(centre, 128, [](const Vec3& at) { return Vec3(10 + 2 * at.x + 3 * at.y); });
  FrameOptions options;
  options.show = Show::kMK;
  const float smooth = roughest(draw(side_pack(centre, map), camera, 120, 100, options));
  ASSERT_GT(smooth, 0);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> inverse(2, 20);
  for (float& i : map.inverse_distance) i = inverse(random);
  const float rough = roughest(draw(side_pack(centre, map), camera, 120, 100, options));
  EXPECT_LT(rough, 2 * smooth);
}

// A lobe shows the mean of the room weighted by it: for a room of even light that light, and less contrast otherwise.
TEST_F(CurvedFrames, ALobeBlurs) {
  const Ball ball;
  const Camera camera = looking_at({0.1f, 1.5f, 1.9f}, ball.centre);
  FrameOptions options;
  options.show = Show::kMK;
  const Picture even = draw(glossy(ball_pack(ball, room_map(ball.centre, 64, [](const Vec3&) { return Vec3(7); }))),
                            camera, 60, 50, options);
  ASSERT_TRUE(even.finite());
  EXPECT_LT(glm::length(even.at(30, 25) - Vec3(7)), 0.05f);
  const Pack room = ball_pack(ball, room_map(ball.centre, 256, wall_light));
  const auto contrast = [&](const Pack& pack) {
    const Picture p = draw(pack, camera, 120, 100, options);
    double sum = 0;
    for (int y = 40; y < 60; ++y)
      for (int x = 50; x < 70; ++x) sum += glm::length(p.at(x, y) - p.at(x + 1, y));
    return sum;
  };
  EXPECT_LT(contrast(glossy(room)), 0.3 * contrast(room));
  options.blur = Blur::kOff;
  EXPECT_EQ(contrast(glossy(room)), contrast(room));
}

// Off, stages, an eye at the surface and within, a ball on the floor, one pixel, orthographic: finite everywhere.
TEST_F(CurvedFrames, ExtremesStayFinite) {
  Ball ball;
  ball.centre.y = ball.radius;  // touches the floor
  const Pack pack = ball_pack(ball, room_map(ball.centre, 64, wall_light), 24, 12);
  FrameOptions options;
  const Camera far = looking_at({0.1f, 1.5f, 1.9f}, ball.centre);
  for (const Show show : {Show::kAll, Show::kM, Show::kMK, Show::kMKR, Show::kD}) {
    options.show = show;
    EXPECT_TRUE(draw(pack, far, 64, 48, options).finite());
  }
  options.show = Show::kAll;
  Camera plan = looking_at({0.3f, 2.9f, 0.2f}, ball.centre);
  plan.up = {0, 0, -1};
  plan.vertical_fov_rad = 0;
  plan.half_height = 1;
  for (const Camera& camera :
       {plan, looking_at(ball.centre + Vec3(0, 0, 0.5001f), ball.centre + Vec3(1, 0, 0.5f)),
        looking_at(ball.centre, ball.centre + Vec3(1, 0, 0)), looking_at({0.3f, 0.5f, 1000}, ball.centre)})
    EXPECT_TRUE(draw(pack, camera, 32, 32, options).finite());
  EXPECT_TRUE(draw(pack, far, 1, 1, options).finite());
  options.reflections = Reflections::kOff;
  EXPECT_EQ(draw(pack, far, 32, 32, options).stats.reflectors, 0u);
}

// A see-through ball adds its reflection to what is behind.
TEST_F(CurvedFrames, AGlassBallReflectsToo) {
  const Ball ball;
  Pack pack = ball_pack(ball, room_map(ball.centre, 64, [](const Vec3&) { return Vec3(10); }));
  pack.materials[0].metallic = 0;
  pack.materials[0].transmission = 1;
  pack.fresnel_maps = {testing::flat_reflectance(Vec3(0.25f))};
  pack.sky = Vec3(4);
  const Camera camera = looking_at({0.1f, 1.5f, 1.9f}, ball.centre);
  const Picture picture = draw(pack, camera, 60, 50);
  ASSERT_TRUE(picture.finite());
  EXPECT_LT(glm::length(picture.at(30, 25) - Vec3(0.75f * 4 + 0.25f * 10)), 0.1f);
}

// Two sides of one reflector that meet in a slanted ridge, and between them a strip of `bevel` metres over which the
// normal turns from one to the other.
constexpr float kSlant = 0.3f;
Pack ridge_pack(const Vec3& centre, const SurroundMap& map, float bevel) {
  Pack pack = ball_pack({}, map);
  pack.mesh.positions.clear();
  pack.mesh.normals.clear();
  for (const float u : {-0.5f, -0.5f * bevel, 0.5f * bevel, 0.5f})
    for (const float v : {-0.5f, 0.5f}) {
      const Vec3 across(std::cos(kSlant), std::sin(kSlant), 0), along(-across.y, across.x, 0), out(0, 0, 1);
      pack.mesh.positions.push_back(centre + u * across + v * along - 0.75f * std::abs(u) * out);
      pack.mesh.normals.push_back((pack.mesh.normals.size() < 4 ? -0.6f : 0.6f) * across + 0.8f * out);
    }
  pack.mesh.uvs.assign(8, Vec2(0));
  pack.mesh.lightmap_uvs.assign(8, Vec2(0));
  pack.mesh.indices = {0, 2, 3, 0, 3, 1, 2, 4, 5, 2, 5, 3, 4, 6, 7, 4, 7, 5};
  pack.mesh.parts[0].index_count = 18;
  pack.curved_reflectors[0].indices = pack.mesh.indices;
  return pack;
}

// Each sample of a pixel on the ridge shows its own side's reflection. One side's for all made dashes of edges.
TEST_F(CurvedFrames, SamplesOnAnEdgeShowTheirOwnSides) {
  const Vec3 centre(0, 1.5f, 0);
  constexpr int kWidth = 120, kHeight = 100, kSub = 16;
  FrameOptions options;
  options.show = Show::kMKR;
  options.samples = 4;
  const SurroundMap map = room_map(centre, 128, [](const Vec3& at) { return Vec3(at.x < 0 ? 10 : 90); });
  const Picture p =
      draw(ridge_pack(centre, map, 0), looking_at(centre + Vec3(0, 0, 2), centre), kWidth, kHeight, options);
  int edges = 0;
  for (int y = 35; y < 65; ++y)
    for (int x = 40; x < 80; ++x) {
      int right = 0;
      for (int k = 0; k < kSub * kSub; ++k) {
        const Vec2 at = Vec2(x, y) + (Vec2(k % kSub, k / kSub) + 0.5f) / float(kSub) - 0.5f * Vec2(kWidth, kHeight);
        right += std::cos(kSlant) * at.x - std::sin(kSlant) * at.y > 0;
      }
      const float share = static_cast<float>(right) / (kSub * kSub);
      edges += share > 0.1f && share < 0.9f;
      EXPECT_NEAR((p.at(x, y).x - 10) / 80, share, 0.3f) << "four samples know it to about 1/4";
    }
  EXPECT_GT(edges, 20);
}

// Normals are those of the strip where a pixel's middle lies beside it: beyond, they would turn until it is seen flat,
// where it reflects five times as much.
TEST_F(CurvedFrames, NormalsEndWithTheirTriangle) {
  const Vec3 centre(0, 1.5f, 0);
  FrameOptions options;
  options.show = Show::kMKR;
  options.samples = 4;
  Pack pack = ridge_pack(centre, room_map(centre, 64, [](const Vec3&) { return Vec3(10); }), 0.002f);
  pack.fresnel_maps[0].table = {Vec3(1), Vec3(1), Vec3(1), Vec3(0.2f), Vec3(0.2f)};  // from a cosine of 9 / 16 on
  const Picture p = draw(pack, looking_at(centre + Vec3(0, 0, 2), centre), 120, 100, options);
  for (int y = 35; y < 65; ++y)
    for (int x = 40; x < 80; ++x) EXPECT_NEAR(p.at(x, y).x, 2, 0.02f) << x << ", " << y;
}

}  // namespace
}  // namespace oriel
