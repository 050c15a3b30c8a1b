// Glass that rays leave and enter again: forks, cups and tubes, whose middle does not see all of them.
#include <limits>

#include "player/scene/glass_bodies.h"
#include "player/scene/glass_tree.h"
#include "tests/player/glass_fixture.h"

namespace oriel {
namespace {

using namespace testing;

// Two slabs upright that are one body by what joins them below: from z = 0 on, each `leg` thick, `gap` apart.
void add_fork(Pack& pack, float leg, float gap, float half = 3) {
  const float z3 = 0, z2 = -leg, z1 = -leg - gap, z0 = -2 * leg - gap;
  const Vec2 outline[8] = {{z0, -half - 1}, {z3, -half - 1}, {z3, half}, {z2, half},
                           {z2, -half},     {z1, -half},     {z1, half}, {z0, half}};
  const auto at = [&](int i, float x) { return Vec3(x, outline[i % 8].y, outline[i % 8].x); };
  for (int i = 0; i < 8; ++i) {
    add_flat(pack, at(i, -half), at(i, half), at(i + 1, half));
    add_flat(pack, at(i, -half), at(i + 1, half), at(i + 1, -half));
  }
  constexpr int kCaps[6][3] = {{1, 2, 3}, {1, 3, 4}, {0, 1, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 7}};
  for (const auto& [a, b, c] : kCaps) {
    add_flat(pack, at(a, -half), at(b, -half), at(c, -half));
    add_flat(pack, at(a, half), at(c, half), at(b, half));
  }
}

std::vector<GlassTriangle> triangles_of(const Pack& pack, std::size_t count) {
  std::vector<GlassTriangle> out(count / 3);
  for (std::size_t i = 0; i < count; ++i) {
    out[i / 3].corners[i % 3] = pack.mesh.positions[pack.mesh.indices[i]];
    out[i / 3].normals[i % 3] = pack.mesh.normals[pack.mesh.indices[i]];
  }
  return out;
}

TEST(GlassTree, HoldsEachTriangleOnceInItsBoxes) {
  Pack pack;
  add_cup(pack);
  const std::size_t count = pack.mesh.indices.size() / 3;
  const std::vector<Vec4> texels = glass_tree(triangles_of(pack, pack.mesh.indices.size()));
  const auto nodes = static_cast<std::size_t>(texels[0].w);
  ASSERT_EQ(texels.size(), 2 * nodes + 6 * count);
  std::vector<int> held(count);
  for (std::size_t node = 0; node < nodes; ++node) {
    const Vec4 &lower = texels[2 * node], &upper = texels[2 * node + 1];
    const auto after = static_cast<std::size_t>(lower.w);
    ASSERT_GT(after, node);
    ASSERT_LE(after, nodes);
    for (std::size_t inner = node + 1; inner < after; ++inner) {
      EXPECT_TRUE(glm::all(glm::greaterThanEqual(Vec3(texels[2 * inner]), Vec3(lower))));
      EXPECT_TRUE(glm::all(glm::lessThanEqual(Vec3(texels[2 * inner + 1]), Vec3(upper))));
      EXPECT_LE(static_cast<std::size_t>(texels[2 * inner].w), after);
    }
    if (upper.w < 0) continue;
    EXPECT_EQ(after, node + 1);
    const auto leaf = static_cast<std::size_t>(upper.w);
    for (std::size_t t = leaf / 8; t < leaf / 8 + leaf % 8; ++t) {
      ++held[t];
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3 corner(texels[2 * nodes + 6 * t + c]);
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(corner, Vec3(lower))) &&
                    glm::all(glm::lessThanEqual(corner, Vec3(upper))));
      }
    }
  }
  EXPECT_EQ(held, std::vector<int>(count, 1));
  EXPECT_TRUE(glass_tree({}).empty());
}

