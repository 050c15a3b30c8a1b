// What is seen from where, in rooms where that is known.
#include "bake/visibility/find_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bake/trace/sampler.h"
#include "bake/visibility/sight_lines.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

// Two rooms of 4 x 4 m side by side along x with a wall 20 cm thick between them, from z = 0; with a door from z = 1.5
// to 2.5 if asked for.
SceneParts rooms_beside(bool door) {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f));
  parts.box("room", wall, {0, 0, 0}, {8, 2.6f, 4}, true);
  parts.box("wall", wall, {3.9f, 0, 0}, {4.1f, 2.6f, door ? 1.5f : 4.0f});
  if (door) parts.box("far wall", wall, {3.9f, 0, 2.5f}, {4.1f, 2.6f, 4});
  return parts;
}

// Cells of 0.25 m over x from 0.5 to 3.5 and z from 0.5 to 3.5: the first room, eyes at 1.6 m.
WalkGrid first_room() {
  return {{0.5f, 0.5f}, 0.25f, 12, 12, std::vector<float>(144, 0), 1.6f};
}

// One group a surface.
std::vector<std::uint32_t> by_surface(const Scene& scene) {
  return scene.triangle_surface;
}

struct Found {
  std::vector<std::uint8_t> seen;
  std::size_t set_bytes = 1, cells = 0;
  // Whether any cell, every cell sees the group.
  bool any(std::uint32_t g) const { return count(g) > 0; }
  bool all(std::uint32_t g) const { return count(g) == cells; }
  std::size_t count(std::uint32_t g) const {
    std::size_t n = 0;
    for (std::size_t c = 0; c < cells; ++c) n += seen[c * set_bytes + g / 8] >> (g % 8) & 1;
    return n;
  }
};

Found find(const Scene& scene, const std::vector<WalkGrid>& grids, std::uint32_t side = 4, int threads = 2) {
  const auto accel = Accel::build(scene);
  EXPECT_TRUE(accel);
  Context context;
  context.threads = threads;
  const std::vector<std::uint32_t> groups = by_surface(scene);
  const auto count = static_cast<std::uint32_t>(scene.surfaces.size());
  const auto found = find_visible_sets({*accel, groups, count}, grids, side, {}, context);
  EXPECT_TRUE(found);
  EXPECT_GT(found->rays, 0u);
  const std::size_t set_bytes = (std::size_t{count} + 7) / 8;
  return {found->seen, set_bytes, found->seen.size() / set_bytes};
}

std::uint32_t surface(const Scene& scene, const std::string& name) {
  for (std::uint32_t i = 0; i < scene.surfaces.size(); ++i)
    if (scene.surfaces[i].name == name) return i;
  ADD_FAILURE() << name;
  return 0;
}

TEST(FindSets, WallsHideWhatIsBehindThemAndDoorsShowIt) {
  for (const bool door : {false, true}) {
    SceneParts parts = rooms_beside(door);
    const auto red = parts.diffuse(Vec3(0.5f, 0, 0));
    parts.box("here", red, {1, 0, 1}, {1.2f, 0.2f, 1.2f});
    parts.box("opposite the door", red, {7, 1, 1.9f}, {7.2f, 1.2f, 2.1f});
    parts.box("in the dead corner", red, {4.2f, 1, 0.1f}, {4.4f, 1.2f, 0.3f});
    const Scene scene = parts.finish();
    const Found found = find(scene, {first_room()});
    EXPECT_EQ(found.cells, 9u);
    EXPECT_TRUE(found.all(surface(scene, "here")));
    EXPECT_EQ(found.any(surface(scene, "opposite the door")), door);
    EXPECT_FALSE(found.any(surface(scene, "in the dead corner")));
  }
}

// A slit 2 cm wide: some eyes of some cells see through it.
TEST(FindSets, SlitsAreFound) {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f));
  parts.box("room", wall, {0, 0, 0}, {8, 2.6f, 4}, true);
  parts.box("wall", wall, {3.9f, 0, 0}, {4.1f, 2.6f, 1.99f});
  parts.box("far wall", wall, {3.9f, 0, 2.01f}, {4.1f, 2.6f, 4});
  parts.box("thing", wall, {6, 1.3f, 1.95f}, {6.1f, 1.4f, 2.05f});
  const Scene scene = parts.finish();
  EXPECT_TRUE(find(scene, {first_room()}).any(surface(scene, "thing")));
}

