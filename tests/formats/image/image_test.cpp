// EXR and PNG files.
#include <gtest/gtest.h>

#include <limits>

#include "formats/core/file.h"
#include "formats/image/png.h"
#include "tests/support/exr.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

using testing::TemporaryFolder;

FloatImage picture(std::uint32_t channels) {
  FloatImage image{5, 3, channels, {}};
  for (std::uint32_t i = 0; i < 15 * channels; ++i) image.pixels.push_back(static_cast<float>(i) * 1.7e5f + 0.1f);
  image.pixels[0] = std::numeric_limits<float>::denorm_min();
  image.pixels[1] = std::numeric_limits<float>::max();
  return image;
}

TEST(Exr, FloatsComeBackExactly) {
  const TemporaryFolder folder;
  for (const std::uint32_t channels : {1u, 3u, 4u}) {
    const auto path = folder.path() / "a.exr";
    const FloatImage image = picture(channels);
    const auto status = write_exr(path, image, {{"oriel:unit", "lux"}});
    ASSERT_TRUE(status) << status.error().text();
    const auto read = read_exr(path);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->width, 5u);
    EXPECT_EQ(read->height, 3u);
    EXPECT_EQ(read->channels, channels);
    EXPECT_EQ(read->pixels, image.pixels);
  }
}

TEST(Exr, LayersComeBackByName) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.exr";
  LayeredImage image;
  image.layers = {{"", picture(3)}, {"specular", picture(4)}, {"a.depth", picture(1)}};
  image.layers["specular"].pixels[7] = -3;
  image.attributes = {{"oriel:unit", "cd/m2"}};
  const auto status = write_exr(path, image);
  ASSERT_TRUE(status) << status.error().text();
  const auto read = read_layered_exr(path);
  ASSERT_TRUE(read) << read.error().text();
  ASSERT_EQ(read->layers.size(), 3u);
  for (const auto& [name, layer] : image.layers) {
    EXPECT_EQ(read->layers.at(name).channels, layer.channels) << name;
    EXPECT_EQ(read->layers.at(name).pixels, layer.pixels) << name;
  }
  EXPECT_EQ(read->attributes.at("oriel:unit"), "cd/m2");
  EXPECT_EQ(read_exr(path)->pixels, image.layers[""].pixels) << "readers of plain pictures see the plain channels";
}

TEST(Exr, LayersOfOneSizeOnly) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.exr";
  EXPECT_FALSE(write_exr(path, LayeredImage{}));
  EXPECT_FALSE(write_exr(path, LayeredImage{{{"specular", picture(3)}}, {}}));
  EXPECT_FALSE(write_exr(path, LayeredImage{{{"", picture(3)}, {"specular", {2, 2, 1, {1, 2, 3, 4}}}}, {}}));
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Exr, SameImageSameBytes) {
  const TemporaryFolder folder;
  ASSERT_TRUE(write_exr(folder.path() / "a.exr", picture(3)));
  ASSERT_TRUE(write_exr(folder.path() / "b.exr", picture(3)));
  EXPECT_EQ(*read_file(folder.path() / "a.exr"), *read_file(folder.path() / "b.exr"));
}

TEST(Exr, BadShapesAndAttributes) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.exr";
  EXPECT_FALSE(write_exr(path, {0, 3, 3, {}}));
  EXPECT_FALSE(write_exr(path, {2, 2, 2, std::vector<float>(8)}));
  EXPECT_FALSE(write_exr(path, {2, 2, 3, std::vector<float>(11)}));
  EXPECT_FALSE(write_exr(path, picture(3), {{"channels", "not a string in OpenEXR"}}));
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Exr, EveryPrefixIsRefused) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.exr";
  ASSERT_TRUE(write_exr(path, picture(3)));
  const Bytes bytes = *read_file(path);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    ASSERT_TRUE(write_file_atomically(path, std::span(bytes).first(n)));
    const auto read = read_exr(path);
    ASSERT_FALSE(read) << n << " of " << bytes.size();
    EXPECT_EQ(read.error().code, ErrorCode::kInvalid);
  }
}

