// oriel-scenes: writes the sample scenes as .glb files, and CIE standard skies as .exr images.
#include <filesystem>

#include "formats/cli/command.h"
#include "formats/core/file.h"
#include "formats/image/exr.h"
#include "scenes/generators.h"
#include "scenes/kit/glb_writer.h"
#include "scenes/sky.h"

namespace {

using namespace oriel;

struct Arguments {
  std::string scene;
  std::filesystem::path output;
  double units_per_m = 1;
  bool no_cameras = false;
  sample::HouseOptions house;
  sample::GalleryOptions gallery;
  sample::RoomOptions dome{.closed = false};
  sample::SkyOptions sky;
};

Result<sample::SampleScene> make_scene(const Arguments& arguments) {
  if (arguments.scene == "classroom") return sample::make_classroom();
  if (arguments.scene == "cornell") return sample::make_cornell();
  if (arguments.scene == "gallery") return sample::make_gallery(arguments.gallery);
  if (arguments.scene == "glass") return sample::make_glass();
  if (arguments.scene == "glass-sphere") return sample::make_glass_sphere();
  if (arguments.scene == "office") return sample::make_office();
  if (arguments.scene == "panels") return sample::make_panels();
  if (arguments.scene == "room") return sample::make_room();
  if (arguments.scene == "dome") return sample::make_room(arguments.dome);
  if (arguments.scene == "studio") return sample::make_studio();
  return sample::make_house(arguments.house);
}

Status run(const Arguments& arguments) {
  ORIEL_TRY(sample::SampleScene scene, make_scene(arguments));
  sample::scale_scene(scene, arguments.units_per_m);
  if (arguments.no_cameras) {
    scene.cameras.clear();
    scene.paths.clear();
  }
  ORIEL_TRY(const auto bytes, sample::write_glb(scene));
  ORIEL_TRY_VOID(write_file_atomically(arguments.output, bytes));
  fmt::print("{}: {} triangles, {} meshes, {} nodes, {} bytes\n", arguments.output.string(),
             sample::triangle_count(scene), scene.meshes.size(), scene.nodes.size(), bytes.size());
  return {};
}

Status run_sky(const Arguments& arguments) {
  ORIEL_TRY(const auto image, sample::make_sky(arguments.sky));
  ORIEL_TRY_VOID(write_exr(arguments.output, image));
  fmt::print("{}: CIE sky of type {}, {} x {}\n", arguments.output.string(), arguments.sky.type, image.width,
             image.height);
  return {};
}

constexpr const char *kArguments = "Arguments", *kFile = "File", *kSky = "Sky";

ToolCommand sky_command(Arguments& arguments) {
  sample::SkyOptions& sky = arguments.sky;
  return {.name = "sky",
          .help = "Writes a CIE standard sky as a latitude-longitude .exr, cd/m²",
          .footer = "",
          .options = {{"TYPE", kArguments, "1 to 15 of ISO 15469 (CIE S 011), or 16: the traditional overcast sky",
                       number(sky.type, 1, 16), Use::kRequired},
                      {"-o,--output", kFile, "The .exr file to write", path(arguments.output, "FILE"), Use::kRequired},
                      {"--elevation", kSky, "Of the sun, degrees; its disk is not in the image",
                       number(sky.elevation_deg, 0, 90), Use::kEveryday},
                      {"--azimuth", kSky, "Of the sun, degrees clockwise from north (-Z); east is +X",
                       number(sky.azimuth_deg, -360, 360), Use::kEveryday},
                      {"--horizontal", kSky, "What the sky sheds on open level ground, lux",
                       number(sky.horizontal_lux, 0, 1e9), Use::kEveryday, "", "", "--zenith"},
                      {"--zenith", kSky, "The zenith's luminance instead, cd/m²", number(sky.zenith_cd_m2, 0, 1e9),
                       Use::kEveryday},
                      {"--ground", kSky, "Reflectance of the ground that fills the lower half",
                       number(sky.ground, 0, 1), Use::kEveryday},
                      {"--height", kSky, "Rows of the image; it has twice as many columns",
                       number(sky.height, 2, 16384), Use::kEveryday}},
          .run = [&arguments] { return run_sky(arguments); }};
}

std::vector<Option> scene_options(Arguments& arguments) {
  return {
      {"SCENE", kArguments,
       "Which scene: classroom, cornell (the Cornell box), dome (a room in a "
       "landscape under a sky dome), gallery (a museum of three rooms), glass (a room with glass bodies), glass-sphere "
       "(the Cornell box with one), house (of two storeys), office, panels (and what else stands little proud of a "
       "wall), room (closed, without a camera), studio (a room with curved metal)",
       one_of(arguments.scene, {"classroom", "cornell", "dome", "gallery", "glass", "glass-sphere", "house", "office",
                                "panels", "room", "studio"}),
       Use::kRequired},
      {"-o,--output", kFile, "The .glb file to write", path(arguments.output, "FILE"), Use::kRequired},
      {"--unit", kFile, "Of the file's numbers, which glTF says are metres",
       choice(arguments.units_per_m, {{"m", 1}, {"cm", 100}, {"mm", 1000}, {"km", 0.001}}), Use::kEveryday},
      {"--no-cameras", kFile, "Leave cameras and walks out", flag(arguments.no_cameras), Use::kEveryday}};
}

// The scene that each is for heads it in the help.
std::vector<Option> own_options(Arguments& arguments) {
  return {{"--triangles", "house", "Triangles to make, within 10 %, to see how tools scale",
           number(arguments.house.triangles, 0, 1e9), Use::kEveryday},
          {"--reflectors", "house", "Planar reflectors (mirrors, polished floors, table tops)",
           number(arguments.house.reflectors, 0, sample::kMaxHouseReflectors), Use::kEveryday},
          {"--floor-roughness", "gallery", "Of the polished tiles, whose lobe is as wide as its square",
           number(arguments.gallery.floor_roughness, 0, 1), Use::kEveryday},
          {"--no-surroundings", "dome", "The room alone, without ground and sky",
           flag(arguments.dome.surroundings, false), Use::kEveryday}};
}

Status settle(const Given& given, const Arguments& arguments, const std::vector<Option>& own) {
  for (const Option& option : own)
    if (given.has(option.name) && arguments.scene != option.group)
      return fail(ErrorCode::kUsage, arguments.scene, "found {}, expected it with {} only", option.name, option.group);
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  const std::vector<Option> own = own_options(arguments);
  CommandLine line{ORIEL_VERSION,
                   {.name = "oriel-scenes",
                    .help = "Writes a sample scene as a binary glTF file, or a standard sky as an OpenEXR image.",
                    .footer = "Exit codes: 0 done, 1 usage, 2 the file cannot be written, 4 failed at run time.",
                    .options = scene_options(arguments),
                    .settle = [&](const Given& given) { return settle(given, arguments, own); },
                    .run = [&] { return run(arguments); },
                    .commands = {sky_command(arguments)}}};
  append(line.command.options, own);
  return run_program(line, argc, argv);
}
