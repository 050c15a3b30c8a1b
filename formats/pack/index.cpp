#include "formats/pack/index.h"

#include <zstd.h>

#include <algorithm>
#include <map>
#include <new>

#include "formats/core/hash.h"

namespace oriel {
namespace {

template <class T>
T load(std::span<const std::byte> file, std::size_t offset) {
  T value;
  std::memcpy(&value, file.data() + offset, sizeof(T));
  return value;
}

// file: the beginning, header and table, of file_bytes bytes.
Result<FileHeader> read_header(std::span<const std::byte> file, std::uint64_t file_bytes) {
  const std::size_t magic_bytes = std::min(file.size(), kPackMagic.size());
  if (magic_bytes == 0 || std::memcmp(file.data(), kPackMagic.data(), magic_bytes) != 0)
    return invalid("header", "is not an .oriel pack: the first bytes are not its magic");
  if (file.size() < sizeof(FileHeader))
    return invalid("header", "the file has {} bytes, expected at least the {} of a header", file.size(),
                   sizeof(FileHeader));
  const auto header = load<FileHeader>(file, 0);
  if (header.version != kPackVersion)
    return invalid("header", "found format version {}, this program reads version {}", header.version, kPackVersion);
  if (header.flags != 0) return invalid("header", "found flags {:#x}, expected 0 (reserved)", header.flags);
  if (header.record_bytes != sizeof(SectionRecord))
    return invalid("header", "found {} bytes a table record, expected {}", header.record_bytes, sizeof(SectionRecord));
  if (header.table_offset != sizeof(FileHeader))
    return invalid("header", "found the table at byte {}, expected {}", header.table_offset, sizeof(FileHeader));
  if (header.reserved[0] != 0 || header.reserved[1] != 0)
    return invalid("header", "found reserved bytes that are not zero");
  if (header.section_count > kMaxSections)
    return invalid("header", "found {} sections, at most {} are accepted", header.section_count, kMaxSections);
  const std::uint64_t table_end = sizeof(FileHeader) + std::uint64_t{header.section_count} * sizeof(SectionRecord);
  if (table_end > file.size())
    return invalid("section table", "the file ends at byte {}, inside the table of {} sections, expected at least {}",
                   file_bytes, header.section_count, table_end);
  Bytes covered(file.begin(), file.begin() + offsetof(FileHeader, checksum));
  covered.insert(covered.end(), file.begin() + sizeof(FileHeader),
                 file.begin() + static_cast<std::ptrdiff_t>(table_end));
  const std::uint64_t checksum = hash64(covered);
  if (checksum != header.checksum)
    return invalid("section table", "header and table have checksum {:016x}, expected {:016x}", checksum,
                   header.checksum);
  return header;
}

Status check_kind(const SectionInfo& section, std::uint64_t nth) {
  const auto* known = find_section_kind(section.kind);
  if (!known) {
    if (!section.optional)
      return invalid(section.label, "is of a kind that this program does not know, and is not marked as optional");
    return {};
  }
  if (known->optional != section.optional)
    return invalid(section.label, "found it marked as {}, expected {}", section.optional ? "optional" : "required",
                   known->optional ? "optional" : "required");
  if (!known->one_each && nth > 0) return invalid(section.label, "is there more than once, expected once");
  if (known->one_each && section.count != 1)
    return invalid(section.label, "found {} elements, expected 1", section.count);
  if (section.codec > static_cast<std::uint32_t>(Codec::kZstd))
    return invalid(section.label, "found codec {}, expected 0 (none) or 1 (zstd)", section.codec);
  return {};
}

Status check_sizes(const SectionInfo& section, std::uint64_t expected_offset, std::uint64_t file_bytes) {
  if (section.offset != expected_offset)
    return invalid(section.label, "found it at byte {}, expected {}", section.offset, expected_offset);
  if (section.offset > file_bytes || section.stored_bytes > file_bytes - section.offset)
    return invalid(section.label, "the file is truncated: it ends at byte {}, expected at least {} bytes from byte {}",
                   file_bytes, section.stored_bytes, section.offset);
  if (section.codec == static_cast<std::uint32_t>(Codec::kNone) && section.raw_bytes != section.stored_bytes)
    return invalid(section.label, "found {} raw bytes, expected the {} that are stored", section.raw_bytes,
                   section.stored_bytes);
  if (section.raw_bytes / kMaxExpansion > section.stored_bytes)
    return invalid(section.label, "found {} raw bytes for {} stored, at most {} for each are accepted",
                   section.raw_bytes, section.stored_bytes, kMaxExpansion);
  return {};
}

}  // namespace

std::string kind_text(std::uint32_t kind) {
  std::string text;
  for (int i = 0; i < 4; ++i) {
    const auto c = static_cast<unsigned char>(kind >> 8 * i);
    if (c < 32 || c > 126) return fmt::format("{:#010x}", kind);
    text += static_cast<char>(c);
  }
  return text;
}

std::string section_label(std::uint32_t kind, std::uint64_t nth) {
  const auto* known = find_section_kind(kind);
  if (!known) return fmt::format("section {} (unknown)", kind_text(kind));
  if (!known->one_each) return fmt::format("section {} ({})", kind_text(kind), known->meaning);
  return fmt::format("section {} {} ({})", kind_text(kind), nth, known->meaning);
}

std::uint64_t index_bytes(std::span<const std::byte> front, std::uint64_t file_bytes) {
  std::uint64_t bytes = sizeof(FileHeader);
  if (front.size() >= sizeof(FileHeader)) {
    const auto sections = std::min<std::uint64_t>(load<FileHeader>(front, 0).section_count, kMaxSections);
    bytes += sections * sizeof(SectionRecord);
  }
  return std::min(bytes, file_bytes);
}

Result<PackIndex> read_index(std::span<const std::byte> file, std::uint64_t file_bytes) {
  ORIEL_TRY(const FileHeader header, read_header(file, file_bytes));
  PackIndex index{header.version, header.file_bytes, {}};
  std::map<std::uint32_t, std::uint64_t> seen;
  std::uint64_t end = sizeof(FileHeader) + std::uint64_t{header.section_count} * sizeof(SectionRecord);
  std::uint64_t raw_total = 0;
  for (std::uint32_t i = 0; i < header.section_count; ++i) {
    const auto record = load<SectionRecord>(file, sizeof(FileHeader) + i * sizeof(SectionRecord));
    const std::uint64_t nth = seen[record.kind]++;
    SectionInfo section{record.kind,
                        record.codec,
                        (record.flags & kSectionOptional) != 0,
                        record.offset,
                        record.stored_bytes,
                        record.raw_bytes,
                        record.count,
                        record.checksum,
                        section_offset_from(end) - end,
                        nth,
                        section_label(record.kind, nth)};
    if ((record.flags & ~kSectionOptional) != 0 || record.reserved0 != 0 || record.reserved1 != 0)
      return invalid(section.label, "found reserved bits that are not zero");
    ORIEL_TRY_VOID(check_kind(section, nth));
    ORIEL_TRY_VOID(check_sizes(section, section_offset_from(end), file_bytes));
    // Each addend is at most kMaxExpansion times the file's length; the sum is checked before it can wrap.
    if (section.raw_bytes > kMaxRawBytes || (raw_total += section.raw_bytes) > kMaxRawBytes)
      return invalid(section.label, "the sections hold more than the accepted {} bytes when decompressed",
                     kMaxRawBytes);
    end = section.offset + section.stored_bytes;
    index.sections.push_back(std::move(section));
  }
  for (const auto& kind : kSectionKinds)
    if (kind.required && !seen.contains(kind.kind))
      return invalid("section table", "has no {}, expected one", section_label(kind.kind, 0));
  if (header.file_bytes != end)
    return invalid("header", "found a file length of {} bytes, but the last section ends at {}", header.file_bytes,
                   end);
  if (file_bytes != end)
    return invalid("header", "found {} bytes after the last section, expected none", file_bytes - end);
  return index;
}

Result<PackIndex> read_index(std::span<const std::byte> file) {
  ORIEL_TRY(PackIndex index, read_index(file, file.size()));
  for (const SectionInfo& section : index.sections)
    ORIEL_TRY_VOID(check_padding(file.subspan(section.offset - section.padding, section.padding), section));
  return index;
}

Status check_padding(std::span<const std::byte> padding, const SectionInfo& section) {
  if (std::any_of(padding.begin(), padding.end(), [](std::byte b) { return b != std::byte{0}; }))
    return invalid(section.label, "the padding before it is not zero");
  return {};
}

std::span<const std::byte> stored_bytes(std::span<const std::byte> file, const SectionInfo& section) {
  return file.subspan(section.offset, section.stored_bytes);
}

Status check_section(std::span<const std::byte> file, const SectionInfo& section) {
  return check_stored(stored_bytes(file, section), section);
}

Status check_stored(std::span<const std::byte> stored, const SectionInfo& section) {
  const std::uint64_t checksum = hash64(stored);
  if (checksum != section.checksum)
    return invalid(section.label, "checksum {:016x}, expected {:016x}", checksum, section.checksum);
  return {};
}

namespace {

// Of this thread: making one for each section takes as long as reading a small one.
ZSTD_DCtx* decompressor() {
  thread_local const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  return context.get();
}

// Whether the stored bytes are one zstd frame of the section's size.
Status check_frame(std::span<const std::byte> stored, const SectionInfo& section) {
  if (section.codec != static_cast<std::uint32_t>(Codec::kZstd))
    return invalid(section.label, "found codec {}, expected 0 (none) or 1 (zstd)", section.codec);
  const auto content = ZSTD_getFrameContentSize(stored.data(), stored.size());
  if (content == ZSTD_CONTENTSIZE_ERROR || content == ZSTD_CONTENTSIZE_UNKNOWN)
    return invalid(section.label, "is not a zstd frame that states its content's size");
  if (content != section.raw_bytes)
    return invalid(section.label, "its zstd frame holds {} bytes, expected {}", static_cast<std::uint64_t>(content),
                   section.raw_bytes);
  const std::size_t frame = ZSTD_findFrameCompressedSize(stored.data(), stored.size());
  if (ZSTD_isError(frame) || frame != stored.size())
    return invalid(section.label, "is not exactly one zstd frame of {} bytes", stored.size());
  return {};
}

}  // namespace

Result<RawBytes> section_bytes(std::span<const std::byte> file, const SectionInfo& section) {
  ORIEL_TRY_VOID(check_section(file, section));
  return decompressed(stored_bytes(file, section), section, section.raw_bytes);
}

namespace {

// Fills `out` with the beginning of a frame, of which `front` is the beginning; false where that is too short for it.
Result<bool> decompress_head(std::span<const std::byte> front, const SectionInfo& section, ZSTD_outBuffer& out) {
  ZSTD_DCtx* context = decompressor();
  ZSTD_DCtx_reset(context, ZSTD_reset_session_only);
  // No more is given at once than the decoder asks for: it would begin with the block behind what is wanted.
  ZSTD_inBuffer in{front.data(), 0, 0};
  for (std::size_t asked = 1; out.pos < out.size;) {
    in.size = std::min(in.size + asked, front.size());
    const std::size_t before = in.pos + out.pos;
    asked = ZSTD_decompressStream(context, &out, &in);
    if (ZSTD_isError(asked)) return invalid(section.label, "cannot be decompressed: {}", ZSTD_getErrorName(asked));
    if (in.pos + out.pos != before) continue;
    if (front.size() < section.stored_bytes) return false;
    return invalid(section.label, "decompressed to {} bytes, expected {}", out.pos, out.size);
  }
  return true;
}

}  // namespace

Result<RawBytes> decompressed(std::span<const std::byte> stored, const SectionInfo& section, std::uint64_t bytes) {
  bytes = std::min(bytes, section.raw_bytes);
  RawBytes raw{std::make_unique_for_overwrite<std::byte[]>(bytes), bytes};
  ORIEL_TRY_VOID(decompress(stored, section, {raw.data.get(), raw.size}));
  return raw;
}

Status decompress(std::span<const std::byte> stored, const SectionInfo& section, std::span<std::byte> to) {
  if (section.codec == static_cast<std::uint32_t>(Codec::kNone)) {
    std::copy_n(stored.begin(), to.size(), to.begin());
    return {};
  }
  ORIEL_TRY_VOID(check_frame(stored, section));
  if (to.size() < section.raw_bytes) {
    ZSTD_outBuffer out{to.data(), to.size(), 0};
    ORIEL_TRY_VOID(decompress_head(stored, section, out));
    return {};
  }
  const std::size_t n = ZSTD_decompressDCtx(decompressor(), to.data(), to.size(), stored.data(), stored.size());
  if (ZSTD_isError(n)) return invalid(section.label, "cannot be decompressed: {}", ZSTD_getErrorName(n));
  if (n != to.size()) return invalid(section.label, "decompressed to {} bytes, expected {}", n, to.size());
  return {};
}

Result<Bytes> stored_head(std::span<const std::byte> front, const SectionInfo& section, std::size_t bytes) {
  Bytes head(std::min<std::uint64_t>(bytes, section.raw_bytes));
  if (section.codec == static_cast<std::uint32_t>(Codec::kNone)) {
    if (front.size() < head.size()) return Bytes();
    std::copy_n(front.begin(), head.size(), head.begin());
    return head;
  }
  if (front.size() == section.stored_bytes) ORIEL_TRY_VOID(check_frame(front, section));
  ZSTD_outBuffer out{head.data(), head.size(), 0};
  ORIEL_TRY(const bool enough, decompress_head(front, section, out));
  return enough ? head : Bytes();
}

}  // namespace oriel
