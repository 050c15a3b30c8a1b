// Packs as files: whole or not at all, readable for ever, and what is wrong with one named.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "formats/core/file.h"
#include "formats/pack/index.h"
#include "formats/pack/reader.h"
#include "formats/pack/validate.h"
#include "formats/pack/writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

using testing::tiny_mapped_pack;
using testing::tiny_pack;

TEST(PackFile, ReadsWhatItWrote) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.oriel";
  const auto written = write_pack(path, tiny_pack());
  ASSERT_TRUE(written) << written.error().text();
  const auto read = read_pack(path);
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_EQ(read->lightmaps.size(), 1u);
}

// An optional kind that packs had once is an unknown one now: kept, at the end.
auto known_sections(std::span<const std::byte> file) {
  auto sections = read_index(file)->sections;
  std::erase_if(sections, [](const auto& section) { return !find_section_kind(section.kind); });
  return sections;
}

// Files of format version 1: a small one, and one with every section. They must stay readable for ever; if this test
// fails, the format has changed and needs a new version. Compressed bytes may differ between versions of zstd, so the
// sections are compared as they are after decompression.
void expect_readable(const char* name, const Pack& expected) {
  const auto file = read_file(std::filesystem::path(ORIEL_SOURCE_DIR) / "tests/formats/pack/golden" / name);
  ASSERT_TRUE(file) << file.error().text();
  const auto pack = decode_pack(*file);
  ASSERT_TRUE(pack) << pack.error().text();
  EXPECT_TRUE(validate(*pack).empty());
  ASSERT_EQ(pack->fresnel_maps.size(), expected.fresnel_maps.size());
  for (std::size_t i = 0; i < expected.fresnel_maps.size(); ++i) {
    EXPECT_EQ(pack->fresnel_maps[i].table, expected.fresnel_maps[i].table);
    EXPECT_EQ(pack->fresnel_maps[i].factor, expected.fresnel_maps[i].factor);
  }
  for (const auto& source : {*pack, expected}) {
    const auto bytes = encode_pack(source);
    ASSERT_TRUE(bytes) << bytes.error().text();
    const auto golden = known_sections(*file), now = known_sections(*bytes);
    ASSERT_EQ(golden.size(), now.size());
    for (std::size_t i = 0; i < now.size(); ++i) {
      EXPECT_EQ(golden[i].kind, now[i].kind);
      // They hold an image of R and a flag of maps, which are not written any more.
      if (now[i].kind == kFresnelSection || now[i].kind == kRadianceMapSection) continue;
      const auto a = section_bytes(*file, golden[i]), b = section_bytes(*bytes, now[i]);
      ASSERT_TRUE(a && b);
      EXPECT_TRUE(std::ranges::equal(a->span(), b->span())) << now[i].label;
    }
  }
}

TEST(PackFile, VersionOneStaysReadable) {
  expect_readable("tiny-v1.oriel", tiny_pack());
  expect_readable("whole-v1.oriel", tiny_mapped_pack());
  const auto file = read_file(std::filesystem::path(ORIEL_SOURCE_DIR) / "tests/formats/pack/golden/whole-v1.oriel");
  std::set<std::uint32_t> kinds;
  const PackIndex index = *read_index(*file);
  for (const auto& section : index.sections) kinds.insert(section.kind);
  for (const auto& kind : kSectionKinds) EXPECT_TRUE(kinds.contains(kind.kind)) << kind.meaning;
  EXPECT_TRUE(kinds.contains(fourcc("VLIT"))) << "light of vertices, which readers skip";
}

TEST(PackFile, FailedWriteLeavesTheOldFile) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.oriel";
  ASSERT_TRUE(write_pack(path, tiny_pack()));
  const auto before = read_file(path);
  Pack bad = tiny_pack();
  bad.materials[0].alpha = 2;
  const auto status = write_pack(path, bad);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().where, path.string());
  EXPECT_EQ(*before, *read_file(path));
  // A folder stands where the file should be: the rename fails, and no temporary file stays.
  const auto blocked = folder.path() / "folder.oriel";
  std::filesystem::create_directories(blocked / "inside");
  const auto refused = write_pack(blocked, tiny_pack());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kIo);
  std::size_t entries = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++entries;
  EXPECT_EQ(entries, 2u);
}

TEST(PackFile, NamesTheFileAndTheSection) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / "a.oriel";
  auto bytes = *encode_pack(tiny_pack());
  const auto index = *read_index(bytes);
  for (const auto& section : index.sections)
    if (section.kind == kLightmapSection) bytes[section.offset + 3] ^= std::byte{1};
  ASSERT_TRUE(write_file_atomically(path, bytes));
  const auto read = read_pack(path);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().text().find(path.string() + ": section LMAP 0 (lightmap page): checksum "), 0u)
      << read.error().text();
  const auto missing = read_pack(folder.path() / "missing.oriel");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace oriel
