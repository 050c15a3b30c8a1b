// All that is seen from a point as one picture: latitude and longitude, 2:1.
#pragma once

#include <array>

#include "formats/assets/camera.h"
#include "formats/image/image.h"

namespace oriel {

// The faces of a cube around an eye. Each is a square picture one pixel wider on every side than its face, so that what
// is interpolated between pixels has no seams.
struct PanoramaViews {
  std::array<Camera, 6> cameras;  // ahead, right, back, left, up, down; level, ahead is the camera's heading
  int size = 0;                   // pixels a side, the margin included
};
// For a picture so wide: a pixel of a face's centre is as large as one of the picture's middle row.
PanoramaViews panorama_views(const Camera& camera, int width);

// From the faces' linear pictures, three channels, of the views' size: the middle is the heading, right of it lies to
// its right, the top row is +Y. width is twice the height.
FloatImage panorama(const PanoramaViews& views, const std::array<FloatImage, 6>& faces, std::uint32_t width);

}  // namespace oriel
