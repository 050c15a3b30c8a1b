// Lights that stand for a lamp, and what they give.
#include "formats/query/live_sums.h"

#include <gtest/gtest.h>

#include <cmath>

#include "formats/core/color.h"
#include "formats/query/clipped_polygon.h"

namespace oriel {
namespace {

// Material 0 is grey, 1 shines.
struct Room {
  Mesh mesh;
  std::vector<Material> materials{2};
  std::vector<std::uint32_t> lamp;  // parts

  Room() {
    materials[0].base_color = Vec3(0.5f);
    materials[1].emission = Vec3(1000, 800, 600);
  }
  // Its front is right x up.
  void quad(const Vec3& corner, const Vec3& right, const Vec3& up, std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vec3& p : {corner, corner + right, corner + right + up, corner + up}) {
      mesh.positions.push_back(p);
      mesh.normals.push_back(normalize_or(glm::cross(right, up), Vec3(0, 1, 0)));
      mesh.uvs.emplace_back(0), mesh.lightmap_uvs.emplace_back(0);
    }
    if (material == 1) lamp.push_back(static_cast<std::uint32_t>(mesh.parts.size()));
    mesh.parts.push_back(
        {std::to_string(mesh.parts.size()), static_cast<std::uint32_t>(mesh.indices.size()), 6, material, 0});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
  }
  // Fronts inside.
  void box(const Vec3& a, const Vec3& b) {
    const Vec3 d = b - a, x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
    quad(a, z, x, 0), quad(a + y, x, z, 0);
    quad(a, x, y, 0), quad(a + z, y, x, 0);
    quad(a, y, z, 0), quad(a + x, z, y, 0);
  }
  LampScene scene() const {
    LiveLamp live{lamp, std::vector<Vec3>(lamp.size(), materials[1].emission), {}};
    return {{mesh, materials, {}, {}}, live};
  }
};

// A lamp of 1 m x 1 m that faces down, 2 m over a floor.
Room lamp_over_floor() {
  Room room;
  room.quad({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, 0);
  room.quad({-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, 1);
  return room;
}

MoverPose shifted(const Vec3& by) {
  MoverPose pose;
  pose.position = by;
  return pose;
}

Vec3 exact_on_floor(const Vec3& point, const Vec3& shift, const Vec3& radiance) {
  ClippedPolygon polygon;
  for (const Vec3& corner : {Vec3(-0.5f, 2, -0.5f), Vec3(0.5f, 2, -0.5f), Vec3(0.5f, 2, 0.5f), Vec3(-0.5f, 2, 0.5f)})
    polygon.v[polygon.count++] = glm::normalize(corner + shift - point);
  return radiance * std::abs(polygon_vector(polygon).y);
}

LiveSum sum_at(const LampScene& scene, std::size_t lights, const MoverPose& pose, const Vec3& point,
               const Vec3& normal) {
  const PosedLights now = pose_lights(scene, lights, pose), baked = pose_lights(scene, lights, {});
  return LiveSums(scene, {now, baked}).at(point, normal);
}

TEST(LiveLights, DirectLightIsTheClosedForm) {
  const Room room = lamp_over_floor();
  const LampScene scene = room.scene();
  for (const Vec3& shift : {Vec3(0), Vec3(1, 0, 0.5f), Vec3(0, -1.5f, 0)})
    for (const Vec3& point : {Vec3(0), Vec3(0.7f, 0, -0.2f), Vec3(3, 0, 2)}) {
      const LiveSum sum = sum_at(scene, 256, shifted(shift), point, {0, 1, 0});
      const Vec3 exact = exact_on_floor(point, shift, room.materials[1].emission);
      EXPECT_LT(glm::length(sum.now - exact), 0.01f * glm::length(exact));
      EXPECT_LT(glm::length(sum.baked - exact_on_floor(point, Vec3(0), room.materials[1].emission)),
                0.01f * glm::length(sum.baked));
    }
}

TEST(LiveLights, PointsAndSpots) {
  Room room = lamp_over_floor();
  room.lamp.clear();
  BrightLight spot;
  spot.kind = BrightLightKind::kSpot;
  spot.intensity = Vec3(100, 50, 25);
  spot.position = {0, 1.5f, 0}, spot.direction = {0, -1, 0};
  spot.inner_cone_rad = 0.2f, spot.outer_cone_rad = 0.3f;
  const LampScene scene({room.mesh, room.materials, {}, {}}, {{}, {}, {spot}});
  const Vec3 below = sum_at(scene, 8, {}, Vec3(0), {0, 1, 0}).now;
  EXPECT_LT(glm::length(below - spot.intensity / 2.25f), 1e-2f);
  EXPECT_EQ(sum_at(scene, 8, {}, {1.5f, 0, 0}, {0, 1, 0}).now, Vec3(0));
  EXPECT_LT(glm::length(sum_at(scene, 8, shifted({1.5f, 0, 0}), {1.5f, 0, 0}, {0, 1, 0}).now - below), 1e-2f);
}

// However few lights are asked for, none of a lamp's own is left out.
TEST(LiveLights, FewStandForAllOfALampsPoints) {
  const Room room = lamp_over_floor();
  BrightLight point;
  point.kind = BrightLightKind::kPoint;
  point.intensity = Vec3(10), point.position = {0, 1.5f, 0};
  const LampScene scene({room.mesh, room.materials, {}, {}},
                        {room.lamp, std::vector<Vec3>(room.lamp.size(), room.materials[1].emission),
                         std::vector<BrightLight>(40, point)});
  const std::vector<LiveLight> few = scene.lights(18, {});
  EXPECT_EQ(few.size(), 41u) << "and one for its surface";
  Vec3 points(0);
  for (const LiveLight& light : few)
    if (light.normal == Vec3(0)) points += light.intensity;
  EXPECT_EQ(points, Vec3(400));
  EXPECT_TRUE(scene.lights(0, {}).empty());
}

TEST(LiveLights, WhereNothingMovedTheBakeStays) {
  Room room = lamp_over_floor();
  room.quad({-0.3f, 1, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}, 0);
  const LampScene scene = room.scene();
  for (float x = -4; x < 4; x += 0.37f) {
    const LiveSum sum = sum_at(scene, 300, {}, {x, 0, 0.1f}, {0, 1, 0});
    EXPECT_EQ(sum.now, sum.baked);
    EXPECT_EQ(sum.kept().value_or(1), 1);
  }
}

TEST(LiveLights, ExtremesAreFinite) {
  // A slit of 1 mm, a lamp in it; another lamp in a closed box within a room.
  Room slit;
  slit.box({0, 0, 0}, {2, 2, 1e-3f});
  slit.quad({0.5f, 0.5f, 5e-4f}, {0.2f, 0, 0}, {0, 0.2f, 0}, 1);
  Room boxed;
  boxed.box({-3, -3, -3}, {3, 3, 3});
  boxed.box({-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f});
  boxed.quad({-0.1f, 0, -0.1f}, {0.2f, 0, 0}, {0, 0, 0.2f}, 1);
  for (const Room* room : {&slit, &boxed}) {
    const LampScene scene = room->scene();
    for (const std::uint32_t lights : {0u, 1u, 2u, 300u})
      for (const Vec3& shift : {Vec3(0), Vec3(0.1f, 0, 0), Vec3(1e6f, 0, 0)}) {
        const LiveSum sum = sum_at(scene, lights, shifted(shift), {0.01f, 0, 5e-4f}, {0, 1, 0});
        ASSERT_TRUE(is_finite(sum.now) && is_finite(sum.baked));
        ASSERT_TRUE(sum.kept().value_or(0) >= 0 && sum.kept().value_or(0) <= 1);
      }
  }
  EXPECT_EQ(luminance(sum_at(boxed.scene(), 300, shifted({0.1f, 0, 0}), {2, -3, 0}, {0, 1, 0}).now), 0);
  EXPECT_EQ(slit.scene().lights(kMostLiveLights, {}).size(), kMostLiveLights);
}

TEST(LiveLights, ALampInAWallIsTold) {
  Room room = lamp_over_floor();
  room.quad({1, 0, -5}, {0, 3, 0}, {0, 0, 10}, 0);
  const LampScene scene = room.scene();
  EXPECT_EQ(scene.passes_through({}), "");
  EXPECT_EQ(scene.passes_through(shifted({0.3f, 0, 0})), "");
  EXPECT_EQ(scene.passes_through(shifted({0.8f, 0, 0})), "2");
  EXPECT_EQ(scene.passes_through(shifted({5, 0, 0})), "");
}

}  // namespace
}  // namespace oriel
