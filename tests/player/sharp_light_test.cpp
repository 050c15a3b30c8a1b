// Light of points and suns by the pixel, against closed forms.
#include "formats/core/half.h"
#include "formats/query/camera.h"
#include "player/scene/check.h"
#include "tests/player/sharp_floor.h"

namespace oriel {
namespace {

using namespace testing;

Vec3 open_light(const Vec3& from, const Vec3& p) {
  const Vec3 to = from - p;
  return kCandela * (to.y / glm::length(to) / length2(to));
}

// The board's shadow on the floor, x and z.
struct BoardShadow {
  Vec2 lower, upper;
  explicit BoardShadow(const Vec3& from) {
    const Vec2 lamp(from.x, from.z);
    const float grows = from.y / (from.y - kBoardHeight);
    lower = lamp + (Vec2(kWest, kNorth) - lamp) * grows, upper = lamp + (Vec2(kEast, kSouth) - lamp) * grows;
  }
  // Metres inside; negative: outside.
  float depth(const Vec3& p) const {
    const Vec2 at(p.x, p.z), in = glm::min(at - lower, upper - at);
    return std::min(in.x, in.y);
  }
  // Of a square about the place.
  float share(const Vec3& p, float side) const {
    const Vec2 at(p.x, p.z);
    const Vec2 in = glm::min(at + side / 2, upper) - glm::max(at - side / 2, lower);
    const Vec2 of = glm::clamp(in / side, Vec2(0), Vec2(1));
    return of.x * of.y;
  }
};

void expect_close(const Vec3& found, const Vec3& wanted, float relative) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], relative * wanted[c] + 1e-4f) << c;
}

// Of a picture from above: lit pixels, dark ones, and how much of the shadow's edges' pixels is lit.
void expect_point_light(const Picture& picture, const FloorFrame& frame, const Vec3& from,
                        const Vec3& factor = Vec3(1)) {
  const BoardShadow shadow(from);
  int lit = 0, dark = 0;
  double sum = 0, wanted = 0;
  for (int y = 0; y < frame.side; ++y)
    for (int x = 0; x < frame.side; ++x) {
      const Vec3 p = frame.at(x, y), open = factor * open_light(from, p) * (kFloorAlbedo / kPi);
      const float share = shadow.share(p, frame.pixel()), found = 1 - picture.at(x, y).r / open.r;
      sum += double{found}, wanted += double{share};
      if (share <= 0) {
        expect_close(picture.at(x, y), open, 0.01f);
        ++lit;
      } else if (share >= 1) {
        EXPECT_EQ(picture.at(x, y), Vec3(0)) << x << ", " << y;
        ++dark;
      } else {
        EXPECT_NEAR(found, share, 0.25f) << x << ", " << y;
      }
    }
  EXPECT_GT(lit, 100);
  EXPECT_GT(dark, 100);
  EXPECT_NEAR(sum, wanted, 0.01 * wanted);
}

using SharpLightTest = FrameTest;

TEST_F(SharpLightTest, APointsLightAndShadowAreExact) {
  const FloorFrame frame{97, 1.5f};
  for (const Vec3& from : {kLampAbove, Vec3(0, 2, 0), Vec3(-0.7f, 1.5f, 0.4f), Vec3(0.02f, 3, 0.013f)}) {
    SharpLamp lamp = point_above();
    lamp.position = from;
    const Picture picture = draw(floor_below_board(lamp), down_from({0, 1, 0}, frame.half), frame.side, frame.side);
    expect_point_light(picture, frame, from);
  }
}

