// oriel-scenes: writes the sample scenes as .glb files, and CIE standard skies as .exr images.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>

#include "formats/core/file.h"
#include "formats/image/exr.h"
#include "scenes/generators.h"
#include "scenes/kit/glb_writer.h"
#include "scenes/sky.h"

namespace {

struct Arguments {
  std::string scene;
  std::string output;
  std::string unit = "m";
  bool no_cameras = false, no_surroundings = false;
  oriel::sample::HouseOptions house;
  oriel::sample::GalleryOptions gallery;
  oriel::sample::RoomOptions room;
  oriel::sample::SkyOptions sky;
  std::string sky_output;
};

const std::map<std::string, double> kUnits_per_m{{"m", 1}, {"cm", 100}, {"mm", 1000}, {"km", 0.001}};

int report(const oriel::Error& error) {
  fmt::print(stderr, "oriel-scenes: error: {}\n", error.text());
  return static_cast<int>(error.code);
}

oriel::Result<oriel::sample::SampleScene> make_scene(const Arguments& arguments) {
  if (arguments.scene == "classroom") return oriel::sample::make_classroom();
  if (arguments.scene == "colonnade") return oriel::sample::make_colonnade();
  if (arguments.scene == "cornell") return oriel::sample::make_cornell();
  if (arguments.scene == "gallery") return oriel::sample::make_gallery(arguments.gallery);
  if (arguments.scene == "glass") return oriel::sample::make_glass();
  if (arguments.scene == "glass-sphere") return oriel::sample::make_glass_sphere();
  if (arguments.scene == "office") return oriel::sample::make_office();
  if (arguments.scene == "panels") return oriel::sample::make_panels();
  if (arguments.scene == "room") return oriel::sample::make_room();
  if (arguments.scene == "dome")
    return oriel::sample::make_room({false, arguments.room.door, !arguments.no_surroundings});
  if (arguments.scene == "studio") return oriel::sample::make_studio();
  return oriel::sample::make_house(arguments.house);
}

int run(const Arguments& arguments) {
  auto scene = make_scene(arguments);
  if (!scene) return report(scene.error());
  oriel::sample::scale_scene(*scene, kUnits_per_m.at(arguments.unit));
  if (arguments.no_cameras) {
    scene->cameras.clear();
    scene->paths.clear();
  }
  const auto bytes = oriel::sample::write_glb(*scene);
  if (!bytes) return report(bytes.error());
  if (const auto written = oriel::write_file_atomically(arguments.output, *bytes); !written)
    return report(written.error());
  fmt::print("{}: {} triangles, {} meshes, {} nodes, {} bytes\n", arguments.output,
             oriel::sample::triangle_count(*scene), scene->meshes.size(), scene->nodes.size(), bytes->size());
  return 0;
}

int run_sky(const Arguments& arguments) {
  const auto image = oriel::sample::make_sky(arguments.sky);
  if (!image) return report(image.error());
  if (const auto written = oriel::write_exr(arguments.sky_output, *image); !written) return report(written.error());
  fmt::print("{}: CIE sky of type {}, {} x {}\n", arguments.sky_output, arguments.sky.type, image->width,
             image->height);
  return 0;
}

CLI::App* add_sky(CLI::App& app, Arguments& arguments) {
  oriel::sample::SkyOptions& sky = arguments.sky;
  CLI::App* command = app.add_subcommand("sky", "Writes a CIE standard sky as a latitude-longitude .exr, cd/m²");
  command->add_option("TYPE", sky.type, "1 to 15 of ISO 15469 (CIE S 011), or 16: the traditional overcast sky")
      ->required();
  command->add_option("-o,--output", arguments.sky_output, "The .exr file to write")->required();
  command->add_option("--elevation", sky.elevation_deg, "Of the sun, degrees; its disk is not in the image")
      ->capture_default_str();
  command->add_option("--azimuth", sky.azimuth_deg, "Of the sun, degrees clockwise from north (-Z); east is +X")
      ->capture_default_str();
  auto* horizontal =
      command->add_option("--horizontal", sky.horizontal_lux, "What the sky sheds on open level ground, lux")
          ->capture_default_str();
  command->add_option("--zenith", sky.zenith_cd_m2, "The zenith's luminance instead, cd/m²")->excludes(horizontal);
  command->add_option("--ground", sky.ground, "Reflectance of the ground that fills the lower half")
      ->capture_default_str();
  command->add_option("--height", sky.height, "Rows of the image; it has twice as many columns")->capture_default_str();
  return command;
}

// An option of one scene only.
struct OwnOption {
  const CLI::Option* option;
  std::string scene;
};

std::vector<OwnOption> add_own_options(CLI::App& app, Arguments& arguments) {
  return {{app.add_option("--triangles", arguments.house.triangles,
                          "house: triangles to make, within 10 %, to see how tools scale")
               ->capture_default_str(),
           "house"},
          {app.add_option("--reflectors", arguments.house.reflectors,
                          "house: planar reflectors (mirrors, polished floors, table tops), 0 to 36")
               ->capture_default_str(),
           "house"},
          {app.add_option("--lawn", arguments.house.lawn_m2, "house: square metres of lawn around it")
               ->capture_default_str(),
           "house"},
          {app.add_option("--floor-roughness", arguments.gallery.floor_roughness,
                          "gallery: of the polished tiles, whose lobe is as wide as its square")
               ->check(CLI::Range(0.0f, 1.0f))
               ->capture_default_str(),
           "gallery"},
          {app.add_flag("--door", arguments.room.door, "dome: a door beside the window, to walk out by"), "dome"},
          {app.add_flag("--no-surroundings", arguments.no_surroundings, "dome: the room alone, without ground and sky"),
           "dome"}};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Writes a sample scene as a binary glTF file, or a standard sky as an OpenEXR image.\n"
      "Exit codes: 0 done, 1 usage, 2 the file cannot be written, 4 failed at run time.",
      "oriel-scenes"};
  Arguments arguments;
  app.add_option("scene", arguments.scene,
                 "Which scene: a classroom, a hall of 200 columns, the Cornell box, a room in a landscape under a sky "
                 "dome, a museum of three rooms, a room with glass bodies, the Cornell box with a glass sphere, a "
                 "two-storey house, an office, a wall of panels and other things that stand little proud, a closed "
                 "room without "
                 "a camera, a room with curved metal")
      ->check(CLI::IsMember({"classroom", "colonnade", "cornell", "dome", "gallery", "glass", "glass-sphere", "house",
                             "office", "panels", "room", "studio"}));
  app.add_option("-o,--output", arguments.output, "The .glb file to write");
  app.add_option("--unit", arguments.unit, "Of the file's numbers, which glTF says are metres: m, cm, mm, km")
      ->check(CLI::IsMember(kUnits_per_m))
      ->capture_default_str();
  app.add_flag("--no-cameras", arguments.no_cameras, "Leave cameras and walks out");
  const std::vector<OwnOption> own = add_own_options(app, arguments);
  const auto* sky = add_sky(app, arguments);
  try {
    app.parse(argc, argv);
    // CLI11's required() would ask for these with the subcommand too.
    for (const char* name : {"scene", "--output"})
      if (!sky->parsed() && app.get_option(name)->count() == 0) throw CLI::RequiredError(name);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(oriel::ErrorCode::kUsage);
  }
  for (const OwnOption& option : own)
    if (option.option->count() > 0 && !sky->parsed() && arguments.scene != option.scene)
      return report({oriel::ErrorCode::kUsage,
                     fmt::format("found {}, expected it with {} only", option.option->get_name(), option.scene),
                     arguments.scene});
  try {
    return sky->parsed() ? run_sky(arguments) : run(arguments);
  } catch (const std::exception& error) {
    return report({oriel::ErrorCode::kRuntime, error.what(), ""});
  }
}
