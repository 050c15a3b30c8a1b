// Light that goes from texel to texel: what surfaces pass on, in closed form.
#include "formats/query/live_bounces.h"

#include <gtest/gtest.h>

#include <cmath>

namespace oriel {
namespace {

constexpr std::uint32_t kSide = 8;  // texels of a wall
constexpr float kAlbedo = 0.5f;

// A cube of 2 m whose walls face inwards, with a page of kSide² texels each.
struct Cube {
  Mesh mesh;
  std::vector<Material> materials{1};
  std::vector<LightmapPage> pages;
  std::vector<std::vector<PagePoint>> points;

  Cube() {
    materials[0].base_color = Vec3(kAlbedo);
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-1.0f, 1.0f}) {
        Vec3 u(0), v(0), o(-1);
        u[(axis + 1) % 3] = 2, v[(axis + 2) % 3] = 2;
        o[axis] = side;
        side < 0 ? wall(o, u, v) : wall(o, v, u);
      }
    for (std::uint32_t p = 0; p < 6; ++p) points.push_back(page_points(mesh, {}, p, pages[p]));
  }
  void wall(const Vec3& o, const Vec3& u, const Vec3& v) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto page = static_cast<std::int32_t>(pages.size());
    for (const Vec2& at : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
      mesh.positions.push_back(o + at.x * u + at.y * v);
      mesh.normals.push_back(glm::normalize(glm::cross(u, v)));
      mesh.uvs.emplace_back(0), mesh.lightmap_uvs.push_back(at);
    }
    mesh.parts.push_back({"wall", static_cast<std::uint32_t>(mesh.indices.size()), 6, 0, page});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
    LightmapPage& added = pages.emplace_back();
    added.width = added.height = kSide;
    added.irradiance.assign(kSide * kSide, Vec3(0));
    added.state.assign(kSide * kSide, TexelState::kValid);
  }
  LampScene scene() const { return {{mesh, materials, {}, {}}, {}}; }
};

std::vector<std::vector<LiveSum>> everywhere(float now, float baked) {
  LiveSum sum;
  sum.now = Vec3(now), sum.baked = Vec3(baked);
  return {6, std::vector<LiveSum>(kSide * kSide, sum)};
}

// In a closed room that is lit alike everywhere n bounces give ρ + ρ² + … + ρⁿ of it: no light is lost or doubled.
TEST(LiveBounces, AClosedRoomHasAGeometricSum) {
  const Cube cube;
  const LampScene scene = cube.scene();
  LiveBounces bounces(scene, cube.pages, cube.points);
  bounces.trace(8, nullptr);
  for (const std::uint32_t count : {0u, 1u, 2u, 12u}) {
    const BouncedLight light = bounces.bounced(everywhere(100, 30), count, nullptr);
    const float expected = 100 * kAlbedo * (1 - std::pow(kAlbedo, static_cast<float>(count))) / (1 - kAlbedo);
    for (std::size_t p = 0; p < 6; ++p)
      for (std::size_t k = 0; k < cube.points[p].size(); ++k) {
        EXPECT_NEAR(light.at(p, k).now.g, expected, 0.01f * expected);
        EXPECT_NEAR(light.at(p, k).baked.g, 0.3f * expected, 0.01f * expected);
      }
    const float more = 100 * std::pow(kAlbedo, static_cast<float>(count + 1));
    EXPECT_NEAR(light.left, count > 0 ? more / (100 + expected) : 0, 0.005);
  }
}

// One wall shines: the middle of the wall across sees it under the closed form of parallel squares.
TEST(LiveBounces, OneWallIsAFormFactor) {
  const Cube cube;
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
  EXPECT_NEAR(middle, 100 * kAlbedo * factor, 0.05f * 100 * kAlbedo * factor);
  for (std::size_t k = 0; k < cube.points[0].size(); ++k) EXPECT_EQ(light.at(0, k).now, Vec3(0)) << "it is flat";
}

TEST(LiveBounces, StopEndsThemEarly) {
  const Cube cube;
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
