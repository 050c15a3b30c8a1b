// OpenEXR files, for results that must keep their floats.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "formats/core/result.h"
#include "formats/image/image.h"

namespace oriel {

// Writes scanlines of 32-bit floats, ZIP-compressed, channels Y, RGB or RGBA; attributes become string attributes of
// the header. Values are written as they are, NaN and infinity too. The same image gives the same bytes; path holds the
// old file or the whole new one. Errors: kInvalid for a shape or an attribute that cannot be written, kIo.
Status write_exr(const std::filesystem::path& path, const FloatImage& image,
                 const std::map<std::string, std::string>& attributes = {});

// Several pictures of one size in one file: the layer "" has the plain channels, the layer "specular" has specular.R
// and so on, as compositors show them.
struct LayeredImage {
  std::map<std::string, FloatImage> layers;
  std::map<std::string, std::string> attributes;
};
// The same of layers; the one without a name must be there. Errors also: kInvalid for layers that differ in size.
Status write_exr(const std::filesystem::path& path, const LayeredImage& image);

// Reads every layer that has R, G, B (and A) or Y of a flat, single-part file of any pixel type and compression, and
// the string attributes. Errors: kIo; kInvalid for deep and multi-part files, subsampled or missing channels.
Result<LayeredImage> read_layered_exr(const std::filesystem::path& path);

}  // namespace oriel
