#include "player/output/picture.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "formats/core/color.h"
#include "formats/image/exr.h"
#include "formats/image/png.h"
#include "formats/image/relative_error.h"
#include "formats/query/camera_notes.h"
#include "player/session/option_names.h"

namespace oriel {
namespace {

std::map<std::string, std::string> texts_of(const PictureNotes& notes) {
  auto texts = camera_notes(notes.camera, notes.origin);
  texts["oriel.camera"] = notes.name;
  texts["oriel.ev100"] = fmt::format("{:.3f}", notes.ev100);
  return texts;
}

}  // namespace

bool is_linear_file(const std::string& path) {
  return std::filesystem::path(path).extension() == ".exr";
}

Status write_light(const std::string& path, const FloatImage& light, const PictureNotes& notes) {
  auto texts = texts_of(notes);
  texts["oriel.unit"] = "cd/m2";
  return write_exr(path, light, texts);
}

Status write_shown(const std::string& path, const ByteImage& shown, const PictureNotes& notes) {
  auto texts = texts_of(notes);
  texts["oriel.tonemap"] = name_of(kToneCurves, notes.curve);
  return write_png(path, shown, texts);
}

FloatImage light_picture(const Renderer& renderer, std::uint32_t n) {
  const UVec2 size(renderer.frame_size());
  FloatImage light{size.x, size.y, 3, renderer.read_light()};
  return n > 1 ? shrink(light, n) : light;
}

Result<ByteImage> shown_picture(Renderer& renderer, const PictureNotes& notes, std::uint32_t n) {
  const UVec2 size(renderer.frame_size());
  ByteImage shown{size.x, size.y, 3, {}};
  ORIEL_TRY(shown.pixels, renderer.read_display(notes.ev100, notes.curve));
  if (n <= 1) return shown;
  FloatImage light{size.x, size.y, 3, {}};
  light.pixels.reserve(shown.pixels.size());
  for (const std::uint8_t v : shown.pixels) light.pixels.push_back(linear_from_srgb8(v));
  const FloatImage mean = shrink(light, n);
  ByteImage out{mean.width, mean.height, 3, {}};
  out.pixels.reserve(mean.pixels.size());
  for (const float v : mean.pixels)
    out.pixels.push_back(static_cast<std::uint8_t>(255 * std::clamp(srgb_from_linear(v), 0.0f, 1.0f) + 0.5f));
  return out;
}

Status write_picture(Renderer& renderer, const std::string& path, const PictureNotes& notes, std::uint32_t n) {
  if (is_linear_file(path)) return write_light(path, light_picture(renderer, n), notes);
  ORIEL_TRY(const ByteImage shown, shown_picture(renderer, notes, n));
  return write_shown(path, shown, notes);
}

std::string next_name(const char* ending) {
  for (int i = 0;; ++i) {
    const std::string name = fmt::format("oriel-{:03}{}", i, ending);
    if (!std::filesystem::exists(name)) return name;
  }
}

}  // namespace oriel
