#include <gtest/gtest.h>

#include "scenes/kit/shapes.h"
#include "scenes/kit/solid_grid.h"
#include "scenes/kit/walk_path.h"
#include "tests/scenes/probe.h"

namespace oriel::sample {
namespace {

using namespace testing;

SampleScene scene_of(SampleMesh mesh) {
  SampleScene scene;
  add_material(scene, SampleMaterial{});
  place(scene, std::move(mesh));
  return scene;
}

void expect_sound(const SampleMesh& mesh) {
  const auto triangles = flatten(scene_of(mesh));
  ASSERT_FALSE(triangles.empty());
  for (const Triangle& t : triangles) ASSERT_EQ(fault(t), "");
}

double volume(const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += glm::dot(DVec3(t.p[0]), glm::cross(DVec3(t.p[1]), DVec3(t.p[2]))) / 6;
  return sum;
}

TEST(Probe, SeesEachFault) {
  Triangle t{{Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {Vec3(0, 0, 1), Vec3(0, 0, 1), Vec3(0, 0, 1)}, 0, 0};
  EXPECT_EQ(fault(t), "");
  EXPECT_NEAR(distance_to(t, Vec3(0.2f, 0.2f, -3)), 3, 1e-6);
  EXPECT_NEAR(distance_to(t, Vec3(-3, 0, 4)), 5, 1e-6);
  Triangle flat = t;
  flat.p[2] = Vec3(0.5f, 0, 0);
  EXPECT_NE(fault(flat), "");
  Triangle turned = t;
  turned.normals[1] = Vec3(0, 0, -1);
  EXPECT_NE(fault(turned), "");
  SampleScene scene;
  add_material(scene, SampleMaterial{});
  SampleMesh a{"a", 0}, b{"b", 0, {}, {}, {}, {}}, c{"c", 0, {}, {}, {}, {}};
  add_quad(a, {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
  add_quad(b, {Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
  place(scene, a);
  place(scene, b);
  EXPECT_TRUE(coplanar_overlaps(scene).empty());
  add_quad(c, {Vec3(1.9f, 0.5f, 0.00004f), Vec3(0, 0.3f, 0), Vec3(1, 0, 0)});  // from the other side
  place(scene, c);
  EXPECT_EQ(coplanar_overlaps(scene), (std::vector<std::string>{"b / c"}));
}

TEST(Shapes, AreSoundAndFaceOutwards) {
  for (const int n : {1, 2, 3, 7, 40}) {
    SampleMesh mesh{"box", 0};
    add_rounded_box(mesh, Vec3(1, 2, 3), Vec3(1, 0.5f, 2), 0.1f, n);
    expect_sound(mesh);
    EXPECT_EQ(mesh.triangle_count(), static_cast<std::size_t>(12 * n * n));
    EXPECT_GT(volume(flatten(scene_of(mesh))), n < 3 ? 0.5 : 0.85) << n;
  }
  SampleMesh sphere{"sphere", 0};
  add_sphere(sphere, Vec3(0), 1, 64, 32);
  expect_sound(sphere);
  const auto ball = flatten(scene_of(sphere));
  EXPECT_NEAR(volume(ball), 4 * kPiD / 3, 0.03);
  EXPECT_EQ(open_edges(ball), 0u);
  for (const Vec3& p : sphere.positions) EXPECT_NEAR(glm::length(p), 1, 1e-6);
  SampleMesh shaft{"shaft", 0};
  add_fluted_shaft(shaft, Vec3(0), {});
  expect_sound(shaft);
  SampleMesh frame{"frame", 0};
  add_frame(frame, {1, 0.7f}, 0.05f, 0.03f, 0.01f);
  expect_sound(frame);
}

TEST(Shapes, AQuadThatIsNotPlanarIsFlatShaded) {
  SampleMesh mesh{"bent", 0};
  add_corners(mesh, Vec3(0), Vec3(1, 0, 0), Vec3(1, 1, 0.3f), Vec3(0, 1, 0));
  expect_sound(mesh);
  EXPECT_EQ(mesh.positions.size(), 6u);
}

TEST(SolidGrid, BuildingsAreClosed) {
  const std::vector<Block> blocks = {{Vec3(0), Vec3(5, 3, 4), true, 0},
                                     {Vec3(0.2f), Vec3(2.4f, 2.8f, 3.8f), false, 1},
                                     {Vec3(2.6f, 0.2f, 0.2f), Vec3(4.8f, 2.8f, 3.8f), false, 2},
                                     {Vec3(2.4f, 0.2f, 1), Vec3(2.6f, 2.2f, 2), false, 3}};
  SampleScene scene;
  add_material(scene, SampleMaterial{});
  std::vector<std::pair<int, int>> tags;
  for (SolidPatch& patch : boundary_patches(blocks)) {
    tags.emplace_back(patch.air_tag, static_cast<int>(patch.facing));
    place(scene, std::move(patch.mesh));
  }
  EXPECT_TRUE(std::is_sorted(tags.begin(), tags.end()));
  EXPECT_EQ(tags.size(), 6u + 6 + 6 + 4);  // the doorway has no face towards the rooms
  const auto triangles = flatten(scene);
  for (const Triangle& t : triangles) ASSERT_EQ(fault(t), "");
  EXPECT_EQ(open_edges(triangles), 0u);
  EXPECT_NEAR(volume(triangles), 60 - 2 * 2.2 * 2.6 * 3.6 - 0.2 * 2 * 1, 1e-4);
  EXPECT_TRUE(coplanar_overlaps(scene).empty());
  auto holed = triangles;
  holed.pop_back();
  EXPECT_EQ(open_edges(holed), 3u);
}

TEST(SolidGrid, NothingGivesNothing) {
  EXPECT_TRUE(boundary_patches({}).empty());
  const std::vector<Block> air{{Vec3(0), Vec3(1), false, 0}};
  EXPECT_TRUE(boundary_patches(air).empty());
}

TEST(WalkPath, IsSmoothAndReachesItsEnds) {
  const std::array<Vec3, 4> waypoints{Vec3(0, 1.6f, 0), Vec3(5, 1.6f, 0), Vec3(5, 1.6f, 4), Vec3(1, 1.6f, 4)};
  const Path path = walk_along("walk", waypoints);
  ASSERT_EQ(path.eyes.size(), 600u);
  EXPECT_LT(glm::distance(path.eyes.front(), waypoints.front()), 1e-5f);
  EXPECT_LT(glm::distance(path.eyes.back(), waypoints.back()), 1e-5f);
  for (std::size_t i = 1; i < path.eyes.size(); ++i) {
    EXPECT_LT(glm::distance(path.eyes[i], path.eyes[i - 1]), 0.03f);
    EXPECT_GT(glm::dot(path.forwards[i], path.forwards[i - 1]), std::cos(3.0f * kPi / 180)) << i;
    EXPECT_GT(path.times_s[i], path.times_s[i - 1]);
  }
}

}  // namespace
}  // namespace oriel::sample
