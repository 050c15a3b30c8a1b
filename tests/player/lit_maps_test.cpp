// Maps of reflectors follow lamps that are switched, pixel by pixel.
#include <thread>

#include "formats/query/group_light.h"
#include "formats/query/seen_places.h"
#include "tests/player/curved_scene.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {

using namespace testing;

constexpr float kWall = 3, kPanel = 2.5f;                            // z
const Vec3 kLight[] = {{300, 200, 100}, {30, 40, 80}};               // lux, on the left wall and on the right one
const Vec3 kColor[] = {{0.5f, 0.25f, 0.75f}, {0.75f, 0.5f, 0.25f}};  // reflectance
const Vec3 kShine(20, 40, 10), kSky(5, 6, 7);                        // cd/m²

// Metal that shows two walls, each lit by a group of its own, a panel of the first group before the left one, and the
// sky above them.
Seen seen(const Vec2& on_plane, const Vec3& direction) {
  const Vec2 panel = on_plane + Vec2(direction) * (kPanel / direction.z);
  if (panel.x > -1.5f && panel.x < -0.5f && std::abs(panel.y) < 0.4f) return {kShine, kPanel};
  const Vec2 wall = on_plane + Vec2(direction) * (kWall / direction.z);
  if (wall.y > 1) return {kSky, std::numeric_limits<float>::infinity()};
  const int side = wall.x < 0 ? 0 : 1;
  return {kColor[side] * kLight[side] / kPi, kWall};
}

Pack two_walls() {
  Pack pack;
  pack.materials.resize(4);
  pack.materials[0].metallic = 1, pack.materials[0].roughness = 0, pack.materials[0].fresnel_map = 0;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(1)));
  for (std::uint32_t side = 0; side < 2; ++side) pack.materials[1 + side].base_color = kColor[side];
  pack.materials[3].emission = kShine;
  pack.sky = kSky;
  add_mirror(pack, {{0, 0, -1}, {0.3f, 0.2f, -1}}, 256, seen);
  add_pixel_meshes(pack);
  for (std::uint32_t side = 0; side < 2; ++side) {
    add_quad(pack, {side == 0 ? 0.0f : 8.0f, -8, kWall}, {-8, 0, 0}, {0, 9, 0}, 1 + side, static_cast<int>(side));
    pack.lightmaps.push_back(flat_page(kLight[side]));
  }
  add_quad(pack, {-0.5f, -0.4f, kPanel}, {-1, 0, 0}, {0, 0.8f, 0}, 3, -1);
  std::vector<std::vector<LightmapPage>> light(3);
  pack.light_groups.resize(3);  // left, right, sky
  for (std::uint32_t g = 0; g < 3; ++g) {
    for (std::uint32_t side = 0; side < 2; ++side) light[g].push_back(flat_page(side == g ? kLight[side] : Vec3(0)));
    pack.light_groups[g].name = std::to_string(g);
    pack.light_groups[g].reflectors = {Vec3(0.25f)};
  }
  for (std::uint32_t p = 0; p < 2; ++p) pack.page_groups.push_back(groups_of_page(pack.lightmaps[p], p, light));
  pack.light_groups[0].materials = {3};
  pack.light_groups[2].sky = true;
  return pack;
}

Camera camera_of_map() {
  return {"c", {0.1f, 0.1f, 1.2f}, {0, 0, -1}, {0, 1, 0}, 1.2f, 0};
}

enum class What { kLeft, kRight, kPanelSeen, kSkySeen, kEdge };

// What a pixel of the mirror shows, as the rays beside its own do too.
What shown(int x, int y, int width, int height) {
  const View view = make_view(camera_of_map(), width, height, {});
  const auto at = [&](float u, float v) {
    const Vec2 ndc((static_cast<float>(x) + u) / static_cast<float>(width) * 2 - 1,
                   1 - (static_cast<float>(y) + v) / static_cast<float>(height) * 2);
    Vec3 direction = glm::transpose(Mat3(view.view_from_pack)) * Vec3(ndc * view.tangents, -1);
    const Vec2 on_plane = Vec2(camera_of_map().eye) + Vec2(direction) * (camera_of_map().eye.z / -direction.z);
    if (std::abs(on_plane.x) > 0.98f || std::abs(on_plane.y) > 0.98f) return What::kEdge;
    direction.z = -direction.z;
    const Seen s = seen(on_plane, direction);
    const Vec2 wall = on_plane + Vec2(direction) * (kWall / direction.z);
    if (!std::isfinite(s.z))
      return wall.y > 1.6f ? What::kSkySeen : What::kEdge;  // eyes differ about it beside the wall
    if (s.z == kPanel) return What::kPanelSeen;
    return wall.y > 0.4f ? What::kEdge : wall.x < 0 ? What::kLeft : What::kRight;
  };
  const What middle = at(0.5f, 0.5f);
  for (const Vec2& beside : {Vec2(-2, -2), Vec2(3, -2), Vec2(-2, 3), Vec2(3, 3)})
    if (at(beside.x, beside.y) != middle) return What::kEdge;
  return middle;
}

