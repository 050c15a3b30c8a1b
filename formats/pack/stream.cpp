#include "formats/pack/stream.h"

#include <zstd.h>

#include <algorithm>
#include <memory>

#include "formats/core/check.h"

namespace oriel {
namespace {

// Level 6 saves 1 to 2 % on maps for two to three times the time, level 15 no more than that (measured:
// docs/notes/format.md).
constexpr int kZstdLevel = 3;

using Compressor = std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)>;

Compressor make_compressor() {
  Compressor compressor(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  ORIEL_CHECK(compressor != nullptr);
  ORIEL_CHECK(!ZSTD_isError(ZSTD_CCtx_setParameter(compressor.get(), ZSTD_c_compressionLevel, kZstdLevel)));
  return compressor;
}

// The first `head` bytes are a block of their own.
Bytes compressed(std::span<const std::byte> raw, std::size_t head) {
  Bytes stored(ZSTD_compressBound(raw.size()) + head);
  const Compressor compressor = make_compressor();
  // The frame states its content's size.
  ORIEL_CHECK(!ZSTD_isError(ZSTD_CCtx_setPledgedSrcSize(compressor.get(), raw.size())));
  ZSTD_inBuffer in{raw.data(), std::min(head, raw.size()), 0};
  ZSTD_outBuffer out{stored.data(), stored.size(), 0};
  if (in.size > 0) ORIEL_CHECK_EQ(ZSTD_compressStream2(compressor.get(), &out, &in, ZSTD_e_flush), 0u);
  in.size = raw.size();
  ORIEL_CHECK_EQ(ZSTD_compressStream2(compressor.get(), &out, &in, ZSTD_e_end), 0u);
  stored.resize(out.pos);
  return stored;
}

template <class T>
std::span<const std::byte> bytes_of(const T* values, std::size_t count) {
  return std::as_bytes(std::span(values, count));
}

}  // namespace

PackStream::PackStream(std::uint64_t section_count, PutBytes put)
    : put_(std::move(put)),
      section_count_(section_count),
      end_(sizeof(FileHeader) + section_count * sizeof(SectionRecord)) {}

Status PackStream::begin(SectionRecord record) {
  if (section_count_ > kMaxSections)
    return invalid("section table", "found {} sections, at most {} are accepted", section_count_, kMaxSections);
  ORIEL_CHECK_LT(records_.size(), section_count_);
  if (record.raw_bytes > kMaxRawBytes || (raw_total_ += record.raw_bytes) > kMaxRawBytes)
    return invalid(section_label(record.kind, 0), "the sections hold more than the accepted {} bytes when decompressed",
                   kMaxRawBytes);
  const auto* known = find_section_kind(record.kind);
  record.flags = !known || known->optional ? kSectionOptional : 0;
  record.offset = end_ = section_offset_from(end_);
  records_.push_back(record);
  hash_.reset();
  return put_(end_, {});  // the padding before it is there even where nothing follows
}

Status PackStream::put_stored(std::span<const std::byte> stored) {
  hash_.add(stored);
  ORIEL_TRY_VOID(put_(end_, stored));
  end_ += stored.size();
  return {};
}

Status PackStream::end() {
  SectionRecord& record = records_.back();
  record.stored_bytes = end_ - record.offset;
  record.checksum = hash_.result();
  if (record.raw_bytes / kMaxExpansion > record.stored_bytes)
    return invalid(section_label(record.kind, 0), "found {} raw bytes for {} stored, at most {} for each are accepted",
                   record.raw_bytes, record.stored_bytes, kMaxExpansion);
  return {};
}

Status PackStream::add(std::uint32_t kind, std::uint64_t count, std::span<const std::byte> raw, std::size_t head) {
  Bytes packed = compressed(raw, head);
  // Bytes that do not shrink are stored as they are. The other bound is the reader's, against decompression bombs.
  const bool shrinks = packed.size() < raw.size() && raw.size() / kMaxExpansion <= packed.size();
  SectionRecord record{};
  record.kind = kind;
  record.codec = static_cast<std::uint32_t>(shrinks ? Codec::kZstd : Codec::kNone);
  record.raw_bytes = raw.size();
  record.count = count;
  ORIEL_TRY_VOID(begin(record));
  ORIEL_TRY_VOID(put_stored(shrinks ? packed : raw));
  return end();
}

Status PackStream::add(const UnknownSection& unknown) {
  SectionRecord record{};
  record.kind = unknown.kind;
  record.codec = unknown.codec;
  record.raw_bytes = unknown.raw_bytes;
  record.count = unknown.count;
  ORIEL_TRY_VOID(begin(record));
  ORIEL_TRY_VOID(put_stored(unknown.stored));
  return end();
}

template <class Take>
Status PackStream::for_each_piece(std::uint64_t raw_bytes, const NextBytes& next, const Take& take) {
  for (std::uint64_t left = raw_bytes; left > 0;) {
    ORIEL_TRY(const std::span<const std::byte> piece, next(left));
    ORIEL_CHECK(!piece.empty() && piece.size() <= left);
    left -= piece.size();
    ORIEL_TRY_VOID(take(piece, left == 0));
  }
  return {};
}

Status PackStream::put_compressed(std::uint64_t raw_bytes, const NextBytes& next) {
  const Compressor compressor = make_compressor();
  // The frame states its content's size.
  ORIEL_CHECK(!ZSTD_isError(ZSTD_CCtx_setPledgedSrcSize(compressor.get(), raw_bytes)));
  Bytes buffer(ZSTD_CStreamOutSize());
  return for_each_piece(raw_bytes, next, [&](std::span<const std::byte> piece, bool last) -> Status {
    ZSTD_inBuffer in{piece.data(), piece.size(), 0};
    for (bool done = false; !done;) {
      ZSTD_outBuffer out{buffer.data(), buffer.size(), 0};
      const std::size_t rest = ZSTD_compressStream2(compressor.get(), &out, &in, last ? ZSTD_e_end : ZSTD_e_continue);
      ORIEL_CHECK(!ZSTD_isError(rest));
      ORIEL_TRY_VOID(put_stored(std::span(buffer).first(out.pos)));
      done = last ? rest == 0 : in.pos == in.size;
    }
    return {};
  });
}

Status PackStream::add(std::uint32_t kind, std::uint64_t count, Codec codec, std::uint64_t raw_bytes,
                       const NextBytes& next) {
  SectionRecord record{};
  record.kind = kind;
  record.codec = static_cast<std::uint32_t>(codec);
  record.raw_bytes = raw_bytes;
  record.count = count;
  ORIEL_TRY_VOID(begin(record));
  if (codec == Codec::kZstd && raw_bytes > 0)
    ORIEL_TRY_VOID(put_compressed(raw_bytes, next));
  else
    ORIEL_TRY_VOID(
        for_each_piece(raw_bytes, next, [&](std::span<const std::byte> piece, bool) { return put_stored(piece); }));
  return end();
}

Status PackStream::finish() {
  ORIEL_CHECK_EQ(records_.size(), section_count_);
  FileHeader header{};
  header.magic = kPackMagic;
  header.version = kPackVersion;
  header.section_count = static_cast<std::uint32_t>(section_count_);
  header.record_bytes = sizeof(SectionRecord);
  header.table_offset = sizeof(FileHeader);
  header.file_bytes = end_;
  const auto table = bytes_of(records_.data(), records_.size());
  hash_.reset();
  hash_.add(bytes_of(&header, 1).first(offsetof(FileHeader, checksum)));
  hash_.add(table);
  header.checksum = hash_.result();
  ORIEL_TRY_VOID(put_(0, bytes_of(&header, 1)));
  return put_(sizeof(FileHeader), table);
}

}  // namespace oriel
