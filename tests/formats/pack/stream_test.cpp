// Packs written piece by piece.
#include <gtest/gtest.h>

#include <random>

#include "formats/core/file.h"
#include "formats/pack/index.h"
#include "formats/pack/stream.h"
#include "tests/formats/pack/hostile.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

using namespace testing;

PutBytes put_into(Bytes& file) {
  return [&file](std::uint64_t offset, std::span<const std::byte> bytes) -> Status {
    file.resize(std::max<std::size_t>(file.size(), offset + bytes.size()));
    std::copy(bytes.begin(), bytes.end(), file.begin() + static_cast<std::ptrdiff_t>(offset));
    return {};
  };
}

// The bytes in pieces of at most `size`.
NextBytes in_pieces(const Bytes& bytes, std::size_t size) {
  return [&bytes, size, at = std::size_t{0}](std::uint64_t most) mutable -> Result<std::span<const std::byte>> {
    const auto piece = std::span(bytes).subspan(at, std::min<std::size_t>(size, most));
    at += piece.size();
    return piece;
  };
}

Bytes noise(std::size_t size) {
  std::mt19937 random(5);
  Bytes bytes(size);
  for (auto& b : bytes) b = static_cast<std::byte>(random() % 16);
  return bytes;
}

// The sections of tiny_file() and `more` others, which `add` adds.
void write_sections(const PutBytes& put, std::size_t more, const std::function<Status(PackStream&)>& add) {
  const Bytes from = tiny_file();
  auto index = *read_index(from);
  std::erase_if(index.sections, [](const SectionInfo& s) { return find_section_kind(s.kind) == nullptr; });
  PackStream stream(index.sections.size() + more, put);
  for (const auto& section : index.sections)
    ASSERT_TRUE(stream.add(section.kind, section.count, section_bytes(from, section)->span()));
  const Status added = add(stream);
  ASSERT_TRUE(added) << added.error().text();
  ASSERT_TRUE(stream.finish());
}

Bytes with_section(const std::function<Status(PackStream&)>& add) {
  Bytes file;
  write_sections(put_into(file), 1, add);
  return file;
}

TEST(PackStream, PiecesOfAnySizeGiveWhatWasThere) {
  const Bytes content = noise(300000);
  for (const Codec codec : {Codec::kNone, Codec::kZstd})
    for (const std::size_t piece : {std::size_t{1000}, std::size_t{123457}, content.size()}) {
      const Bytes file = with_section([&](PackStream& stream) {
        return stream.add(fourcc("MORE"), 7, codec, content.size(), in_pieces(content, piece));
      });
      const auto index = read_index(file);
      ASSERT_TRUE(index) << index.error().text();
      const auto& section = index->sections.back();
      EXPECT_EQ(section.count, 7u);
      EXPECT_TRUE(section.optional);
      const auto raw = section_bytes(file, section);
      ASSERT_TRUE(raw) << raw.error().text();
      EXPECT_TRUE(std::ranges::equal(raw->span(), content));
      EXPECT_EQ(section.stored_bytes < content.size(), codec == Codec::kZstd);
      EXPECT_TRUE(decode_pack(file));
    }
}

TEST(PackStream, ASectionOfNothing) {
  const Bytes none;
  for (const Codec codec : {Codec::kNone, Codec::kZstd}) {
    const Bytes file =
        with_section([&](PackStream& stream) { return stream.add(fourcc("MORE"), 0, codec, 0, in_pieces(none, 1)); });
    EXPECT_TRUE(decode_pack(file)) << static_cast<int>(codec);
  }
}

TEST(PackStream, RefusesWhatNoReaderAccepts) {
  Bytes file;
  PackStream large(2, put_into(file));
  const Bytes some = noise(100);
  const auto status = large.add(kLightmapSection, 1, Codec::kZstd, kMaxRawBytes + 1, in_pieces(some, 100));
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().text().find("the sections hold more than the accepted 17179869184 bytes"),
            std::string::npos);
  PackStream many(kMaxSections + 1, put_into(file));
  EXPECT_EQ(many.add(kSceneSection, 1, some).error().text(),
            "section table: found 1048577 sections, at most 1048576 are accepted");
  PackStream full(
      1, [](std::uint64_t, std::span<const std::byte>) -> Status { return fail(ErrorCode::kIo, "disk", "is full"); });
  EXPECT_EQ(full.add(kSceneSection, 1, some).error().code, ErrorCode::kIo);
}

// 9 GiB between two sections: offsets beyond 32 bits, in a file that is mostly a hole.
TEST(PackStream, LargerThanMemory) {
  constexpr std::uint64_t kLarge = std::uint64_t{9} << 30;
  const TemporaryFolder folder;
  const auto path = folder.path() / "large.oriel";
  const Bytes zeros(std::size_t{1} << 24), last = noise(1000);
  {
    auto file = AtomicFile::create(path);
    ASSERT_TRUE(file);
    const auto zeros_only = [&](std::uint64_t most) -> Result<std::span<const std::byte>> {
      return std::span(zeros).first(std::min<std::uint64_t>(zeros.size(), most));
    };
    const PutBytes put = [&](std::uint64_t at, std::span<const std::byte> bytes) { return file->write(at, bytes); };
    write_sections(put, 2, [&](PackStream& stream) -> Status {
      ORIEL_TRY_VOID(stream.add(fourcc("HOLE"), 1, Codec::kNone, kLarge, zeros_only));
      return stream.add(fourcc("LAST"), 1, last);
    });
    ASSERT_TRUE(file->commit());
  }
  const auto mapped = MappedFile::open(path);
  ASSERT_TRUE(mapped);
  ASSERT_GT(mapped->bytes().size(), kLarge);
  const auto index = read_index(mapped->bytes());
  ASSERT_TRUE(index) << index.error().text();
  const auto& section = index->sections.back();
  EXPECT_GT(section.offset, kLarge);
  EXPECT_TRUE(std::ranges::equal(section_bytes(mapped->bytes(), section)->span(), last));
  EXPECT_TRUE(section_bytes(mapped->bytes(), index->sections[2]));
}

}  // namespace
}  // namespace oriel
