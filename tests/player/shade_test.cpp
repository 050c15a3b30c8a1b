// The shade of movers in light from everywhere, beside closed forms.
#include "formats/query/group_light.h"
#include "player/movers/hemisphere_map.h"
#include "tests/player/mover_fixture.h"

namespace oriel {
namespace {
using namespace testing;

constexpr float kLux = 100;  // of the floor
constexpr float kCeilingLux = 200, kAlbedo = 0.5f;
const float kHalfTurn = std::sqrt(0.5f);
const MoverPose kFaceUp{{0, 0, 0}, {-kHalfTurn, 0, 0, kHalfTurn}};  // the square of 2 m faces up

MoverPose at(const Vec3& position) {
  return {position, kFaceUp.rotation};
}

// The floor at y = -2, 8 by 8 metres, and the mover above it.
Pack floor_scene() {
  Pack pack = mover_pack(even_field(Vec3(1)));
  pack.materials.resize(2);
  pack.materials[1].base_color = Vec3(0);
  pack.lightmaps.push_back(flat_page(Vec3(kLux)));
  add_quad(pack, {-4, -2, 4}, {8, 0, 0}, {0, 0, -8}, 1, 0);
  pack.movers[0].rest = kFaceUp;
  return pack;
}

// A ceiling of 16 by 16 metres at y = 2, which sends out kCeilingLux · kAlbedo.
Pack room_scene() {
  Pack pack = floor_scene();
  pack.materials.resize(3);
  pack.materials[2].base_color = Vec3(kAlbedo);
  pack.lightmaps.push_back(page_of(32, [](std::uint32_t, std::uint32_t) { return Vec3(kCeilingLux); }));
  add_quad(pack, {-8, 2, -8}, {16, 0, 0}, {0, 0, 16}, 2, 1);
  return pack;
}

// From a point to a level rectangle above it whose corner is right over the point.
double corner_factor(double a, double b, double height) {
  const double x = a / height, y = b / height, sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
  return (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2 * kPiD);
}
double form_factor(const DVec2& lower, const DVec2& upper, double height) {
  const auto corner = [&](double x, double y) {
    return std::copysign(1.0, x * y) * corner_factor(std::abs(x), std::abs(y), height);
  };
  return corner(upper.x, upper.y) - corner(lower.x, upper.y) - corner(upper.x, lower.y) + corner(lower.x, lower.y);
}

class ShadeTest : public FrameTest {
 protected:
  static FrameOptions options_of(std::uint32_t lights = 128) {
    FrameOptions options;
    options.show = Show::kD;
    options.shade.lights = lights;
    options.shade.every_pixel = true;
    options.poses = {kFaceUp};
    return options;
  }
  // Illuminance of the floor there; its albedo is 1 for this.
  float lux_at(Pack pack, const FrameOptions& options, float x, float z) {
    pack.materials[1].base_color = Vec3(1);
    return draw(pack, above_floor(x, z), 5, 5, options).at(2, 2).g * kPi;
  }
};

// The floor is black to the lights that are drawn: else it would be among them.
TEST_F(ShadeTest, OfASquareUnderAnEvenCeilingIsItsFormFactor) {
  Pack pack = room_scene();
  pack.materials[1].base_color = Vec3(1);
  pack.lightmaps[0] = flat_page(Vec3(kLux));
  const FrameOptions options = options_of(1000);
  for (const float x : {0.0f, 0.7f, 1.6f}) {
    const double blocked = kCeilingLux * kAlbedo * form_factor({-1 - x, -1}, {1 - x, 1}, 2);
    const float taken = kLux - lux_at(pack, options, x, 0);
    EXPECT_NEAR(taken, blocked, 0.06 * kCeilingLux * kAlbedo * form_factor({-1, -1}, {1, 1}, 2)) << x;
  }
}

TEST_F(ShadeTest, OfTheSkyIsTheSame) {
  Pack pack = floor_scene();
  pack.sky = Vec3(20);
  const FrameOptions options = options_of(1000);
  // Some thirty lights are behind the mover: the mean over places.
  double taken = 0, blocked = 0;
  for (const float x : {-0.6f, -0.3f, 0.0f, 0.25f, 0.5f}) {
    taken += kLux - lux_at(pack, options, x, 0.5f * x);
    blocked += 20 * kPiD * form_factor({-1 - x, -1 - 0.5f * x}, {1 - x, 1 - 0.5f * x}, 2);
  }
  EXPECT_NEAR(taken, blocked, 0.05 * blocked);
}

// What stands between mover and floor leaves no light to take, though the mover sees the ceiling.
TEST_F(ShadeTest, IsNoneWhereNoLightComes) {
  Pack pack = room_scene();
  pack.materials[1].base_color = Vec3(1);
  EXPECT_LT(lux_at(pack, options_of(), 0, 0), 0.9f * kLux);
  add_quad(pack, {-8, -0.5f, -8}, {16, 0, 0}, {0, 0, 16}, 0, -1);
  EXPECT_NEAR(lux_at(pack, options_of(), 0, 0), kLux, 1e-3f * kLux);
}

// Three quarters of the ceiling's light are of a lamp that lights all of the floor, a quarter is of another one.
TEST_F(ShadeTest, FollowsLampsThatAreSwitched) {
  Pack pack = room_scene();
  std::vector<std::vector<LightmapPage>> light;
  for (const Vec2& lux : {Vec2(kLux, 0.75f * kCeilingLux), Vec2(0, 0.25f * kCeilingLux)})
    light.push_back({flat_page(Vec3(lux.x)), page_of(32, [&](auto, auto) { return Vec3(lux.y); })});
  for (std::uint32_t page = 0; page < 2; ++page)
    pack.page_groups.push_back(groups_of_page(pack.lightmaps[page], page, light));
  pack.light_groups.resize(2);
  pack.light_groups[0].name = "window", pack.light_groups[1].name = "lamp";
  for (LightGroup& group : pack.light_groups) group.probes.assign(pack.light_field.probes.size(), Vec3(0.5f));
  FrameOptions options = options_of();
  const float all = kLux - lux_at(pack, options, 0, 0);
  ASSERT_GT(all, 5);
  options.lights = {Vec3(1), Vec3(0)};
  EXPECT_NEAR(kLux - lux_at(pack, options, 0, 0), 0.75f * all, 0.02f * all);
  options.lights = {Vec3(1), Vec3(3)};
  EXPECT_NEAR(kLux - lux_at(pack, options, 0, 0), 1.5f * all, 0.02f * all);
}

// A few maps a frame: in the end it is all of them.
TEST_F(ShadeTest, LateMapsComeInTheEnd) {
  Pack pack = room_scene();
  pack.materials[1].base_color = Vec3(1);
  auto scene = GpuScene::create(pack, device_);
  ASSERT_TRUE(scene);
  FrameOptions options = options_of(64);
  const Camera camera = look_at({5, 1.2f, 5.5f}, {0, -2, 0}, 0.9f);
  const View view = make_view(camera, 48, 32, bounds_with_movers(**scene, options.poses));
  options.shade.maps_a_frame = 10;
  std::uint32_t frames = 0;
  std::vector<double> sums;
  do {
    const auto stats = renderer_->render(**scene, view, options);
    ASSERT_TRUE(stats);
    EXPECT_LE(stats->shade.maps, 10u);
    sums.push_back(0);
    for (const float value : renderer_->read_frame().pixels) sums.back() += value;
  } while (renderer_->has_news() && ++frames < 20);
  EXPECT_GT(frames, 2u);
  for (const double sum : sums) EXPECT_GE(sum, sums.back()) << "a map that is not there yet blocks nothing";
  EXPECT_LT(frames, 20u);
  const FloatImage slow = renderer_->read_frame();
  options.shade.maps_a_frame = 0;
  options.poses[0].position.x = 0.1f;
  ASSERT_TRUE(renderer_->render(**scene, view, options));
  options.poses[0].position.x = 0;
  ASSERT_TRUE(renderer_->render(**scene, view, options));
  EXPECT_EQ(renderer_->read_frame().pixels, slow.pixels);
}

TEST_F(ShadeTest, NoLightsNoMoversNoChange) {
  Pack pack = room_scene();
  const Camera camera = look_at({5, 1.2f, 5.5f}, {0, -2, 0}, 0.9f);
  const Picture none = draw(pack, camera, 48, 32, options_of(0));
  EXPECT_EQ(none.stats.shade.lights, 0u);
  pack.movers.clear();
  FrameOptions options = options_of();
  options.poses.clear();
  const Picture without = draw(pack, camera, 48, 32, options);
  EXPECT_EQ(without.stats.shade.lights, 0u);
  options.shade.lights = 0;
  EXPECT_EQ(draw(pack, camera, 48, 32, options).rgb, without.rgb);
}

TEST_F(ShadeTest, ExtremesStayFinite) {
  Pack pack = room_scene();
  pack.materials[1].base_color = Vec3(1);
  const Camera camera = look_at({5, 1.2f, 5.5f}, {0, -2, 0}, 0.9f);
  // On lights, through the floor, far outside, and one that is nothing.
  for (const Vec3& position :
       {Vec3(0, 2, 0), Vec3(0, -2, 0), Vec3(0, 1.9999f, 0), Vec3(1e4f, 0, 0), Vec3(0, -1e5f, 0)}) {
    FrameOptions options = options_of();
    options.poses = {at(position)};
    const Picture picture = draw(pack, camera, 24, 16, options);
    EXPECT_TRUE(picture.finite()) << position.y;
    for (const float value : picture.rgb) EXPECT_GE(value, 0);
  }
  pack.movers[0].mesh.positions.assign(pack.movers[0].mesh.positions.size(), Vec3(0));
  EXPECT_TRUE(draw(pack, camera, 24, 16, options_of()).finite());
  pack.lightmaps[1] = page_of(32, [](std::uint32_t, std::uint32_t) { return Vec3(0); });
  EXPECT_TRUE(draw(pack, camera, 24, 16, options_of(1)).finite());
}

HemisphereMap slanted_map() {
  LiveLight light;
  light.position = {0.3f, 1.5f, -0.2f};
  light.normal = glm::normalize(Vec3(0.2f, -1, 0.4f));
  return hemisphere_of(light, {Vec3(-4), Vec3(4)});
}

TEST(HemisphereMaps, RaysArePlacesAndHeightsAreDepths) {
  const HemisphereMap map = slanted_map();
  float before = -1;
  for (const Vec2& place : {Vec2(0, 0), Vec2(0.3f, -0.5f), Vec2(-0.9f, 0.8f), Vec2(0.99f, 0.1f)})
    for (const float height : {0.5f, 1.0f, 3.0f}) {
      const Vec3 local = map.local(map.from + height * hemisphere_ray(map, place));
      EXPECT_NEAR(height_of(local), height, 1e-5f);
      EXPECT_LT(glm::length(hemisphere_place(local) - place), 1e-5f);
      for (int face = 0; face < kHemisphereFaces; ++face) {
        const Vec2 sign = face_signs(face);
        if (local.x * sign.x <= 0 || local.y * sign.y <= 0) continue;
        const Vec4 clip = clip_from_pack(map, face) * Vec4(map.from + height * hemisphere_ray(map, place), 1);
        EXPECT_LT(glm::length(Vec2(clip) / clip.w - place), 1e-4f);
        EXPECT_NEAR(0.5f + 0.5f * clip.z / clip.w, hemisphere_depth(map, height), 1e-5f);
      }
      if (height == 0.5f) before = -1;
      EXPECT_GT(hemisphere_depth(map, height), before);
      before = hemisphere_depth(map, height);
    }
}

TEST(HemisphereMaps, PartsHoldTheirBoxes) {
  const HemisphereMap map = slanted_map();
  const Bounds box{{-0.4f, -1, -0.5f}, {0.9f, -0.3f, 0.6f}};
  const auto part = part_of_box(map, box);
  ASSERT_TRUE(part);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 u(i % 10, i / 10 % 10, i / 100);
    const Vec3 local = map.local(glm::mix(box.lower, box.upper, u / 9.0f));
    const Vec2 place = hemisphere_place(local);
    EXPECT_LE(part->lower.x, place.x + 1e-5f);
    EXPECT_LE(part->lower.y, place.y + 1e-5f);
    EXPECT_GE(part->upper.x, place.x - 1e-5f);
    EXPECT_GE(part->upper.y, place.y - 1e-5f);
    EXPECT_LE(part->height, height_of(local) + 1e-5f);
  }
  EXPECT_FALSE(part_of_box(map, {{-1, 1, -1}, {1, 2, 1}})) << "it goes behind the light";
}

TEST(HemisphereMaps, OfFarLightsHoldTheirBounds) {
  LiveLight sky;
  sky.position = {0, 300, 100};
  const Bounds bounds{Vec3(-4), Vec3(4)};
  const HemisphereMap map = hemisphere_of(sky, bounds);
  const auto part = part_of_box(map, bounds);
  ASSERT_TRUE(part);
  EXPECT_GE(part->lower.x, -1);
  EXPECT_LE(part->upper.y, 1);
  EXPECT_GT(part->upper.x - part->lower.x, 0.8f) << "and little else";
}

}  // namespace
}  // namespace oriel
