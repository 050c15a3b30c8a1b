// Radiance maps' meshes against the planes that they are made of.
#include "bake/radiance/map_mesh.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "tests/bake/radiance/mirror_room.h"

namespace oriel {
namespace {

constexpr int kSize = 64;
const IVec2 kMap(kSize);

// Planes by pixel, told by a function of the pixel's centre.
std::vector<PixelPlane> planes_of(const std::function<PixelPlane(const Vec2&)>& at) {
  std::vector<PixelPlane> planes;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) planes.push_back(at(Vec2(x, y) + 0.5f));
  return planes;
}

// What a mesh has at the pixels' centres, from the nearest of its triangles there; -1: nothing.
std::vector<float> rasterised(const MapMesh& mesh) {
  std::vector<float> out(kSize * kSize, -1);
  const auto corner = [&](std::size_t i) { return mesh.vertices[mesh.indices[i]] * Vec3(kSize, kSize, 1); };
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x * b.y - a.y * b.x; };
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const Vec3 a = corner(i), b = corner(i + 1), c = corner(i + 2);
    const float area = cross(Vec2(b - a), Vec2(c - a));
    EXPECT_GT(area, -1e-3f) << "counter-clockwise";
    if (area < 1e-6f) continue;
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const Vec2 p = Vec2(x, y) + 0.5f - Vec2(a);
        const float u = cross(p, Vec2(c - a)) / area, v = cross(Vec2(b - a), p) / area;
        if (u < -1e-4f || v < -1e-4f || u + v > 1 + 1e-4f) continue;
        float& s = out[static_cast<std::size_t>(y * kSize + x)];
        s = std::max(s, a.z + u * (b.z - a.z) + v * (c.z - a.z));
      }
  }
  return out;
}

struct Compared {
  int missing = 0, surplus = 0, off = 0;  // pixels: without a triangle, with one too many, at another depth
};
// Pixels whose four neighbours are as they are: edges may lie elsewhere by less than a pixel.
Compared compare(const MapMesh& mesh, const std::vector<PixelPlane>& planes, float tolerance) {
  const std::vector<float> found = rasterised(mesh);
  Compared out;
  for (int y = 1; y + 1 < kSize; ++y)
    for (int x = 1; x + 1 < kSize; ++x) {
      const auto at = static_cast<std::size_t>(y * kSize + x);
      bool inside = true;
      for (const int step : {-1, 1, -kSize, kSize}) {
        const PixelPlane& beside = planes[at + static_cast<std::size_t>(step)];
        inside &= beside.seen() == planes[at].seen() && std::abs(beside.disparity - planes[at].disparity) < 0.03f;
      }
      if (!inside) continue;
      out.missing += planes[at].seen() && found[at] < 0;
      out.surplus += !planes[at].seen() && found[at] >= 0;
      out.off += planes[at].seen() && found[at] >= 0 && std::abs(found[at] - planes[at].disparity) > tolerance;
    }
  return out;
}

void expect_equal(const MapMesh& mesh, const std::vector<PixelPlane>& planes, float tolerance = 0.5f / kSize) {
  const Compared c = compare(mesh, planes, tolerance);
  EXPECT_EQ(c.missing, 0);
  EXPECT_EQ(c.surplus, 0);
  EXPECT_EQ(c.off, 0);
}

PixelPlane floor_at(const Vec2& p) {
  return {0.2f + 0.004f * p.x + 0.002f * p.y, {0.004f, 0.002f}};
}

TEST(MapMesh, APlaneIsTwoTriangles) {
  const auto planes = planes_of(floor_at);
  const MapMesh mesh = mesh_of(planes, kMap, {});
  EXPECT_EQ(mesh.indices.size(), 6u);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  expect_equal(mesh, planes, 1e-5f);
}

// The checker must see a mesh of another plane, a hole and what should be one.
TEST(MapMesh, AWrongMeshIsSeen) {
  const auto planes = planes_of(floor_at);
  const auto nearer = planes_of([](const Vec2& p) {
    PixelPlane plane = floor_at(p);
    plane.disparity += 0.02f;
    return plane;
  });
  const auto half = planes_of([](const Vec2& p) { return p.x < 32 ? floor_at(p) : PixelPlane(); });
  EXPECT_GT(compare(mesh_of(nearer, kMap, {}), planes, 0.5f / kSize).off, 3000);
  EXPECT_GT(compare(mesh_of(half, kMap, {}), planes, 0.5f / kSize).missing, 1500);
  EXPECT_GT(compare(mesh_of(planes, kMap, {}), half, 0.5f / kSize).surplus, 1500);
}

