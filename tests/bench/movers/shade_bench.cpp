// The shade of movers in light from everywhere, after Barczak 2006: frame time by lights and by method, passes, moving
// movers, error by lights and maps (docs/notes/movers.md).
#include <cstdio>

#include "formats/cli/command.h"
#include "formats/core/color.h"
#include "formats/pack/reader.h"
#include "formats/query/camera.h"
#include "formats/query/camera_spec.h"
#include "formats/query/mover_pose.h"
#include "player/gpu/headless.h"
#include "player/passes/frame.h"

namespace oriel {
namespace {

constexpr float kStep = 0.02f;                      // metres: of the eye, or of movers, from frame to frame
constexpr std::uint32_t kPublished = 7;             // lights a pass, on the hardware of 2006
constexpr std::uint32_t kMany = 1024, kFine = 512;  // of the reference: lights, texels of a map's side

struct Variant {
  const char* name;
  ShadeWork work;
};
constexpr Variant kVariants[] = {{"each light at each pixel", ShadeWork::kEachLight},
                                 {"cells", ShadeWork::kCells},
                                 {"cells, few pixels", ShadeWork::kFewPixels},
                                 {"all as published, merged", ShadeWork::kMerged},
                                 {"lists", ShadeWork::kLists}};

struct Bench {
  std::unique_ptr<GpuScene> scene;
  std::unique_ptr<Renderer> renderer;
  std::vector<Camera> cameras;
  IVec2 size{1024, 768};
  int frames = 3;

  Result<FrameStats> draw(const ShadeSettings& shade, const Camera& camera, int eye_step, int mover_step) const {
    FrameOptions options;
    options.show = Show::kD;
    options.timed = true;
    options.shade = shade;
    options.mover_lights = MoverLights::kUnshadowed;  // of bright lights: no shadows
    for (const Mover& mover : scene->pack().movers) {
      options.poses.push_back(mover.rest);
      options.poses.back().position.x += kStep * static_cast<float>(mover_step);
    }
    Camera moved = camera;
    moved.eye.x += kStep * static_cast<float>(eye_step);
    const View view = make_view(moved, size.x, size.y, bounds_with_movers(*scene, options.poses));
    return renderer->render(*scene, view, options);
  }
  // The frame with the median of its shade's time, of those after the first.
  Result<ShadeStats> median(const ShadeSettings& shade, const Camera& camera, bool eye_moves, int count) const {
    std::vector<ShadeStats> all;
    for (int frame = 0; frame <= count; ++frame) {
      ORIEL_TRY(const FrameStats stats, draw(shade, camera, eye_moves ? frame : 0, eye_moves ? 0 : frame));
      if (frame > 0) all.push_back(stats.shade);
    }
    std::ranges::sort(all, {}, [](const ShadeStats& s) { return s.light_ms + s.cells_ms + s.merge_ms + s.maps_ms; });
    return all[all.size() / 2];
  }
};

ShadeSettings settings_of(ShadeWork work, std::uint32_t lights) {
  ShadeSettings out;
  out.work = work, out.lights = lights, out.lights_a_pass = kPublished, out.every_pixel = true;
  return out;
}

Status print_methods(const Bench& bench, std::span<const std::uint32_t> lights) {
  std::printf("The eye moves, movers stand: ms of the shade at %dx%d, camera by camera the mean.\n\n| lights |",
              bench.size.x, bench.size.y);
  for (const Variant& v : kVariants) std::printf(" %s |", v.name);
  std::printf(" first over last | passes, unmerged and merged |\n|---|---|---|---|---|---|---|---|\n");
  for (const std::uint32_t count : lights) {
    std::printf("| %u |", count);
    double first = 0, last = 0;
    std::uint32_t unmerged = 0, merged = 0;
    for (const Variant& v : kVariants) {
      double ms = 0;
      for (const Camera& camera : bench.cameras) {
        const int frames = v.work == ShadeWork::kEachLight ? 1 : bench.frames;
        ORIEL_TRY(const ShadeStats s, bench.median(settings_of(v.work, count), camera, true, frames));
        ms += (s.cells_ms + s.merge_ms + s.light_ms) / static_cast<double>(bench.cameras.size());
        if (v.work == ShadeWork::kMerged) unmerged += s.unmerged, merged += s.passes;
      }
      std::printf(" %.1f |", ms), std::fflush(stdout);
      if (v.work == ShadeWork::kEachLight) first = ms;
      last = ms;
    }
    std::printf(" %.1f | %u, %u |\n", first / last, unmerged, merged);
  }
  return {};
}

Status print_moving(const Bench& bench, std::uint32_t lights) {
  std::printf("\nMovers move, the eye stands, %u lights: ms a frame.\n\n", lights);
  std::printf(
      "| maps a frame, at most | what is blocked | merging | maps | of them drawn | faces | light | in all |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (const std::uint32_t most : {25u, 50u, 100u, 150u, 0u}) {
    ShadeSettings shade = settings_of(ShadeWork::kLists, lights);
    shade.maps_a_frame = most;
    ORIEL_TRY(const ShadeStats s, bench.median(shade, bench.cameras.front(), false, 2 * bench.frames));
    std::printf("| %s | %.2f | %.1f | %.1f | %u | %u | %.1f | %.1f |\n",
                most == 0 ? "all" : std::to_string(most).c_str(), s.cells_ms, s.merge_ms, s.maps_ms, s.maps, s.faces,
                s.light_ms, s.cells_ms + s.merge_ms + s.maps_ms + s.light_ms);
  }
  return {};
}

Result<std::vector<double>> luminances(const Bench& bench, const ShadeSettings& shade) {
  std::vector<double> out;
  for (const Camera& camera : bench.cameras) {
    ORIEL_TRY_VOID(bench.draw(shade, camera, 0, 0));
    const FloatImage image = bench.renderer->read_frame();
    for (std::size_t i = 0; i + 2 < image.pixels.size(); i += image.channels)
      out.push_back(luminance(Vec3(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2])));
  }
  return out;
}

// Over pixels that the reference's shade changes by a hundredth or more, over the mean shade there.
Status print_errors(const Bench& bench) {
  ShadeSettings best = settings_of(ShadeWork::kCells, kMany);
  best.map_side = kFine, best.lights_a_pass = kMany;
  ShadeSettings none = best;
  none.lights = 0;
  ORIEL_TRY(const std::vector<double> reference, luminances(bench, best));
  ORIEL_TRY(const std::vector<double> open, luminances(bench, none));
  std::printf("\nRoot mean square error of the shade over its mean, beside %u lights and maps of %u².\n\n| lights |",
              kMany, kFine);
  constexpr std::uint32_t kSides[] = {32, 64, 128, 256, 512};
  for (const std::uint32_t side : kSides) std::printf(" maps of %u² |", side);
  std::printf("\n|---|---|---|---|---|---|\n");
  for (const std::uint32_t count : {25u, 50u, 100u, 128u, 300u}) {
    std::printf("| %u |", count);
    for (const std::uint32_t side : kSides) {
      ShadeSettings shade = settings_of(ShadeWork::kLists, count);
      shade.map_side = side, shade.lights_a_pass = kMany;
      ORIEL_TRY(const std::vector<double> found, luminances(bench, shade));
      double squares = 0, taken = 0, pixels = 0;
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (!(open[i] - reference[i] > 0.01 * open[i])) continue;
        squares += (found[i] - reference[i]) * (found[i] - reference[i]), taken += open[i] - reference[i], ++pixels;
      }
      std::printf(" %.1f %% |", pixels > 0 ? 100 * std::sqrt(squares / pixels) / (taken / pixels) : 0.0);
      std::fflush(stdout);
    }
    std::printf("\n");
  }
  return {};
}

