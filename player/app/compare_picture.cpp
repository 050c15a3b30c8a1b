#include "player/app/compare_picture.h"

#include <algorithm>
#include <cmath>

#include "formats/core/json.h"
#include "formats/image/display.h"
#include "formats/image/flip.h"

namespace oriel {

Result<PictureDifference> difference(const FloatImage& reference, const FloatImage& frame, float white) {
  if (reference.width != frame.width || reference.height != frame.height || reference.channels != 3)
    return invalid("reference", "found {}x{} pixels of {} channels, expected {}x{} of 3", reference.width,
                   reference.height, reference.channels, frame.width, frame.height);
  const auto finite = [](const FloatImage& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [](float v) { return std::isfinite(v); });
  };
  if (!finite(reference)) return invalid("reference", "holds values that are not finite");
  if (!finite(frame)) return fail(ErrorCode::kDifferent, "frame", "holds values that are not finite");
  PictureDifference out;
  out.width = frame.width;
  out.height = frame.height;
  for (std::size_t i = 0; i < frame.pixels.size(); i += 3) {
    double most = 0;
    for (std::size_t c = i; c < i + 3; ++c)
      most = std::max(most, std::fabs(double{frame.pixels[c]} - double{reference.pixels[c]}));
    if (most > 0) ++out.changed;
    out.largest = std::max(out.largest, most);
  }
  out.picture = white > 0 ? flip_map(shown(reference, white), shown(frame, white)) : flip_map(reference, frame);
  if (white > 0) out.visible = visible_error(reference, frame, white);
  for (const float v : out.picture.pixels) {
    out.flip += double{v};
    out.worst_flip = std::max(out.worst_flip, double{v});
  }
  out.flip /= static_cast<double>(out.picture.pixels.size());
  return out;
}

std::string difference_text(const PictureDifference& d) {
  std::string text =
      fmt::format("{}x{}: {} pixels changed, by {:.4g} at most; FLIP {:.4g}, at most {:.4g} in a pixel\n", d.width,
                  d.height, d.changed, d.largest, d.flip, d.worst_flip);
  if (d.visible)
    text += fmt::format("visible error {:.3g} (1: just noticeable), above 1 in {:.2g} % of the pixels\n",
                        d.visible->rms, 100 * d.visible->share);
  return text;
}

std::string difference_json(const PictureDifference& d, std::optional<double> max_flip) {
  Json json{{"width", d.width},     {"height", d.height}, {"changed_pixels", d.changed},
            {"largest", d.largest}, {"flip", d.flip},     {"worst_flip", d.worst_flip}};
  if (d.visible) json["visible"] = d.visible->rms, json["visible_share"] = d.visible->share;
  if (max_flip) {
    json["max_flip"] = *max_flip;
    json["passed"] = d.flip <= *max_flip;
  }
  return json.dump(2) + "\n";
}

}  // namespace oriel