TEST(Png, BytesComeBack) {
  const TemporaryFolder folder;
  for (const std::uint32_t channels : {1u, 3u, 4u}) {
    ByteImage image{4, 3, channels, {}};
    for (std::uint32_t i = 0; i < 12 * channels; ++i) image.pixels.push_back(static_cast<std::uint8_t>(i * 31));
    const auto path = folder.path() / "a.png";
    ASSERT_TRUE(write_png(path, image));
    const auto read = read_png(path);
    ASSERT_TRUE(read) << read.error().text();
    EXPECT_EQ(read->channels, channels);
    EXPECT_EQ(read->width, 4u);
    EXPECT_EQ(read->pixels, image.pixels);
  }
}

// The checksum is zlib's of the same bytes.
TEST(Png, TextsAreChunksOfTheirOwn) {
  const ByteImage image{2, 2, 3, std::vector<std::uint8_t>(12, 7)};
  const auto bytes = encode_png(image, {{"oriel.a", "b"}});
  ASSERT_TRUE(bytes);
  const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  const std::string chunk(
      "\0\0\0\x0d"
      "iTXtoriel.a\0\0\0\0\0b"
      "\x50"
      "\x74"
      "\x80"
      "\x1e",
      25);
  EXPECT_EQ(text.find(chunk), 33u);
  const TemporaryFolder folder;
  ASSERT_TRUE(write_file_atomically(folder.path() / "a.png", *bytes));
  EXPECT_EQ(read_png(folder.path() / "a.png")->pixels, image.pixels);
  for (const std::string& keyword : {std::string(), std::string(80, 'k'), std::string("a\nb")})
    EXPECT_FALSE(encode_png(image, {{keyword, ""}})) << keyword;
}

TEST(Png, TextsComeBackFromWholeAndBrokenFiles) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.png";
  const ByteImage image{1, 1, 3, {1, 2, 3}};
  const PngTexts texts{{"oriel.eye", "1,2,3"}, {"oriel.name", "caf\xc3\xa9"}, {"empty", ""}};
  const Bytes bytes = *encode_png(image, texts);
  ASSERT_TRUE(write_file_atomically(path, bytes));
  EXPECT_EQ(*read_png_texts(path), texts);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ASSERT_TRUE(write_file_atomically(path, Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))));
    const auto found = read_png_texts(path);
    ASSERT_EQ(found.has_value(), size >= 8) << size;
    if (!found) continue;
    for (const auto& [keyword, text] : *found) EXPECT_EQ(texts.at(keyword), text);
  }
  EXPECT_FALSE(read_png_texts(folder.path() / "absent.png"));
  // Lengths that reach beyond the file, and chunks without their zeros.
  for (std::size_t at = 8; at < bytes.size(); ++at) {
    Bytes broken = bytes;
    broken[at] ^= std::byte{0xff};
    ASSERT_TRUE(write_file_atomically(path, broken));
    EXPECT_TRUE(read_png_texts(path)) << at;
  }
}

TEST(Png, BadShapesAndFiles) {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.png";
  EXPECT_FALSE(write_png(path, {2, 2, 2, std::vector<std::uint8_t>(8)}));
  EXPECT_FALSE(write_png(path, {2, 2, 3, std::vector<std::uint8_t>(11)}));
  EXPECT_FALSE(write_png(path, {0, 2, 3, {}}));
  EXPECT_EQ(read_png(path).error().code, ErrorCode::kIo);
  ASSERT_TRUE(write_png(path, {2, 2, 3, std::vector<std::uint8_t>(12)}));
  const Bytes bytes = *read_file(path);
  for (std::size_t n = 0; n < 40; ++n) {
    ASSERT_TRUE(write_file_atomically(path, std::span(bytes).first(n)));
    const auto read = read_png(path);
    ASSERT_FALSE(read) << n;
    EXPECT_EQ(read.error().code, ErrorCode::kInvalid);
  }
}

}  // namespace
}  // namespace oriel