struct Asked {
  std::string pack;
  std::vector<std::string> cameras;
  std::vector<double> lights{25, 50, 100, 300, 1000};
  std::string size = "1024x768";
  bool methods = false, moving = false, errors = false;
};

Status run(const Asked& asked, int frames) {
  ORIEL_TRY(const auto context, gpu::HeadlessContext::create());
  ORIEL_TRY(const gpu::Device device, gpu::open_device());
  ORIEL_TRY(Pack pack, read_pack(asked.pack));
  Bench bench;
  bench.frames = frames;
  if (std::sscanf(asked.size.c_str(), "%dx%d", &bench.size.x, &bench.size.y) != 2)
    return fail(ErrorCode::kUsage, "--size", "found '{}', expected WxH", asked.size);
  for (const std::string& name : asked.cameras) {
    const auto known = std::ranges::find(pack.cameras, name, &Camera::name);
    if (known == pack.cameras.end()) return fail(ErrorCode::kUsage, "--camera", "found no camera '{}'", name);
    bench.cameras.push_back(*known);
  }
  ORIEL_TRY(bench.scene, GpuScene::create(std::move(pack), device));
  ORIEL_TRY(bench.renderer, Renderer::create(device));
  std::printf("%s, %zu movers of %zu triangles, %s\n\n", asked.pack.c_str(), bench.scene->pack().movers.size(),
              bench.scene->pack().movers.front().mesh.indices.size() / 3, device.renderer.c_str());
  const std::vector<std::uint32_t> lights(asked.lights.begin(), asked.lights.end());
  if (asked.methods) ORIEL_TRY_VOID(print_methods(bench, lights));
  if (asked.moving) ORIEL_TRY_VOID(print_moving(bench, 300));
  if (asked.errors) ORIEL_TRY_VOID(print_errors(bench));
  return {};
}

int bench(int argc, char** argv) {
  Asked asked;
  int frames = 3;
  if (const auto code = parse_options(
          argc, argv, "Prints what the shade of movers costs and how well it is, by method.",
          {{"PACK", "Arguments", "With movers", text(asked.pack, "PACK"), Use::kRequired},
           {"--camera", "Options", "By name; repeatable", texts(asked.cameras, "NAME"), Use::kRequired},
           {"--lights", "Options", "So many, one after the other", numbers(asked.lights, 1, 1e6)},
           {"--size", "Options", "Pixels", text(asked.size, "WxH")},
           {"--frames", "Options", "Of each measurement, of which the median counts", number(frames, 1, 1e6)},
           {"--methods", "Options", "Time by lights and method", flag(asked.methods)},
           {"--moving", "Options", "Time by maps a frame", flag(asked.moving)},
           {"--errors", "Options", "Error by lights and maps", flag(asked.errors)}}))
    return *code;
  const Status status = run(asked, frames);
  if (!status) return std::fprintf(stderr, "%s\n", status.error().text().c_str()), 1;
  return 0;
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  return oriel::bench(argc, argv);
}
