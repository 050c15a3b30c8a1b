// Walls that stand on floors: found, cut along, and no chart spans them.
#include "bake/visibility/wall_cuts.h"

#include <gtest/gtest.h>

#include <set>

#include "bake/atlas/atlas.h"
#include "bake/visibility/divide.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

std::vector<ChartCut> cuts_of(const Scene& scene) {
  Context context;
  return *find_wall_cuts(*Accel::build(scene), 1, context);
}

SceneParts floor_of(float half = 5) {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0.5f)), {-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half});
  return parts;
}

// Of one that runs along z.
float x_of(const ChartCut& cut) {
  EXPECT_NEAR(cut.from.x, cut.to.x, 1e-4);
  return cut.from.x;
}

TEST(WallCuts, ASheetPartsTheFloor) {
  SceneParts parts = floor_of();
  SceneMaterial sheet;
  sheet.double_sided = true;
  parts.quad("sheet", parts.add(sheet), {1.3f, 0, 2}, {0, 0, -4}, {0, 2.5f, 0});
  Scene scene = parts.finish();
  scene.cuts = cuts_of(scene);
  ASSERT_EQ(scene.cuts.size(), 1u);
  EXPECT_NEAR(x_of(scene.cuts[0]), 1.3f, 1e-4);
  EXPECT_NEAR(std::abs(scene.cuts[0].from.z - scene.cuts[0].to.z), 10, 1e-3) << "on to the ends of the floor";
  EXPECT_TRUE(cut_triangles(scene));
  double area = 0;
  for (std::uint32_t t = 0; t < scene.surfaces[0].triangle_count; ++t) area += triangle_area(scene, t);
  EXPECT_NEAR(area, 100, 1e-3);
  Context context;
  const Atlas atlas = *build_atlas(scene, {}, context);
  std::array<std::set<std::uint32_t>, 2> charts;  // by side
  for (std::uint32_t t = 0; t < scene.surfaces[0].triangle_count; ++t) {
    bool left = false, right = false;
    for (int k = 0; k < 3; ++k) {
      const float x = scene.positions[scene.triangles[t][k]].x;
      left |= x<1.3f - 1e-3f, right |= x> 1.3f + 1e-3f;
    }
    EXPECT_NE(left, right) << "a triangle on both sides";
    charts[right ? 1 : 0].insert(atlas.chart[t]);
  }
  for (const std::uint32_t chart : charts[0]) EXPECT_FALSE(charts[1].contains(chart));
}

// There a float's step is 4 mm. The wall turns by 0.3 rad, so that its cut meets edges at places that are rounded.
TEST(WallCuts, ARoomFarFromZeroIsCut) {
  for (const float away : {5e4f, 1e6f}) {
    SceneParts parts;
    const std::uint32_t m = parts.diffuse(Vec3(0.5f));
    const Vec3 zero(away, 0, -away);
    std::vector<Vec3> positions;
    std::vector<UVec3> triangles;
    for (std::uint32_t i = 0; i <= 10; ++i)
      for (std::uint32_t j = 0; j <= 10; ++j) {
        positions.push_back(zero + Vec3(1.0f * i - 5, 0, 5 - 1.0f * j));
        const std::uint32_t v = 11 * i + j;
        if (i < 10 && j < 10) triangles.insert(triangles.end(), {{v, v + 11, v + 12}, {v, v + 12, v + 1}});
      }
    parts.mesh("floor", m, positions, std::vector<Vec3>(positions.size(), Vec3(0, 1, 0)), triangles);
    SceneMaterial sheet;
    sheet.double_sided = true;
    const Vec3 along(std::sin(0.3f), 0, std::cos(0.3f));
    parts.quad("sheet", parts.add(sheet), zero - 4.0f * along, 8.0f * along, {0, 2.5f, 0});
    Scene scene = parts.finish();
    scene.cuts = cuts_of(scene);
    if (away > 1e5f) {
      cut_triangles(scene);  // as it may be
      continue;
    }
    ASSERT_EQ(scene.cuts.size(), 1u);
    EXPECT_TRUE(cut_triangles(scene));
    Context context;
    const Atlas atlas = *build_atlas(scene, {}, context);
    std::array<std::set<std::uint32_t>, 2> charts;
    for (std::uint32_t t = 0; t < scene.surfaces[0].triangle_count; ++t) {
      DVec3 middle(0);
      for (int k = 0; k < 3; ++k) middle += DVec3(scene.positions[scene.triangles[t][k]] - zero) / 3.0;
      charts[glm::cross(DVec3(along), middle).y > 0].insert(atlas.chart[t]);
    }
    for (const std::uint32_t chart : charts[0]) EXPECT_FALSE(charts[1].contains(chart));
  }
}

