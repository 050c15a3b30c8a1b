// Packs written section by section, so that what is larger than memory can be.
#pragma once

#include <functional>
#include <span>

#include "formats/core/bytes.h"
#include "formats/core/hash.h"
#include "formats/core/result.h"
#include "formats/pack/layout.h"
#include "formats/pack/pack.h"

namespace oriel {

// Puts bytes at an offset of the file, growing it; what nobody writes is 0. AtomicFile::write is one.
using PutBytes = std::function<Status(std::uint64_t offset, std::span<const std::byte> bytes)>;

// The next bytes of a section, at most `most` of them and at least one; called until the section is whole.
using NextBytes = std::function<Result<std::span<const std::byte>>(std::uint64_t most)>;

// Header, table, sections: offsets and checksums are kept on the way, and one section's piece at most is in memory.
// What the sections mean is the caller's concern (validate.h). Errors: those of put and next; kInvalid where a limit of
// the format is passed. After an error the file is of no use.
class PackStream {
 public:
  // section_count: so many sections will be added.
  PackStream(std::uint64_t section_count, PutBytes put);
  PackStream(const PackStream&) = delete;
  PackStream& operator=(const PackStream&) = delete;

  // A section, compressed unless that makes it longer. count: elements inside. head: so many bytes at its beginning are
  // to be had without decompressing more of it (section_head).
  Status add(std::uint32_t kind, std::uint64_t count, std::span<const std::byte> raw, std::size_t head = 0);
  // raw_bytes of a section, piece by piece. The codec is the caller's choice, as it cannot be taken back.
  Status add(std::uint32_t kind, std::uint64_t count, Codec codec, std::uint64_t raw_bytes, const NextBytes& next);
  // A section as it was found.
  Status add(const UnknownSection& unknown);

  // After the last section.
  Status finish();

 private:
  Status begin(SectionRecord record);
  Status put_stored(std::span<const std::byte> stored);
  Status end();
  template <class Take>
  Status for_each_piece(std::uint64_t raw_bytes, const NextBytes& next, const Take& take);
  Status put_compressed(std::uint64_t raw_bytes, const NextBytes& next);

  PutBytes put_;
  std::uint64_t section_count_ = 0;
  std::vector<SectionRecord> records_;
  std::uint64_t end_ = 0;        // of the file so far
  std::uint64_t raw_total_ = 0;  // of all sections
  Hasher64 hash_;                // of the section under way
};

}  // namespace oriel
