// Frames that no pack was played for, beside their references.
#pragma once

#include <filesystem>

#include "formats/image/comparison.h"
#include "trade/measures.h"

namespace oriel::trade {

// What `oriel-bake render` wrote, and what `oriel-preview -o` did, which tells D and S not apart: all is D. Neither has
// reflectors. Errors kIo, kInvalid.
Result<PlayedFrame> read_traced_frame(const std::filesystem::path& file);
Result<PlayedFrame> read_preview_frame(const std::filesystem::path& file);

// Adds the frame's error to the measures, and writes reference, frame and FLIP side by side. Errors kIo, kInvalid.
Status compare_whole(const std::string& camera, PlayedFrame& frame, const LayeredImage& truth,
                     const std::filesystem::path& picture, Measures& measures);

}  // namespace oriel::trade
