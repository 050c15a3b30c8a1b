// Builds pack files that are wrong in a chosen way but whole otherwise: every checksum, size and offset is put right,
// so that the decoders behind the checksums meet the bytes.
#pragma once

#include <zstd.h>

#include <cstring>
#include <vector>

#include "formats/core/hash.h"
#include "formats/pack/index.h"

namespace oriel::testing {

struct ForgedSection {
  SectionRecord record{};
  Bytes stored;
};

struct Forge {
  std::vector<ForgedSection> sections;
  std::uint32_t version = kPackVersion;

  // From a file that read_index accepts.
  static Forge from(const Bytes& file) {
    Forge forge;
    const auto index = *read_index(file);
    for (std::size_t i = 0; i < index.sections.size(); ++i) {
      ForgedSection section;
      std::memcpy(&section.record, file.data() + sizeof(FileHeader) + i * sizeof(SectionRecord), sizeof(SectionRecord));
      const auto stored = stored_bytes(file, index.sections[i]);
      section.stored.assign(stored.begin(), stored.end());
      forge.sections.push_back(std::move(section));
    }
    return forge;
  }

  ForgedSection& find(std::uint32_t kind) {
    for (auto& section : sections)
      if (section.record.kind == kind) return section;
    return sections.at(0);
  }

  static Bytes raw(const ForgedSection& section) {
    if (section.record.codec != 1) return section.stored;
    Bytes bytes(section.record.raw_bytes);
    ZSTD_decompress(bytes.data(), bytes.size(), section.stored.data(), section.stored.size());
    return bytes;
  }
  static void set_raw(ForgedSection& section, const Bytes& bytes) {
    section.record.codec = 0;
    section.record.raw_bytes = bytes.size();
    section.stored = bytes;
  }
  // As zstd, with a frame that is whole.
  static void set_compressed(ForgedSection& section, const Bytes& bytes) {
    section.record.codec = 1;
    section.record.raw_bytes = bytes.size();
    section.stored.resize(ZSTD_compressBound(bytes.size()));
    section.stored.resize(ZSTD_compress(section.stored.data(), section.stored.size(), bytes.data(), bytes.size(), 1));
  }

  Bytes file() const {
    FileHeader header{};
    header.magic = kPackMagic;
    header.version = version;
    header.section_count = static_cast<std::uint32_t>(sections.size());
    header.record_bytes = sizeof(SectionRecord);
    header.table_offset = sizeof(FileHeader);
    std::uint64_t end = sizeof(FileHeader) + sections.size() * sizeof(SectionRecord);
    std::vector<SectionRecord> records;
    for (const auto& section : sections) {
      SectionRecord record = section.record;
      record.offset = (end + kSectionAlignment - 1) / kSectionAlignment * kSectionAlignment;
      record.stored_bytes = section.stored.size();
      record.checksum = hash64(section.stored);
      end = record.offset + record.stored_bytes;
      records.push_back(record);
    }
    header.file_bytes = end;
    Bytes bytes(end);
    std::memcpy(bytes.data(), &header, sizeof(header));
    for (std::size_t i = 0; i < records.size(); ++i) {
      std::memcpy(bytes.data() + sizeof(FileHeader) + i * sizeof(SectionRecord), &records[i], sizeof(SectionRecord));
      if (!sections[i].stored.empty())
        std::memcpy(bytes.data() + records[i].offset, sections[i].stored.data(), sections[i].stored.size());
    }
    seal(bytes);
    return bytes;
  }

  // Puts the checksum of header and table right after bytes in them were changed.
  static void seal(Bytes& bytes) {
    FileHeader header;
    std::memcpy(&header, bytes.data(), sizeof(header));
    Bytes covered(bytes.begin(), bytes.begin() + offsetof(FileHeader, checksum));
    const std::size_t table_end = sizeof(FileHeader) + header.section_count * sizeof(SectionRecord);
    covered.insert(covered.end(), bytes.begin() + sizeof(FileHeader),
                   bytes.begin() + static_cast<std::ptrdiff_t>(table_end));
    const std::uint64_t checksum = hash64(covered);
    std::memcpy(bytes.data() + offsetof(FileHeader, checksum), &checksum, sizeof(checksum));
  }
};

}  // namespace oriel::testing
