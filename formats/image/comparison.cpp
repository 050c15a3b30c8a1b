#include "formats/image/comparison.h"

#include <algorithm>

#include "formats/core/json.h"
#include "formats/image/display.h"
#include "formats/image/flip.h"
#include "formats/image/ssim.h"

namespace oriel {
namespace {

// The layers of `oriel-bake render` that are compared.
constexpr std::array<const char*, 7> kLayers = {"",      "direct",        "indirect",      "specular",
                                                "error", "diffuse_error", "specular_error"};

Status check_finite(const FloatImage& image, ErrorCode code, const char* whose, const char* layer) {
  const auto is_bad = [](float v) { return !std::isfinite(v); };
  const auto& values = image.pixels;
  const auto first = static_cast<std::size_t>(std::find_if(values.begin(), values.end(), is_bad) - values.begin());
  if (first == values.size()) return {};
  const std::size_t pixel = first / image.channels;
  return fail(code, whose, "layer \"{}\" holds {} values that are not finite, the first in pixel {}, {}", layer,
              std::count_if(values.begin(), values.end(), is_bad), pixel % image.width, pixel / image.width);
}

Status check_reference(const LayeredImage& reference, std::uint32_t width, std::uint32_t height) {
  for (const char* name : kLayers) {
    const auto found = reference.layers.find(name);
    if (found == reference.layers.end())
      return invalid("reference", "has no layer \"{}\", expected a file of oriel-bake render", name);
    const FloatImage& layer = found->second;
    if (layer.channels != 3 || layer.width != width || layer.height != height)
      return invalid("reference", "layer \"{}\" has {} x {} pixels of {} channels, expected {} x {} of 3", name,
                     layer.width, layer.height, layer.channels, width, height);
    ORIEL_TRY_VOID(check_finite(layer, ErrorCode::kInvalid, "reference", name));
  }
  return {};
}

FloatImage sum(const FloatImage& a, const FloatImage& b) {
  FloatImage out = a;
  for (std::size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] += b.pixels[i];
  return out;
}

// Pictures side by side, those of one channel as grey.
FloatImage side_by_side(const std::array<const FloatImage*, 3>& pictures) {
  const std::uint32_t width = pictures[0]->width, height = pictures[0]->height;
  FloatImage out{3 * width, height, 3, {}};
  for (std::size_t y = 0; y < height; ++y)
    for (const FloatImage* picture : pictures)
      for (std::size_t x = 0; x < width; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          out.pixels.push_back(
              picture->pixels[(y * width + x) * picture->channels + std::min<std::size_t>(c, picture->channels - 1)]);
  return out;
}

Json error_json(const RelativeError& e) {
  return {{"relRMSE", e.rel_rmse}, {"noise", e.noise}, {"net", e.net()}, {"nRMSE", e.n_rmse}, {"bias", e.bias}};
}

std::string error_text(const RelativeError& e) {
  return fmt::format("{:6.2f} {:6.2f} {:+6.2f}", 100 * e.net(), 100 * e.noise, 100 * e.bias);
}

}  // namespace

Result<Comparison> compare(const PlayedFrame& frame, const LayeredImage& reference, float white) {
  ORIEL_TRY_VOID(check_reference(reference, frame.total.width, frame.total.height));
  ORIEL_TRY_VOID(check_finite(frame.total, ErrorCode::kDifferent, "frame", "all"));
  ORIEL_TRY_VOID(check_finite(frame.diffuse, ErrorCode::kDifferent, "frame", "D"));
  ORIEL_TRY_VOID(check_finite(frame.specular, ErrorCode::kDifferent, "frame", "MKR"));
  const auto layer = [&](const char* name) -> const FloatImage& { return reference.layers.at(name); };
  const FloatImage diffuse = sum(layer("direct"), layer("indirect"));
  Comparison out{frame.total.width, frame.total.height, white > 0 ? white : white_of(layer("")), frame.holes, {}, {}};
  const FloatImage seen = shown(frame.total, out.white), wanted = shown(layer(""), out.white);
  const FloatImage squares = squared_difference(seen, wanted);
  const FloatImage noise = shown_variance(layer(""), layer("error"), out.white);
  const FloatImage ssim = ssim_map(wanted, seen), flip = flip_map(wanted, seen);
  out.picture = side_by_side({&wanted, &seen, &flip});

  std::vector<std::uint8_t> both = frame.mirrors;
  for (std::size_t i = 0; i < both.size(); ++i) both[i] |= frame.glossy[i];
  const std::vector<std::uint8_t> all(both.size(), 1);
  std::vector<std::uint8_t> matte;  // no part of a mover or a reflected image, where there are any
  const bool movers = !frame.movers.empty();
  for (std::size_t i = 0; i < both.size(); ++i) matte.push_back(both[i] == 0 && !(movers && frame.movers[i] != 0));
  if (matte == all) matte.clear();
  const std::array<std::pair<const char*, const std::vector<std::uint8_t>*>, 6> regions = {{{"frame", &all},
                                                                                            {"reflectors", &both},
                                                                                            {"mirrors", &frame.mirrors},
                                                                                            {"glossy", &frame.glossy},
                                                                                            {"movers", &frame.movers},
                                                                                            {"matte", &matte}}};
  for (const auto& [name, region] : regions) {
    RegionComparison r;
    r.name = name;
    r.pixels = static_cast<std::size_t>(std::count(region->begin(), region->end(), 1));
    if (r.pixels == 0) continue;
    ORIEL_TRY(r.total, relative_error(frame.total, layer(""), layer("error"), *region));
    ORIEL_TRY(r.diffuse, relative_error(frame.diffuse, diffuse, layer("diffuse_error"), *region));
    if (region != &all && region != &frame.movers && region != &matte) {
      ORIEL_TRY(r.specular, relative_error(frame.specular, layer("specular"), layer("specular_error"), *region));
    }
    r.mse = mean_over(squares, *region);
    r.noise_mse = mean_over(noise, *region);
    r.ssim = mean_over(ssim, *region);
    r.flip = mean_over(flip, *region);
    out.regions.push_back(std::move(r));
  }
  return out;
}

std::string comparison_text(const Comparison& c) {
  std::string text =
      fmt::format("{}x{}, {:.4g} cd/m2 shown as white; errors in %: net of the reference's noise, the noise, bias\n",
                  c.width, c.height, c.white);
  text += fmt::format("{:<10} {:>8} {:>8} {:>8} {:>6} {:>6}  {:<20}  {:<20}  {:<20}\n", "region", "pixels", "PSNR dB",
                      "of noise", "SSIM", "FLIP", "sum relRMSE", "D relRMSE", "S relRMSE");
  for (const RegionComparison& r : c.regions)
    text += fmt::format("{:<10} {:>8} {:>8.2f} {:>8.2f} {:>6.3f} {:>6.4f}  {}  {}  {}\n", r.name, r.pixels,
                        psnr_db(r.mse), psnr_db(r.noise_mse), r.ssim, r.flip, error_text(r.total),
                        error_text(r.diffuse), r.specular ? error_text(*r.specular) : "");
  text += fmt::format("holes: {:.3f} % of the reflected images' pixels\n", 100 * c.holes);
  return text;
}

std::string comparison_json(const Comparison& c, std::optional<double> max_flip) {
  Json json = {{"width", c.width}, {"height", c.height}, {"white_cd_m2", c.white}, {"holes", c.holes}};
  if (max_flip) {
    json["max_flip"] = *max_flip;
    json["passed"] = c.regions.front().flip <= *max_flip;
  }
  for (const RegionComparison& r : c.regions) {
    Json& out = json["regions"][r.name];
    out = {{"pixels", r.pixels}, {"psnr_db", psnr_db(r.mse)},
           {"mse", r.mse},       {"noise_mse", r.noise_mse},
           {"ssim", r.ssim},     {"flip", r.flip}};
    out["sum"] = error_json(r.total);
    out["D"] = error_json(r.diffuse);
    if (r.specular) out["S"] = error_json(*r.specular);
  }
  return json.dump(2) + "\n";
}

}  // namespace oriel
