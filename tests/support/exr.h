// Pictures that tests read.
#pragma once

#include "formats/image/exr.h"

namespace oriel {

inline Result<FloatImage> read_exr(const std::filesystem::path& path) {
  ORIEL_TRY(LayeredImage image, read_layered_exr(path));
  return std::move(image.layers.at(""));
}

}  // namespace oriel
