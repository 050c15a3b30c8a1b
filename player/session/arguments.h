// The command line of oriel-play.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "formats/cli/option.h"
#include "formats/core/json.h"
#include "formats/core/result.h"
#include "formats/query/mover_pose.h"
#include "player/images/residency.h"
#include "player/passes/display_pass.h"
#include "player/scene/frame_options.h"
#include "player/session/lens_options.h"
#include "player/session/light_settings.h"
#include "player/session/pace.h"

namespace oriel {

// Of a pixel, unless told: a sawtooth edge is the first thing that people see.
inline constexpr int kSamples = 4;

struct PlayArguments {
  std::vector<std::string> given;  // long names of options that the command line has
  std::string pack;
  std::string other;     // pack or picture that it is shown beside; none
  float divider = 0.5f;  // of the two, share of the width
  bool divided = false;  // --split was given
  bool list = false;
  bool offscreen = false;
  int width = 1280, height = 720;
  int supersample = 1;               // pixels averaged to one of a picture, on each axis
  bool sized = false;                // --size was given
  bool sampled = false;              // --samples was given
  std::vector<std::string> cameras;  // as written; "all" is every camera of the pack
  std::vector<std::string> lights;   // as written, for set_lights(); of a file before others
  std::string lights_file;
  std::optional<float> hour;                 // of the pack's day, after both
  std::vector<LightSetting> light_settings;  // what both make of the pack's, once it is open; frame.lights too
  std::vector<MoverMove> moves;
  double time_s = 0;           // of animations; the window's clock starts there
  std::optional<float> ev100;  // nothing: automatic
  ToneCurve curve = ToneCurve::kAces;
  FrameOptions frame{.image_budget_ms = kBudgetOfDevice, .samples = kSamples};
  std::string output;          // a file, or a folder
  std::string format = "png";  // of files in a folder
  bool toned = false;          // --tonemap was given
  std::string
      reference;     // compare with this file of `oriel-bake render`, or earlier frame, instead of drawing into files
  std::string json;  // file for the comparison's numbers
  std::optional<double> max_flip;
  int frames = -1;     // the window closes after so many, -1: never; offscreen: drawn of each camera or the path
  std::string path;    // of the pack by name, or a .json file. Offscreen: frames along it instead of cameras
  double fps = 0;      // of frames along it; 0: `frames` from end to end
  float smooth_s = 0;  // standard deviation that the path is smoothed with
  std::string video;   // film of the path
  bool panorama = false;
  LensSettings lens;
  std::string stats;                    // a file for what the frames cost
  std::uint64_t gpu_memory = kNoLimit;  // bytes of images on the device
  bool log_frames = false;              // tell scripts what the window shows
  Quality quality = Quality::kAutomatic;
  float eye_height_m = 0;  // of people over the floors; 0: as the pack has it

  // Alone: light that is measured, or kept as .exr, is not rounded to half floats.
  bool makes_pictures() const {
    return (reference.empty() || reference.ends_with(".png")) && format == "png" && !output.ends_with(".exr") &&
           (!offscreen || path.empty());
  }
};

// Supersampled pictures have smooth edges already, and large frames.
inline int samples_of_picture(const PlayArguments& arguments) {
  return arguments.supersample > 1 && !arguments.sampled ? 1 : arguments.frame.samples;
}

std::vector<Option> play_options(PlayArguments& out);

// Those options that can change a frame, by name.
Json options_json(const PlayArguments& arguments);

// The arguments, or the exit code after help or a complaint was printed.
std::variant<PlayArguments, int> parse_arguments(int argc, const char* const* argv);

}  // namespace oriel
