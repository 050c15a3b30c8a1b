// oriel-scenes: writes the sample scenes as .glb files, and CIE standard skies as .exr images.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "formats/core/file.h"
#include "formats/image/exr.h"
#include "scenes/generators.h"
#include "scenes/kit/glb_writer.h"
#include "scenes/sky.h"

namespace {

struct Arguments {
  std::string scene;
  std::string output;
  oriel::sample::HouseOptions house;
  oriel::sample::GalleryOptions gallery;
  bool has_house_options = false, has_gallery_options = false;
  oriel::sample::SkyOptions sky;
  std::string sky_output;
};

int report(const oriel::Error& error) {
  fmt::print(stderr, "oriel-scenes: error: {}\n", error.text());
  return static_cast<int>(error.code);
}

oriel::Result<oriel::sample::Scene> make_scene(const Arguments& arguments) {
  if (arguments.scene == "cornell") return oriel::sample::make_cornell();
  if (arguments.scene == "gallery") return oriel::sample::make_gallery(arguments.gallery);
  if (arguments.scene == "studio") return oriel::sample::make_studio();
  return oriel::sample::make_house(arguments.house);
}

int run(const Arguments& arguments) {
  if (arguments.scene != "house" && arguments.has_house_options) {
    return report({oriel::ErrorCode::kUsage, "found --triangles or --reflectors, expected them with house only",
                   arguments.scene});
  }
  if (arguments.scene != "gallery" && arguments.has_gallery_options) {
    return report(
        {oriel::ErrorCode::kUsage, "found --floor-roughness, expected it with gallery only", arguments.scene});
  }
  const auto scene = make_scene(arguments);
  if (!scene) return report(scene.error());
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

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Writes a sample scene as a binary glTF file, or a standard sky as an OpenEXR image.\n"
      "Exit codes: 0 done, 1 usage, 2 the file cannot be written, 4 failed at run time.",
      "oriel-scenes"};
  Arguments arguments;
  app.add_option("scene", arguments.scene,
                 "Which scene: the Cornell box, a museum of three rooms, a two-storey house, a room with curved metal")
      ->check(CLI::IsMember({"cornell", "gallery", "house", "studio"}));
  app.add_option("-o,--output", arguments.output, "The .glb file to write");
  const auto* triangles = app.add_option("--triangles", arguments.house.triangles,
                                         "house: triangles to make, within 10 %, to see how tools scale")
                              ->capture_default_str();
  const auto* reflectors = app.add_option("--reflectors", arguments.house.reflectors,
                                          "house: planar reflectors (mirrors, polished floors, table tops), 0 to 36")
                               ->capture_default_str();
  const auto* roughness = app.add_option("--floor-roughness", arguments.gallery.floor_roughness,
                                         "gallery: of the polished tiles, whose lobe is as wide as its square")
                              ->check(CLI::Range(0.0f, 1.0f))
                              ->capture_default_str();
  const auto* sky = add_sky(app, arguments);
  try {
    app.parse(argc, argv);
    // CLI11's required() would ask for these with the subcommand too.
    for (const char* name : {"scene", "--output"})
      if (!sky->parsed() && app.get_option(name)->count() == 0) throw CLI::RequiredError(name);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(oriel::ErrorCode::kUsage);
  }
  arguments.has_gallery_options = roughness->count() > 0;
  arguments.has_house_options = triangles->count() > 0 || reflectors->count() > 0;
  try {
    return sky->parsed() ? run_sky(arguments) : run(arguments);
  } catch (const std::exception& error) {
    return report({oriel::ErrorCode::kRuntime, error.what(), ""});
  }
}
