#include "formats/export/ktx2.h"

#include <zstd.h>

#include <algorithm>
#include <cmath>

#include "formats/core/half.h"

namespace oriel {
namespace {

constexpr int kLevel = 15;  // of zstd: exports are written once and downloaded often
constexpr std::uint32_t kVkFormatE5b9g9r9 = 123, kZstandard = 2;
constexpr std::uint8_t kIdentifier[] = {0xAB, 'K', 'T', 'X', ' ', '2', '0', 0xBB, '\r', '\n', 0x1A, '\n'};
constexpr std::uint32_t kHeaderBytes = 80, kLevelIndexBytes = 24;

// A basic descriptor block: mantissas R, G, B of 9 bits at 0, 9, 18, each with the shared exponent at 27.
Bytes format_descriptor() {
  constexpr std::uint32_t kSamples = 6, kBlockBytes = 24 + 16 * kSamples;
  constexpr std::uint8_t kRgbsda = 1, kBt709 = 1, kLinear = 1, kExponent = 0x20;
  // The range of samples as the specification gives it for this very format.
  constexpr std::uint32_t kMantissaUpper = 8448, kExponentBias = 15, kMostExponent = 31;
  ByteWriter out;
  out.put(kBlockBytes + 4);
  out.put(std::uint32_t{0});  // vendor Khronos, type basic
  out.put(std::uint16_t{2});  // version: specification 1.3
  out.put(static_cast<std::uint16_t>(kBlockBytes));
  for (const std::uint8_t byte : {kRgbsda, kBt709, kLinear, std::uint8_t{0}}) out.put(byte);
  out.put(std::uint32_t{0});                      // texel block of 1 × 1 × 1 × 1
  out.put(std::uint64_t{sizeof(std::uint32_t)});  // bytes of its first plane; there is no other
  for (std::uint8_t channel = 0; channel < 3; ++channel)
    for (const bool exponent : {false, true}) {
      out.put(static_cast<std::uint16_t>(exponent ? 27 : 9 * channel));
      out.put(static_cast<std::uint8_t>((exponent ? 5 : 9) - 1));
      out.put(static_cast<std::uint8_t>(channel | (exponent ? kExponent : 0)));
      out.put(std::uint32_t{0});  // position
      out.put(exponent ? kExponentBias : 0u);
      out.put(exponent ? kMostExponent : kMantissaUpper);
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

Result<Bytes> compressed(std::span<const std::uint32_t> texels) {
  Bytes out(ZSTD_compressBound(texels.size_bytes()));
  const std::size_t size = ZSTD_compress(out.data(), out.size(), texels.data(), texels.size_bytes(), kLevel);
  if (ZSTD_isError(size)) return fail(ErrorCode::kRuntime, "KTX2", "zstd: {}", ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

}  // namespace

float ktx2_scale(const LightmapPage& page) {
  float most = 0, scale = 1;
  for (const Vec3& e : page.irradiance) most = std::max(most, max_component(e));
  while (most > kRgb9e5Max * scale) scale *= 2;
  return scale;
}

Result<Bytes> lightmap_ktx2(const LightmapPage& page) {
  const float scale = ktx2_scale(page);
  std::vector<std::uint32_t> texels;
  texels.reserve(page.irradiance.size());
  for (const Vec3& e : page.irradiance) texels.push_back(rgb9e5_from_rgb(e / scale));
  ORIEL_TRY(const Bytes level, compressed(texels));
  const Bytes descriptor = format_descriptor(), metadata = keys();
  const std::uint32_t descriptor_at = kHeaderBytes + kLevelIndexBytes;
  const auto metadata_at = static_cast<std::uint32_t>(descriptor_at + descriptor.size());
  ByteWriter out;
  out.put_array(std::span<const std::uint8_t>(kIdentifier));
  const std::uint32_t layers = 0, faces = 1, levels = 1, depth = 0;
  for (const std::uint32_t word : {kVkFormatE5b9g9r9, std::uint32_t{sizeof(std::uint32_t)}, page.width, page.height,
                                   depth, layers, faces, levels, kZstandard})
    out.put(word);
  for (const std::uint32_t word : {descriptor_at, static_cast<std::uint32_t>(descriptor.size()), metadata_at,
                                   static_cast<std::uint32_t>(metadata.size())})
    out.put(word);
  // No global data of the supercompression; then the one level.
  for (const std::uint64_t word : {std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{metadata_at + metadata.size()},
                                   std::uint64_t{level.size()}, std::uint64_t{texels.size() * sizeof(std::uint32_t)}})
    out.put(word);
  for (const Bytes* part : {&descriptor, &metadata, &level}) out.put_array(std::span(*part));
  return out.take();
}

double ktx2_rounding(const LightmapPage& page) {
  const float scale = ktx2_scale(page);
  double squares = 0, count = 0;
  for (const Vec3& e : page.irradiance) {
    const float most = max_component(e);
    if (!(most > 0)) continue;
    const DVec3 off = DVec3(rgb_from_rgb9e5(rgb9e5_from_rgb(e / scale)) * scale - e) / double{most};
    squares += glm::dot(off, off), count += 3;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

}  // namespace oriel