// Meshed in strips of 2 cm, among the feet of 200 tables, each longer than a strip.
TEST(WallCuts, AFinelyMeshedSheetPartsTheFloorOfACrowdedHall) {
  SceneParts parts = floor_of(20);
  SceneMaterial sheet;
  sheet.double_sided = true;
  const std::uint32_t m = parts.add(sheet), wood = parts.diffuse(Vec3(0.5f));
  for (int strip = 0; strip < 200; ++strip)
    parts.quad("sheet", m, {1.3f, 0, 2 - 0.02f * static_cast<float>(strip)}, {0, 0, -0.02f}, {0, 2.5f, 0});
  for (int i = 0; i < 200; ++i) {
    const Vec3 at(3.01f + 0.8f * static_cast<float>(i % 20), 0, -8 + 0.037f * static_cast<float>(43 * i % 400));
    parts.box("table", wood, at, at + Vec3(0.11f + 0.003f * static_cast<float>(i / 20), 0.7f, 0.1f));
  }
  const auto cuts = cuts_of(parts.finish());
  ASSERT_EQ(cuts.size(), 1u);
  EXPECT_NEAR(x_of(cuts[0]), 1.3f, 1e-4);
}

// Of a stage that ends early what is there is kept, and a word says so.
TEST(WallCuts, EndEarlyWithAWordAndStop) {
  SceneParts parts = floor_of();
  parts.box("wall", parts.diffuse(Vec3(0.5f)), {2, 0, -5}, {2.1f, 2.5f, 5});
  const Scene scene = parts.finish();
  const Accel accel = *Accel::build(scene);
  Context context;
  std::vector<Warning> warnings;
  const WarningLog log(context, warnings);
  {
    const Interruptible until(context, [] { return true; });
    const auto cuts = find_wall_cuts(accel, 1, context);
    ASSERT_TRUE(cuts);
    EXPECT_TRUE(cuts->empty());
  }
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].code, WarningCode("time-over"));
  EXPECT_EQ(find_wall_cuts(accel, 1, context)->size(), 1u);
  EXPECT_EQ(warnings.size(), 1u);
  context.stop = true;
  EXPECT_EQ(find_wall_cuts(accel, 1, context).error().code, ErrorCode::kStopped);
}

TEST(WallCuts, AThickWallHasOneLineUnderItsMiddle) {
  for (const float thick : {0.01f, 0.1f, 0.3f}) {
    SceneParts parts = floor_of();
    // Into the floor and up, with a gap for a door.
    parts.box("wall", parts.diffuse(Vec3(0.5f)), {2, -0.05f, -5}, {2 + thick, 2.5f, 1});
    parts.box("wall", parts.diffuse(Vec3(0.5f)), {2, -0.05f, 2}, {2 + thick, 2.5f, 5});
    const auto cuts = cuts_of(parts.finish());
    ASSERT_EQ(cuts.size(), 1u) << thick;
    EXPECT_NEAR(x_of(cuts[0]), 2 + 0.5f * thick, 2e-3) << thick;
  }
}

TEST(WallCuts, RoomsAreCutNoFurtherThanTheirWalls) {
  SceneParts parts = floor_of();
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  parts.box("long", m, {0, 0, -5}, {0.1f, 2.5f, 5});
  parts.box("across", m, {0.1f, 0, 1}, {5, 2.5f, 1.1f});
  const auto cuts = cuts_of(parts.finish());
  ASSERT_EQ(cuts.size(), 3u);
  EXPECT_NEAR(x_of(cuts[0]), 0.05f, 2e-3);
  EXPECT_NEAR(std::min(cuts[1].from.x, cuts[1].to.x), 0.05f, 2e-3) << "not into the other room";
  EXPECT_NEAR(x_of(cuts[2]), 0.1f, 1e-4) << "upright, where the walls meet";
}

// A hall between two rooms whose inner walls are in one line; these are longer together than the walls of the hall.
TEST(WallCuts, WallsInLineDoNotCutTheHallBetween) {
  SceneParts parts = floor_of();
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  for (const float side : {-1.0f, 1.0f}) {
    const float at = side < 0 ? -2.1f : 2.0f;
    parts.box("of the hall", m, {at, 0, -5}, {at + 0.1f, 2.5f, 5});
    parts.box("of a room", m, {side < 0 ? -5 : 2.1f, 0, 0}, {side < 0 ? -2.1f : 5, 2.5f, 0.1f});
  }
  int of_rooms = 0;
  for (const ChartCut& cut : cuts_of(parts.finish())) {
    if (std::max(std::abs(cut.from.y), std::abs(cut.to.y)) > 1e-3) continue;  // not on the floor
    EXPECT_GT(std::max(std::abs(cut.from.x), std::abs(cut.to.x)), 2 - 1e-3);
    EXPECT_GT(cut.from.x * cut.to.x, 0) << "through the hall";
    of_rooms += std::abs(cut.from.z - cut.to.z) < 1e-3;
  }
  EXPECT_EQ(of_rooms, 2);
}

TEST(WallCuts, FurnitureThresholdsAndRimsAreNoWalls) {
  SceneParts parts = floor_of();
  const std::uint32_t m = parts.diffuse(Vec3(0.5f));
  parts.box("bed", m, {-3, 0, -1}, {-2, 0.5f, 1});
  parts.box("leg", m, {1, 0, 1}, {1.05f, 0.7f, 1.05f});
  parts.box("threshold", m, {2, 0, -5}, {2.1f, 0.015f, 5});
  parts.box("rim", m, {4.9f, 0, -5}, {5.1f, 2.5f, 5});
  EXPECT_EQ(cuts_of(parts.finish()).size(), 0u);
}

}  // namespace
}  // namespace oriel
