// Shadow volumes of any triangles: what is counted along a line, against the triangles that the line to the light
// meets.
#include "study/support/shadow_mesh.h"

#include <gtest/gtest.h>

#include <random>

namespace oriel {
namespace {

// Which side of the plane through a, b, c a place is on; homogeneous.
double side_of(const DVec4& a, const DVec4& b, const DVec4& c, const DVec4& p) {
  return glm::determinant(DMat4(a, b, c, p));
}

// +1 where the segment enters a triangle from its front, -1 from its back, 0 where it misses it. Corners may be
// directions: w = 0.
int crossing(const std::array<DVec4, 3>& t, const DVec4& from, const DVec4& to) {
  const double start = side_of(t[0], t[1], t[2], from), end = side_of(t[0], t[1], t[2], to);
  if ((start > 0) == (end > 0)) return 0;
  const DVec4 at = from + (to - from) * (start / (start - end));
  const DVec4 above = at + (from - to);  // off the plane, on the side of `from`
  for (int k = 0; k < 3; ++k) {
    const double within = side_of(t[k], t[(k + 1) % 3], above, at),
                 whole = side_of(t[k], t[(k + 1) % 3], above, t[(k + 2) % 3]);
    if ((within > 0) != (whole > 0)) return 0;
  }
  return start < 0 ? 1 : -1;  // a triangle's front sees it counter-clockwise: the determinant is negative there
}

bool meets(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& from, const Vec3& to) {
  return crossing({DVec4(DVec3(a), 1), DVec4(DVec3(b), 1), DVec4(DVec3(c), 1)}, DVec4(DVec3(from), 1),
                  DVec4(DVec3(to), 1)) != 0;
}

std::vector<UVec3> random_triangles(std::mt19937& random, std::uint32_t places, int count) {
  std::uniform_int_distribution<std::uint32_t> any(0, places - 1);
  std::vector<UVec3> out;
  for (int i = 0; i < count; ++i) out.emplace_back(any(random), any(random), any(random));  // some have no area
  return out;
}

// Open, folded, self-crossing triangles that share edges as chance has it.
TEST(ShadowMesh, CountsTheTrianglesBetween) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto place = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  int blocked = 0;
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec3> positions;
    for (int i = 0; i < 12; ++i) positions.push_back(place());
    const std::vector<UVec3> triangles = random_triangles(random, 12, 14);
    const ShadowMesh mesh(positions, triangles);
    const Vec3 light = 3.0f * place(), eye = 2.0f * place();
    const ShadowMesh::WholeVolumes volumes = mesh.whole_volumes(Vec4(light, 1));
    const auto corner = [&](std::uint32_t v) {
      const DVec3 p(mesh.positions()[v / 2]);
      return v % 2 == 0 ? DVec4(p, 1) : DVec4(p - DVec3(light), 0);
    };
    for (int i = 0; i < 40; ++i) {
      const Vec3 at = 1.5f * place();
      std::uint32_t expected = 0;
      for (const UVec3& t : triangles)
        if (t.x != t.y && t.y != t.z && t.z != t.x && meets(positions[t.x], positions[t.y], positions[t.z], at, light))
          ++expected;
      ASSERT_EQ(mesh.triangles_between(Vec4(at, 1), Vec4(light, 1)), expected) << round << ", " << i;
      int counted = static_cast<int>(mesh.triangles_between(Vec4(eye, 1), Vec4(light, 1)));
      for (std::size_t k = 0; k < volumes.indices.size(); k += 3) {
        const std::uint32_t* v = volumes.indices.data() + k;
        counted += crossing({corner(v[0]), corner(v[1]), corner(v[2])}, DVec4(DVec3(eye), 1), DVec4(DVec3(at), 1));
      }
      ASSERT_EQ(counted, static_cast<int>(expected)) << round << ", " << i;
      blocked += expected > 0;
    }
  }
  EXPECT_GT(blocked, 100);
}

// A lamp in a triangle's plane is not behind it, and one without area hides nothing.
TEST(ShadowMesh, WhatTheLightLiesInThrowsNoShadow) {
  const std::vector<Vec3> positions{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}, {2, 0, -1}};
  const std::vector<UVec3> one{{0, 1, 2}}, flat{{0, 1, 3}};
  const ShadowMesh mesh(positions, one);
  EXPECT_TRUE(mesh.whole_volumes({0, 1e-6f, 0, 1}).indices.empty());
  EXPECT_EQ(mesh.triangles_between({0.1f, -1, 0, 1}, {0, 1e-6f, 0, 1}), 0u);
  EXPECT_EQ(mesh.whole_volumes({0, 0.01f, 0, 1}).indices.size(), 3u * 6 + 3);
  EXPECT_EQ(mesh.triangles_between({0.1f, -1, 0, 1}, {0, 0.01f, 0, 1}), 1u);
  EXPECT_TRUE(ShadowMesh(positions, flat).whole_volumes({0, 1, 0, 1}).indices.empty());
  EXPECT_TRUE(ShadowMesh({}, {}).whole_volumes({0, 1, 0, 1}).indices.empty());
}

// Two triangles of a sheet have one outline: what they share is no side.
TEST(ShadowMesh, NeighboursShareNoSide) {
  const std::vector<Vec3> positions{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {1, 0, 1}, {0, 0, 0}};
  for (const UVec3& second : {UVec3(5, 4, 3), UVec3(3, 4, 5)}) {  // whichever way it is wound
    const std::vector<UVec3> sheet{{0, 1, 2}, second};
    EXPECT_EQ(ShadowMesh(positions, sheet).whole_volumes({0.5f, 2, 0.3f, 1}).sides, 4u * 6);
  }
}

}  // namespace
}  // namespace oriel
