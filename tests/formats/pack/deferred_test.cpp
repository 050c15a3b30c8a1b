// Packs whose images stay in the file.
#include "formats/pack/deferred.h"

#include <gtest/gtest.h>

#include <fstream>

#include "formats/pack/sections.h"
#include "tests/formats/pack/hostile.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

using namespace testing;

class Deferred : public ::testing::Test {
 protected:
  Result<DeferredPack> read(const Bytes& file) {
    EXPECT_TRUE(write_file_atomically(path_, file));
    return open_pack(path_);
  }
  std::string refusal_of(const Bytes& file) {
    const auto pack = read(file);
    return pack ? "accepted" : pack.error().text();
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "a.oriel";
};

bool is_image(std::uint32_t kind) {
  return kind == kTextureSection || kind == kNormalTextureSection || kind == kLightmapSection ||
         kind == kRadianceMapSection || kind == kSurroundMapSection;
}

template <class Image, class Load>
void load_all(std::vector<Image>& images, const Load& load) {
  for (std::size_t i = 0; i < images.size(); ++i) {
    auto loaded = load(i);
    ASSERT_TRUE(loaded) << loaded.error().text();
    images[i] = std::move(*loaded);
  }
}

// All images into the pack.
void load_images(DeferredPack& deferred) {
  Pack& pack = deferred.pack;
  const DeferredImages& images = *deferred.images;
  load_all(pack.textures, [&](std::size_t i) { return images.texture(i); });
  load_all(pack.normal_textures, [&](std::size_t i) { return images.normal_texture(i); });
  load_all(pack.lightmaps, [&](std::size_t i) { return images.lightmap(i); });
  load_all(pack.surround_maps, [&](std::size_t i) { return images.surround_map(i); });
  for (std::size_t i = 0; i < pack.radiance_maps.size(); ++i) {
    auto map = images.radiance_map(i);
    ASSERT_TRUE(map) << map.error().text();
    pack.radiance_maps[i] = std::move(*map);
  }
}

Bytes plain_file() {
  Forge plain = Forge::from(tiny_file());
  for (auto& section : plain.sections)
    if (is_image(section.record.kind)) Forge::set_raw(section, Forge::raw(section));
  return plain.file();
}

TEST_F(Deferred, IsThePackOnceItsImagesAreLoaded) {
  for (const Bytes& file :
       {tiny_file(), plain_file(), *encode_pack(tiny_mapped_pack())}) {  // as zstd frames, and as they are
    auto deferred = read(file);
    ASSERT_TRUE(deferred) << deferred.error().text();
    for (const RadianceMap& map : deferred->pack.radiance_maps)
      EXPECT_TRUE(map.radiance.empty() && map.disparity.empty() && map.valid.empty());
    for (const LightmapPage& page : deferred->pack.lightmaps) EXPECT_TRUE(page.irradiance.empty());
    load_images(*deferred);
    const Pack whole = *read_pack(path_);
    deferred->pack.unknown = whole.unknown;  // which nobody needs who only reads
    EXPECT_EQ(*encode_pack(deferred->pack), *encode_pack(whole));
  }
}

TEST_F(Deferred, LightIsThePagesIrradiance) {
  for (const Bytes& file : {tiny_file(), plain_file(), *encode_pack(tiny_mapped_pack())}) {
    const auto deferred = read(file);
    ASSERT_TRUE(deferred);
    const Pack whole = *read_pack(path_);
    ASSERT_FALSE(whole.lightmaps.empty());
    for (std::size_t i = 0; i < whole.lightmaps.size(); ++i) {
      const LightmapPage& page = whole.lightmaps[i];
      const auto light = deferred->images->light(i);
      ASSERT_TRUE(light) << light.error().text();
      ASSERT_EQ(light->light.size(), page.irradiance.size());
      const std::vector<Vec3> smooth = without_sharp(page);
      EXPECT_EQ(light->sharp_at, page.sharp_at);
      EXPECT_EQ(light->direction.size(), page.direction.size());
      EXPECT_EQ(light->cell, page.cell);
      ASSERT_EQ(light->detail.size(), page.detail.size());
      for (std::size_t t = 0; t < page.detail.size(); ++t)
        EXPECT_EQ(float_from_half(light->detail[t][0]) * light->scale, page.detail[t].r);
      EXPECT_EQ(deferred->images->directional(i), !page.direction.empty());
      for (std::size_t t = 0; t < page.irradiance.size(); ++t)
        for (int c = 0; c < 3; ++c)
          EXPECT_EQ(float_from_half(light->light[t][static_cast<std::size_t>(c)]) * light->scale, smooth[t][c]);
      for (std::size_t t = 0; t < page.direction.size(); ++t)
        EXPECT_EQ(light->direction[t], halves_of(page.direction[t]));
    }
  }
}

TEST_F(Deferred, DamageIsFoundWhenThePackIsOpenedOrTheImageWanted) {
  for (const Bytes& file : {tiny_file(), *encode_pack(tiny_mapped_pack())}) {
    const PackIndex index = *read_index(file);
    for (std::size_t i = 0; i < index.sections.size(); ++i) {
      const SectionInfo& section = index.sections[i];
      Bytes damaged = file;
      damaged[section.offset + section.stored_bytes - 1] ^= std::byte{1};
      auto pack = read(damaged);
      const std::string expected = path_.string() + ": " + section.label + ": checksum";
      if (!pack) {
        EXPECT_EQ(pack.error().text().find(expected), 0u) << pack.error().text();
        continue;
      }
      EXPECT_TRUE(is_image(section.kind) || !find_section_kind(section.kind)) << section.label;
      for (std::size_t s = 0; s < pack->images->sections(); ++s) {
        const Status checked = pack->images->check(s);
        EXPECT_EQ(checked.has_value(), s != i);
        if (!checked) {
          EXPECT_EQ(checked.error().text().find(expected), 0u) << checked.error().text();
        }
      }
      const auto refused = [&](const auto& loaded) {
        ASSERT_FALSE(loaded);
        EXPECT_EQ(loaded.error().text().find(expected), 0u) << loaded.error().text();
      };
      if (section.kind == kTextureSection) refused(pack->images->texture(section.nth));
      if (section.kind == kNormalTextureSection) refused(pack->images->normal_texture(section.nth));
      if (section.kind == kLightmapSection) refused(pack->images->lightmap(section.nth));
      if (section.kind == kLightmapSection) refused(pack->images->light(section.nth));
      if (section.kind == kRadianceMapSection) refused(pack->images->radiance_map(section.nth));
      if (section.kind == kSurroundMapSection) refused(pack->images->surround_map(section.nth));
    }
  }
  const Bytes file = tiny_file();
  EXPECT_NE(refusal_of(Bytes(file.begin(), file.end() - 1)).find("is truncated"), std::string::npos);
}

// The file under an open pack: a mapping would end the program.
TEST_F(Deferred, AFileThatIsCutOrOverwrittenMeanwhileGivesErrors) {
  const Bytes file = *encode_pack(tiny_mapped_pack());
  const auto cut = read(file);
  ASSERT_TRUE(cut);
  std::filesystem::resize_file(path_, 100);
  const auto page = cut->images->lightmap(0);
  ASSERT_FALSE(page);
  EXPECT_EQ(page.error().code, ErrorCode::kIo);
  EXPECT_NE(page.error().text().find("the file was cut"), std::string::npos) << page.error().text();
  const auto overwritten = read(file);
  ASSERT_TRUE(overwritten);
  std::ofstream(path_, std::ios::binary) << std::string(file.size(), 'x');
  for (const bool whole : {false, true}) {
    const Status light = whole ? Status(overwritten->images->lightmap(0).map([](const auto&) {}))
                               : overwritten->images->light(0).map([](const auto&) {});
    ASSERT_FALSE(light);
    EXPECT_NE(light.error().text().find(": section L"), std::string::npos) << light.error().text();
  }
  const auto replaced = read(file);
  ASSERT_TRUE(replaced);
  ASSERT_TRUE(write_file_atomically(path_, Bytes(10)));  // another file under the name: this one stays
  EXPECT_TRUE(replaced->images->light(0));
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
    const auto head = stored_head(stored_bytes(damaged, section), section, kRadianceMapPlaceBytes);
    ASSERT_TRUE(head) << head.error().text();
    EXPECT_EQ(*head, *stored_head(stored_bytes(file, section), section, kRadianceMapPlaceBytes));
    const auto more = stored_head(stored_bytes(damaged, section), section, section.raw_bytes);
    EXPECT_TRUE(!more || *more != *stored_head(stored_bytes(file, section), section, section.raw_bytes))
        << "the damage is there";
  }
}

