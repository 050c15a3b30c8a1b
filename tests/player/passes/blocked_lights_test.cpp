// Lights that movers may block, beside segments from lights to points of surfaces.
#include "player/movers/blocked_lights.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

#include "tests/player/passes/random_boxes.h"

namespace oriel {
namespace {

bool crosses(const Vec3& from, const Vec3& to, const Vec4& sphere) {
  const Vec3 way = to - from, c = Vec3(sphere) - from;
  const float t = std::clamp(glm::dot(c, way) / std::max(length2(way), 1e-20f), 0.0f, 1.0f);
  return glm::length(c - t * way) <= sphere.w;
}
bool face_each_other(const ShadeLight& light, const RandomBoxes::Place& place) {
  const Vec3 way = light.position - place.position;
  if (light.normal != Vec3(0) && glm::dot(light.normal, way) >= 0) return false;
  return place.two_sided || glm::dot(place.normal, way) > 0 || glm::dot(place.shading, way) > 0;
}

bool has_light(const BlockedLights& database, std::uint32_t leaf, std::uint32_t light) {
  return std::ranges::binary_search(database.lights_of(leaf), light);
}

// A furnished room with lights to all sides and to one.
struct Lit {
  explicit Lit(unsigned seed, int boxes = 12, int count = 40) : scene(seed) {
    scene.furnish({6, 2, 4}, boxes);
    scene.add_loose(60, 0.3f);
    cells = make_shade_cells(scene.triangles, {0.5f, 200});
    for (int i = 0; i < count; ++i) lights.push_back({scene.in(scene.room), i % 3 == 0 ? Vec3(0) : scene.direction()});
    lights.push_back({scene.place().position, Vec3(0)});
  }
  Vec4 sphere(float most) { return {scene.in(scene.room), scene.uniform(0.02f, most)}; }
  BlockedLights database(BlockedLights::Hidden hidden = {}) const { return {cells, lights, std::move(hidden)}; }
  std::vector<std::uint32_t> leaves() const {
    std::vector<std::uint32_t> out;
    for (std::uint32_t c = 0; c < cells.size(); ++c)
      if (cells[c].child == 0) out.push_back(c);
    return out;
  }
  // Pairs of a leaf and a light that is in its list.
  std::size_t blocked(const BlockedLights& database) const {
    std::size_t sum = 0;
    for (const std::uint32_t leaf : leaves()) sum += database.lights_of(leaf).size();
    return sum;
  }
  void expect_same(const BlockedLights& a, const BlockedLights& b) const {
    for (const std::uint32_t leaf : leaves()) ASSERT_EQ(a.lights_of(leaf), b.lights_of(leaf));
  }

