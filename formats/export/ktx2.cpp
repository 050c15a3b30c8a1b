#include "formats/export/ktx2.h"

#include <zstd.h>

#include <bit>

namespace oriel {
namespace {

constexpr int kLevel = 15;               // of zstd: exports are written once and downloaded often
constexpr std::uint32_t kZstandard = 2;  // scheme of supercompression
constexpr std::uint8_t kIdentifier[] = {0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};
constexpr std::uint32_t kHeaderBytes = 80, kLevelIndexBytes = 24;
// Of the Khronos Data Format Specification.
constexpr std::uint8_t kRgbsda = 1, kBc6h = 133, kBt709 = 1, kLinear = 1;
constexpr std::uint8_t kExponent = 0x20, kFloat = 0x80;

struct Sample {
  std::uint16_t bit;
  std::uint8_t bits, channel;
  std::uint32_t lower, upper;
};

struct Coding {
  std::uint32_t vk_format, type_bytes;
  std::uint8_t model, block_side, block_bytes;
  std::vector<Sample> samples;
};

Coding coding_of(TexelCoding coding) {
  if (coding == TexelCoding::kBc6h)
    return {131, 1, kBc6h, 4, 16, {{0, 128, kFloat, 0, std::bit_cast<std::uint32_t>(1.0f)}}};
  // Mantissas R, G, B of 9 bits at 0, 9, 18, each with the shared exponent at 27; the range of samples as the
  // specification gives it for this very format.
  Coding out{123, 4, kRgbsda, 1, 4, {}};
  for (std::uint8_t channel = 0; channel < 3; ++channel) {
    out.samples.push_back({static_cast<std::uint16_t>(9 * channel), 9, channel, 0, 8448});
    out.samples.push_back({27, 5, static_cast<std::uint8_t>(channel | kExponent), 15, 31});
  }
  return out;
}

// A basic descriptor block.
Bytes format_descriptor(const Coding& coding) {
  const auto block_bytes = static_cast<std::uint32_t>(24 + 16 * coding.samples.size());
  const auto side = static_cast<std::uint8_t>(coding.block_side - 1);
  ByteWriter out;
  out.put(block_bytes + 4);
  out.put(std::uint32_t{0});  // vendor Khronos, type basic
  out.put(std::uint16_t{2});  // version: specification 1.3
  out.put(static_cast<std::uint16_t>(block_bytes));
  for (const std::uint8_t byte : {coding.model, kBt709, kLinear, std::uint8_t{0}}) out.put(byte);
  for (const std::uint8_t byte : {side, side, std::uint8_t{0}, std::uint8_t{0}}) out.put(byte);
  out.put(std::uint64_t{coding.block_bytes});  // of the first plane; there is no other
  for (const Sample& sample : coding.samples) {
    out.put(sample.bit);
    out.put(static_cast<std::uint8_t>(sample.bits - 1));
    out.put(sample.channel);
    out.put(std::uint32_t{0});  // position
    out.put(sample.lower);
    out.put(sample.upper);
  }
  return out.take();
}

void put_key(std::string_view key, std::string_view value, ByteWriter& out) {
  const std::size_t bytes = key.size() + value.size() + 2;  // each ends with a zero
  out.put(static_cast<std::uint32_t>(bytes));
  out.put_array(std::span(key.data(), key.size()));
  out.put('\0');
  out.put_array(std::span(value.data(), value.size()));
  for (std::size_t i = 0; i <= (4 - bytes % 4) % 4; ++i) out.put('\0');
}

Bytes keys() {
  ByteWriter out;
  put_key("KTXorientation", "rd", out);  // rows go down, as v does
  put_key("KTXwriter", "oriel-inspect", out);
  return out.take();
}

Result<Bytes> compressed(std::span<const std::byte> level) {
  Bytes out(ZSTD_compressBound(level.size()));
  const std::size_t size = ZSTD_compress(out.data(), out.size(), level.data(), level.size(), kLevel);
  if (ZSTD_isError(size)) return fail(ErrorCode::kRuntime, "KTX2", "zstd: {}", ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

}  // namespace

Result<Bytes> ktx2_file(const Ktx2Texture& texture) {
  const Coding coding = coding_of(texture.coding);
  ORIEL_TRY(const Bytes level, compressed(texture.level));
  const Bytes descriptor = format_descriptor(coding), metadata = keys();
  const std::uint32_t descriptor_at = kHeaderBytes + kLevelIndexBytes;
  const auto metadata_at = static_cast<std::uint32_t>(descriptor_at + descriptor.size());
  ByteWriter out;
  out.put_array(std::span<const std::uint8_t>(kIdentifier));
  const std::uint32_t layers = 0, levels = 1, depth = 0;
  for (const std::uint32_t word : {coding.vk_format, coding.type_bytes, texture.width, texture.height, depth, layers,
                                   texture.faces, levels, kZstandard})
    out.put(word);
  for (const std::uint32_t word : {descriptor_at, static_cast<std::uint32_t>(descriptor.size()), metadata_at,
                                   static_cast<std::uint32_t>(metadata.size())})
    out.put(word);
  // No global data of the supercompression; then the one level.
  for (const std::uint64_t word : {std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{metadata_at + metadata.size()},
                                   std::uint64_t{level.size()}, std::uint64_t{texture.level.size()}})
    out.put(word);
  for (const Bytes* part : {&descriptor, &metadata, &level}) out.put_array(std::span(*part));
  return out.take();
}

}  // namespace oriel
