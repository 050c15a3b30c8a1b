// Light by group of lamps: what is told apart sums to all, and is what each group's lamps give alone.
#include <gtest/gtest.h>

#include "formats/core/color.h"
#include "formats/query/group_light.h"
#include "tests/bake/radiosity/baked.h"

namespace oriel {
namespace {

using test::bake;
using test::Baked;
using test::SceneParts;

constexpr double kGroupsError = 0.03;

RadiosityOptions group_options() {
  return test::cached_options(kGroupsError);
}

// Two rooms with a door between them, a polished floor, a lamp of each colour in one of them, a point light in the
// other, a window to the sky. only: the lamps of that group alone shine; ~0u: all do.
Scene rooms(bool groups, std::uint32_t only = ~0u) {
  const auto on = [&](std::uint32_t group) { return only == ~0u || only == group ? 1.0f : 0.0f; };
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.7f, 0.6f, 0.5f));
  SceneMaterial polished;
  polished.base_color = Vec3(0.4f), polished.metallic = 0, polished.roughness = 0.2f;
  const auto floor = parts.add(polished);
  const auto red = parts.diffuse(Vec3(0.5f), on(0) * Vec3(900, 300, 200));
  const auto blue = parts.diffuse(Vec3(0.5f), on(1) * Vec3(100, 200, 700));
  parts.quad("floor", floor, {0, 0, 3}, {6, 0, 0}, {0, 0, -3});
  parts.quad("ceiling", wall, {0, 2.5f, 0}, {6, 0, 0}, {0, 0, 3});
  parts.quad("back", wall, {0, 0, 0}, {6, 0, 0}, {0, 2.5f, 0});
  parts.quad("front", wall, {6, 0, 3}, {-6, 0, 0}, {0, 1.2f, 0});  // above it is the sky
  parts.quad("left", wall, {0, 0, 3}, {0, 0, -3}, {0, 2.5f, 0});
  parts.quad("right", wall, {6, 0, 0}, {0, 0, 3}, {0, 2.5f, 0});
  parts.box("between", wall, {2.9f, 0, 0.8f}, {3.1f, 2.5f, 3});
  parts.box("table", wall, {1, 0.6f, 1}, {1.8f, 0.7f, 1.8f});
  parts.quad("red lamp", red, {0.8f, 2.45f, 0.8f}, {0.3f, 0, 0}, {0, 0, 0.3f});
  parts.quad("blue lamp", blue, {2.2f, 2.45f, 2.2f}, {0.2f, 0, 0}, {0, 0, 0.2f});
  Light bulb;
  bulb.name = "bulb", bulb.position = {4.5f, 1.8f, 1.5f}, bulb.intensity = on(2) * Vec3(80, 80, 60);
  parts.scene().lights.push_back(bulb);
  Scene scene = parts.finish();
  scene.sky = on(3) * Vec3(30, 40, 60);
  if (!groups) return scene;
  for (const char* name : {"red", "blue", "bulb", "sky"}) scene.light_groups.push_back({name, {name}});
  for (Surface& surface : scene.surfaces)
    if (surface.name == "blue lamp") surface.light_group = 1;
  scene.lights.front().light_group = 2;
  scene.sky_group = 3;
  return scene;
}

const Baked& together() {
  static const Baked baked = bake(rooms(true), 0.15f, group_options());
  return baked;
}

// To rounding, and the light of all is that of a bake which nobody asked.
TEST(LightGroups, SumToAllLightWhichTheyDoNotChange) {
  const Radiosity& light = together().radiosity;
  ASSERT_EQ(light.groups.size(), 4u);
  const Baked plain = bake(rooms(false), 0.15f, group_options());
  EXPECT_TRUE(plain.radiosity.groups.empty());
  for (std::size_t p = 0; p < light.pages.size(); ++p) {
    EXPECT_EQ(light.pages[p].irradiance, plain.radiosity.pages[p].irradiance);
    EXPECT_EQ(light.pages[p].detail, plain.radiosity.pages[p].detail);
    ASSERT_FALSE(light.pages[p].detail.empty());
    for (const auto values : {&LightmapPage::irradiance, &LightmapPage::detail}) {
      const std::vector<Vec3>& all = light.pages[p].*values;
      for (std::size_t i = 0; i < all.size(); ++i) {
        Vec3 sum(0);
        for (const auto& group : light.groups) {
          sum += (group[p].*values)[i];
          ASSERT_TRUE(glm::all(glm::greaterThanEqual((group[p].*values)[i], Vec3(0))));
        }
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(sum[c], all[i][c], 1e-5f * all[i][c] + 1e-12f) << i;
      }
    }
  }
}

// Both are as good as was asked, by their own samples: relative, what is darker than a tenth of the mean light as that.
// A group that has a few percent of all light is noisier beside its own: samples are where all light wants them.
TEST(LightGroups, AreWhatTheirLampsGiveAlone) {
  const Radiosity& light = together().radiosity;
  const double floor = 0.1 * luminance(light.report.mean);
  for (std::uint32_t g = 0; g < 4; ++g) {
    const Baked alone = bake(rooms(false, g), 0.15f, group_options());
    double sum = 0, squares = 0, bias = 0, count = 0;
    alone.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t) {
      const auto p = static_cast<std::size_t>(&page - alone.radiosity.pages.data());
      const double one = luminance(page.irradiance[t]), off = luminance(light.groups[g][p].irradiance[t]) - one;
      squares += off * off / (one * one + floor * floor), bias += off, sum += one, ++count;
    });
    EXPECT_LT(std::sqrt(squares / count), std::sqrt(2.0) * kGroupsError) << g;
    EXPECT_LT(std::abs(bias / sum), kGroupsError / 2) << g;
  }
}

// What a pack keeps gives them back: all as they are to the bit, one alone to 2^-8 of its own light and of the sum's.
TEST(LightGroups, AreSwitchedInWhatAPackKeeps) {
  const Radiosity& light = together().radiosity;
  const PageGroups kept = groups_of_page(light.pages[0], 0, light.groups);
  std::vector<Vec3> all = light.pages[0].irradiance;
  relight(kept, false, std::vector<Vec3>(4, Vec3(1)), 0, all);
  EXPECT_EQ(all, light.pages[0].irradiance);
  for (std::size_t g = 0; g < 4; ++g) {
    std::vector<Vec3> factors(4, Vec3(0));
    factors[g] = Vec3(1);
    for (const bool details : {false, true}) {
      const std::vector<Vec3>& before = details ? light.pages[0].detail : light.pages[0].irradiance;
      const std::vector<Vec3>& own = details ? light.groups[g][0].detail : light.groups[g][0].irradiance;
      std::vector<Vec3> shown = before;
      relight(kept, details, factors, 0, shown);
      double worst = 0;
      for (std::size_t i = 0; i < own.size(); ++i)
        worst = std::max(worst, double{std::abs(luminance(shown[i]) - luminance(own[i]))} /
                                    (luminance(own[i]) + 1e-6 * luminance(before[i]) + 1e-9));
      EXPECT_LT(worst, 4 * 0x1p-8) << g;  // the brightest of four has the rounding of three
      EXPECT_GT(worst, 0) << g;
    }
  }
}

}  // namespace
}  // namespace oriel
