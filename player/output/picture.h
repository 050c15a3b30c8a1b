// Frames as files.
#pragma once

#include <string>

#include "formats/core/result.h"
#include "formats/image/image.h"
#include "player/passes/frame.h"

namespace oriel {

// What a picture's file tells of how it was made, beside the light.
struct PictureNotes {
  Camera camera;       // pack space
  DVec3 origin{0};     // of pack space, world metres
  std::string name{};  // of the camera
  float ev100 = 0;
  ToneCurve curve = ToneCurve::kAces;
};

// The frame that a renderer drew last, n x n of its pixels averaged to one: n divides its size. As light (cd/m²), or as
// shown: there they are averaged as the display shines.
FloatImage light_picture(const Renderer& renderer, std::uint32_t n = 1);
Result<ByteImage> shown_picture(Renderer& renderer, const PictureNotes& notes, std::uint32_t n = 1);

// That as a picture file: .png as shown, .exr linear. Both hold the notes: name, eye and direction in world metres,
// field of view, exposure.
Status write_picture(Renderer& renderer, const std::string& path, const PictureNotes& notes, std::uint32_t n = 1);

// A picture in linear light (cd/m²) as .exr, or one as shown as .png, with its notes.
Status write_light(const std::string& path, const FloatImage& light, const PictureNotes& notes);
Status write_shown(const std::string& path, const ByteImage& shown, const PictureNotes& notes);

// The first free name of the working folder, as oriel-000.png. ending: ".png", ".exr", ".json".
std::string next_name(const char* ending);

// Whether a file of that name is for linear light: .exr.
bool is_linear_file(const std::string& path);

}  // namespace oriel
