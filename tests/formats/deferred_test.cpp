// Packs whose radiance maps stay in the file.
#include "formats/pack/deferred.h"

#include <gtest/gtest.h>

#include "formats/pack/sections.h"
#include "tests/formats/hostile.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

using namespace testing;

class Deferred : public ::testing::Test {
 protected:
  Result<DeferredPack> read(const Bytes& file) {
    EXPECT_TRUE(write_file_atomically(path_, file));
    return read_pack_deferred(path_);
  }
  std::string refusal_of(const Bytes& file) {
    const auto pack = read(file);
    return pack ? "accepted" : pack.error().text();
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "a.oriel";
};

void expect_same_pixels(const RadianceMap& a, const RadianceMap& b) {
  EXPECT_EQ(a.radiance, b.radiance);
  EXPECT_EQ(a.disparity, b.disparity);
  EXPECT_EQ(a.valid, b.valid);
}

TEST_F(Deferred, IsThePackOnceItsMapsAreLoaded) {
  Forge plain = Forge::from(tiny_file());  // maps as zstd frames, and as they are
  for (auto& section : plain.sections)
    if (section.record.kind == kRadianceMapSection) Forge::set_raw(section, Forge::raw(section));
  for (const Bytes& file : {tiny_file(), plain.file()}) {
    auto deferred = read(file);
    ASSERT_TRUE(deferred) << deferred.error().text();
    const Pack whole = *read_pack(path_);
    ASSERT_EQ(deferred->pack.radiance_maps.size(), whole.radiance_maps.size());
    for (std::size_t i = 0; i < whole.radiance_maps.size(); ++i) {
      RadianceMap& map = deferred->pack.radiance_maps[i];
      EXPECT_TRUE(map.radiance.empty() && map.disparity.empty() && map.valid.empty());
      EXPECT_EQ(map.residual, whole.radiance_maps[i].residual);
      auto loaded = deferred->maps->load(i);
      ASSERT_TRUE(loaded) << loaded.error().text();
      expect_same_pixels(*loaded, whole.radiance_maps[i]);
      loaded->residual = map.residual;
      map = std::move(*loaded);
    }
    EXPECT_EQ(*encode_pack(deferred->pack), *encode_pack(whole));
  }
}

TEST_F(Deferred, DamageIsFoundWhenThePackIsOpened) {
  const Bytes file = tiny_file();
  const PackIndex index = *read_index(file);
  for (const auto& section : index.sections) {
    Bytes damaged = file;
    damaged[section.offset + section.stored_bytes / 2] ^= std::byte{1};
    EXPECT_NE(refusal_of(damaged).find(section.label + ": checksum"), std::string::npos) << section.label;
  }
  EXPECT_NE(refusal_of(Bytes(file.begin(), file.end() - 1)).find("is truncated"), std::string::npos);
}

// So that opening a pack decompresses no pixels: what lies behind the place's block is not asked for.
TEST_F(Deferred, APlaceIsToBeHadWithoutThePixels) {
  Pack pack = tiny_pack();
  for (RadianceMap& map : pack.radiance_maps) {
    map.width = map.height = 128;  // less than the greatest block of zstd, and it shrinks
    map.radiance.assign(16384, Vec3(1));
    for (std::size_t i = 0; i < 16384; ++i) map.radiance[i].g = static_cast<float>(i * i % 509) / 509;
    map.disparity.assign(16384, 0.5f);
    map.valid.assign(16384, 1);
  }
  const Bytes file = *encode_pack(pack);
  const PackIndex index = *read_index(file);
  for (const auto& section : index.sections) {
    if (section.kind != kRadianceMapSection) continue;
    Bytes damaged = file;
    for (std::size_t i = 80; i < section.stored_bytes; ++i) damaged[section.offset + i] = std::byte{0xff};
    const auto head = section_head(damaged, section, kRadianceMapPlaceBytes);
    ASSERT_TRUE(head) << head.error().text();
    EXPECT_EQ(*head, *section_head(file, section, kRadianceMapPlaceBytes));
    const auto more = section_head(damaged, section, section.raw_bytes);
    EXPECT_TRUE(!more || *more != *section_head(file, section, section.raw_bytes)) << "the damage is there";
  }
}

// Sections are decoded side by side where there are many bytes; which error is told does not depend on that.
TEST_F(Deferred, OfTwoDamagedSectionsTheFirstIsNamed) {
  Pack pack = tiny_pack();
  Texture& texture = pack.textures[0];
  texture.width = texture.height = 1024;
  texture.texels.resize(4 << 20);
  std::uint32_t random = 1;
  for (auto& byte : texture.texels) byte = static_cast<std::uint8_t>((random = random * 1664525 + 1013904223) >> 24);
  const Bytes file = *encode_pack(pack);
  ASSERT_TRUE(read(file));
  const PackIndex index = *read_index(file);
  for (std::size_t first = 0; first + 1 < index.sections.size(); ++first) {
    Bytes damaged = file;
    for (std::size_t i = first; i < index.sections.size(); i += index.sections.size() - 1 - first)
      damaged[index.sections[i].offset] ^= std::byte{1};
    EXPECT_NE(refusal_of(damaged).find(index.sections[first].label + ": checksum"), std::string::npos);
  }
}

TEST_F(Deferred, APlaceThatMeansNothingIsFoundWhenThePackIsOpened) {
  const std::string map = "section RMAP 0 (radiance map): ";
  const auto says = [&](const Bytes& file, const std::string& text) {
    const std::string found = refusal_of(file);
    EXPECT_NE(found.find(path_.string() + ": " + map + text), std::string::npos) << found;
  };
  says(with_raw(kRadianceMapSection, 4, 0u), "element 0: found 0 x 4 texels");
  says(with_raw(kRadianceMapSection, 4, 7u), "found 220 bytes, expected the 248 of its pixels");
  says(with_raw(kRadianceMapSection, 48, 31), "element 0: found disparity shift 31");
  says(with_raw(kRadianceMapSection, 0, 9u), "issue 412");
  Forge cut = Forge::from(tiny_file());
  Forge::set_raw(cut.find(kRadianceMapSection), Bytes(20));
  says(cut.file(), "element 0: found 0 x 0 texels");
  Forge empty = Forge::from(tiny_file());
  Forge::set_compressed(empty.find(kRadianceMapSection), {});
  says(empty.file(), "found 0 bytes");
}

TEST_F(Deferred, PixelsThatMeanNothingAreFoundWhenTheyAreLoaded) {
  Forge forge = Forge::from(tiny_file());
  auto& section = forge.find(kRadianceMapSection);
  Bytes raw = Forge::raw(section);
  raw[raw.size() - 24] = std::byte{3};  // the first of 6 x 4 pixels' validity; those behind it are differences
  Forge::set_raw(section, raw);
  const auto pack = read(forge.file());
  ASSERT_TRUE(pack) << pack.error().text();
  const auto map = pack->maps->load(0);
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ErrorCode::kInvalid);
  EXPECT_NE(map.error().text().find(path_.string() + ": section RMAP 0 (radiance map): issue 417"), std::string::npos)
      << map.error().text();
  EXPECT_TRUE(pack->maps->load(1));
}

TEST_F(Deferred, FilesThatAreNotThere) {
  EXPECT_EQ(read_pack_deferred(path_).error().code, ErrorCode::kIo);
  EXPECT_NE(refusal_of({}).find("is not an .oriel pack"), std::string::npos);
}

}  // namespace
}  // namespace oriel
