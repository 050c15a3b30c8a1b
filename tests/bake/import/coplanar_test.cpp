// Surfaces that lie in one place: what is moved, and what stays.
#include <gtest/gtest.h>

#include "bake/import/coplanar.h"
#include "bake/trace/accel.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel::test {
namespace {

const Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

// A floor of 4 x 4 m, its front up.
SceneParts floor_of(std::uint32_t* material) {
  SceneParts parts;
  *material = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", *material, Vec3(-2, 0, -2), 4.0f * kZ, 4.0f * kX);
  return parts;
}

Scene separated(SceneParts& parts, std::size_t* warnings = nullptr) {
  Scene scene = parts.finish();
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) scene.surfaces[s].node_path = scene.surfaces[s].name;
  std::size_t count = 0;
  Context context;
  context.warn = [&](const Warning&) { ++count; };
  separate_layers(scene, context);
  if (warnings != nullptr) *warnings = count;
  return scene;
}

float height(const Scene& scene, std::size_t surface) {
  return scene.positions[scene.surfaces[surface].first_vertex].y;
}

// The surface that a ray from above meets at a place of the floor.
std::string seen_from_above(const Scene& scene, float x, float z) {
  const auto accel = Accel::build(scene);
  const Hit hit = accel->intersect({Vec3(x, 1, z), Vec3(0.01f, -1, 0.02f)});
  return hit ? scene.surfaces[scene.triangle_surface[hit.triangle]].name : "";
}

// Whichever comes first in the file, and whatever else is in the room.
TEST(Coplanar, TheSmallerLiesOnTop) {
  for (const bool carpet_first : {false, true}) {
    SceneParts parts;
    const std::uint32_t m = parts.diffuse(Vec3(0.5f));
    const auto carpet = [&] { parts.quad("carpet", m, Vec3(-1, 0, -1), 1.5f * kZ, 2.0f * kX); };
    if (carpet_first) carpet();
    parts.quad("floor", m, Vec3(-2, 0, -2), 4.0f * kZ, 4.0f * kX);
    if (!carpet_first) carpet();
    std::size_t warnings = 0;
    const Scene scene = separated(parts, &warnings);
    EXPECT_EQ(warnings, 1u);
    EXPECT_EQ(height(scene, carpet_first ? 1 : 0), 0) << "the floor stays";
    EXPECT_NEAR(height(scene, carpet_first ? 0 : 1), 1e-4f * scene.radius(), 1e-6f);
    for (int i = 0; i < 50; ++i)
      EXPECT_EQ(seen_from_above(scene, -0.9f + 0.037f * static_cast<float>(i), -0.4f), "carpet");
    EXPECT_EQ(seen_from_above(scene, 1.5f, 1.5f), "floor");
  }
}

TEST(Coplanar, LayersLieOnEachOther) {
  std::uint32_t m = 0;
  SceneParts parts = floor_of(&m);
  SceneMaterial cut_out;
  cut_out.alpha_mode = AlphaMode::kMask;
  parts.quad("leaves", parts.add(cut_out), Vec3(-2, 0, -2), 3.0f * kZ, 4.0f * kX);
  parts.quad("carpet", m, Vec3(-1, 0, -1), 2.0f * kZ, 2.0f * kX);
  parts.quad("copy", m, Vec3(-1, 0, -1), 2.0f * kZ, 2.0f * kX);
  const Scene scene = separated(parts);
  EXPECT_LT(height(scene, 0), height(scene, 1));
  EXPECT_LT(height(scene, 1), height(scene, 2)) << "a small one would be hidden";
  EXPECT_LT(height(scene, 2), height(scene, 3));
}

TEST(Coplanar, OfCopiesThatWhichLetsLightThroughLiesOnTop) {
  std::uint32_t m = 0;
  SceneParts parts = floor_of(&m);
  SceneMaterial cut_out;
  cut_out.alpha_mode = AlphaMode::kMask;
  parts.quad("leaves", parts.add(cut_out), Vec3(-1, 0, -1), 2.0f * kZ, 2.0f * kX);
  parts.quad("carpet", m, Vec3(-1, 0, -1), 2.0f * kZ, 2.0f * kX);
  const Scene scene = separated(parts);
  EXPECT_LT(height(scene, 2), height(scene, 1));
}

