#include "player/options/arguments.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>

#include "formats/core/text.h"
#include "player/options/option_names.h"
#include "player/session/keys.h"

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

std::string parse_size(const std::string& text, int& width, int& height) {
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) == 2 && width > 0 && height > 0) return {};
  return "found '" + text + "', expected WIDTHxHEIGHT, as 1280x720";
}

std::string parse_exposure(const std::string& text, std::optional<float>& ev100) {
  ev100.reset();
  if (text == "auto") return {};
  char* end = nullptr;
  const float value = std::strtof(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(std::fabs(value) <= 40)) {
    return "found '" + text + "', expected auto or an exposure value from -40 to 40";
  }
  ev100 = value;
  return {};
}

void add_picture_options(CLI::App& app, PlayArguments& out) {
  app.add_option_function<std::string>(
         "--exposure",
         [&out](const std::string& text) {
           const std::string complaint = parse_exposure(text, out.ev100);
           if (!complaint.empty()) throw CLI::ValidationError("--exposure", complaint);
         },
         "Exposure value at ISO 100: 1.2 * 2^EV cd/m2 is shown as white (a room: 5 to 9, daylight: 15). auto: the "
         "frame's "
         "log-average luminance becomes middle grey")
      ->type_name("EV|auto")
      ->default_str("auto");
  app.add_option("--tonemap", out.curve, "Tone curve: aces rolls highlights off like film, none clips them")
      ->transform(CLI::CheckedTransformer(kToneCurves).description(""))
      ->type_name("aces|none")
      ->default_str("aces");
  app.add_option(
         "--show", out.frame.show,
         "What to show: the image that reflectors see (M), blurred by their roughness (MK), times their reflectance "
         "(MKR), the diffuse light alone (D), or the whole frame (all); or of each texel its illuminance (lux), "
         "standard error (error), state (texels) or chart (charts) in colours; how many surfaces each pixel is drawn "
         "by "
         "(overdraw); or where reflections were planned for (zones)")
      ->transform(CLI::CheckedTransformer(kStages).description(""))
      ->type_name("M|MK|MKR|D|all|lux|error|texels|charts|overdraw|zones")
      ->default_str("all");
  app.add_option(
         "--reflections", out.frame.reflections,
         "What reflectors show: rays marched through their radiance maps, the maps' pixels as points as Bastos et "
         "al. published it, the mirrored scene drawn again, or nothing")
      ->transform(CLI::CheckedTransformer(kReflections).description(""))
      ->type_name("march|points|geometry|off")
      ->default_str("march");
  app.add_option("--maps", out.frame.maps_per_element,
                 "Radiance maps blended for each reflector element in view: more fill more gaps and cost more time; 0 "
                 "shows none")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  app.add_option("--select", out.frame.selection,
                 "Which maps: taken from the direction nearest to the mirrored eye's, or from the nearest place")
      ->transform(CLI::CheckedTransformer(kSelections).description(""))
      ->type_name("angle|distance")
      ->default_str("angle");
  app.add_option("--blur", out.frame.blur,
                 "K's width in the image: by the distance of what is reflected, one for all distances as Bastos et al. "
                 "published it (of the reflector's mean one), or as sharp as a mirror. Lamps that a glossy reflector's "
                 "maps leave "
                 "out are exact for the first two")
      ->transform(CLI::CheckedTransformer(kBlurs).description(""))
      ->type_name("distance|constant|off")
      ->default_str("distance");
  app.add_option("--kernel", out.frame.kernel,
                 "K as the lobe, which leaves the mirror direction at grazing angles, or centred on the mirror ray as "
                 "Bastos et al. published it; not of lamps that a glossy reflector's maps leave out")
      ->transform(CLI::CheckedTransformer(kKernelPlaces).description(""))
      ->type_name("lobe|centred")
      ->default_str("lobe");
  app.add_option("--fresnel", out.frame.reflectance,
                 "R from the exact table by angle, or from the sphere map as Bastos et al. published it")
      ->transform(CLI::CheckedTransformer(kReflectances).description(""))
      ->type_name("table|sphere")
      ->default_str("table");
  app.add_option("--pvs", out.frame.visible_sets,
                 "Draw only what may be seen from where the eye stands, where the pack knows it; off: all that lies in "
                 "the view, to compare with")
      ->transform(CLI::CheckedTransformer(kSwitch).description(""))
      ->type_name("on|off")
      ->default_str("on");
  app.add_option("--samples", out.frame.samples,
                 "Samples of a pixel: edges are smooth from 4 on; as many as the device has. 1 is fastest")
      ->check(CLI::Range(1, 64))
      ->type_name("N")
      ->capture_default_str();
  app.add_flag(
      "!--no-mipmaps", out.frame.mipmaps,
      "Textures at full resolution at each pixel's centre, as a ray tracer without antialiasing samples them: for "
      "comparing frames");
}

