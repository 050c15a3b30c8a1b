// Sun and sky by the hour: closed forms, and each hour beside a bake of it alone.
#include <gtest/gtest.h>

#include <numeric>

#include "bake/scene/daylight.h"
#include "formats/core/color.h"
#include "tests/bake/radiosity/baked.h"

namespace oriel {
namespace {

using test::bake;
using test::Baked;
using test::SceneParts;

constexpr double kError = 0.03;

RadiosityOptions options(double error = kError) {
  return test::cached_options(error);
}

Scene in_daylight(Scene scene, const std::string& hours) {
  DayOptions day;
  EXPECT_TRUE(parse_day("2026-06-21@52.5,13.4", day));
  EXPECT_TRUE(parse_hours(hours, day));
  Context context;
  EXPECT_TRUE(add_daylight(day, scene, context));
  for (const DayHour& hour : scene.day.hours) scene.light_groups.push_back({fmt::format("{}", hour.hour), {}});
  scene.light_groups.push_back({"lamps", {}});
  for (Light& light : scene.lights) light.light_group = scene.day.hours[static_cast<std::size_t>(light.hour)].group;
  for (Surface& surface : scene.surfaces) surface.light_group = static_cast<std::uint32_t>(scene.day.lit());
  return scene;
}

// E of open level ground = sun · sin(elevation) + sky, hour by hour, to half a percent, whatever the other hours are.
TEST(Day, OpenGroundHasTheLightOfTheModel) {
  SceneParts parts;
  parts.quad("ground", parts.diffuse(Vec3(0.3f)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  RadiosityOptions fine = options(1e-4);
  fine.samples = 1 << 16;
  const Baked baked = bake(in_daylight(parts.finish(), "6-18/3"), 0.5f, fine);
  const Day& day = baked.scene.day;
  ASSERT_EQ(day.lit(), 5u);
  for (const DayHour& hour : day.hours) {
    double sum = 0, count = 0;
    baked.each_texel([&](const LightmapPage&, std::uint32_t t, std::uint32_t) {
      const double lux = luminance(baked.radiosity.groups[hour.group][0].irradiance[t]) * day.lit();
      sum += lux, ++count;
      const double exact = hour.sun_lux * hour.to_sun.y + hour.sky_lux;
      EXPECT_NEAR(lux / exact, 1, 0.005) << hour.hour << " texel " << t;
    });
    ASSERT_GT(count, 4);
    const double exact = hour.sun_lux * hour.to_sun.y + hour.sky_lux;
    std::printf("%02.0f:00  %8.0f lux, closed form %8.0f, off by %.3f %%\n", hour.hour, sum / count, exact,
                100 * (sum / count / exact - 1));
  }
}

// A room with a window to the south and one to the east, a table, and a lamp.
Scene room_by_day() {
  SceneParts parts;
  const auto wall = parts.diffuse(Vec3(0.7f, 0.6f, 0.5f)), lamp = parts.diffuse(Vec3(0.5f), Vec3(3000));
  parts.quad("floor", wall, {0, 0, 3}, {4, 0, 0}, {0, 0, -3});
  parts.quad("ceiling", wall, {0, 2.5f, 0}, {4, 0, 0}, {0, 0, 3});
  parts.quad("north", wall, {0, 0, 0}, {4, 0, 0}, {0, 2.5f, 0});
  parts.quad("south", wall, {4, 0, 3}, {-4, 0, 0}, {0, 1, 0});
  parts.quad("lintel", wall, {4, 2.2f, 3}, {-4, 0, 0}, {0, 0.3f, 0});
  parts.quad("west", wall, {0, 0, 3}, {0, 0, -3}, {0, 2.5f, 0});
  parts.quad("east", wall, {4, 0, 0}, {0, 0, 2}, {0, 2.5f, 0});
  parts.box("table", wall, {1, 0.6f, 1}, {1.8f, 0.7f, 1.8f});
  parts.quad("lamp", lamp, {0.8f, 2.45f, 0.8f}, {0.3f, 0, 0}, {0, 0, 0.3f});
  return parts.finish();
}

// Of the difference between an hour's group and a bake of that hour: rms, relative, dark texels to a tenth of the mean.
// Where an hour has a fifth of all light it is as good as alone (docs/notes/lights.md): both have the error asked for.
// A hundredth of the texels is left out: what those at the edge of a sun's patch have follows from where a few points
// lie.
TEST(Day, HoursAreWhatTheirSunAndSkyGiveAlone) {
  const Baked all = bake(in_daylight(room_by_day(), "8-16/4"), 0.2f, options());
  const Day& day = all.scene.day;
  for (const DayHour& hour : day.hours) {
    Scene scene = room_by_day();
    for (SceneMaterial& material : scene.materials) material.emission = Vec3(0);
    const Baked alone = bake(in_daylight(std::move(scene), fmt::format("{}", hour.hour)), 0.2f, options());
    const double floor = 0.1 * luminance(alone.radiosity.report.mean);
    std::vector<double> squares, well_lit;
    double bias = 0, sum = 0;
    alone.each_texel([&](const LightmapPage& page, std::uint32_t t, std::uint32_t) {
      const auto p = static_cast<std::size_t>(&page - alone.radiosity.pages.data());
      const double one = luminance(page.irradiance[t]),
                   own = luminance(all.radiosity.groups[hour.group][p].irradiance[t]);
      const double off = own * static_cast<double>(day.lit()) - one;
      squares.push_back(off * off / (one * one + floor * floor)), bias += off, sum += one;
      if (own > 0.2 * luminance(all.radiosity.pages[p].irradiance[t])) well_lit.push_back(squares.back());
    });
    const auto rms = [](std::vector<double>& values, double share) {
      std::ranges::sort(values);
      const auto count = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
      return std::sqrt(std::accumulate(values.begin(), values.begin() + count, 0.0) / static_cast<double>(count));
    };
    ASSERT_GT(well_lit.size(), 100u);
    const double held = rms(well_lit, 0.99);
    std::printf(
        "%02.0f:00  rms %.2f %%, of 99 %% %.2f %%, of those where it has a fifth of the light (%zu of %zu) %.2f %%, "
        "bias %.2f %%\n",
        hour.hour, 100 * rms(squares, 1), 100 * rms(squares, 0.99), well_lit.size(), squares.size(), 100 * held,
        100 * bias / sum);
    EXPECT_LT(held, std::sqrt(2.0) * kError) << hour.hour;
    EXPECT_LT(std::abs(bias / sum), kError / 2) << hour.hour;
  }
}

}  // namespace
}  // namespace oriel