TEST_F(SharpLightTest, IsAddedToTheRestOfTheLightmap) {
  Pack pack = floor_below_board();
  for (Vec3& e : pack.lightmaps[0].irradiance) e += Vec3(10, 20, 30);
  pack.lightmaps[0].irradiance[3] = Vec3(5);  // less than its sharp light by noise
  const Picture picture = draw(pack, down_from({0, 1, 0}, 1.5f), 97, 97);
  expect_close(picture.at(48, 48), Vec3(10, 20, 30) * (kFloorAlbedo / kPi), 1e-3f);
  const FloorFrame frame{97, 1.5f};
  expect_close(picture.at(80, 80), (Vec3(10, 20, 30) + open_light(kLampAbove, frame.at(80, 80))) * (kFloorAlbedo / kPi),
               0.01f);
}

TEST_F(SharpLightTest, ASpotsConeFadesAsItsAngles) {
  SharpLamp spot = point_above();
  spot.direction = glm::normalize(Vec3(0.1f, -1, 0.2f));
  spot.cos_outer = std::cos(0.5f), spot.inverse_falloff = 1 / (std::cos(0.2f) - std::cos(0.5f));
  Pack pack = dark_floor();
  pack.sharp_light.lamps = {spot};
  add_record(pack, {SharpShine{0, false, 0}.code()});
  const FloorFrame frame{65, 1.5f};
  const Picture picture = draw(pack, down_from({0, 1, 0}, frame.half), frame.side, frame.side);
  for (int y = 0; y < frame.side; ++y)
    for (int x = 0; x < frame.side; ++x) {
      const Vec3 p = frame.at(x, y);
      const float cosine = glm::dot(glm::normalize(p - kLampAbove), spot.direction);
      const float t = std::clamp((cosine - spot.cos_outer) * spot.inverse_falloff, 0.0f, 1.0f);
      expect_close(picture.at(x, y), t * t * open_light(kLampAbove, p) * (kFloorAlbedo / kPi), 0.01f);
    }
}

TEST_F(SharpLightTest, AProfileIsBilinearBetweenItsAngles) {
  SharpLamp lamp = point_above();
  lamp.direction = glm::normalize(Vec3(0.2f, -1, 0.1f)), lamp.profile = 1;
  lamp.right = glm::normalize(Vec3(1, 0.2f, 0)), lamp.over = glm::cross(lamp.direction, lamp.right);
  Pack pack = dark_floor();
  pack.sharp_light.lamps = {lamp};
  const std::vector<float> candela{1, 2, 3, 2, 4, 0, 4, 8, 1, 1, 2, 2};
  pack.sharp_light.profiles = {{0, 90, 2, 1, {9, 9}}, {10, 50, 3, 4, candela}};
  add_record(pack, {SharpShine{0, false, 0}.code()});
  const Picture picture = draw(pack, down_from({0, 1, 0}, 1.9f), 65, 65);
  for (int i = 0; i < 65 * 65; ++i) {
    const Vec3 p = FloorFrame{65, 1.9f}.at(i % 65, i / 65), way = glm::normalize(p - kLampAbove);
    const float down = (glm::degrees(std::acos(glm::dot(way, lamp.direction))) - 10) / 20,
                around = std::atan2(glm::dot(way, lamp.over), glm::dot(way, lamp.right)) / (kPi / 2);
    if (std::min(std::abs(down), std::abs(down - 2)) < 1e-3f) continue;
    const auto row = static_cast<std::size_t>(down < 1 ? 0 : 4), column = static_cast<std::size_t>(around + 4) % 4;
    const float t = down < 1 ? down : down - 1, s = around - std::floor(around);
    const float one = glm::mix(candela[row + column], candela[row + 4 + column], t),
                next = glm::mix(candela[row + (column + 1) % 4], candela[row + 4 + (column + 1) % 4], t);
    const Vec3 lit = glm::mix(one, next, s) * open_light(kLampAbove, p) * (kFloorAlbedo / kPi);
    expect_close(picture.at(i % 65, i / 65), down > 0 && down < 2 ? lit : Vec3(0), 0.01f);
  }
}

struct BoardWidth {
  float west, east;
};

// Boards along z above the origin, under a sun: a picture around their edges at x = 0, and where a pixel sees a board's
// edge at x, in radii of the sun from its middle.
struct BoardsInTheSun {
  Vec3 to_sun;
  float radius_rad;
  FloorFrame frame{64, 0};
  Pack pack = dark_floor();

