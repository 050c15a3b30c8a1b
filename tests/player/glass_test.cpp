// Bodies of solid glass: against closed forms of refraction, absorption and total reflection, in an even light, and
// where numbers run out.
#include <algorithm>
#include <cmath>
#include <random>

#include "player/scene/glass_bodies.h"
#include "tests/player/glass_fixture.h"

namespace oriel {
namespace {

using namespace testing;

std::vector<GlassBody> bodies_of(const Pack& pack, std::vector<std::uint32_t>& indices,
                                 std::vector<DrawRange>& ranges) {
  ranges = sorted_ranges(pack.mesh, indices);
  return take_glass_bodies(pack, indices, ranges);
}

TEST(GlassBodies, AreFoundByWhatEncloses) {
  Pack pack = glass_pack(1.5f, 0);
  add_box(pack, Vec3(0), Vec3(1, 2, 3));
  add_ball(pack, Vec3(5, 0, 0), 1);
  add_ball(pack, Vec3(9, 0, 0), 1), add_ball(pack, Vec3(9, 0, 0), 0.9f, true);  // hollow
  std::vector<std::uint32_t> indices;
  std::vector<DrawRange> ranges;
  const auto bodies = bodies_of(pack, indices, ranges);
  ASSERT_EQ(bodies.size(), 3u);
  EXPECT_EQ(bodies[0].planes.size(), 6u);
  EXPECT_LT(length2(bodies[0].centre - Vec3(0.5f, 1, 1.5f)), 1e-8f);
  EXPECT_TRUE(bodies[1].planes.empty());
  EXPECT_NEAR(bodies[1].radius, 1, 1e-5);
  EXPECT_EQ(ranges.size(), 1u) << "the inner shell faces inwards: thin";
  EXPECT_TRUE(is_inside(bodies[0], pack.mesh, indices, Vec3(0.99f, 1.99f, 0.01f)));
  EXPECT_FALSE(is_inside(bodies[0], pack.mesh, indices, Vec3(1.01f, 1, 1)));
  EXPECT_TRUE(is_inside(bodies[1], pack.mesh, indices, Vec3(5.5f, 0.5f, 0)));
  EXPECT_FALSE(is_inside(bodies[1], pack.mesh, indices, Vec3(5.8f, 0.8f, 0)));
}

class GlassTest : public FrameTest {};

// Nothing is to be seen of glass that neither reflects nor absorbs in an even light.
TEST_F(GlassTest, IsNotSeenInAnEvenLight) {
  for (const float ior : {1.0f, 1.5f, 2.4f})
    for (const float roughness : {0.0f, 0.3f, 0.8f})
      for (const bool ball : {false, true}) {
        Pack pack = glass_pack(ior, roughness);
        pack.sky = Vec3(100, 80, 60);
        ball ? add_ball(pack, Vec3(0), 0.7f) : add_box(pack, Vec3(-0.5f, -0.7f, -0.4f), Vec3(0.5f, 0.7f, 0.4f));
        const Picture picture = draw(pack, glass_camera({1, 0.8f, 2}, Vec3(0)), 48, 48);
        expect_even(picture, pack.sky, fmt::format("ior {} roughness {}{}", ior, roughness, ball ? " ball " : " box "));
      }
}

// An edge behind a slab lies where the closed form of the parallel shift has it.
TEST_F(GlassTest, SlabShiftsWhatLiesBehind) {
  Pack pack = glass_pack(ShiftedEdge::kIor, 0);
  ShiftedEdge::add(pack);
  const Camera camera = glass_camera({1.5f, 0, 1.5f}, {0, 0, -1});
  ShiftedEdge::expect_in(draw(pack, camera, 160, 160), camera);
}

TEST_F(GlassTest, SlabAbsorbsByItsThickness) {
  Pack pack = glass_pack(1.5f, 0, AbsorbedLight::kAbsorption);
  add_box(pack, Vec3(-3, -3, -AbsorbedLight::kThick), Vec3(3, 3, 0));
  AbsorbedLight::add(pack);
  AbsorbedLight::expect_in(draw(pack, AbsorbedLight::camera(), 32, 32));
}

// A block in a room of six colours: by refraction and total reflection to and fro each pixel has one of them.
TEST_F(GlassTest, BlockShowsTheWallsThatRaysFind) {
  const Vec3 lower(-0.5f, -0.6f, -0.4f), upper(0.5f, 0.6f, 0.4f);
  constexpr float kRoom = 2, kIor = 1.5f;
  Pack pack = glass_pack(kIor, 0);
  add_box(pack, lower, upper);
  const std::array<Vec3, 6> colors = add_room(pack, kRoom);
  const auto box_exit = [](const Vec3& low, const Vec3& high, const Vec3& p, const Vec3& d, int& side) {
    float nearest = 1e30f;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(d[axis]) < 1e-7f) continue;
      const float way = ((d[axis] > 0 ? high : low)[axis] - p[axis]) / d[axis];
      if (way < nearest) nearest = way, side = 2 * axis + (d[axis] > 0);
    }
    return p + nearest * d;
  };
  const auto normal_of = [](int side) {
    Vec3 n(0);
    n[side / 2] = side % 2 ? 1.0f : -1.0f;
    return n;
  };
  const Camera camera = glass_camera({1.2f, 0.7f, 1.5f}, Vec3(0), 0.7f);
  constexpr int kSize = 96;
  const Picture picture = draw(pack, camera, kSize, kSize);
  // The wall that a pixel shows, -1 beside the block; + 6 where it was reflected totally.
  const auto expected = [&](int x, int y) {
    Vec3 d = pixel_ray(camera, x, y, kSize, kSize);
    float enter = -1e30f, leave = 1e30f;
    int side = 0, wall = 0, again = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float a = (lower[axis] - camera.eye[axis]) / d[axis], b = (upper[axis] - camera.eye[axis]) / d[axis];
      if (std::min(a, b) > enter) enter = std::min(a, b), side = 2 * axis + (d[axis] < 0);
      leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave) return -1;
    Vec3 p = camera.eye + enter * d;
    d = glm::refract(d, normal_of(side), 1 / kIor);
    for (int i = 0; i < 6; ++i) {
      p = box_exit(lower, upper, p, d, side);
      const Vec3 beyond = glm::refract(d, -normal_of(side), kIor);
      if (length2(beyond) > 0) {
        d = beyond;
        break;
      }
      d = glm::reflect(d, normal_of(side)), again = 6;
    }
    box_exit(Vec3(-kRoom), Vec3(kRoom), p, d, wall);
    return wall + again;
  };
  int right = 0, total = 0, reflected = 0;
  for (int y = 1; y + 1 < kSize; ++y)
    for (int x = 1; x + 1 < kSize; ++x) {
      const int wall = expected(x, y);
      bool at_edge = false;  // between two colours
      for (int i = 0; i < 9; ++i) at_edge |= expected(x + i % 3 - 1, y + i / 3 - 1) != wall;
      if (wall < 0 || at_edge) continue;
      ++total, reflected += wall >= 6;
      right += length2(picture.at(x, y) - colors[static_cast<std::size_t>(wall % 6)]) < 25;
    }
  EXPECT_GT(total, 1500);
  EXPECT_GT(reflected, 200);
  EXPECT_GT(right, total * 99 / 100) << "of " << total;
}