void add_mover_options(CLI::App& app, PlayArguments& out) {
  app.add_option_function<std::vector<std::string>>(
         "--move",
         [&out](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             const Result<MoverMove> move = parse_move(text);
             if (!move) throw CLI::ValidationError("--move", move.error().message);
             out.moves.push_back(*move);
           }
         },
         "Puts a mover there, world metres, and turns it about up by degrees; repeatable")
      ->type_name("NODE=x,y,z[,yaw]")
      ->allow_extra_args(false);
  app.add_option("--time", out.time_s,
                 "Seconds into the movers' animations, which repeat; the window goes on from there")
      ->check(CLI::Range(-1e9, 1e9))
      ->type_name("S")
      ->capture_default_str();
  app.add_option("--mover-lights", out.frame.mover_lights,
                 "How the brightest lights shine on movers: pixel by pixel with shadows from and onto them, without "
                 "shadows, or in harmonics as all other light")
      ->transform(CLI::CheckedTransformer(kMoverLights).description(""))
      ->type_name("shadowed|unshadowed|harmonics")
      ->default_str("shadowed");
  app.add_option(
         "--light-points", out.frame.light_points,
         "Points of a bright light that movers' shadows are taken from, at most: lights that look small take fewer")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
}

void add_compare_options(CLI::App& app, PlayArguments& out) {
  app.add_option(
         "--compare", out.reference,
         "With --offscreen: print how far the frame is from this file of oriel-bake render, whole and over its "
         "reflectors; -o is then the picture of reference, frame and FLIP side by side. Or with an earlier frame: "
         "how many pixels have changed, and how much; -o is then FLIP's. Or with another pack by the same camera, "
         "likewise")
      ->type_name("FILE.exr|png|oriel");
  app.add_option("--json", out.json, "The numbers of --compare as JSON")->type_name("FILE");
  app.add_option("--max-flip", out.max_flip, "End with exit code 5 where the frame's FLIP is above this")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("X");
}

void add_path_options(CLI::App& app, PlayArguments& out) {
  CLI::Option* path =
      app.add_option("--path", out.path,
                     "A path of the pack, or a walk that F9 has recorded. Offscreen: frames along it instead of "
                     "cameras; prints how they flicker. In the window: what P plays")
          ->type_name("NAME|FILE.json");
  app.add_option("--fps", out.fps, "Offscreen: so many frames a second of --path, from its start; --video: 30")
      ->check(CLI::Range(0.01, 1000.0))
      ->needs(path)
      ->excludes(app.get_option("--frames"))
      ->type_name("N");
  app.add_option("--smooth", out.smooth_s,
                 "Average --path over time by a Gaussian of this standard deviation, which takes the jerks out")
      ->check(CLI::Range(0.0f, 60.0f))
      ->needs(path)
      ->type_name("SECONDS");
  app.add_option("--video", out.video,
                 "Offscreen: --path as a film, by ffmpeg; without it its frames become pictures in the folder "
                 "NAME-frames")
      ->needs(path)
      ->excludes(app.get_option("--frames"))
      ->type_name("NAME.mp4");
}