  BoardsInTheSun(const Vec3& towards, float radius, std::initializer_list<BoardWidth> boards)
      : to_sun(towards), radius_rad(radius) {
    frame.half = 2.9f * std::tan(radius), frame.middle = Vec2(-to_sun.x, -to_sun.z) / to_sun.y;
    SharpLamp sun;
    sun.sun = true, sun.direction = -to_sun, sun.intensity = kCandela, sun.angular_radius_rad = radius;
    pack.sharp_light.lamps = {sun};
    std::vector<std::uint32_t> words = {SharpShine{0, false, static_cast<std::uint32_t>(2 * boards.size())}.code()};
    for (const auto& [west, east] : boards) {
      const auto first = static_cast<std::uint32_t>(pack.sharp_light.triangles.size());
      add_board(pack.sharp_light, west, east, -3, 2.5f + 0.1f * static_cast<float>(first));
      words.push_back(edges(3) | first), words.push_back(edges(6) | (first + 1));
    }
    add_record(pack, words);
  }
  Camera camera() const { return down_from({frame.middle.x, 0.5f, frame.middle.y}, frame.half); }
  float offset(float x, int column, int row) const {
    const Vec3 inwards = glm::normalize(glm::cross(Vec3(x, kBoardHeight, 0) - frame.at(column, row), Vec3(0, 0, 1)));
    return -glm::dot(inwards, to_sun) / std::tan(radius_rad);
  }
  // How far what shows is from that, at most. open: how much of the sun, by column and row.
  template <class Open>
  float most_off(const Picture& picture, const Open& open) const {
    float most = 0;
    for (int y = 0; y < frame.side; ++y)
      for (int x = 0; x < frame.side; ++x) {
        const float found = picture.at(x, y).r / (kCandela.r * to_sun.y * kFloorAlbedo / kPi);
        most = std::max(most, std::abs(found - open(x, y)));
      }
    return most;
  }
};

// Of a disk of radius 1 beyond a straight edge so far from its middle.
float disk_beyond(float off) {
  const float u = std::clamp(off, -1.0f, 1.0f);
  return 0.5f + (u * std::sqrt(1 - u * u) + std::asin(u)) / kPi;
}

TEST_F(SharpLightTest, ASunsPenumbraIsThatOfADisk) {
  for (const Vec3& to_sun : {glm::normalize(Vec3(0, 1, 0)), glm::normalize(Vec3(0.5f, 1, 0.3f))})
    for (const float degrees : {0.05f, 0.533f, 5.0f}) {
      const BoardsInTheSun boards(to_sun, degrees * kPi / 360, {{0, 3}});
      const Picture picture = draw(boards.pack, boards.camera(), 64, 64);
      EXPECT_LT(boards.most_off(picture, [&](int x, int y) { return disk_beyond(boards.offset(0, x, y)); }), 0.05f)
          << degrees;
    }
}

// Boards that cover the same twice, that meet without common corners, and one narrower than the sun.
TEST_F(SharpLightTest, WhatCoversASunIsTheUnionOfTriangles) {
  const float radius = 0.5f * kPi / 180, bar = 0.5f * std::tan(radius);
  const Vec3 to_sun = glm::normalize(Vec3(0.2f, 1, 0.3f));
  const BoardsInTheSun twice(to_sun, radius, {{0, 3}, {0, 2}}), meeting(to_sun, radius, {{-3, 0}, {0, 3}}),
      thin(to_sun, radius, {{0, bar}});
  EXPECT_LT(twice.most_off(draw(twice.pack, twice.camera(), 64, 64),
                           [&](int x, int y) { return disk_beyond(twice.offset(0, x, y)); }),
            0.05f);
  EXPECT_LT(meeting.most_off(draw(meeting.pack, meeting.camera(), 64, 64), [](int, int) { return 0.0f; }), 0.03f);
  EXPECT_LT(thin.most_off(draw(thin.pack, thin.camera(), 64, 64),
                          [&](int x, int y) {
                            return 1 - disk_beyond(thin.offset(bar, x, y)) + disk_beyond(thin.offset(0, x, y));
                          }),
            0.05f);
}

