// Lamps that move, in frames.
#include <chrono>
#include <thread>

#include "formats/query/clipped_polygon.h"
#include "formats/query/group_light.h"
#include "player/navigation/drag.h"
#include "player/navigation/lamps.h"
#include "player/navigation/poses.h"
#include "player/scene/lights.h"
#include "player/scene/live_lamps.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {

using namespace testing;

constexpr Vec3 kRadiance(1000, 800, 600), kOthers(30, 40, 80);
constexpr std::uint32_t kSide = 32;  // texels

// What a lamp of 1 m x 1 m at that middle, facing down, gives a point of the floor y = 0.
Vec3 exact(const Vec3& middle, const Vec3& point) {
  ClippedPolygon polygon;
  for (const Vec2& c : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
    polygon.v[polygon.count++] = glm::normalize(middle + 0.5f * Vec3(c.x, 0, c.y) - point);
  return kRadiance * std::abs(polygon_vector(polygon).y);
}

// A floor of 4 m x 4 m, lit by the lamp 2 m above its middle and by others.
Pack lit_floor() {
  Pack pack;
  pack.materials.resize(2);
  pack.materials[0].base_color = Vec3(0.5f);
  pack.materials[1].emission = kRadiance;
  add_quad(pack, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, 0, 0);
  add_quad(pack, {-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, 1, -1);
  std::vector<std::vector<LightmapPage>> light(2, std::vector<LightmapPage>(1));
  for (std::vector<LightmapPage>& pages : light) {
    pages[0].width = pages[0].height = kSide;
    pages[0].standard_error.assign(kSide * kSide, Vec3(0));
    pages[0].state.assign(kSide * kSide, TexelState::kValid);
    pages[0].irradiance.assign(kSide * kSide, kOthers);
  }
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const Vec2 at = 4.0f * (Vec2(x, y) + 0.5f) / float(kSide) - 2.0f;  // u is z, v is x
      light[0][0].irradiance[y * kSide + x] = exact({0, 2, 0}, {at.y, 0, at.x});
    }
  pack.lightmaps = {light[0][0]};
  for (std::size_t i = 0; i < kSide * kSide; ++i) pack.lightmaps[0].irradiance[i] += kOthers;
  pack.page_groups = {groups_of_page(pack.lightmaps[0], 0, light)};
  pack.light_groups.resize(2);
  pack.light_groups[0].name = "lamp", pack.light_groups[0].materials = {1};
  pack.light_groups[1].name = "others";
  return pack;
}

// From above the floor, below the lamp; up is -z.
Camera camera_above() {
  return {"c", {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, 1.5f, 0};
}

MoverPose shifted(const Vec3& by) {
  MoverPose pose;
  pose.position = by;
  return pose;
}

using LampsTest = FrameTest;

TEST_F(LampsTest, WhereNothingMovedFramesAreTheBakesToTheBit) {
  const Pack pack = lit_floor();
  const Picture baked = draw(pack, camera_above(), 64, 64);
  EXPECT_EQ(draw(pack, camera_above(), 64, 64, {.lamps = {{}, {}}}).rgb, baked.rgb);
  const auto scene = GpuScene::create(pack, device_);
  ASSERT_TRUE(scene);
  const View view = make_view(camera_above(), 64, 64, (*scene)->bounds());
  const auto render = [&](const FrameOptions& options) {
    EXPECT_TRUE(renderer_->render(**scene, view, options));
    return renderer_->read_light();
  };
  EXPECT_NE(render({.lamps = {shifted({1, 0, 0}), {}}}), baked.rgb);
  EXPECT_EQ((*scene)->take_live_reports().size(), 1u);
  EXPECT_EQ(render({}), baked.rgb);  // and back
  EXPECT_TRUE((*scene)->take_live_reports().empty());
}

TEST_F(LampsTest, DirectLightIsTheClosedForm) {
  const Pack pack = lit_floor();
  for (const float factor : {1.0f, 0.5f}) {
    const Picture picture = draw(pack, camera_above(), 64, 64,
                                 {.lights = {Vec3(factor), Vec3(1)},
                                  .lamps = {shifted({1, 0.5f, 0}), {}},
                                  .live = {{.lights = 256, .bounces = 0}}});
    ASSERT_TRUE(picture.finite());
    for (const IVec2& pixel : {IVec2(32, 32), IVec2(60, 32), IVec2(10, 50)}) {
      const Vec2 at = (Vec2(pixel) + 0.5f) / 32.0f - 1.0f;
      const Vec3 point = std::tan(0.75f) * Vec3(at.x, 0, at.y);
      const Vec3 expected = (kOthers + factor * exact({1, 2.5f, 0}, point)) * (0.5f / kPi);
      EXPECT_LT(glm::length(picture.at(pixel.x, pixel.y) - expected), 0.02f * glm::length(expected));
    }
  }
}

// Texels that the bake filled from around have light of a lamp whose live lights give none there.
TEST_F(LampsTest, WhatIsCoveredLosesTheLightOfALampThatIsGone) {
  Pack pack = lit_floor();
  add_quad(pack, {-2, 0.3f, -2}, {0, 0, 4}, {1.2f, 0, 0}, 0, -1);
  const Camera below = {"c", {-1.7f, 0.2f, 0}, {0, -1, 0}, {0, 0, -1}, 1.0f, 0};
  const float before = draw(pack, below, 32, 32).at(16, 16).g, others = 0.5f * kOthers.g / kPi;
  EXPECT_GT(before, 1.2f * others);
  const FrameOptions away{.lamps = {shifted({0, 500, 0}), {}}};
  EXPECT_NEAR(draw(pack, below, 32, 32, away).at(16, 16).g, others, 0.01f * others);
}

TEST_F(LampsTest, TheLampIsSeenWhereItIs) {
  Camera up = camera_above();
  up.forward = {0, 1, 0}, up.up = {0, 0, 1}, up.eye = {0, 0.5f, 0};
  const Picture before = draw(lit_floor(), up, 64, 64);
  const Picture after = draw(lit_floor(), up, 64, 64, {.lamps = {shifted({1.2f, 0, 0}), {}}});
  EXPECT_EQ(before.at(32, 32), kRadiance);
  EXPECT_EQ(after.at(32, 32), Vec3(0));
  EXPECT_TRUE(after.at(4, 32) == kRadiance || after.at(60, 32) == kRadiance);
}

TEST_F(LampsTest, AnyNumberOfLightsIsFinite) {
  for (const LiveOptions& lights : {LiveOptions{0}, LiveOptions{1}, LiveOptions{.lights = 3000, .bounces = 100}})
    for (const Vec3& shift : {Vec3(0, -2, 0), Vec3(0, -1.9999f, 0), Vec3(0, -3, 0), Vec3(1e5f, 0, 0)}) {
      const Picture picture =
          draw(lit_floor(), camera_above(), 32, 32, {.lamps = {shifted(shift), {}}, .live = {lights, false}});
      EXPECT_TRUE(picture.finite()) << lights.lights << " lights, moved by " << shift.x << ", " << shift.y << ": "
                                    << picture.at(16, 16).x;
    }
}

// In the background light comes in two steps, and ends with what it is at once.
TEST(LiveLamps, ComeToTheSameInTheBackground) {
  const Pack pack = lit_floor();
  const ImageSource images(pack, nullptr, {});
  const LiveSettings settings{{.lights = 64, .bounces = 2}, false};
  LiveSettings in_background = settings;
  in_background.in_background = true;
  const std::vector<MoverPose> away{shifted({1, 0, 0}), {}}, farther{shifted({0, 1, 0}), {}};
  LiveLamps at_once(pack, images), later(pack, images);
  ASSERT_TRUE(at_once.place(farther, settings));
  const auto expected = at_once.changes({});
  ASSERT_TRUE(expected);
  ASSERT_TRUE(later.place(away, in_background));  // on the way
  bool whole = false;
  for (int i = 0; i < 10000 && !whole; ++i) {
    ASSERT_TRUE(later.place(farther, in_background));
    whole = !later.take_reports().empty();
    if (!whole) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_TRUE(whole);
  const auto found = later.changes({});
  ASSERT_TRUE(found);
  EXPECT_EQ((*found)[0].light, (*expected)[0].light);
  ASSERT_TRUE(later.place(std::vector<MoverPose>(2), in_background));
  EXPECT_EQ(later.changes({}), nullptr);
}

// Movers are lit from where lamps are now; where they hang is told by where they were baked.
TEST(Lamps, PointLightsGoAlong) {
  Pack pack = lit_floor();
  BrightLight spot;
  spot.kind = BrightLightKind::kSpot;
  spot.position = {1, 2, 0}, spot.direction = {1, 0, 0};
  pack.light_field.lights = {spot, spot};
  pack.light_field.lights[1].kind = BrightLightKind::kDirectional;
  pack.light_groups[0].bright_lights = {0, 1};
  const auto poses = lamps_at(pack, std::vector<MoverMove>{*parse_move("lamp=0,3,0,90")}, 0);
  ASSERT_TRUE(poses);
  const std::vector<BrightLight> placed = placed_lights(pack, *poses);
  const Mat4 pose(pack_from_object((*poses)[0]));
  EXPECT_LT(glm::distance(placed[0].position, Vec3(pose * Vec4(spot.position, 1))), 1e-6f);
  EXPECT_LT(std::fabs(glm::dot(placed[0].direction, spot.direction)), 1e-6f) << "a quarter turn";
  EXPECT_EQ(placed[1].direction, spot.direction) << "a sun stands still";
  EXPECT_EQ(placed_lights(pack, std::vector<MoverPose>(2))[0].position, spot.position);
}

TEST(Lamps, MovesPutTheirMiddleThere) {
  Pack pack = lit_floor();
  pack.mesh.origin = DVec3(100, 0, 0);
  const auto move = parse_move("lamp=101,2.5,0,90");
  ASSERT_TRUE(move);
  const auto poses = lamps_at(pack, std::vector<MoverMove>{*move}, 0);
  ASSERT_TRUE(poses);
  ASSERT_EQ(poses->size(), 2u);
  const Vec3 corner(pack_from_object((*poses)[0]) * DVec4(0.5, 2, 0.5, 1));
  EXPECT_LT(glm::distance(corner, Vec3(1.5f, 2.5f, -0.5f)), 1e-5f);
  EXPECT_TRUE(is_rest((*poses)[1]));
  EXPECT_TRUE(lamps_at(pack, {}, 0)->empty());
  const auto home = lamps_at(pack, std::vector<MoverMove>{*parse_move("lamp=100,2,0")}, 0);
  ASSERT_TRUE(home);
  EXPECT_TRUE(is_rest((*home)[0]));
}

TEST(Lamps, GoAsTheirAnimationHasThem) {
  Pack pack = lit_floor();
  LightGroup& lamp = pack.light_groups[0];
  lamp.rest = {{1, 2, 0}, {0, 0, 0, 1}};
  lamp.keys = {{0, lamp.rest}, {1, {{1, 4, 0}, {0, 1, 0, 0}}}, {3, {{1, 4, 0}, {0, 1, 0, 0}}}};
  EXPECT_TRUE(lamps_at(pack, {}, 0)->empty()) << "at rest, to the bit";
  const auto poses = lamps_at(pack, {}, 2);  // two metres up and half a turn about the node's origin
  ASSERT_TRUE(poses);
  ASSERT_EQ(poses->size(), 2u);
  const Vec3 corner(pack_from_object((*poses)[0]) * DVec4(0.5, 2, 0.5, 1));
  EXPECT_LT(glm::distance(corner, Vec3(1.5f, 4, -0.5f)), 1e-5f);
  const auto moved = lamps_at(pack, std::vector<MoverMove>{*parse_move("lamp=0,3,0")}, 2);
  ASSERT_TRUE(moved);
  EXPECT_LT(glm::distance(Vec3(pack_from_object((*moved)[0]) * DVec4(0, 2, 0, 1)), Vec3(0, 3, 0)), 1e-5f)
      << "who moves it says where it is";
}

TEST(Lamps, NamesThatCannotMoveAreTold) {
  const Pack pack = lit_floor();
  const auto error_of = [&](const char* text) {
    const std::vector<MoverMove> moves{*parse_move(text)};
    const auto movers = poses_at(pack, moves, 0);
    if (!movers) return movers.error().text();
    const auto lamps = lamps_at(pack, moves, 0);
    return lamps ? std::string() : lamps.error().text();
  };
  EXPECT_EQ(error_of("lamp=0,0,0"), "");
  EXPECT_NE(error_of("lamb=0,0,0").find("lamp"), std::string::npos);
  EXPECT_NE(error_of("others=0,0,0").find("no shining surface"), std::string::npos);
}

TEST(Lamps, AreTakenWhereTheyAre) {
  const Pack pack = lit_floor();
  const PickRay from_below{{0, 1, 0}, {0, 1, 0}};
  const auto grip = grip_lamp(pack, {}, from_below);
  ASSERT_TRUE(grip);
  EXPECT_TRUE(grip->lamp);
  EXPECT_EQ(grip->mover, 0u);
  EXPECT_NEAR(grip->at.y, 2, 1e-6f);
  const std::vector<MoverPose> away{shifted({5, 0, 0}), {}};
  EXPECT_FALSE(grip_lamp(pack, away, from_below));
  EXPECT_TRUE(grip_lamp(pack, away, {{5, 1, 0}, {0, 1, 0}}));
  EXPECT_FALSE(grip_lamp(pack, {}, {{0, 1, 0}, {0, -1, 0}}));  // the floor
}

}  // namespace
}  // namespace oriel
