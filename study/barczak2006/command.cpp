// oriel-study barczak2006: what the shade of movers costs by each step of the thesis, and how well it is.
#include <algorithm>
#include <filesystem>

#include "formats/core/color.h"
#include "formats/query/camera_spec.h"
#include "formats/query/mover_pose.h"
#include "player/navigation/view.h"
#include "player/output/picture.h"
#include "study/barczak2006/shade_steps.h"
#include "study/rooms.h"

namespace oriel::study {
namespace {

constexpr float kStride = 0.02f;                    // metres: of the eye, or of movers, from frame to frame
constexpr std::uint32_t kMany = 1024, kFine = 512;  // of the reference: lights, texels of a map's side

struct ShadeArguments {
  std::vector<double> lights{25, 50, 100, 300, 1000};
  bool moving = false, errors = false;
};

class ShadeComparison {
 public:
  ShadeComparison(ShownScene& shown, ShadeSteps& steps, const ShownArguments& arguments)
      : shown_(shown), steps_(steps), arguments_(arguments) {}

  Status find_cameras() {
    ORIEL_TRY(cameras_, shown_cameras(*shown_.scene, arguments_.cameras));
    return {};
  }

  // The eye moves, movers stand. Of so many lights, by step: passes, work and times; means over cameras.
  Status print_steps(std::uint32_t lights) {
    const FrameOptions options = options_of(lights, 0);
    fmt::print(
        "\n{} lights, the eye moves; milliseconds\n\n"
        "| | passes of {} lights | cells and lights | maps drawn | what is blocked | merging | maps | light | in all "
        "|\n"
        "|---|---|---|---|---|---|---|---|---|\n",
        lights, kPublishedLights);
    const auto count = static_cast<double>(cameras_.size());
    double first = 0, last = 0;
    for (const ShadeStep step : kShadeSteps) {
      ORIEL_TRY_VOID(steps_.begin(*shown_.scene, options));
      StepCost sum;
      std::uint32_t maps = 0;
      for (const Camera& camera : cameras_) {
        ORIEL_TRY(const StepCost cost, median(options, camera, step, maps));
        sum.passes += cost.passes, sum.shade.pairs += cost.shade.pairs, sum.merge_ms += cost.merge_ms / count;
        sum.shade.cells_ms += cost.shade.cells_ms / count, sum.shade.maps_ms += cost.shade.maps_ms / count;
        sum.shade.light_ms += cost.shade.light_ms / count;
      }
      last = sum.sum_ms();
      if (step == ShadeStep::kEachLight) first = last;
      fmt::print("| {} | {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", name_of(step), sum.passes,
                 sum.shade.pairs, maps, sum.shade.cells_ms, sum.merge_ms, sum.shade.maps_ms, sum.shade.light_ms, last);
    }
    fmt::print("\nThe first takes {:.1f} times as long as the last.\n", first / last);
    return {};
  }

  // Movers move, the eye stands: by how many maps are drawn a frame.
  Status print_moving(std::uint32_t lights) {
    fmt::print(
        "\n{} lights, movers move; milliseconds\n\n"
        "| maps a frame, at most | what is blocked | maps | of them drawn | faces | light | in all |\n"
        "|---|---|---|---|---|---|---|\n",
        lights);
    for (const std::uint32_t most : {25u, 50u, 100u, 150u, 0u}) {
      ORIEL_TRY_VOID(steps_.begin(*shown_.scene, options_of(lights, 0)));
      std::vector<StepCost> all;
      for (int frame = 0; frame <= 2 * arguments_.frames; ++frame) {
        FrameOptions options = options_of(lights, frame);
        options.shade.maps_a_frame = most;
        ORIEL_TRY(const StepCost cost, steps_.draw(view_of(cameras_.front(), 0), options, ShadeStep::kLists));
        if (frame > 0) all.push_back(cost);
      }
      const StepCost& cost = middle(all);
      const ShadeStats& s = cost.shade;
      fmt::print("| {} | {:.2f} | {:.1f} | {} | {} | {:.1f} | {:.1f} |\n", most == 0 ? "all" : std::to_string(most),
                 s.cells_ms, s.maps_ms, s.maps, s.faces, s.light_ms, cost.sum_ms());
    }
    return {};
  }

