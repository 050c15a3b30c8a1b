#include "trade/frames.h"

#include <algorithm>

#include "formats/image/png.h"

namespace oriel::trade {
namespace {

namespace fs = std::filesystem;

Status write_side_by_side(const fs::path& file, const FloatImage& picture) {
  ByteImage bytes{picture.width, picture.height, 3, {}};
  for (const float v : picture.pixels)
    bytes.pixels.push_back(static_cast<std::uint8_t>(255 * std::clamp(v, 0.0f, 1.0f) + 0.5f));
  return write_png(file, bytes);
}

}  // namespace

Result<PlayedFrame> read_traced_frame(const fs::path& file) {
  ORIEL_TRY(const LayeredImage image, read_layered_exr(file));
  PlayedFrame played;
  for (const auto& [part, layer] :
       {std::pair{&played.total, ""}, {&played.diffuse, "direct"}, {&played.specular, "specular"}}) {
    const auto found = image.layers.find(layer);
    if (found == image.layers.end()) return invalid(file.string(), "found no layer '{}', expected one", layer);
    *part = found->second;
  }
  const FloatImage& indirect = image.layers.at("indirect");
  for (std::size_t i = 0; i < indirect.pixels.size(); ++i) played.diffuse.pixels[i] += indirect.pixels[i];
  return played;
}

Result<PlayedFrame> read_preview_frame(const fs::path& file) {
  ORIEL_TRY(const LayeredImage image, read_layered_exr(file));
  const auto all = image.layers.find("");
  if (all == image.layers.end()) return invalid(file.string(), "found no layer '', expected one");
  PlayedFrame played;
  played.total = played.diffuse = played.specular = all->second;
  std::fill(played.specular.pixels.begin(), played.specular.pixels.end(), 0.0f);
  return played;
}

Status compare_whole(const std::string& camera, PlayedFrame& frame, const LayeredImage& truth, const fs::path& picture,
                     Measures& measures) {
  const std::vector<std::uint8_t> none(std::size_t{frame.total.width} * frame.total.height, 0);
  frame.mirrors = frame.glossy = frame.movers = none;
  ORIEL_TRY(const Comparison comparison, compare(frame, truth, 0));
  ORIEL_TRY_VOID(write_side_by_side(picture, comparison.picture));
  measures.frames.push_back(frame_error_of(camera, comparison));
  return {};
}

}  // namespace oriel::trade
