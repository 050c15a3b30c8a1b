// KTX2 files: read back by a parser of its own, field by field as the specifications have them.
#include "formats/export/ktx2.h"

#include <gtest/gtest.h>
#include <zstd.h>

#include "formats/core/half.h"
#include "formats/export/lightmap_texture.h"

namespace oriel {
namespace {

struct Parsed {
  std::uint32_t header[9] = {}, descriptor_at = 0, descriptor_bytes = 0, keys_at = 0, keys_bytes = 0;
  std::uint64_t global_at = 0, global_bytes = 0, level_at = 0, level_bytes = 0, inflated_bytes = 0;
  std::vector<std::uint32_t> texels;  // or other words of the level
};

Parsed parsed(const Bytes& file) {
  Parsed p;
  ByteReader in(file);
  const auto magic = in.get_array<char>(12);
  EXPECT_EQ(std::string_view(magic.data(), magic.size()), "\xABKTX 20\xBB\r\n\x1A\n");
  for (std::uint32_t& word : p.header) word = in.get<std::uint32_t>();
  for (std::uint32_t* word : {&p.descriptor_at, &p.descriptor_bytes, &p.keys_at, &p.keys_bytes})
    *word = in.get<std::uint32_t>();
  for (std::uint64_t* word : {&p.global_at, &p.global_bytes, &p.level_at, &p.level_bytes, &p.inflated_bytes})
    *word = in.get<std::uint64_t>();
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(p.level_at + p.level_bytes, file.size());
  p.texels.resize(p.inflated_bytes / 4);
  EXPECT_EQ(ZSTD_decompress(p.texels.data(), p.inflated_bytes, file.data() + p.level_at, p.level_bytes),
            p.inflated_bytes);
  return p;
}

LightmapPage page_of(std::uint32_t width, std::uint32_t height, float brightest) {
  LightmapPage page{width, height, {}, {}, {}};
  for (std::uint32_t i = 0; i < width * height; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(width * height - 1);
    page.irradiance.push_back(brightest * Vec3(share, share * share, 0.01f));
  }
  return page;
}

Bytes file_of(const LightmapPage& page, TexelCoding coding = TexelCoding::kRgb9e5) {
  return *ktx2_file(lightmap_texture(page, coding).texture);
}

TEST(Ktx2, HeaderAndIndexAreTheSpecifications) {
  const Parsed p = parsed(file_of(page_of(7, 5, 300)));
  const std::uint32_t expected[9] = {123, 4, 7, 5, 0, 0, 1, 1, 2};
  for (int i = 0; i < 9; ++i) EXPECT_EQ(p.header[i], expected[i]) << "word " << i;
  EXPECT_EQ(p.descriptor_at, 104u);
  EXPECT_EQ(p.keys_at, p.descriptor_at + p.descriptor_bytes);
  EXPECT_EQ(p.keys_bytes % 4, 0u);
  EXPECT_EQ(p.level_at, p.keys_at + p.keys_bytes);
  EXPECT_EQ(p.global_bytes, 0u);
  EXPECT_EQ(p.inflated_bytes, 4u * 7 * 5);
}

TEST(Ktx2, DescriptorNamesTheSharedExponent) {
  const Bytes file = file_of(page_of(2, 2, 1));
  const Parsed p = parsed(file);
  ByteReader in{std::span<const std::byte>(file).subspan(p.descriptor_at, p.descriptor_bytes)};
  EXPECT_EQ(in.get<std::uint32_t>(), p.descriptor_bytes);
  EXPECT_EQ(in.get<std::uint32_t>(), 0u);
  EXPECT_EQ(in.get<std::uint16_t>(), 2u);
  EXPECT_EQ(in.get<std::uint16_t>(), 24u + 6 * 16);
  for (const int byte : {1, 1, 1, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0}) EXPECT_EQ(in.get<std::uint8_t>(), byte);
  for (std::uint32_t channel = 0; channel < 3; ++channel) {
    EXPECT_EQ(in.get<std::uint32_t>(), 9 * channel | 8u << 16 | channel << 24);
    EXPECT_EQ(in.get<std::uint32_t>(), 0u);
    EXPECT_EQ(in.get<std::uint32_t>(), 0u);
    EXPECT_EQ(in.get<std::uint32_t>(), 8448u);
    EXPECT_EQ(in.get<std::uint32_t>(), 27u | 4u << 16 | (channel | 0x20u) << 24);
    EXPECT_EQ(in.get<std::uint32_t>(), 0u);
    EXPECT_EQ(in.get<std::uint32_t>(), 15u);
    EXPECT_EQ(in.get<std::uint32_t>(), 31u);
  }
  EXPECT_TRUE(in.ok());
}

// A block of 4 x 4 texels of 16 bytes, one sample of unsigned floats over all of it.
TEST(Ktx2, DescriptorOfBc6hIsThatOfItsBlocks) {
  const Bytes file = file_of(page_of(7, 5, 300), TexelCoding::kBc6h);
  const Parsed p = parsed(file);
  EXPECT_EQ(p.header[0], 131u);
  EXPECT_EQ(p.header[1], 1u);
  EXPECT_EQ(p.inflated_bytes, 2u * 2 * 16);
  ByteReader in{std::span<const std::byte>(file).subspan(p.descriptor_at, p.descriptor_bytes)};
  in.get_array<std::uint8_t>(12);
  for (const int byte : {133, 1, 1, 0, 3, 3, 0, 0, 16, 0, 0, 0, 0, 0, 0, 0}) EXPECT_EQ(in.get<std::uint8_t>(), byte);
  EXPECT_EQ(in.get<std::uint32_t>(), 127u << 16 | 0x80u << 24);
  EXPECT_EQ(in.get<std::uint32_t>(), 0u);
  EXPECT_EQ(in.get<std::uint32_t>(), 0u);
  EXPECT_EQ(in.get<std::uint32_t>(), 0x3F800000u);
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(p.descriptor_bytes, 4u + 24 + 16);
}

// The coding follows from what is known of the light: a page with 4 % of noise need not keep thousandths.
TEST(Ktx2, TheCodingIsAsGoodAsTheLight) {
  LightmapPage page = page_of(16, 16, 300);
  page.state.assign(256, TexelState::kValid);
  for (const Vec3& e : page.irradiance) page.standard_error.push_back(1e-5f * e);
  EXPECT_EQ(lightmap_texture(page, {}).texture.coding, TexelCoding::kRgb9e5);
  const double rounding = lightmap_texture(page, TexelCoding::kBc6h).rounding;
  for (const auto& [times, coding] : {std::pair(3.9f, TexelCoding::kRgb9e5), std::pair(4.1f, TexelCoding::kBc6h)}) {
    for (std::size_t i = 0; i < 256; ++i)
      page.standard_error[i] = times * static_cast<float>(rounding) * page.irradiance[i];
    EXPECT_EQ(lightmap_texture(page, {}).texture.coding, coding) << times;
  }
}

TEST(Ktx2, KeysTellTheOrientationAndTheWriter) {
  const Bytes file = file_of(page_of(2, 2, 1));
  const Parsed p = parsed(file);
  ByteReader in{std::span<const std::byte>(file).subspan(p.keys_at, p.keys_bytes)};
  using std::string_literals::operator""s;
  for (const std::string& expected : {"KTXorientation\0rd\0"s, "KTXwriter\0oriel-inspect\0"s}) {
    EXPECT_EQ(in.get_string(), expected);
    in.get_array<char>((4 - expected.size() % 4) % 4);
  }
  EXPECT_TRUE(in.ok());
}

// From a cellar to the sun's surface: no light is cut, and none is off by more than the format's step.
TEST(Ktx2, LightComesBackWithinTheStatedRounding) {
  for (const float brightest : {0.02f, 1.0f, 300.0f, 65408.0f, 130000.0f, 1e9f}) {
    const LightmapPage page = page_of(16, 16, brightest);
    const float scale = texture_scale(page);
    EXPECT_EQ(scale, brightest <= 65408 ? 1.0f : std::exp2(std::ceil(std::log2(brightest / 65408))));
    const Parsed p = parsed(file_of(page));
    ASSERT_EQ(p.texels.size(), page.irradiance.size());
    double squares = 0;
    for (std::size_t i = 0; i < p.texels.size(); ++i) {
      const Vec3 read = rgb_from_rgb9e5(p.texels[i]) * scale, was = page.irradiance[i];
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(read[c], was[c], 0x1p-9f * max_component(was) + 0x1p-24f * scale);
        squares += std::pow(double{read[c] - was[c]} / max_component(was), 2);
      }
    }
    EXPECT_NEAR(lightmap_texture(page, TexelCoding::kRgb9e5).rounding,
                std::sqrt(squares / (3.0 * static_cast<double>(p.texels.size()))), 1e-6);
  }
}

TEST(Ktx2, ABlackPageIsBlack) {
  const LightmapPage page{1, 1, {Vec3(0)}, {}, {}};
  EXPECT_EQ(parsed(file_of(page)).texels, std::vector<std::uint32_t>{0});
  EXPECT_EQ(texture_scale(page), 1);
  EXPECT_EQ(lightmap_texture(page, TexelCoding::kRgb9e5).rounding, 0);
}

}  // namespace
}  // namespace oriel
