// A picture as part of a frame of another size. No OpenGL.
#pragma once

#include "formats/image/image.h"

namespace oriel {

// `picture`, three or four channels, as high as the frame and in its middle, so that what a camera of that field of
// view saw lies where the frame shows it: cut off at the sides of a narrow frame. Each pixel is the mean of what it
// covers; one size gives the same values. RGBA: alpha is `alpha`, 0 beside the picture.
FloatImage fit_picture(const FloatImage& picture, std::uint32_t width, std::uint32_t height, float alpha);

}  // namespace oriel
