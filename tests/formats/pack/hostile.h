// Files that were tampered with, and how they are refused.
#pragma once

#include <gtest/gtest.h>

#include <cstring>

#include "formats/pack/reader.h"
#include "formats/pack/writer.h"
#include "tests/formats/pack/forge.h"
#include "tests/support/tiny_pack.h"

namespace oriel::testing {

// tiny_mapped_pack() as a file.
inline Bytes tiny_file() {
  auto bytes = encode_pack(tiny_mapped_pack());
  EXPECT_TRUE(bytes);
  return *bytes;
}

inline std::string refusal(const Bytes& file) {
  const auto pack = decode_pack(file);
  if (pack) return "accepted";
  EXPECT_EQ(pack.error().code, ErrorCode::kInvalid);
  EXPECT_FALSE(pack.error().where.empty());
  return pack.error().text();
}

inline void expect_refusal(const Bytes& file, const std::string& text) {
  const std::string found = refusal(file);
  EXPECT_NE(found.find(text), std::string::npos) << "found: " << found << "\nexpected: " << text;
}

// A file in whose table one field of one record was changed, and sealed again.
template <class Change>
Bytes with_record(std::uint32_t kind, const Change& change) {
  Bytes file = tiny_file();
  FileHeader header;
  std::memcpy(&header, file.data(), sizeof(header));
  for (std::uint32_t i = 0; i < header.section_count; ++i) {
    SectionRecord record;
    auto* place = file.data() + sizeof(FileHeader) + i * sizeof(SectionRecord);
    std::memcpy(&record, place, sizeof(record));
    if (record.kind != kind) continue;
    change(record);
    std::memcpy(place, &record, sizeof(record));
    break;
  }
  Forge::seal(file);
  return file;
}

// Writes value over the raw bytes of a section at offset.
template <class T>
Bytes with_raw(std::uint32_t kind, std::size_t offset, T value) {
  Forge forge = Forge::from(tiny_file());
  auto& section = forge.find(kind);
  Bytes raw = Forge::raw(section);
  std::memcpy(raw.data() + offset, &value, sizeof(value));
  Forge::set_raw(section, raw);
  return forge.file();
}

}  // namespace oriel::testing