// Sections are decoded side by side where there are many bytes; which error is told does not depend on that.
TEST_F(Deferred, OfTwoDamagedSectionsTheFirstIsNamed) {
  Pack pack = tiny_pack();
  pack.plan.assign(2 << 20, ' ');
  pack.plan.front() = '{';
  pack.plan.back() = '}';
  const Bytes file = *encode_pack(pack);
  ASSERT_TRUE(read(file)) << refusal_of(file);
  PackIndex index = *read_index(file);
  std::erase_if(index.sections, [](const SectionInfo& s) { return is_image(s.kind) || !find_section_kind(s.kind); });
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
  says(with_raw(kRadianceMapSection, 8, 0u), "element 0: found 0 x 4 texels");
  says(with_raw(kRadianceMapSection, 8, 7u), "found 224 bytes, expected the 252 of its pixels");
  says(with_raw(kRadianceMapSection, 52, 31), "element 0: found disparity shift 31");
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
  const auto map = pack->images->radiance_map(0);
  ASSERT_FALSE(map);
  EXPECT_EQ(map.error().code, ErrorCode::kInvalid);
  EXPECT_NE(map.error().text().find(path_.string() + ": section RMAP 0 (radiance map): issue 417"), std::string::npos)
      << map.error().text();
  EXPECT_TRUE(pack->images->radiance_map(1));
}

