// Light where none can be: behind walls, in corners, under what stands on a floor.
#include <gtest/gtest.h>

#include "tests/bake/radiosity/baked.h"

namespace oriel {
namespace {

using test::Baked;
using test::SceneParts;

constexpr float kLeakTexel = 0.1f;

class Leaks : public ::testing::TestWithParam<Estimator> {
 protected:
  static Baked bake(Scene scene) {
    RadiosityOptions options;
    options.estimator = GetParam();
    options.samples = 64;
    return test::bake(std::move(scene), kLeakTexel, options);
  }
  // For eyes on a circle around the middle alone.
  static Baked bake_seen_from_outside(Scene scene) {
    RadiosityOptions options = test::cached_options(0.05);
    if (GetParam() == Estimator::kReference) options = {.samples = 64};
    for (int i = 0; i < 8; ++i)
      options.eyes.emplace_back(1.8f * std::cos(kPi * float(i) / 4), 1.5f, 1.8f * std::sin(kPi * float(i) / 4));
    return test::bake(std::move(scene), kLeakTexel, options);
  }
};

std::uint32_t two_sided(SceneParts& parts) {
  const std::uint32_t material = parts.diffuse(Vec3(0.7f));
  parts.scene().materials[material].double_sided = true;
  return material;
}

void add_lamp(SceneParts& parts, const Vec3& corner) {
  parts.quad("lamp", parts.diffuse(Vec3(0), Vec3(10)), corner, {0.3f, 0, 0}, {0, 0, 0.3f});
}

// Brightest texel whose centre `dark` accepts over the mean of all others but the lamp's.
template <class Dark>
double leaked_share(const Baked& b, const Dark& dark) {
  double lit = 0, leaked = 0;
  std::size_t count = 0, dark_count = 0;
  for (std::size_t p = 0; p < b.texel_map.size(); ++p)
    for (std::size_t i = 0; i < b.texel_map[p].texel.size(); ++i) {
      const TexelPoint middle = sample_texel(b.atlas, b.texel_map[p], i, Vec3(0.5f));
      const Surface& surface = b.scene.surfaces[b.scene.triangle_surface[middle.triangle]];
      if (surface.name == "lamp") continue;
      const double e = b.radiosity.pages[p].irradiance[b.texel_map[p].texel[i]].g;
      const SurfacePoint point = point_on_side(b.scene, middle.triangle, middle.barycentric);
      if (dark(surface, point)) {
        leaked = std::max(leaked, e);
        ++dark_count;
      } else {
        lit += e;
        ++count;
      }
    }
  EXPECT_GT(lit, 0);
  EXPECT_GT(dark_count, 0u);
  return leaked / (lit / static_cast<double>(count));
}

// Two rooms of 1 m with a wall between them at x = 0, which no border of the floor's texels meets; the lamp is in the
// left one.
SceneParts two_rooms() {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.7f)), {-1.03f, 0, 0}, {0.97f, 1, 1}, true);
  add_lamp(parts, {-0.7f, 0.99f, 0.3f});
  return parts;
}

bool on_the_right(const Surface&, const SurfacePoint& point) {
  return point.position.x + 1e-4f * point.geometric_normal.x > 0;
}

TEST_P(Leaks, ThinWall) {
  SceneParts parts = two_rooms();
  parts.box("wall", parts.diffuse(Vec3(0.7f)), {-0.0005f, 0, 0}, {0.0005f, 1, 1});
  EXPECT_LE(leaked_share(bake(parts.finish()), on_the_right), 0.01);
}

TEST_P(Leaks, WallWithoutThickness) {
  for (const bool faces_the_light : {false, true}) {
    SceneParts parts = two_rooms();
    const float z = faces_the_light ? 0.0f : 1.0f;
    parts.quad("wall", two_sided(parts), {0, 0, z}, {0, 0, 1 - 2 * z}, {0, 1, 0});
    EXPECT_LE(leaked_share(bake(parts.finish()), on_the_right), 0.01) << faces_the_light;
  }
}

// Quads that share no vertex meet in the edges of a closed room; the lamp hangs outside.
TEST_P(Leaks, ClosedRoomOfSeparateQuads) {
  SceneParts parts;
  const auto wall = two_sided(parts);
  parts.quad("floor", wall, {0, 0, 1}, {1, 0, 0}, {0, 0, -1});
  parts.quad("ceiling", wall, {0, 1, 0}, {1, 0, 0}, {0, 0, 1});
  parts.quad("back", wall, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  parts.quad("front", wall, {1, 0, 1}, {-1, 0, 0}, {0, 1, 0});
  parts.quad("left", wall, {0, 0, 1}, {0, 0, -1}, {0, 1, 0});
  parts.quad("right", wall, {1, 0, 0}, {0, 0, 1}, {0, 1, 0});
  parts.box("thing", parts.diffuse(Vec3(0.7f)), {0.4f, 0.4f, 0.4f}, {0.6f, 0.6f, 0.6f});
  parts.quad("ground", parts.diffuse(Vec3(0.7f)), {-2, -1, 3}, {5, 0, 0}, {0, 0, -5});
  add_lamp(parts, {0.3f, 3, 0.3f});
  const Baked b = bake(parts.finish());
  const auto inside = [](const Surface&, const SurfacePoint& p) {
    const Vec3 above = p.position + 1e-4f * p.geometric_normal;
    return glm::all(glm::greaterThan(above, Vec3(0))) && glm::all(glm::lessThan(above, Vec3(1)));
  };
  EXPECT_LE(leaked_share(b, inside), 0.01);
  EXPECT_EQ(b.sides.doubled, 0u);
  EXPECT_EQ(b.sides.turned, 6u) << "the light is outside";
}

// A box sunk into the floor: no light comes up under it, no dark rim runs around it.
TEST_P(Leaks, ObjectStandingInTheFloor) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.7f)), {0, 0, 0}, {2, 2, 2}, true);
  add_lamp(parts, {0.85f, 1.99f, 0.85f});
  const Scene empty = parts.finish();
  parts.box("box", parts.diffuse(Vec3(0)), {0.83f, -0.2f, 0.83f}, {1.17f, 0.05f, 1.17f});
  const Baked bare = bake(empty), b = bake(parts.finish());
  const auto floor_light = [](const Baked& baked, const auto& wanted) {
    std::vector<double> found;
    for (std::size_t p = 0; p < baked.texel_map.size(); ++p)
      for (std::size_t i = 0; i < baked.texel_map[p].texel.size(); ++i) {
        const TexelPoint middle = sample_texel(baked.atlas, baked.texel_map[p], i, Vec3(0.5f));
        const Vec3 at = point_on(baked.scene, middle.triangle, middle.barycentric);
        if (at.y == 0 && wanted(at))
          found.push_back(baked.radiosity.pages[p].irradiance[baked.texel_map[p].texel[i]].g);
      }
    return found;
  };
  const auto by_the_box = [](const Vec3& at) { return std::max(std::abs(at.x - 1), std::abs(at.z - 1)) < 0.28f; };
  const auto with = floor_light(b, by_the_box), without = floor_light(bare, by_the_box);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) EXPECT_GT(with[i], 0.5 * without[i]) << i;
}

