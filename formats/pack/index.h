// The section table of a pack: what lies where, before anything is decoded.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "formats/core/bytes.h"
#include "formats/core/result.h"
#include "formats/pack/layout.h"

namespace oriel {

struct SectionInfo {
  std::uint32_t kind = 0, codec = 0;
  bool optional = false;
  std::uint64_t offset = 0, stored_bytes = 0, raw_bytes = 0, count = 0, checksum = 0;
  std::uint64_t padding = 0;  // bytes before it that belong to nothing, and are 0
  std::uint64_t nth = 0;      // among those of its kind
  std::string label;          // "section LMAP 2 (lightmap page)"
};

struct PackIndex {
  std::uint32_t version = 0;
  std::uint64_t file_bytes = 0;
  std::vector<SectionInfo> sections;  // in file order
};

// Checks the header, the table with its checksum, the place of every section, the padding and the file's length; not
// the sections' own checksums. Error kInvalid names the field or the section.
Result<PackIndex> read_index(std::span<const std::byte> file);

// The same of a file's beginning, header and table, for who reads the rest later: without the padding between sections
// (check_padding). file_bytes: the length of the whole file.
Result<PackIndex> read_index(std::span<const std::byte> front, std::uint64_t file_bytes);
// How many bytes of it are needed: those of the header, once these are given those of the table too; at most the
// file's.
std::uint64_t index_bytes(std::span<const std::byte> front, std::uint64_t file_bytes);
Status check_padding(std::span<const std::byte> padding, const SectionInfo& section);

// The stored bytes of a section. file and section belong to a read_index that succeeded.
std::span<const std::byte> stored_bytes(std::span<const std::byte> file, const SectionInfo& section);

// Compares the checksum of the stored bytes.
Status check_section(std::span<const std::byte> file, const SectionInfo& section);

// Bytes that were not cleared when allocated: a frame that lies about its size costs no memory.
struct RawBytes {
  std::unique_ptr<std::byte[]> data;
  std::size_t size = 0;
  std::span<const std::byte> span() const { return {data.get(), size}; }
};

// check_section, then the decompressed bytes: exactly raw_bytes of them. May throw std::bad_alloc.
Result<RawBytes> section_bytes(std::span<const std::byte> file, const SectionInfo& section);

// The same parts apart, of stored bytes. The first `bytes` of what is decompressed, at most raw_bytes.
Status check_stored(std::span<const std::byte> stored, const SectionInfo& section);
Result<RawBytes> decompressed(std::span<const std::byte> stored, const SectionInfo& section, std::uint64_t bytes);
// The same into memory that is there: as many as it holds, at most raw_bytes.
Status decompress(std::span<const std::byte> stored, const SectionInfo& section, std::span<std::byte> to);

// The first of them, of a section that check_section accepts: at most `bytes`, fewer where the section holds fewer.
// What follows in the section is not looked at. front: of the stored bytes, as much as is there; empty where that is
// too little of a section that has more.
Result<Bytes> stored_head(std::span<const std::byte> front, const SectionInfo& section, std::size_t bytes);

}  // namespace oriel