TEST(FindSets, GlassCutOutsAndBacksHideNothing) {
  for (const int kind : {0, 1, 2, 3}) {
    SceneParts parts = rooms_beside(true);
    SceneMaterial pane;
    pane.transmission = kind == 1 ? 0.9f : 0.0f;
    pane.alpha_mode = kind == 2 ? AlphaMode::kMask : AlphaMode::kOpaque;
    const auto m = parts.add(pane);
    // In the door; seen from the first room its front, or (3) its back.
    if (kind == 3)
      parts.quad("pane", m, {4, 0, 1.4f}, {0, 2.6f, 0}, {0, 0, 1.2f});
    else
      parts.quad("pane", m, {4, 0, 1.4f}, {0, 0, 1.2f}, {0, 2.6f, 0});
    parts.box("thing", parts.diffuse(Vec3(0.5f)), {7, 1, 1.9f}, {7.2f, 1.2f, 2.1f});
    const Scene scene = parts.finish();
    const Found found = find(scene, {first_room()});
    EXPECT_EQ(found.any(surface(scene, "thing")), kind != 0) << kind;
    EXPECT_EQ(found.any(surface(scene, "pane")), kind != 3) << kind << ": backs are not drawn";
  }
}

TEST(FindSets, SurfacesThatLieInEachOtherAreAllSeen) {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.5f));
  parts.box("room", wall, {0, 0, 0}, {4, 2.6f, 4}, true);
  for (const char* name : {"one", "other"}) parts.quad(name, wall, {1, 0.8f, 1}, {0, 0, 0.5f}, {0.5f, 0, 0});
  const Scene scene = parts.finish();
  const Found found = find(scene, {first_room()});
  EXPECT_TRUE(found.all(surface(scene, "one")));
  EXPECT_TRUE(found.all(surface(scene, "other")));
}

TEST(FindSets, ThreadsDoNotMatter) {
  const Scene scene = rooms_beside(true).finish();
  EXPECT_EQ(find(scene, {first_room()}, 4, 1).seen, find(scene, {first_room()}, 4, 3).seen);
}

TEST(FindSets, EyeCellsStayFew) {
  VisibilityOptions options;
  EXPECT_EQ(eye_cell_side(std::vector{first_room()}, options), 4u);
  options.most_cells = 4;
  EXPECT_EQ(eye_cell_side(std::vector{first_room()}, options), 6u);
  options = {};
  options.cell_m = 0.01f;
  EXPECT_EQ(eye_cell_side(std::vector{first_room()}, options), 1u);
}

