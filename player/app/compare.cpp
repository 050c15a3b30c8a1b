#include "player/app/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/image/comparison.h"
#include "formats/image/display.h"
#include "formats/image/flip.h"
#include "formats/image/png.h"
#include "formats/image/visible.h"
#include "formats/query/camera_spec.h"
#include "player/gpu/headless.h"
#include "player/navigation/lamps.h"
#include "player/navigation/poses.h"
#include "player/output/other.h"
#include "player/output/picture.h"
#include "player/output/played_frame.h"
#include "player/passes/frame.h"

namespace oriel {
namespace {

// A frame beside an earlier one of oriel-play.
struct PictureDifference {
  std::uint32_t width = 0, height = 0;
  std::size_t changed = 0;          // pixels with a value that is not the same
  double largest = 0;               // difference of two values: cd/m² of linear pictures, [0, 1] of pictures as shown
  double flip = 0, worst_flip = 0;  // mean and largest over the pixels
  std::optional<VisibleError> visible;  // of linear pictures
  FloatImage picture;                   // FLIP by pixel, one channel
};

// Pictures of one size, three channels: linear light, which is shown with `white` (cd/m²) as white, or, where white is
// 0, sRGB-encoded in [0, 1] already. Errors: kInvalid where the sizes differ, kDifferent where the frame has values
// that are not finite.
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

// max_flip: of the mean.
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

// How many player's pixels a reference's pixel has on each axis.
Result<std::uint32_t> supersampling(const PlayArguments& arguments, const FloatImage& reference) {
  if (!arguments.sized) return 1u;
  const auto width = static_cast<std::uint32_t>(arguments.width), height = static_cast<std::uint32_t>(arguments.height);
  const std::uint32_t n = width / reference.width;
  if (n >= 1 && n * reference.width == width && n * reference.height == height) return n;
  return fail(ErrorCode::kUsage, "--size", "found {}x{}, expected a whole multiple of the reference's {}x{}", width,
              height, reference.width, reference.height);
}

Result<Camera> choose_camera(const GpuScene& scene, const PlayArguments& arguments) {
  const Pack& pack = scene.pack();
  const CameraChoices choices{pack.cameras, pack.paths, pack.mesh.origin};
  if (arguments.cameras.empty()) return initial_camera(choices, scene.bounds().lower, scene.bounds().upper);
  return parse_camera(arguments.cameras[0], choices);
}

// [0, 1], one channel as grey.
Status write_difference(const std::string& path, const FloatImage& picture) {
  ByteImage bytes{picture.width, picture.height, picture.channels, {}};
  for (const float v : picture.pixels)
    bytes.pixels.push_back(static_cast<std::uint8_t>(255 * std::clamp(v, 0.0f, 1.0f) + 0.5f));
  return write_png(path, bytes);
}

// What both kinds of comparison end with.
Status report(const std::string& text, const std::string& json, const FloatImage& picture, double flip,
              const PlayArguments& arguments) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  if (!arguments.json.empty()) ORIEL_TRY_VOID(write_text_atomically(arguments.json, json));
  if (!arguments.output.empty()) ORIEL_TRY_VOID(write_difference(arguments.output, picture));
  if (arguments.max_flip && !(flip <= *arguments.max_flip))
    return fail(ErrorCode::kDifferent, arguments.reference, "found a FLIP of {:.4g}, expected at most {}", flip,
                *arguments.max_flip);
  return {};
}

std::vector<float> encoded(const std::vector<std::uint8_t>& shown) {
  std::vector<float> out;
  out.reserve(shown.size());
  for (const std::uint8_t v : shown) out.push_back(static_cast<float>(v) / 255);
  return out;
}

// A file to compare with: of `oriel-bake render`, or an earlier frame, linear or as shown.
struct Reference {
  LayeredImage layers;  // of an earlier frame the one without a name alone
  bool rendered = false, linear = true;
  const FloatImage& picture() const { return layers.layers.at(""); }
};

Result<Reference> read_reference(const PlayArguments& arguments) {
  Reference out;
  if (is_linear_file(arguments.reference)) {
    ORIEL_TRY(out.layers, read_layered_exr(arguments.reference));
    out.rendered = out.layers.layers.size() > 1;
  } else {
    ORIEL_TRY(const ByteImage shown, read_png(arguments.reference));
    FloatImage picture{shown.width, shown.height, shown.channels, encoded(shown.pixels)};
    out.layers.layers[""] = std::move(picture);
    out.linear = false;
  }
  if (!out.rendered && arguments.sized &&
      (arguments.width != static_cast<int>(out.picture().width) ||
       arguments.height != static_cast<int>(out.picture().height)))
    return fail(ErrorCode::kUsage, "--size", "found {}x{}, expected the earlier frame's {}x{}", arguments.width,
                arguments.height, out.picture().width, out.picture().height);
  return out;
}

// Of the renderer's last frame.
Status compare_with_picture(const Reference& reference, Renderer& renderer, const PlayArguments& arguments) {
  const UVec2 size(renderer.frame_size());
  FloatImage frame{size.x, size.y, 3, {}};
  float white = 0;
  if (reference.linear) {
    frame.pixels = renderer.read_light();
    white = arguments.ev100 ? white_of_exposure(*arguments.ev100) : white_of(reference.picture());
  } else {
    ORIEL_TRY(const std::optional<float> metered, renderer.meter());
    ORIEL_TRY(const auto shown,
              renderer.read_display(arguments.ev100.value_or(metered.value_or(0.0f)), arguments.curve));
    frame.pixels = encoded(shown);
  }
  ORIEL_TRY(const PictureDifference found, difference(reference.picture(), frame, white));
  return report(difference_text(found), difference_json(found, arguments.max_flip), found.picture, found.flip,
                arguments);
}

Status compare_with_rendered(const Reference& reference, const PlayedFrame& frame, const PlayArguments& arguments) {
  ORIEL_TRY(const Comparison comparison,
            compare(frame, reference.layers, arguments.ev100 ? white_of_exposure(*arguments.ev100) : 0));
  return report(comparison_text(comparison), comparison_json(comparison, arguments.max_flip), comparison.picture,
                comparison.regions.front().flip, arguments);
}

// Another pack by the same camera, both as shown with one exposure: the first's, unless told.
Status compare_with_pack(GpuScene& scene, Renderer& renderer, const gpu::Device& device,
                         const PlayArguments& arguments) {
  ORIEL_TRY(const auto other, Other::open(arguments.reference, device, {false, arguments.gpu_memory}));
  ORIEL_TRY(const Camera camera, choose_camera(scene, arguments));
  FrameOptions options = arguments.frame;
  ORIEL_TRY(options.poses, poses_at(scene.pack(), arguments.moves, arguments.time_s));
  ORIEL_TRY(options.lamps, lamps_at(scene.pack(), arguments.moves, arguments.time_s));
  const View view = make_view(camera, arguments.width, arguments.height, bounds_with_movers(scene, options.poses));
  ORIEL_TRY_VOID(renderer.render(scene, view, options));
  ORIEL_TRY(const std::optional<float> metered, renderer.meter());
  const float ev100 = arguments.ev100.value_or(metered.value_or(0.0f));
  ORIEL_TRY_VOID(other->draw(
      {camera, scene.pack().mesh.origin, view.width, view.height, options, arguments.moves, arguments.time_s}));
  const UVec2 size(view.width, view.height);
  ORIEL_TRY(const auto first, renderer.read_display(ev100, arguments.curve));
  ORIEL_TRY(const auto second, other->read_display(ev100, arguments.curve));
  ORIEL_TRY(const PictureDifference found,
            difference({size.x, size.y, 3, encoded(second)}, {size.x, size.y, 3, encoded(first)}, 0));
  return report(difference_text(found), difference_json(found, arguments.max_flip), found.picture, found.flip,
                arguments);
}

}  // namespace

