// Texel values whose interpolation has the texels' light, against the light itself.
#include "bake/radiosity/texels/fit_texels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "bake/trace/sampler.h"
#include "formats/assets/bilinear.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

constexpr float kTexel = 0.1f;

// A square of 3 m whose texels hold the means of light(x, y), in texels of its page, and that standard error.
struct Sheet {
  Scene scene;
  Atlas atlas;
  TexelMapPage map;
  LightmapPage page;
};

using Light = std::function<float(float x, float y)>;

Sheet sheet(const Light& light, float standard_error = 0) {
  constexpr int kPlaces = 8;
  test::SceneParts parts;
  parts.quad("sheet", parts.diffuse(Vec3(0.5f)), {0, 0, 0}, {3, 0, 0}, {0, 3, 0});
  Sheet s;
  s.scene = parts.finish();
  Context context;
  AtlasOptions options;
  options.texel_m = kTexel;
  s.atlas = *build_atlas(s.scene, options, context);
  auto maps = *build_texel_map(s.atlas, context);
  EXPECT_EQ(maps.size(), 1u);
  s.map = std::move(maps[0]);
  const std::size_t size = std::size_t{s.map.width} * s.map.height;
  s.page = {s.map.width, s.map.height, std::vector<Vec3>(size), std::vector<Vec3>(size), std::vector<TexelState>(size)};
  for (const std::uint32_t t : s.map.texel) {
    double sum = 0;
    for (int i = 0; i < kPlaces * kPlaces; ++i)
      sum += light(static_cast<float>(t % s.page.width) + (static_cast<float>(i % kPlaces) + 0.5f) / kPlaces,
                   static_cast<float>(t / s.page.width) + (static_cast<float>(i / kPlaces) + 0.5f) / kPlaces);
    s.page.irradiance[t] = Vec3(static_cast<float>(sum / (kPlaces * kPlaces)));
    s.page.standard_error[t] = Vec3(standard_error);
    s.page.state[t] = TexelState::kValid;
  }
  return s;
}

float shown(const LightmapPage& page, float x, float y) {
  const TexelsAround around =
      texels_around({x / static_cast<float>(page.width), y / static_cast<float>(page.height)}, page.width, page.height);
  float sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += around.weight[i] * page.irradiance[around.texel[i]].g;
  return sum;
}

// Of what is shown, root mean square over the inside of the sheet.
double error(const Sheet& s, const Light& light) {
  double squares = 0, count = 0;
  for (float y = 8; y < 24; y += 0.173f)
    for (float x = 8; x < 24; x += 0.137f)
      squares += std::pow(double{shown(s.page, x, y)} - double{light(x, y)}, 2), ++count;
  return std::sqrt(squares / count);
}

Sheet fitted(Sheet s) {
  fit_texels({s.atlas, s.map}, s.page);
  return s;
}

TEST(FitTexels, LeavesWhatInterpolationShowsAlready) {
  for (const Light& light :
       {Light([](float, float) { return 3.0f; }), Light([](float x, float y) { return x + y / 2; })}) {
    const Sheet means = sheet(light), after = fitted(means);
    EXPECT_LT(error(after, light), 1e-4);
    for (const std::uint32_t t : means.map.texel)
      EXPECT_NEAR(after.page.irradiance[t].g, means.page.irradiance[t].g, 0.2f) << "the border bends at most";
  }
}

// A penumbra of two texels and one of four. A fifth of the error goes where its border is a texel's, where bounds hold
// most of it back, more where it is slanted to the grid.
TEST(FitTexels, PenumbraeAreShownAsTheyAre) {
  for (const float width : {2.0f, 4.0f})
    for (const float turn : {0.0f, 0.4f, 0.785f}) {
      const Light light = [&](float x, float y) {
        const float across = (x - 16) * std::cos(turn) + (y - 16) * std::sin(turn);
        return 0.1f + std::clamp(across / width + 0.5f, 0.0f, 1.0f);
      };
      const Sheet means = sheet(light), after = fitted(means);
      EXPECT_LT(error(after, light), (turn == 0 ? 0.85 : 0.75) * error(means, light)) << width << " " << turn;
      double sum = 0, before = 0;
      for (const std::uint32_t t : means.map.texel) {
        const float a = means.page.irradiance[t].g, b = after.page.irradiance[t].g;
        sum += b, before += a;
        EXPECT_GE(b, 0.1f - 1e-5f) << "no ringing";
        EXPECT_LE(b, 1.1f + 1e-5f);
      }
      EXPECT_NEAR(sum / before, 1, 2e-3) << "light is neither made nor lost";
    }
}