// Pillars and boards at random, by surface of a few triangles: what an eye sees on an even grid of directions must be
// in the sets of its place.
TEST(FindSets, RandomEyesSeeNothingElse) {
  SceneParts parts = rooms_beside(true);
  const auto wall = parts.diffuse(Vec3(0.5f));
  Sampler place(5, 1, 0);
  for (int i = 0; i < 60; ++i) {
    const Vec2 at = place.next2() * Vec2(7, 3.5f), size = place.next2() * 0.3f + 0.05f;
    const float low = place.next1() * 1.5f;
    parts.box("box " + std::to_string(i), wall, {at.x + 0.2f, low, at.y + 0.2f},
              {at.x + 0.2f + size.x, low + 0.4f, at.y + 0.2f + size.y});
  }
  const Scene scene = parts.finish();
  const auto accel = Accel::build(scene);
  Context context;
  std::vector<std::uint32_t> group(scene.triangles.size());
  for (std::uint32_t t = 0; t < group.size(); ++t) group[t] = t / 2;
  VisibleSets sets;
  sets.groups = group.back() + 1;
  sets.side = 2;
  sets.below_m = 0.4f;
  sets.above_m = 0.2f;
  const std::vector<WalkGrid> grids{first_room()};
  auto found = find_visible_sets({*accel, group, sets.groups}, grids, sets.side, {}, context);
  ASSERT_TRUE(found);
  sets.seen = std::move(found->seen);
  const SeenGroups lookup(sets, grids);
  const SightLines lines(*accel);
  int missing = 0, eyes = 0, left_out = 0;
  for (std::uint32_t e = 0; e < 400; ++e) {
    Sampler sampler(77, e, 0);
    const Vec2 at = sampler.next2() * 3.0f + 0.5f;
    const Vec3 eye(at.x, 1.2f + 0.6f * sampler.next1(), at.y);
    const auto may = lookup.from(eye);
    ASSERT_TRUE(may);
    // Not from inside a box.
    const Hit below = accel->intersect({eye, {0, -1, 0}});
    if (!below || !below.front) continue;
    ++eyes;
    left_out += static_cast<int>(std::count(may->begin(), may->end(), 0));
    std::vector<SightLines::Line> around;
    for (int y = 0; y < 60; ++y)
      for (int x = 0; x < 120; ++x) {
        const float z = (static_cast<float>(y) + 0.5f) / 30 - 1, turn = 2 * kPi * (static_cast<float>(x) + 0.5f) / 120;
        const float r = std::sqrt(1 - z * z);
        around.push_back({eye, eye + 20.0f * Vec3(r * std::cos(turn), z, r * std::sin(turn)), ~0u});
      }
    lines.trace(around, [&](std::size_t, std::uint32_t triangle) { missing += (*may)[group[triangle]] == 0; });
  }
  EXPECT_GT(eyes, 300);
  EXPECT_GT(left_out, 50 * eyes) << "the sets leave something out";
  EXPECT_EQ(missing, 0);
}

// Two rooms without a door; a mirror on the wall between them shows all of the first room that lies before it, and
// nothing of the second. Behind a screen that hides the mirror from all eyes it shows nothing.
TEST(ReflectedSets, HoldWhatEyesSeeInAMirror) {
  for (const bool hidden : {false, true}) {
    SceneParts parts = rooms_beside(false);
    const auto grey = parts.diffuse(Vec3(0.5f));
    parts.quad("mirror", grey, {3.89f, 1, 1.5f}, {0, 0, 1}, {0, 1, 0});  // to -x
    parts.box("ball", grey, {1, 1, 1}, {1.2f, 1.2f, 1.2f});
    parts.box("next door", grey, {6, 1, 1}, {6.2f, 1.2f, 1.2f});
    if (hidden) parts.box("screen", grey, {3.6f, 0, 0.01f}, {3.7f, 2.59f, 3.99f});
    const Scene scene = parts.finish();
    const auto accel = Accel::build(scene);
    ASSERT_TRUE(accel);
    std::vector<std::uint32_t> own;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t)
      if (scene.triangle_surface[t] == surface(scene, "mirror")) own.push_back(t);
    ASSERT_EQ(own.size(), 2u);
    ASSERT_LT(geometric_normal(scene, own[0]).x, -0.9f);
    const SeenMirror mirror{Vec4(-1, 0, 0, 3.89f), 1e-5f, own};
    std::vector<Vec3> eyes;
    for (int i = 0; i < 64; ++i)
      eyes.emplace_back(0.5f + 0.04f * static_cast<float>(i), 1.6f, 0.5f + 0.3f * static_cast<float>(i % 10));
    const std::vector<std::uint32_t> groups = by_surface(scene);
    Context context;
    const auto found = find_reflected_sets({*accel, groups, static_cast<std::uint32_t>(scene.surfaces.size())},
                                           std::span(&mirror, 1), eyes, {}, context);
    ASSERT_TRUE(found);
    const auto has = [&](const std::string& name) {
      const std::uint32_t g = surface(scene, name);
      return (found->seen[g / 8] >> (g % 8) & 1) != 0;
    };
    EXPECT_EQ(has("ball"), !hidden);
    EXPECT_EQ(has("room"), !hidden);
    EXPECT_FALSE(has("next door"));
    EXPECT_FALSE(has("mirror")) << "it does not see itself";
    EXPECT_GT(found->rays, 0u);
  }
}

}  // namespace
}  // namespace oriel