TEST(MapMesh, PlanesThatMeetStayTogether) {
  const auto planes = planes_of([](const Vec2& p) {
    const float along = 0.7f * (p.x - 30) + 0.3f * (p.y - 20);
    return along < 0 ? PixelPlane{0.4f, Vec2(0)} : PixelPlane{0.4f - 0.01f * along, {-0.007f, -0.003f}};
  });
  const MapMesh mesh = mesh_of(planes, kMap, {});
  expect_equal(mesh, planes);
  EXPECT_LT(mesh.indices.size(), 3 * 24u) << "few triangles";
  std::set<std::pair<float, float>> places;
  for (const Vec3& v : mesh.vertices) EXPECT_TRUE(places.emplace(v.x, v.y).second) << "no cut";
}

// A square before a floor: its outline is cut, no triangle spans the step, and slanted edges are lines.
TEST(MapMesh, StepsAreCut) {
  const auto in_front = [](const Vec2& p) {
    const Vec2 d = p - Vec2(31, 33);
    return std::abs(d.x + 0.3f * d.y) < 14 && std::abs(d.y - 0.3f * d.x) < 17;
  };
  const auto planes = planes_of([&](const Vec2& p) { return in_front(p) ? PixelPlane{0.7f, Vec2(0)} : floor_at(p); });
  const MapMesh mesh = mesh_of(planes, kMap, {});
  expect_equal(mesh, planes);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    int front = 0;
    for (std::size_t k = 0; k < 3; ++k) front += mesh.vertices[mesh.indices[i + k]].z > 0.6f;
    EXPECT_TRUE(front == 0 || front == 3) << "a triangle between the two";
  }
  EXPECT_LT(mesh.indices.size(), 3 * 160u) << "steps of pixels are lines";
}

TEST(MapMesh, WhatWasNotSeenHasNoTriangle) {
  const auto planes = planes_of([](const Vec2& p) { return glm::length(p - 32.0f) < 12 ? PixelPlane() : floor_at(p); });
  expect_equal(mesh_of(planes, kMap, {}), planes);
  EXPECT_TRUE(mesh_of(planes_of([](const Vec2&) { return PixelPlane(); }), kMap, {}).indices.empty());
}

// A curved body before the sky: within the error everywhere but for its rim, which is seen at a grazing angle.
TEST(MapMesh, CurvedThingsAndTheSky) {
  const auto planes = planes_of([](const Vec2& p) {
    const Vec2 d = (p - 32.0f) / 20.0f;
    const float h = 1 - glm::dot(d, d);
    return h > 0 ? PixelPlane{0.5f + 0.2f * h, -0.02f * d} : PixelPlane{0, Vec2(0)};
  });
  const MapMesh mesh = mesh_of(planes, kMap, {});
  expect_equal(mesh, planes, 1.0f / kSize);
  EXPECT_LT(mesh.indices.size(), 3 * 1500u);
}

// Of captured maps: planes are those of the room's walls, wherever the eye is.
TEST(MapMesh, ARoomsMapIsItsWalls) {
  const test::MirrorRoom room;
  const Accel accel = *Accel::build(room.scene);
  ViewOptions options;
  options.views_per_element = 4;
  options.map_resolution = 64;
  const test::Captured captured = test::capture(accel, room, options);
  const ReflectedSurroundings surroundings(accel, captured.reflectors, {});
  ASSERT_FALSE(captured.plan.maps.empty());
  for (const RadianceMap& map : captured.plan.maps) {
    const auto planes = find_planes(surroundings, map);
    for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
      if (!planes[i].seen() || (i + 1) % map.width == 0) continue;
      const float on = planes[i].disparity + planes[i].slope.x, back = planes[i + 1].disparity - planes[i + 1].slope.x;
      const float d0 = planes[i].disparity - back, d1 = on - planes[i + 1].disparity;
      EXPECT_TRUE(d0 * d1 <= 1e-9f || std::min(std::abs(d0), std::abs(d1)) < 1e-4f) << "walls meet without a step";
    }
    const MapMesh mesh = mesh_of(planes, IVec2(map.width, map.height), {});
    EXPECT_LT(mesh.indices.size() / 3, map.valid.size() / 25)
        << "five walls and where they meet: 2 % of the pixels' triangles";
  }
}

}  // namespace
}  // namespace oriel
