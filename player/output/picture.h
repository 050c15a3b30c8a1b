// Frames as files.
#pragma once

#include <string>

#include "formats/core/result.h"
#include "player/passes/frame.h"

namespace oriel {

// The frame that a renderer drew last, as a picture file: .png as shown, .exr linear.
Status write_picture(Renderer& renderer, const std::string& path, int width, int height, float ev100, ToneCurve curve,
                     const std::string& camera);

}  // namespace oriel