TEST(GlassTree, IsOfClosedGlassAlone) {
  for (const bool open : {false, true}) {
    Pack pack = glass_pack(1.5f, 0);
    add_cup(pack);
    if (open) pack.mesh.parts.pop_back();
    std::vector<std::uint32_t> indices;
    std::vector<DrawRange> ranges = sorted_ranges(pack.mesh, indices);
    const auto bodies = take_glass_bodies(pack, indices, ranges);
    ASSERT_EQ(bodies.size(), open ? 0u : 1u);
    EXPECT_EQ(ranges.empty(), !open);
    if (!open) {
      EXPECT_FALSE(bodies[0].tree.empty());
    }
  }
}

class HollowGlassTest : public FrameTest {};

TEST_F(HollowGlassTest, ForkShiftsWhatLiesBehindTwice) {
  Pack pack = glass_pack(ShiftedEdge::kIor, 0);
  add_fork(pack, 0.5f * ShiftedEdge::kThick, 0.3f);
  testing::add_quad(pack, {0, -4, ShiftedEdge::kBehind}, {4, 0, 0}, {0, 8, 0}, add_lamp(pack, Vec3(100)), -1);
  const Camera camera = glass_camera({1.5f, 0, 1.5f}, {0, 0, -1});
  ShiftedEdge::expect_in(draw(pack, camera, 160, 160), camera);
}

TEST_F(HollowGlassTest, ForkAbsorbsByItsThickness) {
  Pack pack = glass_pack(1.5f, 0, AbsorbedLight::kAbsorption);
  add_fork(pack, 0.5f * AbsorbedLight::kThick, 0.3f);
  AbsorbedLight::add(pack);
  AbsorbedLight::expect_in(draw(pack, AbsorbedLight::camera(), 32, 32));
}

// A card between the two slabs hides the far one.
TEST_F(HollowGlassTest, ShowsWhatStandsInIt) {
  const Vec3 absorption(0, 1, 2);
  Pack pack = glass_pack(1.5f, 0, absorption);
  add_fork(pack, 0.1f, 0.3f);
  testing::add_quad(pack, {-9, -9, -2}, {18, 0, 0}, {0, 18, 0}, add_lamp(pack, Vec3(100)), -1);
  testing::add_quad(pack, {-1, -1, -0.2f}, {1, 0, 0}, {0, 2, 0}, add_lamp(pack, Vec3(50)), -1);
  const Picture picture = draw(pack, glass_camera({0, 0, 1.5f}, Vec3(0)), 64, 64);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(picture.at(20, 32)[c], 50 * std::exp(-0.1f * absorption[c]), 1);
    EXPECT_NEAR(picture.at(44, 32)[c], 100 * std::exp(-0.2f * absorption[c]), 1);
  }
}

// What a ray meets of the body from within or from outside.
struct Met {
  float way = std::numeric_limits<float>::infinity();
  Vec3 normal{0};
};

Met meet(const std::vector<GlassTriangle>& triangles, const Vec3& p, const Vec3& d, bool leaving) {
  Met met;
  for (const GlassTriangle& t : triangles) {
    const Vec3 a = t.corners[0], ab = t.corners[1] - a, ac = t.corners[2] - a, n = glm::cross(ab, ac);
    const float speed = glm::dot(n, d);
    if (leaving ? speed <= 0 : speed >= 0) continue;
    const float way = glm::dot(n, a - p) / speed;
    const Vec3 x = p + way * d - a;
    const float v = glm::dot(glm::cross(x, ac), n) / glm::dot(n, n),
                w = glm::dot(glm::cross(ab, x), n) / glm::dot(n, n);
    if (way > 1e-5f && way < met.way && v >= 0 && w >= 0 && v + w <= 1) met = {way, glm::normalize(n)};
  }
  return met;
}