void add_options(CLI::App& app, PlayArguments& out) {
  app.add_option("pack", out.pack, "The .oriel pack")->required()->type_name("PACK");
  app.add_option(
         "other", out.other,
         "Another pack of the building, or a picture (.exr linear cd/m2, .png as shown), to be seen beside it by "
         "the same camera")
      ->type_name("OTHER");
  app.add_option("--split", out.divider,
                 "Beside OTHER: the share of the width that shows PACK; the window's divider can be dragged from there")
      ->check(CLI::Range(0.0f, 1.0f))
      ->type_name("X")
      ->capture_default_str();
  app.add_flag("--list", out.list, "Print the cameras and paths of the pack, and stop");
  app.add_flag("--offscreen", out.offscreen, "Draw pictures into files: needs no display and no window");
  app.add_option_function<std::string>(
         "--size",
         [&out](const std::string& text) {
           const std::string complaint = parse_size(text, out.width, out.height);
           if (!complaint.empty()) throw CLI::ValidationError("--size", complaint);
           out.sized = true;
         },
         "Pixels of the window or the picture; with --compare the reference's, or a whole multiple that is averaged")
      ->type_name("WxH")
      ->default_str("1280x720");
  app.add_option(
         "--camera", out.cameras,
         "A camera by name or by number from 0, PATH@SECONDS for a point of a path, or eye and target in world metres. "
         "May be repeated offscreen; all: every camera of the pack")
      ->type_name("NAME|N|PATH@S|ex,ey,ez,tx,ty,tz|all")
      ->allow_extra_args(false);
  add_mover_options(app, out);
  add_picture_options(app, out);
  app.add_option("-o,--output", out.output,
                 "With --offscreen: the file (.png as shown, .exr linear cd/m2), or with several cameras a folder")
      ->type_name("FILE|DIR");
  add_compare_options(app, out);
  app.add_option("--supersample", out.supersample,
                 "Pictures and F12 are drawn so many times as wide and as high, and averaged: smooth edges")
      ->check(CLI::Range(1, 16))
      ->excludes(app.get_option("--compare"))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--format", out.format, "Of the files written to a folder")
      ->check(CLI::IsMember({"png", "exr"}))
      ->excludes(app.get_option("--compare"))
      ->type_name("png|exr")
      ->capture_default_str();
  app.add_option(
         "--frames", out.frames,
         "Close the window after so many frames. Offscreen: draw each camera so often and report the median time, or "
         "so many frames along --path")
      ->check(CLI::PositiveNumber)
      ->excludes(app.get_option("--compare"))
      ->type_name("N");
  add_path_options(app, out);
  app.add_flag("--panorama", out.panorama,
               "Offscreen: all that is seen from the camera's eye, latitude and longitude, 2048x1024 unless --size "
               "tells; the middle is the camera's heading")
      ->excludes(app.get_option("--compare"))
      ->excludes(app.get_option("--path"))
      ->excludes(app.get_option("--frames"));
  app.add_option("--stats", out.stats, "Offscreen: time each pass and write times, counts and the options as JSON")
      ->type_name("FILE");
  app.add_option_function<std::string>(
         "--gpu-memory",
         [&out](const std::string& text) {
           const auto bytes = parse_bytes(text);
           if (!bytes) throw CLI::ValidationError("--gpu-memory", bytes.error().message);
           out.gpu_memory = *bytes;
         },
         "Textures, lightmap pages and maps take no more than this on the device: what is near and in view is shown as "
         "it is, the rest coarser or not at all. Without it: no limit")
      ->type_name("SIZE");
  app.add_flag("--panel", out.panel,
               "Open the panel at once: exposure, stages, reflections, times, what is under the pointer");
  app.add_flag("--gl-debug", out.gl_debug, "Print the messages of the OpenGL driver");
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
  if (!out.offscreen && !out.stats.empty()) return "--stats needs --offscreen";
  if (!out.offscreen && (!out.video.empty() || out.fps > 0 || out.smooth_s > 0 || out.panorama))
    return "--video, --fps, --smooth and --panorama need --offscreen";
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

}  // namespace

std::variant<PlayArguments, int> parse_arguments(int argc, const char* const* argv) {
  PlayArguments out;
  CLI::App app(kDescription, "oriel-play");
  app.footer("In the window:\n" + key_help() + "\n" + kExitCodes);
  app.set_version_flag("--version", "oriel-play " ORIEL_PLAY_VERSION);
  add_options(app, out);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ErrorCode::kUsage);
  }
  if (!out.video.empty() && out.fps == 0) out.fps = kFilmFps;
  if (out.panorama && !out.sized) out.width = kPanoramaWidth, out.height = kPanoramaWidth / 2;
  out.toned = app.get_option("--tonemap")->count() > 0;
  out.sampled = app.get_option("--samples")->count() > 0;
  out.divided = app.get_option("--split")->count() > 0;
  const std::string complaint = contradiction(out);
  if (!complaint.empty()) {
    std::fprintf(stderr, "oriel-play: %s\nRun with --help for more information.\n", complaint.c_str());
    return static_cast<int>(ErrorCode::kUsage);
  }
  return out;
}

}  // namespace oriel
