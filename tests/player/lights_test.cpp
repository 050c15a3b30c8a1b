// Lamps that are switched, in frames.
#include "formats/query/group_light.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {

using namespace testing;

// A wall lit by two groups, and a panel of each that shines.
Pack lit_wall() {
  Pack pack;
  pack.materials.resize(3);
  pack.materials[0].base_color = Vec3(0.5f);
  for (std::uint32_t g = 0; g < 2; ++g) pack.materials[1 + g].emission = g == 0 ? Vec3(20, 10, 5) : Vec3(0, 30, 60);
  add_quad(pack, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 0, 0);
  add_quad(pack, {-1, -1, 0.1f}, {0.5f, 0, 0}, {0, 0.5f, 0}, 1, -1);
  add_quad(pack, {0.5f, -1, 0.1f}, {0.5f, 0, 0}, {0, 0.5f, 0}, 2, -1);
  const Vec3 of_group[] = {{300, 200, 100}, {30, 40, 80}};
  pack.lightmaps = {flat_page(of_group[0] + of_group[1])};
  std::vector<std::vector<LightmapPage>> light;
  for (const Vec3& e : of_group) light.push_back({flat_page(e)});
  pack.page_groups = {groups_of_page(pack.lightmaps[0], 0, light)};
  pack.light_groups.resize(2);
  for (std::uint32_t g = 0; g < 2; ++g)
    pack.light_groups[g].name = std::to_string(g), pack.light_groups[g].materials = {1 + g};
  return pack;
}

Camera camera() {
  return {"c", {0, 0, 2}, {0, 0, -1}, {0, 1, 0}, 1.0f, 0};
}

using LightsTest = FrameTest;

TEST_F(LightsTest, AtOneAreAsBakedToTheBit) {
  const Pack pack = lit_wall();
  Pack plain = pack;
  plain.light_groups.clear(), plain.page_groups.clear();
  const Picture without = draw(plain, camera(), 64, 48);
  EXPECT_EQ(draw(pack, camera(), 64, 48).rgb, without.rgb);
  EXPECT_EQ(draw(pack, camera(), 64, 48, {.lights = {Vec3(1), Vec3(1)}}).rgb, without.rgb);
  EXPECT_EQ(draw(pack, camera(), 64, 48, {.lights = {Vec3(1)}}).rgb, without.rgb);  // of another pack
}

TEST_F(LightsTest, ShowWhatIsLeft) {
  const Pack pack = lit_wall();
  const auto expect = [&](const Vec3& wall, const Vec3& left, const Vec3& right, const std::vector<Vec3>& lights) {
    const Picture picture = draw(pack, camera(), 64, 48, {.lights = lights});
    const auto near = [](const Vec3& is, const Vec3& wanted) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(is[c], wanted[c], 0x1p-7f * wanted[c] + 1e-3f);
    };
    near(picture.at(32, 12), wall * (0.5f / kPi));
    near(picture.at(17, 38), left);
    near(picture.at(46, 38), right);
  };
  expect({330, 240, 180}, {20, 10, 5}, {0, 30, 60}, {});
  expect({30, 40, 80}, {0, 0, 0}, {0, 30, 60}, {Vec3(0), Vec3(1)});
  expect({300, 200, 100}, {20, 10, 5}, {0, 0, 0}, {Vec3(1), Vec3(0)});
  expect({165, 220, 200}, {10, 10, 0}, {0, 15, 150}, {Vec3(0.5f, 1, 0), Vec3(0.5f, 0.5f, 2.5f)});
}

// Nothing but sky is seen; the hours have skies of their own.
TEST_F(LightsTest, TheSkyFollowsTheHour) {
  Pack pack = lit_wall();
  pack.sky = Vec3(50, 60, 70);  // their mean
  for (std::uint32_t g = 0; g < 2; ++g) {
    DayHour hour;
    hour.hour = 9 + 6 * static_cast<float>(g), hour.group = g;
    hour.sky = g == 0 ? Vec3(100) : Vec3(0, 20, 40);
    pack.day.hours.push_back(hour);
  }
  Camera away = camera();
  away.forward = {0, 0, 1};
  for (const float share : {0.0f, 0.25f, 1.0f}) {
    const Picture picture = draw(pack, away, 8, 8, {.lights = {Vec3(2 * (1 - share)), Vec3(2 * share)}});
    const Vec3 wanted = (1 - share) * pack.day.hours[0].sky + share * pack.day.hours[1].sky;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.at(4, 4)[c], wanted[c], 1e-3f * wanted[c] + 1e-3f);
  }
}

// A sky whose red is how far a direction lies towards +X and whose green how far it lies up, straight and in a mirror.
TEST_F(LightsTest, TheSkyIsSeenByDirection) {
  Pack pack = lit_wall();
  pack.sky = Vec3(100, 200, 50);
  pack.sky_map = {64, 32, {}};
  for (std::uint32_t y = 0; y < 32; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      const float turn = 2 * kPi * ((static_cast<float>(x) + 0.5f) / 64 - 0.5f);
      const float polar = kPi * (static_cast<float>(y) + 0.5f) / 32;
      pack.sky_map.texels.emplace_back(1 + std::sin(polar) * std::cos(turn), 1 + std::cos(polar), 1);
    }
  const auto expect = [&](const Vec3& light, const Vec3& direction) {
    EXPECT_NEAR(light.x, 100 * (1 + direction.x), 2);
    EXPECT_NEAR(light.y, 200 * (1 + direction.y), 4);
    EXPECT_NEAR(light.z, 50, 0.5f);
  };
  for (const Vec3& forward : {Vec3(0, 0, 1), Vec3(1, 0, 0.2f), Vec3(-1, 0.7f, 1), Vec3(-1, 0, 0.01f)}) {
    Camera away = camera();
    away.forward = glm::normalize(forward);
    expect(draw(pack, away, 9, 9).at(4, 4), away.forward);
  }
  pack.materials.push_back({});
  pack.materials.back().fresnel_map = 0;
  pack.fresnel_maps = {flat_reflectance(Vec3(1))};
  add_bare_mirror(pack, {-2, -2, 0.5f}, {4, 0, 0}, {0, 4, 0}, 3);
  const Picture picture = draw(pack, camera(), 33, 33);
  const float edge = std::tan(0.5f) * 32 / 33;
  expect(picture.at(16, 16), {0, 0, 1});
  expect(picture.at(32, 0), glm::normalize(Vec3(edge, edge, 1)));
}

}  // namespace
}  // namespace oriel
