#include "player/output/picture.h"

#include <filesystem>
#include <map>

#include "formats/camera/camera_notes.h"
#include "formats/image/exr.h"
#include "formats/image/png.h"
#include "player/options/option_names.h"

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

Status write_picture(Renderer& renderer, const std::string& path, int width, int height, const PictureNotes& notes) {
  const auto w = static_cast<std::uint32_t>(width), h = static_cast<std::uint32_t>(height);
  if (is_linear_file(path)) return write_light(path, FloatImage{w, h, 3, renderer.read_light()}, notes);
  ORIEL_TRY(std::vector<std::uint8_t> pixels, renderer.read_display(notes.ev100, notes.curve));
  return write_shown(path, ByteImage{w, h, 3, std::move(pixels)}, notes);
}

}  // namespace oriel