class LightsInMaps : public FrameTest {
 protected:
  static constexpr int kWidth = 96, kHeight = 72;
  // All pixels of the mirror, by what they show, are times these what they were.
  void expect(const Picture& picture, const std::array<Vec3, 4>& wanted) {
    std::array<int, 4> count{};
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const What what = shown(x, y, kWidth, kHeight);
        if (what == What::kEdge) continue;
        const auto w = static_cast<std::size_t>(what);
        ++count[w];
        const Vec3 is = picture.at(x, y);
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(is[c], wanted[w][c], 0x1p-8f * max_component(wanted[w]) + 1e-3f) << x << " " << y << " " << w;
      }
    for (const int pixels : count) EXPECT_GT(pixels, 20);
  }
  static std::array<Vec3, 4> light(const Vec3& left, const Vec3& right, const Vec3& sky) {
    return {left * kColor[0] * kLight[0] / kPi, right * kColor[1] * kLight[1] / kPi, left * kShine, sky * kSky};
  }
  Picture draw(GpuScene& scene, const FrameOptions& options) {
    const auto stats = renderer_->render(scene, make_view(camera_of_map(), kWidth, kHeight, scene.bounds()), options);
    EXPECT_TRUE(stats) << stats.error().text();
    return {kWidth, kHeight, renderer_->read_light(), {}};
  }
  // Once nothing is on its way.
  Picture settle(GpuScene& scene, const FrameOptions& options) {
    for (int i = 0; i < 2000; ++i) {
      EXPECT_TRUE(scene.load_images(make_view(camera_of_map(), kWidth, kHeight, scene.bounds())));
      EXPECT_TRUE(scene.advance(std::chrono::milliseconds(1)).empty());
      const Picture picture = draw(scene, options);
      EXPECT_FALSE(scene.has_live_news()) << "a frame shows all that has come";
      const LoadingState state = scene.images().state();
      if (!state.busy && !state.following) return picture;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << "still on its way";
    return {};
  }
};

TEST_F(LightsInMaps, EachPixelFollowsWhatItShows) {
  const Pack pack = two_walls();
  FrameOptions options;
  auto scene = GpuScene::create(pack, device_);
  ASSERT_TRUE(scene) << scene.error().text();
  const Picture baked = draw(**scene, options);
  expect(baked, light(Vec3(1), Vec3(1), Vec3(1)));
  options.lights = {Vec3(0), Vec3(1), Vec3(1)};
  const Picture right = draw(**scene, options);
  expect(right, light(Vec3(0), Vec3(1), Vec3(1)));
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const What what = shown(x, y, kWidth, kHeight);
      if (what != What::kRight && what != What::kSkySeen) continue;
      ASSERT_EQ(right.at(x, y), baked.at(x, y)) << "what stays the same stays to the bit";
    }
  options.lights = {Vec3(0.5f, 1, 2), Vec3(0.25f), Vec3(0, 3, 1)};
  expect(draw(**scene, options), light(Vec3(0.5f, 1, 2), Vec3(0.25f), Vec3(0, 3, 1)));
  options.lights = {Vec3(0), Vec3(0), Vec3(0)};
  expect(draw(**scene, options), light(Vec3(0), Vec3(0), Vec3(0)));
  options.lights = {Vec3(1), Vec3(1), Vec3(1)};
  EXPECT_EQ(draw(**scene, options).rgb, baked.rgb);
}

