// PNG files, for pictures to look at and for masks.
#pragma once

#include <filesystem>

#include "formats/core/bytes.h"
#include "formats/core/result.h"
#include "formats/image/image.h"

namespace oriel {

// The bytes of a file: grey, RGB or RGBA with 8 bits a channel. The same image gives the same bytes. Errors: kInvalid
// for a shape that cannot be written, kRuntime.
Result<Bytes> encode_png(const ByteImage& image);

// The same as a file: path holds the old one or the whole new one. Errors also: kIo.
Status write_png(const std::filesystem::path& path, const ByteImage& image);

// Keeps the file's channels, except that grey with alpha becomes RGBA and 16 bits become 8. Errors: kIo, kInvalid.
Result<ByteImage> read_png(const std::filesystem::path& path);

}  // namespace oriel
