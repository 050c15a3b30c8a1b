#include "formats/image/png.h"

#include <algorithm>
#include <memory>
#include <span>
#include <string_view>

#include "formats/core/file.h"

// Static, so that other users of stb in the same program do not clash.
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 32768
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace oriel {
namespace {

constexpr std::size_t kFirstChunk = 8 + 25;  // after the signature and IHDR

void append(std::string_view text, Bytes& to) {
  for (const char c : text) to.push_back(static_cast<std::byte>(c));
}

void append_big_endian(std::uint32_t value, Bytes& to) {
  for (int shift = 24; shift >= 0; shift -= 8) to.push_back(static_cast<std::byte>(value >> shift & 0xff));
}

// ISO 3309, as PNG's appendix has it.
std::uint32_t crc32(std::span<const std::byte> bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const std::byte b : bytes) {
    crc ^= std::to_integer<std::uint32_t>(b);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
  }
  return ~crc;
}

Result<Bytes> text_chunks(const PngTexts& texts) {
  Bytes out;
  for (const auto& [keyword, text] : texts) {
    const bool ascii = std::all_of(keyword.begin(), keyword.end(), [](char c) { return c > ' ' && c <= '~'; });
    if (keyword.empty() || keyword.size() > 79 || !ascii)
      return invalid("", "found the keyword \"{}\", expected 1 to 79 ASCII characters", keyword);
    Bytes chunk;
    append("iTXt", chunk);
    append(keyword, chunk);
    append(std::string_view("\0\0\0\0\0", 5), chunk);  // not compressed; no language, no translated keyword
    append(text, chunk);
    append_big_endian(static_cast<std::uint32_t>(chunk.size() - 4), out);
    out.insert(out.end(), chunk.begin(), chunk.end());
    append_big_endian(crc32(chunk), out);
  }
  return out;
}

std::uint32_t big_endian_at(std::span<const std::byte> bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | std::to_integer<std::uint32_t>(bytes[i]);
  return value;
}

// The inside of an iTXt chunk: keyword, 0, compressed, method, language, 0, keyword in that language, 0, text.
void add_text(std::string_view chunk, PngTexts& texts) {
  const std::size_t keyword = chunk.find('\0');
  if (keyword == std::string_view::npos || keyword + 3 > chunk.size() || chunk[keyword + 1] != 0) return;
  const std::size_t language = chunk.find('\0', keyword + 3);
  if (language == std::string_view::npos) return;
  const std::size_t translated = chunk.find('\0', language + 1);
  if (translated == std::string_view::npos) return;
  texts.emplace(chunk.substr(0, keyword), chunk.substr(translated + 1));
}

}  // namespace

Result<Bytes> encode_png(const ByteImage& image, const PngTexts& texts) {
  if (image.channels != 1 && image.channels != 3 && image.channels != 4)
    return invalid("", "found {} channels, expected 1, 3 or 4", image.channels);
  if (image.width == 0 || image.height == 0 || image.width > STBI_MAX_DIMENSIONS || image.height > STBI_MAX_DIMENSIONS)
    return invalid("", "found {} x {} pixels, expected 1 to {} a side", image.width, image.height, STBI_MAX_DIMENSIONS);
  const std::uint64_t expected = std::uint64_t{image.width} * image.height * image.channels;
  if (image.pixels.size() != expected || expected > 0x7fff0000)
    return invalid("", "found {} values, expected {} and less than 2^31", image.pixels.size(), expected);
  ORIEL_TRY(const Bytes chunks, text_chunks(texts));
  Bytes bytes;
  const auto take = [](void* to, void* data, int size) {
    const auto* p = static_cast<const std::byte*>(data);
    static_cast<Bytes*>(to)->insert(static_cast<Bytes*>(to)->end(), p, p + size);
  };
  const int stride = static_cast<int>(image.width * image.channels);
  if (!stbi_write_png_to_func(take, &bytes, static_cast<int>(image.width), static_cast<int>(image.height),
                              static_cast<int>(image.channels), image.pixels.data(), stride))
    return fail(ErrorCode::kRuntime, "", "cannot be encoded as PNG");
  bytes.insert(bytes.begin() + kFirstChunk, chunks.begin(), chunks.end());
  return bytes;
}

Status write_png(const std::filesystem::path& path, const ByteImage& image, const PngTexts& texts) {
  auto bytes = encode_png(image, texts);
  if (!bytes) {
    bytes.error().where = path.string();
    return tl::unexpected<Error>(bytes.error());
  }
  return write_file_atomically(path, *bytes);
}

Result<ByteImage> read_png(const std::filesystem::path& path) {
  ORIEL_TRY(const Bytes bytes, read_file(path, 0x7fffffff));
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels))
    return invalid(path.string(), "is not a PNG file that can be read: {}", stbi_failure_reason());
  if (channels == 2) channels = 4;
  int in_file = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(data, size, &width, &height, &in_file, channels), &stbi_image_free);
  if (!pixels) return invalid(path.string(), "is a broken PNG file: {}", stbi_failure_reason());
  ByteImage image{
      static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), static_cast<std::uint32_t>(channels), {}};
  const std::size_t count = std::size_t{image.width} * image.height * image.channels;
  image.pixels.assign(pixels.get(), pixels.get() + count);
  return image;
}

Result<PngTexts> read_png_texts(const std::filesystem::path& path) {
  ORIEL_TRY(const Bytes bytes, read_file(path, 0x7fffffff));
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (!all.starts_with(kSignature)) return invalid(path.string(), "is not a PNG file");
  PngTexts texts;
  // A chunk: length, type, that many bytes, checksum.
  for (std::size_t at = kSignature.size(); bytes.size() - at >= 12;) {
    const std::size_t length = big_endian_at(bytes, at);
    if (length > bytes.size() - at - 12) break;
    if (all.substr(at + 4, 4) == "iTXt") add_text(all.substr(at + 8, length), texts);
    at += 12 + length;
  }
  return texts;
}

}  // namespace oriel