// A post reaches through the floor of a closed room into daylight. None of that comes up by its texels, where somebody
// looks from inside.
TEST_P(Leaks, PostThatReachesThroughTheFloor) {
  SceneParts parts;
  parts.box("room", two_sided(parts), Vec3(0), {2, 2, 2}, true);
  add_lamp(parts, {0.85f, 1.99f, 0.85f});
  parts.box("post", parts.diffuse(Vec3(0.5f)), {0.33f, -0.12f, 0.33f}, {0.63f, 0.6f, 0.63f});
  parts.scene().sky = Vec3(100);
  RadiosityOptions options = test::cached_options(0.05);
  if (GetParam() == Estimator::kReference) options = {.samples = 64};
  for (int i = 0; i < 9; ++i)
    options.eyes.emplace_back(0.2f + 0.8f * static_cast<float>(i % 3), 1.5f, 0.2f + 0.8f * static_cast<float>(i / 3));
  const Baked b = test::bake(parts.finish(), kLeakTexel, options);
  double low = 0, high = 0;
  for (std::uint32_t t = 0; t < b.scene.triangles.size(); ++t) {
    if (b.scene.surfaces[b.scene.triangle_surface[t]].name != "post") continue;
    for (int k = 0; k < 400; ++k) {
      const Vec2 u(static_cast<float>(k % 20) / 19, static_cast<float>(k / 20) / 19);
      const Vec2 at = u.x + u.y > 1 ? 1.0f - u : u;
      const Vec3 p = point_on(b.scene, t, at);
      const auto& uv = b.atlas.uv[t];
      const Vec2 on_page = uv[0] + at.x * (uv[1] - uv[0]) + at.y * (uv[2] - uv[0]);
      const double light = irradiance_at(b.radiosity.pages[static_cast<std::size_t>(b.atlas.page[t])], on_page).g;
      if (p.y > 0.005f) (p.y < 0.1f ? low : high) = std::max(p.y < 0.1f ? low : high, light);
    }
  }
  EXPECT_GT(high, 0.1);
  EXPECT_LT(low, high) << "eighty times that without";
}

// A closed room stands on a floor that goes on outdoors, where all eyes are: it stays as dark as it is.
TEST_P(Leaks, RoomThatIsSeenFromOutsideAlone) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.7f));
  parts.quad("floor", white, {-2.03f, 0, 2.03f}, {4.06f, 0, 0}, {0, 0, -4.06f});
  parts.box("room", two_sided(parts), {-1, -0.5f, -1}, {1, 2, 1}, true);
  parts.scene().sky = Vec3(100);
  const Baked b = bake_seen_from_outside(parts.finish());
  const auto inside = [](const Surface& surface, const SurfacePoint& at) {
    return surface.name == "floor" && std::max(std::abs(at.position.x), std::abs(at.position.z)) < 0.99f;
  };
  EXPECT_LT(leaked_share(b, inside), 0.001);
}

// Boards reach through the wall of a closed room, by less than a texel; from outside, where all eyes are, their ends
// are seen in the daylight.
TEST_P(Leaks, BoardsThatReachThroughTheWall) {
  SceneParts parts;
  const auto white = parts.diffuse(Vec3(0.7f));
  parts.box("room", white, {-1, 0, -1}, {1, 2, 1}, true);
  parts.box("shell", white, {-1.005f, -0.005f, -1.005f}, {1.005f, 2.005f, 1.005f});
  for (int i = 0; i < 4; ++i) {
    const float y = 0.33f + 0.4f * static_cast<float>(i);
    parts.box("board", white, {-1.03f, y, -0.57f}, {-0.77f, y + 0.02f, 0.57f});
  }
  parts.scene().sky = Vec3(100);
  const Baked b = bake_seen_from_outside(parts.finish());
  const auto inside = [](const Surface& surface, const SurfacePoint&) { return surface.name == "room"; };
  EXPECT_LT(leaked_share(b, inside), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Estimators, Leaks, ::testing::Values(Estimator::kReference, Estimator::kCached),
                         [](const auto& test) { return test.param == Estimator::kReference ? "Reference" : "Cached"; });

}  // namespace
}  // namespace oriel