  RandomBoxes scene;
  std::vector<ShadeCell> cells;
  std::vector<ShadeLight> lights;
};

TEST(BlockedLights, MissNone) {
  std::size_t crossed = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Lit lit(seed);
    BlockedLights database = lit.database();
    const std::vector<Vec4> spheres = {lit.sphere(0.1f), lit.sphere(0.6f), Vec4(lit.lights[3].position, 0.2f)};
    for (std::uint32_t m = 0; m < spheres.size(); ++m) database.move(m, spheres[m]);
    for (int i = 0; i < 50000; ++i) {
      const RandomBoxes::Place place = lit.scene.place();
      const auto light = static_cast<std::uint32_t>(lit.scene.index(lit.lights.size()));
      if (!face_each_other(lit.lights[light], place)) continue;
      const std::uint32_t leaf = leaf_at(lit.cells, place.position);
      for (std::uint32_t m = 0; m < spheres.size(); ++m) {
        if (!crosses(lit.lights[light].position, place.position, spheres[m])) continue;
        ++crossed;
        ASSERT_TRUE(has_light(database, leaf, light)) << seed;
      }
    }
  }
  EXPECT_GT(crossed, 5000u);
}

// Of the leaves that may be in a mover's shade, most have a point that is.
TEST(BlockedLights, AreFew) {
  Lit lit(7, 12, 20);
  std::map<std::uint32_t, std::vector<RandomBoxes::Place>> places;
  for (int i = 0; i < 1000000; ++i) {
    const RandomBoxes::Place place = lit.scene.place();
    places[leaf_at(lit.cells, place.position)].push_back(place);
  }
  std::size_t told = 0, crossed = 0;
  for (int i = 0; i < 10; ++i) {
    const Vec4 sphere = lit.sphere(0.4f);
    BlockedLights database = lit.database();
    database.move(0, sphere);
    told += lit.blocked(database);
    for (const auto& [leaf, inside] : places)
      for (const std::uint32_t light : database.lights_of(leaf))
        crossed += std::ranges::any_of(inside, [&, l = lit.lights[light]](const RandomBoxes::Place& place) {
          return face_each_other(l, place) && crosses(l.position, place.position, sphere);
        });
  }
  EXPECT_GT(crossed, 200u) << told;
  EXPECT_LT(told, 2 * crossed);
  BlockedLights database = lit.database();
  database.move(0, Vec4(0, 500, 0, 0.5f));
  EXPECT_EQ(lit.blocked(database), 0u);
}

TEST(BlockedLights, DoNotDependOnTheWayOfMovers) {
  Lit lit(8);
  BlockedLights moved = lit.database();
  std::vector<Vec4> spheres;
  for (std::uint32_t m = 0; m < 5; ++m) spheres.push_back(lit.sphere(0.5f));
  std::vector<bool> moving(spheres.size());
  for (int step = 0; step < 60; ++step) {
    const auto m = static_cast<std::uint32_t>(lit.scene.index(spheres.size()));
    if (step % 7 == 6)
      spheres[m].w = -1;
    else if (step % 3 == 0 || spheres[m].w < 0)
      spheres[m] = lit.sphere(0.5f);
    else
      spheres[m] += Vec4(0.1f * lit.scene.direction(), 0);
    moved.move(m, spheres[m]);
    moving[m] = true;
    BlockedLights fresh = lit.database();
    for (std::uint32_t k = 0; k < spheres.size(); ++k)
      if (moving[k]) fresh.move(k, spheres[k]);
    lit.expect_same(moved, fresh);
  }
}

TEST(BlockedLights, LeaveOutWhatIsHidden) {
  Lit lit(10);
  // What stands still hides all beyond x = 0 from the even lights. A mover there throws no shade in them.
  std::multiset<std::pair<std::uint32_t, float>> asked;
  const auto hidden = [&](std::uint32_t light, const Bounds& box) {
    asked.insert({light, box.lower.x});
    return light % 2 == 0 && box.lower.x > 0;
  };
  BlockedLights database = lit.database(hidden), open = lit.database();
  const Vec4 left(-0.5f, 0, 0, 0.4f), right(1, 0, 0, 0.4f);
  database.move(0, left);
  open.move(0, left);
  for (const std::uint32_t leaf : lit.leaves())
    for (std::uint32_t l = 0; l < lit.lights.size(); ++l) {
      bool drops = false;
      for (std::uint32_t c = 0; c < lit.cells.size(); ++c) {  // the leaf and cells around it
        const Bounds &outer = lit.cells[c].cell, &inner = lit.cells[leaf].cell;
        const bool around = glm::all(glm::lessThanEqual(outer.lower, inner.lower)) &&
                            glm::all(glm::lessThanEqual(inner.upper, outer.upper));
        drops |= around && l % 2 == 0 && lit.cells[c].content.lower.x > 0;
      }
      ASSERT_EQ(has_light(database, leaf, l), !drops && has_light(open, leaf, l));
    }
  EXPECT_LT(lit.blocked(database), lit.blocked(open));
  database.remove(0);
  asked.clear();
  database.move(0, left);  // of cells it knows: only the mover is asked about
  EXPECT_LE(asked.size(), lit.lights.size());
  database.move(0, right);
  for (const std::uint32_t leaf : lit.leaves())
    for (const std::uint32_t light : database.lights_of(leaf)) EXPECT_EQ(light % 2, 1u);
  EXPECT_GT(lit.blocked(database), 0u);
}

TEST(BlockedLights, KeepToLightsThatFaceThem) {
  RandomBoxes scene(11);
  scene.add_box({{-4, 0, -4}, {4, 3, 4}}, true);
  const auto cells = make_shade_cells(scene.triangles, {0.5f, 300});
  // Under the ceiling: down, up, and one that is above the mover but shines down from below it.
  const std::vector<ShadeLight> lights = {
      {{0, 2.9f, 0}, {0, -1, 0}}, {{0, 2.9f, 0}, {0, 1, 0}}, {{0, 1, 0}, {0, -1, 0}}};
  BlockedLights database(cells, lights, {});
  database.move(0, {0, 2, 0, 0.3f});
  std::size_t down = 0;
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    if (cells[c].child != 0) continue;
    EXPECT_FALSE(has_light(database, c, 1));
    EXPECT_FALSE(has_light(database, c, 2));
    down += has_light(database, c, 0);
    EXPECT_TRUE(cells[c].content.lower.y < 2.3f || !has_light(database, c, 0));
  }
  EXPECT_GT(down, 0u);
  EXPECT_LT(down, 30u);
}