// A cup in a room of six colours: each pixel has one of them, by refraction and total reflection.
TEST_F(HollowGlassTest, CupShowsTheWallsThatRaysFind) {
  constexpr float kRoom = 2, kIor = 1.5f;
  Pack pack = glass_pack(kIor, 0);
  add_cup(pack);
  const std::vector<GlassTriangle> cup = triangles_of(pack, pack.mesh.indices.size());
  const std::array<Vec3, 6> colors = add_room(pack, kRoom);
  const Camera camera = glass_camera({0.9f, 0.8f, 1.7f}, Vec3(0), 0.7f);
  constexpr int kSize = 96;
  const Picture picture = draw(pack, camera, kSize, kSize);
  // The wall that a pixel shows, -1 beside the cup, -2 where it takes more than the player follows.
  const auto expected = [&](int x, int y) {
    Vec3 p = camera.eye, d = pixel_ray(camera, x, y, kSize, kSize);
    bool inside = false;
    for (int i = 0; i < 12; ++i) {
      const Met met = meet(cup, p, d, inside);
      if (!std::isfinite(met.way)) break;
      p += met.way * d;
      const Vec3 n = inside ? -met.normal : met.normal, bent = glm::refract(d, n, inside ? kIor : 1 / kIor);
      if (length2(bent) > 0)
        d = bent, inside = !inside;
      else
        d = glm::reflect(d, n);
      if (i == 11) return -2;
    }
    if (p == camera.eye) return -1;
    if (inside) return -2;
    int wall = 0;
    float nearest = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const float way = (std::copysign(kRoom, d[axis]) - p[axis]) / d[axis];
      if (way < nearest) nearest = way, wall = 2 * axis + (d[axis] > 0);
    }
    return wall;
  };
  int right = 0, total = 0;
  for (int y = 1; y + 1 < kSize; ++y)
    for (int x = 1; x + 1 < kSize; ++x) {
      const int wall = expected(x, y);
      bool at_edge = false;  // between two colours
      for (int i = 0; i < 9; ++i) at_edge |= expected(x + i % 3 - 1, y + i / 3 - 1) != wall;
      if (wall < 0 || at_edge) continue;
      ++total;
      right += length2(picture.at(x, y) - colors[static_cast<std::size_t>(wall)]) < 25;
    }
  EXPECT_GT(total, 3000);
  EXPECT_GT(right, total * 99 / 100) << "of " << total;
}

TEST_F(HollowGlassTest, IsNotSeenInAnEvenLight) {
  for (const float ior : {1.0f, 1.5f})
    for (const float roughness : {0.0f, 0.3f})
      for (const bool cup : {false, true}) {
        Pack pack = glass_pack(ior, roughness);
        pack.sky = Vec3(100, 80, 60);
        cup ? add_cup(pack) : add_fork(pack, 0.2f, 0.3f, 0.5f);
        const Picture picture = draw(pack, glass_camera({0.7f, 0.9f, 2}, Vec3(0)), 48, 48);
        EXPECT_EQ(picture.stats.glass, 1u);
        expect_even(picture, pack.sky, fmt::format("ior {} roughness {}{}", ior, roughness, cup ? " cup " : " fork "));
      }
}

// From in the glass, in the cup and on its rim.
TEST_F(HollowGlassTest, IsFinite) {
  for (const float roughness : {0.0f, 0.3f}) {
    Pack pack = glass_pack(1.5f, roughness, Vec3(1, 2, 3));
    add_cup(pack);
    add_room(pack, 2);
    for (const Vec3& eye : {Vec3(0.45f, 0.1f, 0), Vec3(0, 0.1f, 0.05f), Vec3(0.45f, 0.65f, 0), Vec3(0, 1.5f, 0.01f)})
      for (Camera camera : {glass_camera(eye, Vec3(0), 1), glass_camera(eye, {1, 0.3f, 1}, 1)})
        for (const float half_height : {0.0f, 1.0f}) {
          if (half_height > 0) camera.vertical_fov_rad = 0, camera.half_height = half_height;
          EXPECT_TRUE(draw(pack, camera, 32, 24).finite()) << eye.x << ' ' << eye.y;
        }
  }
}

}  // namespace
}  // namespace oriel
