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
  std::uint64_t nth = 0;  // among those of its kind
  std::string label;      // "section LMAP 2 (lightmap page)"
};

struct PackIndex {
  std::uint32_t version = 0;
  std::uint64_t file_bytes = 0;
  std::vector<SectionInfo> sections;  // in file order
};

// Checks the header, the table with its checksum, the place of every section, the padding and the file's length; not
// the sections' own checksums. Error kInvalid names the field or the section.
Result<PackIndex> read_index(std::span<const std::byte> file);

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

// The first of them, of a section that check_section accepts: at most `bytes`, fewer where the section holds fewer.
// What follows in the section is not looked at.
Result<Bytes> section_head(std::span<const std::byte> file, const SectionInfo& section, std::size_t bytes);

}  // namespace oriel