TEST_F(SharpLightTest, NothingLeaksThroughTheMiddleOfASunsShadow) {
  SharpLamp sun;
  sun.sun = true, sun.direction = {0, -1, 0}, sun.intensity = kCandela, sun.angular_radius_rad = kPi / 180;
  const Camera camera{"c", {0.3f, 0.7f, 0.6f}, {-0.2f, -0.7f, -0.6f}};
  const Picture picture = draw(floor_below_board(sun), camera, 97, 97);
  int dark = 0;
  for (int y = 0; y < 97; ++y)
    for (int x = 0; x < 97; ++x) {
      const PixelRay ray = pixel_ray(camera, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 97, 97);
      const Vec3 p = ray.origin - ray.direction * (ray.origin.y / ray.direction.y);
      const Vec2 in = glm::min(Vec2(p.x - kWest, p.z - kNorth), Vec2(kEast - p.x, kSouth - p.z));
      if (ray.direction.y >= 0 || std::min(in.x, in.y) < 0.04f) continue;
      EXPECT_EQ(picture.at(x, y), Vec3(0)) << x << ", " << y;
      ++dark;
    }
  EXPECT_GT(dark, 300);
  EXPECT_GT(picture.at(48, 94).r, 0);
}

// The foot of a wall without thickness, where the floor ends, with the sun behind it.
TEST_F(SharpLightTest, NothingLeaksBelowAWall) {
  SharpLamp sun;
  sun.sun = true, sun.direction = -glm::normalize(Vec3(0.3f, 1, -2)), sun.intensity = kCandela;
  Pack pack = dark_floor();
  pack.sharp_light.lamps = {sun};
  const Vec3 a(-6, 0, -2), b(6, 0, -2), c(6, 4, -2), d(-6, 4, -2);
  add_quad(pack, a, b - a, d - a, 0, -1);
  pack.sharp_light.triangles = {{a, b, c}, {a, c, d}};
  FrameOptions options;
  options.samples = 4;
  const Camera camera = look_at({0.6f, 1.3f, 1.6f}, {-0.1f, 0, -2}, 0.6f);
  add_record(pack, {SharpShine{0, false, 2}.code(), edges(2) | 0, edges(6) | 1});
  const Picture picture = draw(pack, camera, 97, 97, options);
  EXPECT_EQ(*std::ranges::max_element(picture.rgb), 0);
}

TEST_F(SharpLightTest, PartsOfATexelHaveRecordsOfTheirOwn) {
  Pack pack = dark_floor();
  pack.sharp_light.lamps = {point_above()};
  const std::uint32_t lit = 11, dark = 13;
  pack.sharp_light.words = {
      0, kSharpSplit, dark, lit, 6, lit, kSharpSplit, lit, lit, lit, dark, 1, SharpShine{0, false, 0}.code(), 0};
  const FloorFrame frame{64, 2};  // 16 pixels a texel
  const Picture picture = draw(pack, down_from({0, 1, 0}, frame.half), frame.side, frame.side);
  for (int y = 0; y < frame.side; ++y)
    for (int x = 0; x < frame.side; ++x) {
      const int u = y % 16, v = x % 16;
      const bool is_dark = (u < 8 && v < 8) || (u >= 4 && u < 8 && v >= 12);
      const Vec3 open = open_light(kLampAbove, frame.at(x, y)) * (kFloorAlbedo / kPi);
      expect_close(picture.at(x, y), is_dark ? Vec3(0) : open, 0.01f);
    }
}