  // Over pixels that the reference's shade changes by a hundredth of the largest or more, over the mean shade there.
  Status print_errors() {
    ORIEL_TRY(const std::vector<double> reference, taken(kMany, kFine, ShadeStep::kCells));
    const double least = 0.01 * *std::ranges::max_element(reference);
    constexpr std::uint32_t kSides[] = {32, 64, 128, 256, 512};
    fmt::print("\nRoot mean square error of the shade over its mean, beside {} lights and maps of {}²\n\n| lights |",
               kMany, kFine);
    for (const std::uint32_t side : kSides) fmt::print(" maps of {}² |", side);
    fmt::print("\n|---|---|---|---|---|---|\n");
    for (const std::uint32_t lights : {25u, 50u, 100u, 128u, 300u}) {
      fmt::print("| {} |", lights);
      for (const std::uint32_t side : kSides) {
        ORIEL_TRY(const std::vector<double> found, taken(lights, side, ShadeStep::kLists));
        double squares = 0, sum = 0, pixels = 0;
        for (std::size_t i = 0; i < found.size(); ++i) {
          if (!(reference[i] > least)) continue;
          squares += (found[i] - reference[i]) * (found[i] - reference[i]), sum += reference[i], ++pixels;
        }
        fmt::print(" {:.1f} % |", pixels > 0 ? 100 * std::sqrt(squares / pixels) / (sum / pixels) : 0.0);
      }
      fmt::print("\n");
    }
    return {};
  }

  // Of the first camera, by step, the light that movers take.
  Status write_pictures(std::uint32_t lights) {
    std::error_code failed;
    std::filesystem::create_directories(arguments_.output, failed);
    if (failed) return fail(ErrorCode::kIo, arguments_.output, "cannot be made: {}", failed.message());
    const FrameOptions options = options_of(lights, 0);
    ORIEL_TRY_VOID(steps_.begin(*shown_.scene, options));
    std::optional<float> ev100 = arguments_.ev100;
    for (const ShadeStep step : kShadeSteps) {
      ORIEL_TRY_VOID(steps_.draw(view_of(cameras_.front(), 0), options, step));
      ORIEL_TRY_VOID(shown_.renderer->take_light(steps_.read()));
      if (!ev100) {
        ORIEL_TRY(ev100, shown_.renderer->meter());
      }
      const std::string file =
          fmt::format("{}/{}-{}.png", arguments_.output, static_cast<int>(step) + 1, cameras_.front().name);
      ORIEL_TRY_VOID(write_picture(
          *shown_.renderer, file,
          {cameras_.front(), shown_.scene->pack().mesh.origin, cameras_.front().name, ev100.value_or(0.0f)}));
    }
    return {};
  }

 private:
  FrameOptions options_of(std::uint32_t lights, int mover_strides) const {
    FrameOptions out;
    out.shade.lights = lights;
    for (const Mover& mover : shown_.scene->pack().movers) {
      out.poses.push_back(mover.rest);
      out.poses.back().position.x += kStride * static_cast<float>(mover_strides);
    }
    return out;
  }

  View view_of(Camera camera, int eye_strides) const {
    camera.eye.x += kStride * static_cast<float>(eye_strides);
    const FrameOptions options = options_of(0, 0);
    return make_view(camera, arguments_.width, arguments_.height, bounds_with_movers(*shown_.scene, options.poses));
  }

  static const StepCost& middle(std::vector<StepCost>& all) {
    std::ranges::sort(all, {}, &StepCost::sum_ms);
    return all[all.size() / 2];
  }