TEST_F(GlassTest, FrostedBlurGrowsWithTheDistanceBehind) {
  constexpr float kRoughness = 0.5f;
  const float slopes = slope_width(kRoughness * kRoughness, [](const auto& facet) {
    return glm::refract(glm::refract(Vec3(0, 0, -1), facet(), 1 / 1.5f), facet(), 1.5f);
  });
  for (const float behind : {0.01f, 0.1f, 0.4f}) {
    Pack pack = glass_pack(1.5f, kRoughness);
    add_box(pack, Vec3(-3, -3, 0), Vec3(3, 3, 0.01f));
    add_boards(pack, -behind);
    const Camera camera = glass_camera({0, 0, 1.01f}, Vec3(0), kBoardsFov);
    const float found = edge_width(draw(pack, camera, kBoardsSize, kBoardsSize), kBoardsSize);
    const float blur = pixels_of(slopes, behind);
    EXPECT_NEAR(found, std::sqrt(blur * blur + 4), 0.15f * blur + 1) << behind << " m behind, alone " << blur;
  }
}

// A pane without thickness spreads what is seen through it as it spreads what it reflects, from both sides.
TEST_F(GlassTest, FrostedPanesBlurByTheDistanceBehind) {
  constexpr float kRoughness = 0.35f;
  const float slopes = slope_width(kRoughness * kRoughness, [](const auto& facet) {
    const Vec3 mirrored = glm::reflect(Vec3(0, 0, -1), facet());
    return Vec3(mirrored.x, mirrored.y, -mirrored.z);
  });
  for (const bool back : {false, true})
    for (const float behind : {0.01f, 0.1f, 0.4f}) {
      Pack pack = glass_pack(1.5f, kRoughness);
      pack.solids.clear();
      pack.materials[0].base_color = Vec3(0.5f, 1, 1);
      pack.materials[0].double_sided = true;
      testing::add_quad(pack, {-3, -3, 0}, back ? Vec3(0, 6, 0) : Vec3(6, 0, 0), back ? Vec3(6, 0, 0) : Vec3(0, 6, 0),
                        0, -1);
      add_boards(pack, -behind);
      const Camera camera = glass_camera({0, 0, 1}, Vec3(0), kBoardsFov);
      const Picture picture = draw(pack, camera, kBoardsSize, kBoardsSize);
      const Vec3 bright = picture.at(kBoardsSize * 7 / 8, kBoardsSize / 2);
      EXPECT_NEAR(bright.x, 0.5f * bright.y, 0.5f) << "its tint";
      EXPECT_NEAR(bright.y, 98, 2);
      Picture untinted = picture;
      for (float& c : untinted.rgb) c *= 2;
      const float found = edge_width(untinted, kBoardsSize), blur = pixels_of(slopes, behind);
      EXPECT_NEAR(found, std::sqrt(blur * blur + 4), 0.15f * blur + 1) << behind << " m behind, alone " << blur;
    }
}

