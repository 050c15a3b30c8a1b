// Light that goes from texel to texel: what surfaces pass on, in closed form.
#include "formats/query/live_bounces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/formats/query/lit_cube.h"

namespace oriel {
namespace {

std::vector<std::vector<LiveSum>> everywhere(float now, float baked) {
  LiveSum sum;
  sum.now = Vec3(now), sum.baked = Vec3(baked);
  return {6, std::vector<LiveSum>(kLitSide * kLitSide, sum)};
}

// In a closed room that is lit alike everywhere n bounces give ρ + ρ² + … + ρⁿ of it: no light is lost or doubled.
TEST(LiveBounces, AClosedRoomHasAGeometricSum) {
  const LitCube cube;
  const LampScene scene = cube.scene();
  LiveBounces bounces(scene, cube.pages, cube.points);
  bounces.trace(8, nullptr);
  for (const std::uint32_t count : {0u, 1u, 2u, 12u}) {
    const BouncedLight light = bounces.bounced(everywhere(100, 30), count, nullptr);
    const float expected = 100 * kLitAlbedo * (1 - std::pow(kLitAlbedo, static_cast<float>(count))) / (1 - kLitAlbedo);
    for (std::size_t p = 0; p < 6; ++p)
      for (std::size_t k = 0; k < cube.points[p].size(); ++k) {
        EXPECT_NEAR(light.at(p, k).now.g, expected, 0.01f * expected);
        EXPECT_NEAR(light.at(p, k).baked.g, 0.3f * expected, 0.01f * expected);
      }
    const float more = 100 * std::pow(kLitAlbedo, static_cast<float>(count + 1));
    EXPECT_NEAR(light.left, count > 0 ? more / (100 + expected) : 0, 0.005);
  }
}

// One wall shines: the middle of the wall across sees it under the closed form of parallel squares.
TEST(LiveBounces, OneWallIsAFormFactor) {
  const LitCube cube;
  const LampScene scene = cube.scene();
  LiveBounces bounces(scene, cube.pages, cube.points);
  bounces.trace(bounces.wanted_rays(), nullptr);
  EXPECT_EQ(bounces.rays(), 64u);
  std::vector<std::vector<LiveSum>> direct = everywhere(0, 0);
  for (LiveSum& sum : direct[0]) sum.now = Vec3(100);
  const BouncedLight light = bounces.bounced(direct, 1, nullptr);
  float middle = 0;
  for (std::size_t k = 0; k < cube.points[1].size(); ++k) {
    const Vec3& at = cube.points[1][k].position;
    if (std::abs(at.y) < 0.3f && std::abs(at.z) < 0.3f) middle += light.at(1, k).now.g / 4;
  }
  // From a corner of a rectangle of a x b at distance 1 (Howell's catalogue, C-3), four of them: a = b = 1/2.
  const float a = 0.5f, root = std::sqrt(1 + a * a);
  const float factor = 4 / (2 * kPi) * 2 * (a / root) * std::atan(a / root);
  EXPECT_NEAR(middle, 100 * kLitAlbedo * factor, 0.05f * 100 * kLitAlbedo * factor);
  for (std::size_t k = 0; k < cube.points[0].size(); ++k) EXPECT_EQ(light.at(0, k).now, Vec3(0)) << "it is flat";
}

TEST(LiveBounces, StopEndsThemEarly) {
  const LitCube cube;
  const LampScene scene = cube.scene();
  LiveBounces bounces(scene, cube.pages, cube.points);
  const std::atomic<bool> stop{true};
  bounces.trace(64, &stop);
  EXPECT_EQ(bounces.rays(), 0u);
  const BouncedLight light = bounces.bounced(everywhere(1, 1), 3, nullptr);
  EXPECT_EQ(light.at(0, 0).now, Vec3(0)) << "no rays yet";
}

}  // namespace
}  // namespace oriel
