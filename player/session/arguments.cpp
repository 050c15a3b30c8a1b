#include "player/session/arguments.h"

#include <filesystem>

#include "formats/cli/command.h"
#include "formats/core/text.h"
#include "player/session/keys.h"
#include "player/session/live_options.h"
#include "player/session/option_names.h"
#include "player/session/reflection_options.h"

namespace oriel {
namespace {

constexpr const char* kDescription =
    "Shows an .oriel pack made by oriel-bake: in a window to walk through, or as pictures without any display.\n\n"
    "  oriel-play gallery.oriel                                     walk\n"
    "  oriel-play gallery.oriel --list                              which cameras and paths it has\n"
    "  oriel-play gallery.oriel --offscreen --camera mirror -o mirror.png\n"
    "  oriel-play gallery.oriel --offscreen --camera all -o pictures\n"
    "  oriel-play gallery.oriel --offscreen --camera walk@0 --show M -o M.exr\n"
    "  oriel-play gallery.oriel --offscreen --camera mirror --compare mirror.exr -o difference.png\n"
    "  oriel-play gallery.oriel --offscreen --path oriel-000.json --smooth 0.3 --video walk.mp4\n"
    "  oriel-play gallery.oriel --offscreen --camera mirror --panorama -o around.png\n"
    "  oriel-play before.oriel after.oriel                          both, beside each other\n";

constexpr const char* kExitCodes =
    "Exit codes: 0 done, 1 usage, 2 a file cannot be read or written, 3 the pack is broken,\n"
    "            4 failed at run time (no OpenGL 3.3, no display), 5 further from the reference than --max-flip,\n"
    "            130 stopped by the user";

constexpr double kFilmFps = 30;
constexpr int kPanoramaWidth = 2048;
constexpr int kFramesOfLens = 64;

constexpr const char *kPack = "Arguments", *kWindow = "Window", *kPicture = "Picture", *kLights = "Lights",
                     *kMovers = "Movers", *kOffscreen = "Offscreen", *kCompare = "Comparison", *kPath = "Paths",
                     *kLens = "Lens", *kDevice = "Device";

OptionValue size(PlayArguments& out) {
  return {"WxH",
          [&out](const std::string& typed) -> Status {
            char rest = 0;
            out.sized = std::sscanf(typed.c_str(), "%dx%d%c", &out.width, &out.height, &rest) == 2 && out.width > 0 &&
                        out.height > 0;
            if (out.sized) return {};
            return fail(ErrorCode::kUsage, "", "found '{}', expected WIDTHxHEIGHT, as 1280x720", typed);
          },
          [&out] { return fmt::format("{}x{}", out.width, out.height); }};
}

OptionValue exposure(std::optional<float>& ev100) {
  OptionValue value = number(ev100, -40, 40);
  value.type = "auto|EV";
  value.set = [&ev100, set = value.set](const std::string& typed) -> Status {
    ev100.reset();
    if (typed == "auto" || set(typed)) return {};
    return fail(ErrorCode::kUsage, "", "found '{}', expected auto or an exposure value from -40 to 40", typed);
  };
  value.get = [&ev100] { return ev100 ? fmt::format("{}", *ev100) : "auto"; };
  value.json = [&ev100] { return ev100 ? Json(*ev100) : Json("auto"); };
  return value;
}

OptionValue gpu_memory(std::uint64_t& bytes) {
  return {"SIZE",
          [&bytes](const std::string& typed) -> Status {
            ORIEL_TRY(bytes, parse_bytes(typed));
            return {};
          },
          [&bytes] { return bytes == kNoLimit ? "" : fmt::format("{}B", bytes); },
          [&bytes] { return bytes == kNoLimit ? Json() : Json(bytes); }};
}

OptionValue frames(int& count) {
  OptionValue value = number(count, 1, 1e9);
  value.get = [&count] { return count > 0 ? std::to_string(count) : ""; };
  return value;
}

OptionValue fps(double& target) {
  OptionValue value = number(target, 0.01, 1000);
  value.get = [&target] { return target > 0 ? fmt::format("{}", target) : ""; };
  return value;
}

std::vector<Option> picture_options(PlayArguments& out) {
  return {
      {"--exposure", kPicture,
       "Exposure value at ISO 100: 1.2 * 2^EV cd/m2 is shown as white (a room: 5 to 9, daylight: 15). auto: the "
       "frame's log-average luminance becomes middle grey",
       exposure(out.ev100), Use::kEveryday, "exposure"},
      {"--tonemap", kPicture, "Tone curve: aces rolls highlights off like film, none clips them",
       choice(out.curve, kToneCurves), Use::kRare},
      {"--show", kPicture,
       "What to show: the image that reflectors see (M), blurred by their roughness (MK), times their reflectance "
       "(MKR), the diffuse light alone (D), or the whole frame (all); or of each texel its illuminance (lux), standard "
       "error (error), state (texels) or chart (charts) in colours",
       choice(out.frame.show, kStages), Use::kEveryday, "show"},
      {"--pvs", kPicture,
       "Draw only what may be seen from where the eye stands, where the pack knows it; off: all that lies in the view, "
       "to compare with",
       choice(out.frame.visible_sets, kSwitch), Use::kRare, "pvs"},
      {"--samples", kPicture, "Samples of a pixel: edges are smooth from 4 on; as many as the device has. 1 is fastest",
       number(out.frame.samples, 1, 64), Use::kRare, "samples"},
  };
}

std::vector<Option> mover_options(PlayArguments& out) {
  return {
      {"--move", kMovers, "Puts a mover or a lamp there, world metres, and turns it about up by degrees; repeatable",
       each(out.moves, "NODE=x,y,z[,yaw]", parse_move, text_of), Use::kEveryday},
      {"--time", kMovers, "Seconds into the movers' animations, which repeat; the window goes on from there",
       number(out.time_s, -1e9, 1e9)},
      {"--mover-lights", kMovers,
       "How the brightest lights shine on movers: by pixel with shadows, without them, or in harmonics as other light",
       choice(out.frame.mover_lights, kMoverLights)},
      {"--shade", kMovers, "Lights that stand for light from everywhere, in which movers throw shade; 0: no such shade",
       number(out.frame.shade.lights, 0, kMostShadeLights), Use::kRare},
  };
}

std::vector<Option> offscreen_options(PlayArguments& out) {
  return {
      {"--offscreen", kOffscreen, "Draw pictures into files: needs no display and no window", flag(out.offscreen),
       Use::kEveryday},
      {"-o,--output", kOffscreen,
       "With --offscreen: the file (.png as shown, .exr linear cd/m2), or with several cameras a folder",
       text(out.output, "FILE|DIR"), Use::kEveryday},
      {"--supersample", kOffscreen,
       "Pictures and F12 are drawn so many times as wide and as high, and averaged: smooth edges",
       number(out.supersample, 1, 16), Use::kRare, "", "", "--compare"},
      {"--format", kOffscreen, "Of the files written to a folder", one_of(out.format, {"png", "exr"}), Use::kRare, "",
       "", "--compare"},
      {"--frames", kOffscreen,
       "Close the window after so many frames. Offscreen: draw each camera so often and report the median time, or so "
       "many frames along --path",
       frames(out.frames), Use::kRare, "", "", "--compare"},
      {"--panorama", kOffscreen,
       "Offscreen: all that is seen from the camera's eye, latitude and longitude, 2048x1024 unless --size tells; the "
       "middle is the camera's heading",
       flag(out.panorama), Use::kRare, "", "", "--compare --path --frames"},
      {"--stats", kOffscreen,
       "Times as JSON. Offscreen of each pass, with counts and the options; of the window, when it closes, how fast "
       "frames came while something moved and how soon the whole one after it",
       text(out.stats, "FILE")},
  };
}

std::vector<Option> compare_options(PlayArguments& out) {
  return {
      {"--compare", kCompare,
       "With --offscreen: print how far the frame is from this file of oriel-bake render, whole and over its "
       "reflectors; -o is then the picture of reference, frame and FLIP side by side. Or with an earlier frame: how "
       "many pixels have changed, and how much; -o is then FLIP's. Or with another pack by the same camera, likewise",
       text(out.reference, "FILE.exr|FILE.png|FILE.oriel"), Use::kEveryday},
      {"--json", kCompare, "The numbers of --compare as JSON", text(out.json, "FILE")},
      {"--max-flip", kCompare, "End with exit code 5 where the frame's FLIP is above this", number(out.max_flip, 0, 1)},
  };
}

std::vector<Option> path_options(PlayArguments& out) {
  return {
      {"--path", kPath,
       "A path of the pack, or a walk that F9 has recorded. Offscreen: frames along it instead of cameras; prints how "
       "they flicker. In the window: what P plays",
       text(out.path, "NAME|FILE.json"), Use::kEveryday},
      {"--fps", kPath, "Offscreen: so many frames a second of --path, from its start; --video: 30", fps(out.fps),
       Use::kRare, "", "", "--frames", "--path"},
      {"--smooth", kPath,
       "Average --path over time by a Gaussian of this standard deviation, in seconds, which takes the jerks out",
       number(out.smooth_s, 0, 60), Use::kRare, "", "", "", "--path"},
      {"--video", kPath,
       "Offscreen: --path as a film, by ffmpeg; without it its frames become pictures in the folder NAME-frames",
       text(out.video, "NAME.mp4"), Use::kEveryday, "", "", "--frames", "--path"},
  };
}

std::vector<Option> light_options(PlayArguments& out) {
  return {
      {"--light", kLights,
       "A group of lamps (--list tells which there are) dimmed, switched or coloured: a share of what was baked, off, "
       "a colour temperature, a colour. * stands for all groups, day for the sun and sky of the pack's day. May be "
       "repeated; the last counts",
       texts(out.lights, "NAME=0.3|off|on|2700K|#rrggbb"), Use::kEveryday, "lights"},
      {"--hour", kLights,
       "The time of the pack's day (oriel-bake --day) that is shown, by its clock, between those baked: 14.5 or 14:30. "
       "--list tells which it has",
       clock_hour(out.hour), Use::kEveryday, "hour"},
      {"--lights", kLights,
       "What lamps are set to, from a file that the window keeps: {\"desk\": \"0.3 2700K\", \"hall\": \"off\"}. "
       "--light comes after it",
       text(out.lights_file, "FILE"), Use::kRare, "lights_file"},
  };
}

std::vector<Option> window_options(PlayArguments& out) {
  return {
      {"PACK", kPack, "The .oriel pack", text(out.pack, "PACK"), Use::kRequired},
      {"OTHER", kPack,
       "Another pack of the building, or a picture (.exr linear cd/m2, .png as shown), to be seen beside it by the "
       "same "
       "camera",
       text(out.other, "OTHER"), Use::kEveryday},
      {"--split", kWindow,
       "Beside OTHER: the share of the width that shows PACK; the window's divider can be dragged from there",
       number(out.divider, 0, 1)},
      {"--list", kWindow, "Print the cameras and paths of the pack, and stop", flag(out.list), Use::kEveryday},
      {"--size", kWindow,
       "Pixels of the window or the picture; with --compare the reference's, or a whole multiple that is averaged",
       size(out), Use::kEveryday},
      {"--camera", kWindow,
       "A camera by name or by number from 0, PATH@SECONDS for a point of a path, or eye and target in world metres. "
       "May "
       "be repeated offscreen; all: every camera of the pack",
       texts(out.cameras, "NAME|N|PATH@S|ex,ey,ez,tx,ty,tz|all"), Use::kEveryday},
      {"--log-frames", kWindow, "A line on stderr whenever the window shows something else: for scripts that drive it",
       flag(out.log_frames)},
      {"--quality", kWindow,
       "auto keeps 15 frames a second while something moves, with coarser frames where the device needs that, and "
       "draws "
       "the whole frame once it stands still; full draws each frame whole; fast none",
       choice(out.quality, kQualities), Use::kEveryday},
      {"--eye-height", kWindow,
       "Of people who walk, over the floor; their steps, speed and reach go with it. Default: as the bake found it",
       length(out.eye_height_m)},
      {"--gpu-memory", kDevice,
       "Textures, lightmap pages and maps take no more than this on the device: what is near and in view is shown as "
       "it "
       "is, the rest coarser or not at all. Without it: no limit",
       gpu_memory(out.gpu_memory), Use::kRare, "gpu_memory"},
  };
}

std::string contradiction(const PlayArguments& out) {
  const bool measures = !out.stats.empty() || !out.path.empty();
  const bool compares = !out.reference.empty();
  if (compares && out.toned && std::filesystem::path(out.reference).extension() == ".exr")
    return "--compare shows linear light without a tone curve: leave --tonemap out";
  if (compares && !out.offscreen) return "--compare needs --offscreen";
  if (out.divided && out.other.empty()) return "--split parts two: a second pack or a picture is missing";
  if (compares && !out.other.empty()) return "found both --compare and " + out.other + ", expected one of them";
  if (out.panorama && !out.other.empty()) return "--panorama shows one pack: leave " + out.other + " out";
  if (compares && measures) return "--compare draws one frame: leave --path and --stats out";
  if (!compares && (!out.json.empty() || out.max_flip)) return "--json and --max-flip are for --compare";
  if (compares && (out.cameras.size() > 1 || (out.cameras.size() == 1 && out.cameras[0] == "all")))
    return "--compare takes one camera";
  if (compares && out.frame.show != Show::kAll) return "--compare draws the stages that it needs: leave --show out";
  if (compares && !out.output.empty() && std::filesystem::path(out.output).extension() != ".png")
    return "--compare writes its picture as .png";
  if (out.offscreen && !out.list && !compares && !measures && out.output.empty())
    return "--offscreen draws into files: -o FILE is missing";
  if (!out.offscreen && !out.output.empty()) return "-o needs --offscreen";
  if (!out.offscreen && (!out.video.empty() || out.fps > 0 || out.smooth_s > 0 || out.panorama))
    return "--video, --fps, --smooth and --panorama need --offscreen";
  if (!out.offscreen && (out.lens.frames > 1 || out.lens.open()))
    return "--accumulate, --aperture and --shutter need --offscreen";
  if (out.lens.frames > 1 && !out.other.empty()) return "--accumulate shows one pack: leave " + out.other + " out";
  if (!out.video.empty() && !out.output.empty()) return "found both --video and -o, expected one of them";
  if (!out.video.empty() && !std::filesystem::path(out.video).has_extension())
    return "--video takes the kind of film from its name: expected an extension, as .mp4";
  if (out.panorama && out.supersample > 1) return "--panorama is drawn at its size: leave --supersample out";
  if (out.panorama && !out.stats.empty()) return "--panorama is not timed: leave --stats out";
  if (out.panorama && out.width != 2 * out.height)
    return "found --size " + std::to_string(out.width) + "x" + std::to_string(out.height) +
           ", expected twice as wide as high of --panorama";
  if (out.offscreen && !out.path.empty() && !out.cameras.empty())
    return "found both --path and --camera, expected one of them";
  if (!out.offscreen && (out.cameras.size() > 1 || (out.cameras.size() == 1 && out.cameras[0] == "all"))) {
    return "several cameras need --offscreen";
  }
  return {};
}

Status settle(const Given& given, PlayArguments& out) {
  if (!out.video.empty() && out.fps == 0) out.fps = kFilmFps;
  if (out.lens.open() && !given.has("--accumulate")) out.lens.frames = kFramesOfLens;
  if (out.panorama && !out.sized) out.width = kPanoramaWidth, out.height = kPanoramaWidth / 2;
  out.given = given.typed();
  out.toned = given.has("--tonemap"), out.sampled = given.has("--samples"), out.divided = given.has("--split");
  out.frame.halves = out.makes_pictures();
  // Sides of a panorama and frames of a film show the same reflectors.
  if (out.offscreen && (out.panorama || !out.path.empty()) && !given.has("--frame-budget"))
    out.frame.image_budget_ms = std::numeric_limits<float>::infinity();
  if (const std::string complaint = contradiction(out); !complaint.empty())
    return fail(ErrorCode::kUsage, "", "{}", complaint);
  return {};
}

}  // namespace

std::vector<Option> play_options(PlayArguments& out) {
  std::vector<Option> options = window_options(out);
  for (auto&& more : {offscreen_options(out), picture_options(out), reflection_options(kPicture, out),
                      light_options(out), mover_options(out), live_options(kLights, out.frame.live), path_options(out),
                      lens_options(kLens, out.lens), compare_options(out)})
    append(options, more);
  return options;
}

Json options_json(const PlayArguments& arguments) {
  PlayArguments copy = arguments;
  Json json;
  for (const Option& option : play_options(copy)) record(option, json);
  return json;
}

std::variant<PlayArguments, int> parse_arguments(int argc, const char* const* argv) {
  PlayArguments out;
  CommandLine line{
      ORIEL_PLAY_VERSION,
      {"oriel-play", kDescription, "In the window:\n" + key_help() + "\n" + kExitCodes, play_options(out)}};
  line.command.settle = [&out](const Given& given) { return settle(given, out); };
  line.command.run = []() -> Status { return {}; };
  const auto parsed = parse(line, argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  return out;
}

}  // namespace oriel