// Eyes in the glass, on it, along it, numbers that are too large or none: finite, and no brighter than what there is.
TEST_F(GlassTest, StaysWithinWhatCameIn) {
  const std::vector<Camera> cameras = {
      glass_camera({0.1f, 0.2f, 0.05f}, {1, 0, 0}),   glass_camera({0, 0, 0.4f}, Vec3(0)),
      glass_camera({3, 0, 0.39f}, {0, 0, 0.39f}),     glass_camera({3, 0.6f, 0.4001f}, {0, 0.6f, 0.4f}),
      glass_camera({0, 0, 0.4001f}, {5, 0, 0.4001f}), glass_camera({2, 1, 2}, Vec3(0))};
  Camera flat = glass_camera({2, 1, 2}, Vec3(0));
  flat.vertical_fov_rad = 0, flat.half_height = 1;
  for (const auto& [ior, roughness, absorption] : {std::tuple{1.5f, 0.0f, 0.0f},
                                                   {0.5f, 0.0f, 0.0f},
                                                   {0.0f, 1.0f, 1e30f},
                                                   {1e6f, 0.02f, 1.0f},
                                                   {1.0001f, 1.0f, 1e-30f},
                                                   {2.4f, 0.5f, 3.0f}})
    for (const bool ball : {false, true}) {
      Pack pack = glass_pack(ior, roughness, Vec3(absorption, 0, 1));
      pack.sky = Vec3(100);
      ball ? add_ball(pack, Vec3(0), 0.5f) : add_box(pack, Vec3(-0.5f, -0.6f, -0.4f), Vec3(0.5f, 0.6f, 0.4f));
      pack.mesh.positions[2] = pack.mesh.positions[1];  // a triangle without area, which opens the box
      for (const Camera& camera : {cameras[0], cameras[1], cameras[2], cameras[3], cameras[4], cameras[5], flat}) {
        const Picture picture = draw(pack, camera, 24, 24);
        ASSERT_TRUE(picture.finite()) << ior << " " << roughness << " " << absorption;
        const float most = 101 * std::max(ior * ior, 1.0f);
        for (const float value : picture.rgb) ASSERT_LE(value, most) << ior << " " << roughness << " " << absorption;
      }
    }
}

// Glass out of view costs nothing.
TEST_F(GlassTest, CostsNothingOutOfView) {
  Pack pack = glass_pack(1.5f, 0);
  testing::add_quad(pack, {-1, -1, -2}, {2, 0, 0}, {0, 2, 0}, add_lamp(pack, Vec3(100)), -1);
  const Camera camera = glass_camera({0, 0, 0}, {0, 0, -1});
  const std::uint32_t without = draw(pack, camera, 16, 16).stats.draws;
  add_box(pack, {-0.5f, -0.5f, 3}, {0.5f, 0.5f, 4});
  EXPECT_EQ(draw(pack, camera, 16, 16).stats.draws, without);
}

}  // namespace
}  // namespace oriel
