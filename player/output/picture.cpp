#include "player/output/picture.h"

#include <filesystem>

#include "formats/image/exr.h"
#include "formats/image/png.h"

namespace oriel {

Status write_picture(Renderer& renderer, const std::string& path, int width, int height, float ev100, ToneCurve curve,
                     const std::string& camera) {
  const auto w = static_cast<std::uint32_t>(width), h = static_cast<std::uint32_t>(height);
  if (std::filesystem::path(path).extension() == ".exr") {
    return write_exr(
        path, FloatImage{w, h, 3, renderer.read_light()},
        {{"oriel.camera", camera}, {"oriel.unit", "cd/m2"}, {"oriel.ev100", fmt::format("{:.3f}", ev100)}});
  }
  ORIEL_TRY(std::vector<std::uint8_t> pixels, renderer.read_display(ev100, curve));
  return write_png(path, ByteImage{w, h, 3, std::move(pixels)});
}

}  // namespace oriel