// A poster a tenth of a millimetre before the wall, over a decal that lies in the wall's plane and is moved further.
TEST(Coplanar, WhatLiesLittleBeforeOneIsNotOvertaken) {
  for (const float before : {1e-5f, 1e-4f, 5e-4f}) {
    std::uint32_t m = 0;
    SceneParts parts = floor_of(&m);
    parts.quad("decal", m, Vec3(-1, 0, -1), 2.0f * kZ, 2.0f * kX);
    parts.quad("poster", m, Vec3(-0.5f, before, -0.5f), 2.0f * kZ, 2.0f * kX);
    const Scene scene = separated(parts);
    EXPECT_GT(height(scene, 1), 0);
    EXPECT_EQ(seen_from_above(scene, 0.1f, 0.2f), "poster") << before;
    EXPECT_EQ(seen_from_above(scene, -0.9f, -0.8f), "decal");
  }
  std::uint32_t m = 0;
  SceneParts parts = floor_of(&m);
  parts.quad("poster", m, Vec3(-0.5f, 1e-4f, -0.5f), 2.0f * kZ, 2.0f * kX);
  EXPECT_EQ(height(separated(parts), 1), 1e-4f) << "nothing overtakes it";
}

// A case of glass, a pane seen from both sides or a block, does not hide what it stands on.
TEST(Coplanar, GlassStandsOnWhatItStandsOn) {
  for (const bool block : {false, true}) {
    std::uint32_t m = 0;
    SceneParts parts = floor_of(&m);
    SceneMaterial glass;
    glass.transmission = 1, glass.metallic = 0, glass.roughness = 0;
    glass.solid = block, glass.double_sided = !block;
    parts.box("case", parts.add(glass), Vec3(-1, 0, -1), Vec3(0, 1, 0));
    const Scene scene = separated(parts);
    const Surface& box = scene.surfaces[1];
    float lowest = 1;
    for (std::uint32_t v = box.first_vertex; v < box.first_vertex + box.vertex_count; ++v)
      lowest = std::min(lowest, scene.positions[v].y);
    EXPECT_NEAR(lowest, 1e-4f * scene.radius(), 1e-6f);
    EXPECT_EQ(height(scene, 0), 0);
  }
}

// Tiles beside each other, a box on the floor, a sheet's other side and a roof of two sheets are not in each other's
// way.
TEST(Coplanar, NeighboursAndOppositeSidesStay) {
  std::uint32_t m = 0;
  SceneParts parts = floor_of(&m);
  parts.quad("tile", m, Vec3(2, 0, -2), 4.0f * kZ, 4.0f * kX);
  parts.box("box", m, Vec3(-1, 0, -1), Vec3(0, 1, 0));
  parts.box("beside it", m, Vec3(0, 0, -1), Vec3(1, 1, 0));
  const Scene before = parts.finish();
  std::size_t warnings = 0;
  const Scene scene = separated(parts, &warnings);
  EXPECT_EQ(warnings, 0u);
  EXPECT_EQ(scene.positions, before.positions);
}

// A copy of a box is a little larger then, and as closed as before: no corner has come apart.
TEST(Coplanar, BodiesStayClosed) {
  SceneParts parts;
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  parts.box("box", m, Vec3(-1), Vec3(1));
  parts.box("copy", m, Vec3(-1), Vec3(1));
  const Scene scene = separated(parts);
  const float lift = 1e-4f * std::sqrt(3.0f);
  const Surface& copy = scene.surfaces[1];
  for (std::uint32_t v = copy.first_vertex; v < copy.first_vertex + copy.vertex_count; ++v)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(std::abs(scene.positions[v][k]), 1 + lift, 1e-6f);
  for (std::uint32_t v = 0; v < scene.surfaces[0].vertex_count; ++v)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(std::abs(scene.positions[v][k]), 1);
}

// Panels in the plane of a ceiling shine into the room.
// A sheet thinner than what is moved: its sides turn over with their bottom, and show their normals all the same.
TEST(Coplanar, SidesOfThinBodiesKeepTheirFront) {
  std::uint32_t m = 0;
  SceneParts parts = floor_of(&m);
  parts.quad("ceiling below", m, Vec3(-2, 0, -2), 4.0f * kX, 4.0f * kZ);
  parts.box("paper", m, Vec3(-0.5f, 0, -0.5f), Vec3(0.5f, 5e-5f, 0.5f));
  std::size_t warnings = 0;
  const Scene scene = separated(parts, &warnings);
  EXPECT_EQ(warnings, 1u);
  for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_GT(glm::dot(geometric_normal(scene, t), scene.normals[scene.triangles[t][k]]), 0) << t;
}

TEST(Coplanar, PanelsInCeilingsAreSeen) {
  SceneParts parts;
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  parts.box("room", m, Vec3(-2), Vec3(2), true);
  parts.quad("panel", parts.diffuse(Vec3(0), Vec3(100)), Vec3(-0.5f, 2, -0.5f), kX, kZ);
  const Scene scene = separated(parts);
  EXPECT_LT(height(scene, 1), 2);
  EXPECT_EQ(height(scene, 0), -2);
  const auto accel = Accel::build(scene);
  const Hit hit = accel->intersect({Vec3(0), kY});
  EXPECT_EQ(scene.triangle_surface[hit.triangle], 1u);
  EXPECT_TRUE(hit.front);
}

}  // namespace
}  // namespace oriel::test