TEST(BlockedLights, KeepToSurfacesThatFaceLights) {
  RandomBoxes scene(13);
  scene.add_box({{-4, 0, -4}, {4, 0.2f, 4}}, false);
  const std::vector<ShadeTriangle> top(scene.triangles.begin() + 6, scene.triangles.begin() + 8);
  const std::vector<ShadeLight> lights = {{{0, 3, 0}, Vec3(0)}, {{0, -3, 0}, Vec3(0)}};
  std::vector<ShadeTriangle> both = top;
  for (ShadeTriangle& t : both) t.two_sided = true;
  const auto count = [&](const std::vector<ShadeTriangle>& triangles, std::uint32_t light, const Vec4& sphere) {
    const auto cells = make_shade_cells(triangles, {0.5f, 300});
    BlockedLights database(cells, lights, {});
    database.move(0, sphere);
    std::size_t sum = 0;
    for (std::uint32_t c = 0; c < cells.size(); ++c) sum += cells[c].child == 0 && has_light(database, c, light);
    return sum;
  };
  EXPECT_GT(count(top, 0, {0, 1.5f, 0, 0.3f}), 0u);
  EXPECT_EQ(count(top, 1, {0, -1.5f, 0, 0.3f}), 0u);
  EXPECT_GT(count(both, 1, {0, -1.5f, 0, 0.3f}), 0u);
  EXPECT_EQ(count(top, 0, {0, 3.31f, 0, 0.3f}), 0u);  // behind the light
  EXPECT_EQ(count(top, 0, {0, -0.4f, 0, 0.3f}), 0u);  // behind the surface
}

TEST(BlockedLights, TakeWhatIsDegenerate) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  const auto none = make_shade_cells({}, {});
  const std::vector<ShadeLight> one = {{}};
  BlockedLights empty(none, one, {});
  empty.move(0, {0, 0, 0, 1});
  EXPECT_TRUE(empty.lights_of(0).empty());
  BlockedLights nothing({}, {}, {});
  nothing.move(63, {0, 0, 0, 1});
  nothing.remove(63);

  Lit lit(12);
  BlockedLights dark(lit.cells, {}, {});
  dark.move(0, {0, 0, 0, 1});
  EXPECT_TRUE(dark.lights_of(0).empty());

  BlockedLights database = lit.database();
  for (const Vec4& nowhere :
       {Vec4(nan, 0, 0, 1), Vec4(0, 0, 0, nan), Vec4(0, infinity, 0, 1), Vec4(0, 0, 0, infinity), Vec4(0, 0, 0, -1)}) {
    database.move(63, {0, 0, 0, 0.5f});
    EXPECT_GT(lit.blocked(database), 0u);
    database.move(63, nowhere);
    EXPECT_EQ(lit.blocked(database), 0u);
  }
  // One around all of it: whatever faces a light.
  database.move(63, {0, 0, 0, 100});
  for (int i = 0; i < 2000; ++i) {
    const RandomBoxes::Place place = lit.scene.place();
    const auto light = static_cast<std::uint32_t>(lit.scene.index(lit.lights.size()));
    if (!face_each_other(lit.lights[light], place)) continue;
    ASSERT_TRUE(has_light(database, leaf_at(lit.cells, place.position), light));
  }
}

}  // namespace
}  // namespace oriel