// In the background, with room for old and new ones at a time, and without.
TEST_F(LightsInMaps, ThoseThatComeLaterAreTheSame) {
  const Pack pack = two_walls();
  FrameOptions options;
  const std::vector<Vec3> lights{Vec3(2), Vec3(0.5f), Vec3(0)};
  options.lights = lights;
  const Picture wanted = FrameTest::draw(pack, camera_of_map(), kWidth, kHeight, options);
  std::uint64_t limit = kNoLimit;
  for (int run = 0; run < 2; ++run) {
    auto scene = GpuScene::create(pack, device_, {true, limit});
    ASSERT_TRUE(scene) << scene.error().text();
    options.lights = {};
    const Picture baked = settle(**scene, options);
    limit = (*scene)->images().state().used;
    options.lights = lights;
    EXPECT_EQ(settle(**scene, options).rgb, wanted.rgb);
    EXPECT_EQ((*scene)->images().state().used, limit);
    options.lights = {};
    EXPECT_EQ(settle(**scene, options).rgb, baked.rgb);
    EXPECT_EQ((*scene)->images().state().used, limit);
  }
}

// The panel goes up and to the right: the mirrored scene shows it there, as maps would not.
TEST_F(LightsInMaps, ALampThatMovesIsShownWhereItIs) {
  const Pack pack = two_walls();
  FrameOptions options;
  options.lamps.resize(3);
  options.lamps[0].position = Vec3(1.2f, 0.3f, -0.4f);
  const Picture found = FrameTest::draw(pack, camera_of_map(), kWidth, kHeight, options);
  options.reflections = Reflections::kGeometry;
  EXPECT_EQ(found.rgb, FrameTest::draw(pack, camera_of_map(), kWidth, kHeight, options).rgb);
  options.reflections = Reflections::kChosen;
  auto later = GpuScene::create(pack, device_, {true, kNoLimit});
  ASSERT_TRUE(later) << later.error().text();
  const std::vector<MoverPose> lamps = std::exchange(options.lamps, {});
  const Picture baked = settle(**later, options);
  options.lamps = lamps;
  EXPECT_EQ(settle(**later, options).rgb, found.rgb);
  options.lamps = {};
  EXPECT_EQ(settle(**later, options).rgb, baked.rgb);
}

// A ball in a room of which one group lights the wall at +x, and another all else.
TEST_F(LightsInMaps, SurroundMapsFollowToo) {
  const test::Ball ball{{0.31731f, 0.91347f, 0.20991f}};  // no pixel shows an edge
  const auto at_upper_x = [](const Vec3& p) { return p.x > test::kUpper.x - 1e-6f; };
  const auto pack_of = [&](const std::function<Vec3(const Vec3&)>& light) {
    Pack pack = test::ball_pack(ball, test::room_map(ball.centre, 256, light), 96, 48);
    pack.materials.emplace_back();
    const Vec3 size = test::kUpper - test::kLower;
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 2; ++side) {
        Vec3 corner = test::kLower, right(0), up(0);
        right[(axis + 1) % 3] = size[(axis + 1) % 3], up[(axis + 2) % 3] = size[(axis + 2) % 3];
        if (side == 1) corner[axis] = test::kUpper[axis], std::swap(right, up);
        add_quad(pack, corner, right, up, 1, axis == 0 && side == 1 ? 1 : 0);
      }
    for (std::uint32_t p = 0; p < 2; ++p) {
      pack.lightmaps.push_back(flat_page(Vec3(1000)));
      std::vector<std::vector<LightmapPage>> of_groups(2);
      for (std::uint32_t g = 0; g < 2; ++g)
        for (std::uint32_t page = 0; page < 2; ++page)
          of_groups[g].push_back(flat_page(Vec3(g == page ? 1000.0f : 0.0f)));
      pack.page_groups.push_back(groups_of_page(pack.lightmaps[p], p, of_groups));
    }
    pack.light_groups.resize(2);
    for (std::uint32_t g = 0; g < 2; ++g)
      pack.light_groups[g].name = std::to_string(g), pack.light_groups[g].surrounds = {Vec3(0.5f)};
    return pack;
  };
  const Camera camera_of_map = test::looking_at({0.9f, 1.5f, 1.7f}, ball.centre);
  FrameOptions options;
  options.show = Show::kMKR;
  const Picture dark =
      FrameTest::draw(pack_of([&](const Vec3& p) { return at_upper_x(p) ? Vec3(0) : test::wall_light(p); }),
                      camera_of_map, 120, 90, options);
  const Pack pack = pack_of(test::wall_light);
  const Picture baked = FrameTest::draw(pack, camera_of_map, 120, 90, options);
  options.lights = {Vec3(1), Vec3(0)};
  const Picture followed = FrameTest::draw(pack, camera_of_map, 120, 90, options);
  EXPECT_NE(baked.rgb, dark.rgb) << "else nothing is tested";
  for (std::size_t i = 0; i < dark.rgb.size(); ++i)
    ASSERT_NEAR(followed.rgb[i], dark.rgb[i], 0x1p-7f * dark.rgb[i] + 0.05f);
  options.lights = {Vec3(1), Vec3(1)};
  EXPECT_EQ(FrameTest::draw(pack, camera_of_map, 120, 90, options).rgb, baked.rgb);
}

