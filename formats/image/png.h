// PNG files, for pictures to look at and for masks.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "formats/core/bytes.h"
#include "formats/core/result.h"
#include "formats/image/image.h"

namespace oriel {

// Notes in a file: international text chunks (iTXt, PNG 1.2 section 4.2.3). Keywords: 1 to 79 characters, ASCII; text:
// UTF-8.
using PngTexts = std::map<std::string, std::string>;

// The bytes of a file: grey, RGB or RGBA with 8 bits a channel. The same image gives the same bytes. Errors: kInvalid
// for a shape or a keyword that cannot be written, kRuntime.
Result<Bytes> encode_png(const ByteImage& image, const PngTexts& texts = {});

// The same as a file: path holds the old one or the whole new one. Errors also: kIo.
Status write_png(const std::filesystem::path& path, const ByteImage& image, const PngTexts& texts = {});

// Keeps the file's channels, except that grey with alpha becomes RGBA and 16 bits become 8. Errors: kIo, kInvalid.
Result<ByteImage> read_png(const std::filesystem::path& path);

// The international text chunks of a file that are not compressed, up to the first chunk that does not lie in the file.
// Errors: kIo; kInvalid where the file is no PNG.
Result<PngTexts> read_png_texts(const std::filesystem::path& path);

}  // namespace oriel
