// PNG, JPEG and WebP into RGBA8, Radiance and OpenEXR skies into floats. The only door to OpenImageIO.
#pragma once

#include <filesystem>
#include <span>

#include "bake/scene/scene.h"
#include "formats/core/bytes.h"
#include "formats/core/result.h"

namespace oriel {

inline constexpr std::uint32_t kMaxImageSize = 16384;  // texels a side

struct ImageSize {
  std::uint32_t width = 0, height = 0;
};

// From the header alone. Errors as decode_image.
Result<ImageSize> image_size(std::span<const std::byte> bytes, const std::string& name);

// Told by the first bytes, not by any name. Alpha is not multiplied in; 16-bit images are rounded to 8, of moving ones
// the first is taken. Error kInvalid
// for other formats (named where known), broken data, and sides beyond kMaxImageSize. May run in several threads at
// once.
Result<Image> decode_image(std::span<const std::byte> bytes, const std::string& name);

// A Radiance (.hdr) or OpenEXR file, told by its first bytes: channels R, G and B, or one channel as grey; values as
// they stand, which may be anything a float can be; not rotated. Errors: kIo; kInvalid as decode_image.
Result<ImageSize> sky_image_size(const std::filesystem::path& path);
Result<SkyImage> read_sky_image(const std::filesystem::path& path);

}  // namespace oriel
