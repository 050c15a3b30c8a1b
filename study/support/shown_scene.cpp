#include "study/support/shown_scene.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "formats/pack/reader.h"
#include "formats/query/camera_spec.h"
#include "player/navigation/view.h"
#include "player/output/picture.h"

namespace oriel::study {
namespace {
namespace fs = std::filesystem;
constexpr const char *kWhat = "What is shown", *kPicture = "Pictures";

struct CameraFile {
  std::string name;
  Camera camera;
  std::string file;  // empty: none
};

Result<std::vector<CameraFile>> choose_cameras(const GpuScene& scene, const ShownArguments& arguments) {
  ORIEL_TRY(const std::vector<Camera> cameras, shown_cameras(scene, arguments.cameras));
  std::vector<CameraFile> out;
  for (const Camera& camera : cameras) out.push_back({camera.name, camera, {}});
  if (arguments.output.empty()) return out;
  const fs::path output = arguments.output;
  if (output.extension() == ".png" || is_linear_file(arguments.output)) {
    if (out.size() > 1)
      return fail(ErrorCode::kUsage, arguments.output, "found one file for {} cameras, expected a folder", out.size());
    out[0].file = arguments.output;
    return out;
  }
  std::error_code failed;
  fs::create_directories(output, failed);
  if (failed) return fail(ErrorCode::kIo, arguments.output, "cannot be made: {}", failed.message());
  for (std::size_t i = 0; i < out.size(); ++i) out[i].file = (output / fmt::format("{:02}.png", i)).string();
  return out;
}

}  // namespace

Result<std::vector<Camera>> shown_cameras(const GpuScene& scene, const std::vector<std::string>& asked) {
  const Pack& pack = scene.pack();
  const CameraChoices choices{pack.cameras, pack.paths, pack.mesh.origin};
  std::vector<Camera> out;
  for (const std::string& text : asked) {
    if (text == "all") {
      out.insert(out.end(), pack.cameras.begin(), pack.cameras.end());
      continue;
    }
    ORIEL_TRY(Camera camera, parse_camera(text, choices));
    if (camera.name.empty()) camera.name = text;
    out.push_back(std::move(camera));
  }
  if (out.empty()) out.push_back(initial_camera(choices, scene.bounds().lower, scene.bounds().upper));
  if (out[0].name.empty()) out[0].name = "start";
  return out;
}

std::vector<Option> shown_options(ShownArguments& out) {
  return {
      {"INPUT", kWhat, "An .oriel pack, or a glTF scene, which is baked first", text(out.input, "SCENE|PACK"),
       Use::kRequired},
      {"--camera", kWhat, "A camera by name or number, or as oriel-play --camera takes it; all: every one of the pack",
       texts(out.cameras, "CAMERA"), Use::kEveryday},
      {"-o,--output", kPicture, "The picture to write, .png or .exr; a folder for several cameras",
       text(out.output, "FILE|DIR"), Use::kEveryday},
      {"--width", kPicture, "Pixels", number(out.width, 1, 16384), Use::kEveryday},
      {"--height", kPicture, "Pixels", number(out.height, 1, 16384), Use::kEveryday},
      {"--frames", kPicture, "How often each is drawn; the time is the median's", number(out.frames, 1, 10000),
       Use::kEveryday},
      {"--ev", kPicture, "Exposure value at ISO 100; metered unless told", number(out.ev100, -100, 100),
       Use::kEveryday},
  };
}

Result<Pack> open_or_bake(const std::string& input, BakeOptions options) {
  if (fs::path(input).extension() == ".oriel") return read_pack(input);
  options.scene = input;
  Context context;
  context.warn = [](const Warning& warning) { fmt::print(stderr, "oriel-study: {}\n", warning.text); };
  ORIEL_TRY(BakeResult baked, bake(options, context));
  return std::move(baked.pack);
}

Result<ShownScene> ShownScene::open(Pack pack) {
  ShownScene out;
  ORIEL_TRY(out.context, gpu::HeadlessContext::create());
  ORIEL_TRY(out.device, gpu::open_device());
  ORIEL_TRY(out.scene, GpuScene::create(std::move(pack), out.device));
  ORIEL_TRY(out.renderer, Renderer::create(out.device));
  return out;
}

Status draw_cameras(ShownScene& shown, const ShownArguments& arguments, const FrameOptions& options,
                    FrameExtension* extension) {
  ORIEL_TRY(const std::vector<CameraFile> cameras, choose_cameras(*shown.scene, arguments));
  for (const CameraFile& one : cameras) {
    const View view = make_view(one.camera, arguments.width, arguments.height, shown.scene->bounds());
    std::vector<double> ms;
    for (int i = 0; i < arguments.frames; ++i) {
      const auto start = std::chrono::steady_clock::now();
      ORIEL_TRY_VOID(shown.renderer->render(*shown.scene, view, options, extension));
      glFinish();
      ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    std::nth_element(ms.begin(), ms.begin() + static_cast<std::ptrdiff_t>(ms.size() / 2), ms.end());
    fmt::print("{}: {:.1f} ms\n", one.name, ms[ms.size() / 2]);
    if (one.file.empty()) continue;
    float ev100 = arguments.ev100.value_or(0.0f);
    if (!arguments.ev100) {
      ORIEL_TRY(const std::optional<float> metered, shown.renderer->meter());
      ev100 = metered.value_or(0.0f);
    }
    ORIEL_TRY_VOID(
        write_picture(*shown.renderer, one.file, {one.camera, shown.scene->pack().mesh.origin, one.name, ev100}));
  }
  return {};
}

}  // namespace oriel::study