// An edge within a texel has no better interpolation between bounds; it must not become worse.
TEST(FitTexels, SharpEdgesStay) {
  for (const float at : {16.0f, 16.25f, 16.5f, 16.9f}) {
    const Light light = [&](float x, float) { return x < at ? 0.1f : 1.0f; };
    const Sheet means = sheet(light);
    EXPECT_LT(error(fitted(means), light), 1.02 * error(means, light)) << at;
  }
}

// What may be noise is not made sharper: that would make it stronger.
TEST(FitTexels, NoiseStaysAsItIs) {
  constexpr float kNoise = 0.05f;
  Sheet noisy = sheet([](float, float) { return 1.0f; }, kNoise);
  for (const std::uint32_t t : noisy.map.texel)
    noisy.page.irradiance[t] += kNoise * std::sqrt(3.0f) * (2 * Sampler(7, t, 0).next1() - 1);
  const Light even = [](float, float) { return 1.0f; };
  const double before = error(noisy, even);
  EXPECT_LT(error(fitted(noisy), even), 1.06 * before);
  for (const std::uint32_t t : noisy.map.texel) noisy.page.standard_error[t] = Vec3(0);
  EXPECT_GT(error(fitted(noisy), even), 1.12 * before) << "without the gate it is: the test shows something";
}

// Light that falls towards a wall, or the rim of a chart, beyond which texels have nothing: the texel there was sampled
// on one side of its middle, over a part of its square.
TEST(FitTexels, PartsOfTexelsAreShownWhereTheyWereSampled) {
  constexpr int kLast = 20;  // texels of the page
  const Light light = [](float x, float y) { return 30 - x + 0.1f * y; };
  for (const float part : {0.1f, 0.3f, 0.5f, 0.8f}) {
    Sheet s = sheet(light);
    std::vector<Reach> reach(s.map.texel.size());
    for (std::size_t i = 0; i < s.map.texel.size(); ++i) {
      const std::uint32_t t = s.map.texel[i];
      if (const int x = static_cast<int>(t % s.page.width); x > kLast)
        s.page.state[t] = TexelState::kBuried;
      else if (x == kLast) {
        ReachSum sum;
        for (int k = 0; k < 64; ++k)
          sum.add(
              {part * (static_cast<float>(k / 8) + 0.5f) / 8 - 0.5f, (static_cast<float>(k % 8) + 0.5f) / 8 - 0.5f});
        reach[i] = sum.mean();
        s.page.irradiance[t] = Vec3(light(kLast + 0.5f * part, static_cast<float>(t / s.page.width) + 0.5f));
      }
    }
    const auto worst = [&](const LightmapPage& page) {
      double most = 0;
      for (float y = 10; y < 20; y += 0.1f)
        for (float x = 0; x < part; x += 0.05f)
          most = std::max(most, std::fabs(double{shown(page, kLast + x, y)} - double{light(kLast + x, y)}));
      return most;
    };
    const double before = worst(s.page);
    fit_texels({s.atlas, s.map, reach}, s.page);
    // Beyond the last middle there is nothing to interpolate with.
    EXPECT_LT(worst(s.page), part > 0.5f ? part - 0.5 : 0.1 * before) << part << " of a texel";
  }
}

TEST(FitTexels, NothingIsReadFromBuriedTexels) {
  Sheet s = sheet([](float, float) { return 1.0f; });
  for (std::size_t i = 0; i < s.map.texel.size(); i += 3) {
    s.page.state[s.map.texel[i]] = TexelState::kBuried;
    s.page.irradiance[s.map.texel[i]] = Vec3(1e9f);
  }
  const Sheet after = fitted(s);
  for (const std::uint32_t t : s.map.texel)
    EXPECT_EQ(after.page.irradiance[t].g, s.page.state[t] == TexelState::kValid ? 1.0f : 1e9f);
}

}  // namespace
}  // namespace oriel