  // Of frames after the first. maps: that the first one draws are added.
  Result<StepCost> median(const FrameOptions& options, const Camera& camera, ShadeStep step, std::uint32_t& maps) {
    std::vector<StepCost> all;
    const int frames = step == ShadeStep::kEachLight ? 1 : arguments_.frames;
    for (int frame = 0; frame <= frames; ++frame) {
      ORIEL_TRY(const StepCost cost, steps_.draw(view_of(camera, frame), options, step));
      maps += cost.shade.maps;
      if (frame > 0) all.push_back(cost);
    }
    return middle(all);
  }

  // Luminances of the light that movers take, camera by camera.
  Result<std::vector<double>> taken(std::uint32_t lights, std::uint32_t map_side, ShadeStep step) {
    FrameOptions options = options_of(lights, 0);
    options.shade.map_side = map_side;
    ORIEL_TRY_VOID(steps_.begin(*shown_.scene, options));
    std::vector<double> out;
    for (const Camera& camera : cameras_) {
      ORIEL_TRY_VOID(steps_.draw(view_of(camera, 0), options, step, kMany));
      const FloatImage image = steps_.read();
      for (std::size_t i = 0; i + 2 < image.pixels.size(); i += image.channels)
        out.push_back(luminance(Vec3(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2])));
    }
    return out;
  }

  ShownScene& shown_;
  ShadeSteps& steps_;
  const ShownArguments& arguments_;
  std::vector<Camera> cameras_;
};

Status compare_shades(const ShownArguments& arguments, const ShadeArguments& asked) {
  ORIEL_TRY(Pack pack, open_or_bake(arguments.input, {}));
  if (pack.movers.empty() || pack.lightmaps.empty())
    return fail(ErrorCode::kUsage, arguments.input,
                "found no movers over a lightmap, expected some: oriel-bake --object NODE:mover makes them");
  ORIEL_TRY(ShownScene shown, ShownScene::open(std::move(pack)));
  ORIEL_TRY(ShadeSteps steps, ShadeSteps::create(shown.device.dialect));
  ShadeComparison comparison(shown, steps, arguments);
  ORIEL_TRY_VOID(comparison.find_cameras());
  const Pack& open = shown.scene->pack();
  fmt::print("{}, {} movers of {} triangles, {}x{}, {}\n", arguments.input, open.movers.size(),
             open.movers.front().mesh.indices.size() / 3, arguments.width, arguments.height, shown.device.renderer);
  const auto most = static_cast<std::uint32_t>(std::ranges::max(asked.lights));
  for (const double lights : asked.lights) ORIEL_TRY_VOID(comparison.print_steps(static_cast<std::uint32_t>(lights)));
  if (asked.moving) ORIEL_TRY_VOID(comparison.print_moving(std::min(most, 300u)));
  if (asked.errors) ORIEL_TRY_VOID(comparison.print_errors());
  if (!arguments.output.empty()) ORIEL_TRY_VOID(comparison.write_pictures(std::min(most, 300u)));
  return {};
}

}  // namespace

ToolCommand barczak2006_command(ShownArguments& arguments) {
  auto asked = std::make_shared<ShadeArguments>();
  ToolCommand command;
  command.name = "barczak2006";
  command.help =
      "Large sets of point lights (Barczak 2006): the shade of movers by each step of the thesis; pictures are of the "
      "light that they take";
  command.options = shown_options(arguments);
  append(command.options,
         {{"--lights", "Method", "That stand for light from everywhere: so many, one after the other",
           numbers(asked->lights, 1, kMostShadeLights), Use::kEveryday},
          {"--moving", "Method", "Prints times by maps that are drawn a frame, while movers move", flag(asked->moving),
           Use::kEveryday},
          {"--errors", "Method", "Prints errors by lights and maps", flag(asked->errors), Use::kEveryday}});
  command.run = [&arguments, asked] { return compare_shades(arguments, *asked); };
  return command;
}

}  // namespace oriel::study