TEST_F(SharpLightTest, FollowsItsTintAndItsGroup) {
  const Vec3 tint(1, 0.5f, 0.25f), factor(0.5f, 0, 3);
  Pack pack = dark_floor();
  pack.sharp_light.lamps = {point_above()};
  pack.sharp_light.lamps[0].light_group = 0;
  pack.light_groups.resize(1);
  pack.light_groups[0].name = "lamp";
  add_board(pack.sharp_light, kWest, kEast, kNorth, kSouth);
  add_record(pack, {SharpShine{0, true, 2}.code(), rgb9e5_from_rgb(tint), edges(3) | 0, edges(6) | 1});
  const FloorFrame frame{97, 1.5f};
  const Camera camera = down_from({0, 1, 0}, frame.half);
  expect_point_light(draw(pack, camera, frame.side, frame.side), frame, kLampAbove, tint);
  const Picture picture = draw(pack, camera, frame.side, frame.side, {.lights = {factor}});
  expect_close(picture.at(90, 90), factor * tint * open_light(kLampAbove, frame.at(90, 90)) * (kFloorAlbedo / kPi),
               0.01f);
}

// What a mirror shows is what an eye behind it sees.
TEST_F(SharpLightTest, IsSeenInAMirror) {
  Pack pack = floor_below_board();
  const Camera behind = look_at({0, 1, -3.6f}, {0, 0, 0}, 0.6f), before = look_at({0, 1, -0.4f}, {0, 0, -4}, 0.6f);
  const Picture direct = draw(pack, behind, 64, 64);
  pack.materials.resize(2);
  pack.materials[1].metallic = 1, pack.materials[1].fresnel_map = 0, pack.materials[1].roughness = 0;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(1)));
  add_bare_mirror(pack, {-2, 0, -2}, {4, 0, 0}, {0, 2, 0}, 1);
  const Picture mirrored = draw(pack, before, 64, 64);
  int same = 0, dark = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const float wanted = direct.at(63 - x, y).r, found = mirrored.at(x, y).r;
      same += std::abs(found - wanted) <= 0.02f * wanted ? 1 : 0, dark += wanted == 0 ? 1 : 0;
    }
  EXPECT_GT(dark, 100);
  EXPECT_LT(dark, 64 * 64 / 2);
  EXPECT_GT(same, 64 * 64 * 95 / 100);
}

TEST_F(SharpLightTest, IsReceivedByTheMappedNormal) {
  Pack pack = dark_floor();
  pack.sharp_light.lamps = {point_above()};
  add_record(pack, {SharpShine{0, false, 0}.code()});
  pack.materials[0].normal_texture = 0;
  pack.normal_textures.push_back({"n", 1, 1, Wrap::kRepeat, Wrap::kRepeat, false, {200, 128, 220, 255}});
  pack.mesh.normal_uvs = pack.mesh.uvs;
  pack.mesh.tangents.assign(4, Vec4(1, 0, 0, 1));
  const Vec3 n = glm::normalize(2.0f * Vec3(200, 220, 128) / 255.0f - 1.0f);
  for (const bool directional : {false, true}) {
    if (directional) pack.lightmaps[0].direction.assign(16, Vec3(-0.6f, 0.8f, 0));  // of light that is not there
    const Picture picture = draw(pack, down_from({0, 1, 0}, 1.5f), 33, 33);
    const Vec3 p = FloorFrame{33, 1.5f}.at(20, 16), to = glm::normalize(kLampAbove - p);
    expect_close(picture.at(20, 16), open_light(kLampAbove, p) / to.y * (glm::dot(n, to) * kFloorAlbedo / kPi), 0.01f);
  }
}

TEST_F(SharpLightTest, StaysWhereThePageIsCoarse) {
  const Pack pack = floor_below_board();
  const Camera camera = down_from({0, 1, 0}, 1.5f);
  LoadingOptions least;
  least.limit = 1;
  const auto scene = GpuScene::create(pack, device_, least);
  ASSERT_TRUE(scene);
  ASSERT_TRUE(renderer_->render(**scene, make_view(camera, 97, 97, (*scene)->bounds()), {}));
  const Picture whole = draw(pack, camera, 97, 97);
  EXPECT_GT(whole.at(4, 4).r, 0);
  EXPECT_EQ(renderer_->read_light(), whole.rgb);
}