Status play_compare(DeferredPack pack, const PlayArguments& arguments) {
  if (std::filesystem::path(arguments.reference).extension() == ".oriel") {
    ORIEL_TRY(const auto context, gpu::HeadlessContext::create());
    ORIEL_TRY(const gpu::Device device, gpu::open_device());
    ORIEL_TRY(const auto scene, GpuScene::create(std::move(pack), device, {false, arguments.gpu_memory}));
    ORIEL_TRY(const auto renderer, Renderer::create(device));
    return compare_with_pack(*scene, *renderer, device, arguments);
  }
  ORIEL_TRY(const Reference reference, read_reference(arguments));
  const FloatImage& picture = reference.picture();
  ORIEL_TRY(const std::uint32_t n, supersampling(arguments, picture));
  ORIEL_TRY(const auto context, gpu::HeadlessContext::create());
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  ORIEL_TRY(const auto scene, GpuScene::create(std::move(pack), device, {false, arguments.gpu_memory}));
  ORIEL_TRY(const Camera camera, choose_camera(*scene, arguments));
  ORIEL_TRY(const auto renderer, Renderer::create(device));
  FrameOptions options = arguments.frame;
  ORIEL_TRY(options.poses, poses_at(scene->pack(), arguments.moves, arguments.time_s));
  ORIEL_TRY(options.lamps, lamps_at(scene->pack(), arguments.moves, arguments.time_s));
  const View view = make_view(camera, static_cast<int>(n * picture.width), static_cast<int>(n * picture.height),
                              bounds_with_movers(*scene, options.poses));
  if (!reference.rendered) {
    ORIEL_TRY_VOID(renderer->render(*scene, view, options));
    return compare_with_picture(reference, *renderer, arguments);
  }
  ORIEL_TRY(const PlayedFrame frame, draw_compared(*renderer, {*scene, view, options, n}));
  return compare_with_rendered(reference, frame, arguments);
}

}  // namespace oriel
