// What the rooms share: a scene or pack that is shown without a window, its cameras, its pictures.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bake/run/pipeline.h"
#include "formats/cli/option.h"
#include "player/gpu/headless.h"
#include "player/passes/frame.h"
#include "player/scene/gpu_scene.h"

namespace oriel::study {

struct ShownArguments {
  std::string input;                 // a pack, or a glTF scene that is baked first
  std::string output;                // a picture, .png or .exr, of the first camera; a folder for several; none
  std::vector<std::string> cameras;  // as oriel-play takes them; none: the pack's first
  int width = 640, height = 360;     // pixels
  int frames = 1;                    // drawn of each camera; the median's time counts
  std::optional<float> ev100;        // none: metered
};
std::vector<Option> shown_options(ShownArguments& out);

// Cameras as --camera names them, "all" those of the pack; none: the one to start with. Error kUsage.
Result<std::vector<Camera>> shown_cameras(const GpuScene& scene, const std::vector<std::string>& asked);

// options: of the bake, where the input is a scene. Errors of both.
Result<Pack> open_or_bake(const std::string& input, BakeOptions options);

// A pack on a device without a window.
struct ShownScene {
  std::unique_ptr<gpu::HeadlessContext> context;
  gpu::Device device;
  std::unique_ptr<GpuScene> scene;
  std::unique_ptr<Renderer> renderer;
  static Result<ShownScene> open(Pack pack);
};

// Draws the cameras, writes what was asked for, and prints a line for each: its name and milliseconds.
// extension: of the method; none: as the player draws. Errors kUsage, kIo, kRuntime.
Status draw_cameras(ShownScene& shown, const ShownArguments& arguments, const FrameOptions& options,
                    FrameExtension* extension = nullptr);

}  // namespace oriel::study
