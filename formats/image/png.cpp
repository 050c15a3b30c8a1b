#include "formats/image/png.h"

#include <memory>

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

Result<Bytes> encode_png(const ByteImage& image) {
  if (image.channels != 1 && image.channels != 3 && image.channels != 4)
    return invalid("", "found {} channels, expected 1, 3 or 4", image.channels);
  if (image.width == 0 || image.height == 0 || image.width > STBI_MAX_DIMENSIONS || image.height > STBI_MAX_DIMENSIONS)
    return invalid("", "found {} x {} pixels, expected 1 to {} a side", image.width, image.height, STBI_MAX_DIMENSIONS);
  const std::uint64_t expected = std::uint64_t{image.width} * image.height * image.channels;
  if (image.pixels.size() != expected || expected > 0x7fff0000)
    return invalid("", "found {} values, expected {} and less than 2^31", image.pixels.size(), expected);
  Bytes bytes;
  const auto append = [](void* to, void* data, int size) {
    const auto* p = static_cast<const std::byte*>(data);
    static_cast<Bytes*>(to)->insert(static_cast<Bytes*>(to)->end(), p, p + size);
  };
  const int stride = static_cast<int>(image.width * image.channels);
  if (!stbi_write_png_to_func(append, &bytes, static_cast<int>(image.width), static_cast<int>(image.height),
                              static_cast<int>(image.channels), image.pixels.data(), stride))
    return fail(ErrorCode::kRuntime, "", "cannot be encoded as PNG");
  return bytes;
}

Status write_png(const std::filesystem::path& path, const ByteImage& image) {
  auto bytes = encode_png(image);
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

}  // namespace oriel
