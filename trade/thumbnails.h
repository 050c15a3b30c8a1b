// Pictures within a page: cut out of what oriel-play --compare wrote, as data URIs.
#pragma once

#include <filesystem>
#include <string>

#include "formats/core/result.h"

namespace oriel::trade {

struct Thumbnails {
  std::string reference, frame, flip;  // data URIs of PNG files
  std::uint32_t width = 0, height = 0;
};

// Of a picture of three side by side; wider ones than `widest` are averaged over whole blocks of pixels. Errors: kIo;
// kInvalid for a picture whose width 3 does not divide.
Result<Thumbnails> thumbnails(const std::filesystem::path& side_by_side, std::uint32_t widest);

}  // namespace oriel::trade