// The lamp of a group, and the board where rays of the moved lamp meet it.
Pack movable() {
  Pack pack = floor_below_board();
  constexpr std::uint32_t kFine = 64;
  LightmapPage page = page_of(kFine, [](auto, auto) { return Vec3(50); });
  page.sharp.assign(kFine * kFine, Vec3(30)), page.sharp_at.assign(kFine * kFine, 1);
  pack.lightmaps = {page};
  // Its back, which is not drawn, is above.
  add_quad(pack, {kWest, kBoardHeight, kNorth}, {kEast - kWest, 0, 0}, {0, 0, kSouth - kNorth}, 0, -1);
  BrightLight point;
  point.position = kLampAbove, point.intensity = kCandela;
  pack.light_field.lights = {point};
  pack.sharp_light.lamps[0].light_group = 0;
  pack.light_groups.resize(1);
  pack.light_groups[0].name = "lamp", pack.light_groups[0].bright_lights = {0};
  return pack;
}

TEST_F(SharpLightTest, OfALampThatMovesIsItsLightElsewhere) {
  const Pack pack = movable();
  const FloorFrame frame{48, 1.5f};
  const Camera camera = down_from({0, 0.9f, 0}, frame.half);
  constexpr float kBlur = 0.09f;  // metres: one and a half texels
  const Vec3 rest = Vec3(20) * (kFloorAlbedo / kPi);
  for (const Vec3& by : {Vec3(0.001f, 0, 0), Vec3(-0.6f, 0, 0.3f)})
    for (const float factor : {1.0f, 0.5f}) {
      MoverPose pose;
      pose.position = by;
      const Picture picture = draw(pack, camera, frame.side, frame.side,
                                   {.lights = {Vec3(factor)}, .lamps = {pose}, .live = {{.bounces = 0}}});
      int lit = 0, dark = 0;
      for (int y = 0; y < frame.side; ++y)
        for (int x = 0; x < frame.side; ++x) {
          const Vec3 p = frame.at(x, y), open = factor * open_light(kLampAbove + by, p) * (kFloorAlbedo / kPi);
          const float inside = BoardShadow(kLampAbove + by).depth(p);
          if (std::abs(inside) < kBlur) continue;
          expect_close(picture.at(x, y), inside > 0 ? rest : rest + open, 0.02f);
          ++(inside > 0 ? dark : lit);
        }
      EXPECT_GT(lit, 100);
      EXPECT_GT(dark, 100);
    }
}

// Who asks for texels is told of all light.
TEST_F(SharpLightTest, IsInTheTexelsOfLampsAsTheyShine) {
  const auto scene = GpuScene::create(movable(), device_);
  ASSERT_TRUE(scene);
  const Vec3 factors[] = {Vec3(0.5f, 0, 2)};
  ASSERT_TRUE((*scene)->set_lamps(factors, {}, {}));
  const auto page = (*scene)->page(0);
  ASSERT_TRUE(page);
  for (const std::size_t texel : {0u, 64u * 20 + 10}) expect_close((*page)->irradiance[texel], Vec3(35, 20, 80), 0.01f);
}

TEST(CheckDrawable, RefusesSharpLightThatTexturesCannotHold) {
  gpu::Device device;
  device.texture_size = 4096, device.array_layers = 64;
  Pack pack = floor_below_board();
  EXPECT_TRUE(check_drawable(pack, device));
  pack.sharp_light.words.resize(4096 * 4096 + 1);
  EXPECT_FALSE(check_drawable(pack, device));
  pack.sharp_light.words.resize(4);
  device.texture_size = 2048;
  EXPECT_FALSE(check_drawable(pack, device));
}

}  // namespace
}  // namespace oriel
