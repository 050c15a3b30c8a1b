// Images made ready for the device: mip levels, coarser pages and maps, uploads in slices.
#include "player/images/image_data.h"

#include <gtest/gtest.h>

#include <functional>

#include "formats/core/color.h"
#include "formats/core/half.h"
#include "player/gpu/framebuffer.h"
#include "player/gpu/headless.h"
#include "player/images/map_array.h"
#include "player/images/mean_mips.h"

namespace oriel {
namespace {

Texture texture_of(std::uint32_t width, std::uint32_t height, const std::function<std::uint8_t(std::uint32_t)>& at) {
  Texture out;
  out.width = width;
  out.height = height;
  for (std::uint32_t i = 0; i < 4 * width * height; ++i) out.texels.push_back(at(i));
  return out;
}

TEST(MeanMips, OneColourStaysThat) {
  for (const Encoding encoding : {Encoding::kSrgb, Encoding::kLinear})
    for (int code = 0; code < 256; ++code) {
      const auto levels =
          mean_mips(texture_of(7, 3, [&](std::uint32_t) { return static_cast<std::uint8_t>(code); }), encoding);
      ASSERT_EQ(levels.size(), 3u);
      EXPECT_EQ(levels[0].size(), 4u * 21);
      EXPECT_EQ(levels[1].size(), 4u * 3);
      EXPECT_EQ(levels[2].size(), 4u);
      for (const auto& level : levels)
        for (const std::uint8_t v : level) ASSERT_EQ(v, code);
    }
}

TEST(MeanMips, MeansAreOfLinearLightAndAlphaOfItself) {
  // Columns of black and white, clear and covered.
  const Texture columns = texture_of(4, 2, [](std::uint32_t i) { return static_cast<std::uint8_t>(i / 4 % 2 * 255); });
  const auto grey = static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(0.5f)));
  for (const auto& level : {mean_mips(columns, Encoding::kSrgb)[1], mean_mips(columns, Encoding::kSrgb)[2]})
    for (std::size_t i = 0; i < level.size(); ++i) EXPECT_EQ(level[i], i % 4 == 3 ? 128 : grey);
  EXPECT_EQ(mean_mips(columns, Encoding::kLinear)[2], std::vector<std::uint8_t>(4, 128));
}

// Of odd sizes each texel of a level covers more than two of the level before: the mean stays.
TEST(MeanMips, OddSizesKeepTheMean) {
  const Texture ramp = texture_of(9, 1, [](std::uint32_t i) { return static_cast<std::uint8_t>(i / 4 * 30); });
  const auto levels = mean_mips(ramp, Encoding::kLinear);
  ASSERT_EQ(levels.size(), 4u);
  EXPECT_EQ(levels[3][0], 120);
  EXPECT_EQ(levels[1][0] + levels[1][12], 240) << "and is even about the middle";
}

HalfPage page_of(std::uint32_t width, std::uint32_t height, const std::function<float(std::uint32_t)>& at) {
  HalfPage page{width, height, 0.5f, {}, {}};
  for (std::uint32_t i = 0; i < width * height; ++i) page.light.push_back(halves_of(Vec3(at(i))));
  return page;
}

std::vector<float> red_of(const TextureData& data) {
  const auto& block = data.blocks.at(0);
  const auto* texels = static_cast<const Half4*>(block.pixels.get());
  std::vector<float> out;
  for (int i = 0; i < block.width * block.height; ++i) out.push_back(float_from_half(texels[i][0]));
  return out;
}

TEST(LightData, CoarserPagesAreMeansOfWhatHasLight) {
  const auto light = [](std::uint32_t i) { return i == 0 ? 0.0f : static_cast<float>(8 * i); };
  const LightData whole = light_data(page_of(4, 4, light));
  EXPECT_EQ(whole.light.bytes(), light_page_bytes({4, 4}, {0, 0}, false, false, 0));
  EXPECT_EQ(whole.scale, 0.5f);
  EXPECT_NEAR(whole.mean_lux, 0.5f * 64, 1e-3f);  // of the 15 with light
  const LightData half = light_data(page_of(4, 4, light), 1);
  EXPECT_EQ(half.light.bytes(), light_page_bytes({4, 4}, {0, 0}, false, false, 1));
  EXPECT_NEAR(red_of(half.light)[0], 80 / 3.0f, 0.02f);
  EXPECT_FLOAT_EQ(red_of(half.light)[1], (16 + 24 + 48 + 56) / 4.0f);
  const LightData least = light_data(page_of(4, 4, light), 9);
  EXPECT_EQ(least.light.width, 1);
  EXPECT_EQ(light_data(page_of(3, 5, light), 1).light.height, 2);
}

TEST(MapArray, CoarserMapsKeepLightAndDepthTogether) {
  RadianceMap map;
  map.lower = {-1, -1};
  map.upper = {1, 1};
  map.width = 6;
  map.height = 5;
  for (std::uint32_t i = 0; i < 30; ++i) {
    map.radiance.emplace_back(static_cast<float>(i), 0, 0);
    map.disparity.push_back(static_cast<float>(i) / 30);
    map.valid.push_back(1);
  }
  const RadianceMap half = coarser_map(map, 1);
  EXPECT_EQ(half.width, 3u);
  EXPECT_EQ(half.height, 2u);
  ASSERT_EQ(half.radiance.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(half.disparity[i], half.radiance[i].r / 30);
  EXPECT_EQ(coarser_map(map, 5).radiance.size(), 1u);
  const RadianceMap* const layers[] = {&map, &half};
  const MapArrayData data = MapArrayData::make(layers);
  const IVec2 sizes[] = {{6, 5}, {3, 2}};
  EXPECT_EQ(data.light.bytes() + data.disparity.bytes(), map_array_bytes(sizes));
}

TEST(TextureUpload, InSlicesIsTheSameAsAtOnce) {
  const auto context = gpu::HeadlessContext::create();
  ASSERT_TRUE(context) << context.error().text();
  ASSERT_TRUE(gpu::open_device());
  const Texture texture = texture_of(37, 21, [](std::uint32_t i) { return static_cast<std::uint8_t>(i * 37 % 251); });
  const auto pixels_of = [](const gpu::Texture2d& uploaded) {
    std::vector<std::uint8_t> out;
    for (int level = 0; level < uploaded.levels(); ++level) {
      const int w = std::max(1, uploaded.width() >> level), h = std::max(1, uploaded.height() >> level);
      std::vector<std::uint8_t> of_level(4 * static_cast<std::size_t>(w * h));
      glPixelStorei(GL_PACK_ALIGNMENT, 1);
      uploaded.bind(0);
      glGetTexImage(GL_TEXTURE_2D, level, GL_RGBA, GL_UNSIGNED_BYTE, of_level.data());
      out.insert(out.end(), of_level.begin(), of_level.end());
    }
    return out;
  };
  TextureUpload whole(normal_texture_data(texture));
  ASSERT_TRUE(whole.step(1 << 20));
  const std::vector<std::uint8_t> expected = pixels_of(whole.texture);
  ASSERT_TRUE(std::equal(texture.texels.begin(), texture.texels.end(), expected.begin()));
  for (const std::size_t slice : {std::size_t{0}, std::size_t{1}, std::size_t{500}}) {
    TextureUpload upload(normal_texture_data(texture));
    std::size_t steps = 1;
    while (!upload.step(slice)) ++steps;
    EXPECT_GE(steps * std::max<std::size_t>(slice, 4 * 37), expected.size());
    EXPECT_EQ(pixels_of(upload.texture), expected);
  }
}

}  // namespace
}  // namespace oriel