// From a plane at z = 0 half of the pixels see a mirror at z = 2, and in it a wall at z = -1; as far away as its image
// there is another wall behind the mirror. The others see a wall at z = 2 through a pane.
TEST(SeenPlacesOfMaps, AreThoseOfImagesAndBehindPanes) {
  constexpr float kEye = 0.5f;
  Pack pack;
  pack.materials.resize(3);
  pack.materials[0].metallic = 1, pack.materials[0].roughness = 0, pack.materials[0].fresnel_map = 0;
  pack.materials[2].transmission = 0.8f;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.9f)));
  Reflector own;
  own.lower = Vec2(-0.1f), own.upper = Vec2(0.1f);
  Reflector facing;  // x and y of it are -x and y
  facing.pack_from_reflector = Mat4(Vec4(-1, 0, 0, 0), Vec4(0, 1, 0, 0), Vec4(0, 0, -1, 0), Vec4(0, 0, 2, 1));
  facing.lower = Vec2(-9, -9), facing.upper = Vec2(0, 9);
  pack.reflectors = {own, facing};
  const Vec3 left(-9, 0, 0), right(9, 0, 0), up(0, 18, 0);
  add_quad(pack, {9, -9, 2}, left, up, 0, 3);            // the mirror
  add_quad(pack, {-9, -9, -1}, 2.0f * right, up, 1, 0);  // what it shows
  add_quad(pack, {9, -9, 5}, 2.0f * left, up, 1, 1);     // behind it
  add_quad(pack, {0, -9, 2}, left, up, 1, 2);            // beside it
  add_quad(pack, {0, -9, 2 - 1e-4f}, left, up, 2, 4);    // the pane
  RadianceMap map;
  map.eye = {0, 0, -kEye}, map.lower = own.lower, map.upper = own.upper;
  map.width = map.height = 16;
  for (std::uint32_t i = 0; i < 256; ++i) {
    map.radiance.emplace_back(1), map.valid.push_back(i == 0 ? 0 : i == 1 ? 2 : 1);
    map.disparity.push_back(i % 16 < 8 ? kEye / (kEye + 2) : kEye / (kEye + 5));
  }
  const SeenPlaces places(pack.mesh, pack.materials, pack.reflectors, pack.fresnel_maps);
  const SeenPixels pixels = places.of(map, own);
  const std::vector<SeenPlace>& seen = pixels.places;
  EXPECT_EQ(std::pair(seen[0].page, seen[0].material), std::pair(SeenPlace::kNone, SeenPlace::kNone));
  EXPECT_EQ(std::pair(seen[1].page, seen[1].material), std::pair(SeenPlace::kNone, SeenPlace::kSky));
  for (std::uint32_t i = 2; i < 256; ++i) {
    const bool mirrored = i % 16 >= 8;
    ASSERT_EQ(seen[i].page, mirrored ? 0 : 2) << i;
    ASSERT_EQ(seen[i].material, 1);
    const Vec2 way = glm::mix(map.lower, map.upper, (Vec2(i % 16, i / 16) + 0.5f) / 16.0f) / kEye;
    const Vec2 at = way * (kEye + (mirrored ? 5.0f : 2.0f));
    EXPECT_NEAR(seen[i].uv().y, (at.y + 9) / 18, 1e-4f);
    EXPECT_NEAR(seen[i].uv().x, mirrored ? (at.x + 9) / 18 : -at.x / 9, 1e-4f);
  }
}

}  // namespace
}  // namespace oriel