// Whatever an image's section holds: read at once or when it is wanted, the answer is the same.
TEST_F(Deferred, BrokenImagesAreRefusedEitherWay) {
  const auto loads = [](const Result<DeferredPack>& pack) {
    if (!pack) return false;
    const DeferredImages& images = *pack->images;
    bool good = true;
    const auto all = [&](std::size_t count, const auto& load) {
      for (std::size_t i = 0; i < count; ++i) good = load(i).has_value() && good;
    };
    all(pack->pack.textures.size(), [&](std::size_t i) { return images.texture(i); });
    all(pack->pack.normal_textures.size(), [&](std::size_t i) { return images.normal_texture(i); });
    all(pack->pack.lightmaps.size(), [&](std::size_t i) {
      const auto whole = images.lightmap(i);
      EXPECT_TRUE(!whole || images.light(i)) << "light is a part of the page";
      return whole;
    });
    all(pack->pack.radiance_maps.size(), [&](std::size_t i) { return images.radiance_map(i); });
    all(pack->pack.surround_maps.size(), [&](std::size_t i) { return images.surround_map(i); });
    return good;
  };
  const Forge whole = Forge::from(*encode_pack(tiny_mapped_pack()));
  std::uint32_t random = 5;
  const auto below = [&](std::size_t n) { return (random = random * 1664525 + 1013904223) / 65536 % n; };
  int accepted = 0, refused = 0;
  for (int round = 0; round < 400; ++round) {
    Forge forge = whole;
    ForgedSection* section = nullptr;
    while (section == nullptr || !is_image(section->record.kind))
      section = &forge.sections[below(forge.sections.size())];
    Bytes raw = Forge::raw(*section);
    raw[below(below(2) == 0 ? std::min<std::size_t>(raw.size(), 24) : raw.size())] ^=
        static_cast<std::byte>(1 << below(8));
    if (below(10) == 0) raw.resize(raw.size() - 1 - below(std::min<std::size_t>(raw.size() - 1, 40)));
    below(2) == 0 ? Forge::set_raw(*section, raw) : Forge::set_compressed(*section, raw);
    const bool deferred = loads(read(forge.file()));
    ASSERT_EQ(deferred, read_pack(path_).has_value()) << "round " << round << ", " << refusal_of(forge.file());
    (deferred ? accepted : refused) += 1;
  }
  EXPECT_GT(accepted, 50);
  EXPECT_GT(refused, 50);
}

TEST_F(Deferred, FilesThatAreNotThere) {
  EXPECT_EQ(open_pack(path_).error().code, ErrorCode::kIo);
  EXPECT_NE(refusal_of({}).find("is not an .oriel pack"), std::string::npos);
}

}  // namespace
}  // namespace oriel
