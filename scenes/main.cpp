// oriel-scenes: writes the sample scenes as .glb files.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "formats/core/file.h"
#include "scenes/generators.h"
#include "scenes/kit/glb_writer.h"

namespace {

struct Arguments {
  std::string scene;
  std::string output;
  oriel::sample::HouseOptions house;
  bool has_house_options = false;
};

int report(const oriel::Error& error) {
  fmt::print(stderr, "oriel-scenes: error: {}\n", error.text());
  return static_cast<int>(error.code);
}

oriel::Result<oriel::sample::Scene> make_scene(const Arguments& arguments) {
  if (arguments.scene == "cornell") return oriel::sample::make_cornell();
  if (arguments.scene == "gallery") return oriel::sample::make_gallery();
  return oriel::sample::make_house(arguments.house);
}

int run(const Arguments& arguments) {
  if (arguments.scene != "house" && arguments.has_house_options) {
    return report({oriel::ErrorCode::kUsage, "found --triangles or --reflectors, expected them with house only",
                   arguments.scene});
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

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Writes a sample scene as a binary glTF file.\n"
      "Exit codes: 0 done, 1 usage, 2 the file cannot be written, 4 failed at run time.",
      "oriel-scenes"};
  Arguments arguments;
  app.add_option("scene", arguments.scene, "Which scene: the Cornell box, a museum of three rooms, a two-storey house")
      ->required()
      ->check(CLI::IsMember({"cornell", "gallery", "house"}));
  app.add_option("-o,--output", arguments.output, "The .glb file to write")->required();
  const auto* triangles = app.add_option("--triangles", arguments.house.triangles,
                                         "house: triangles to make, within 10 %, to see how tools scale")
                              ->capture_default_str();
  const auto* reflectors = app.add_option("--reflectors", arguments.house.reflectors,
                                          "house: planar reflectors (mirrors, polished floors, table tops), 0 to 36")
                               ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(oriel::ErrorCode::kUsage);
  }
  arguments.has_house_options = triangles->count() > 0 || reflectors->count() > 0;
  try {
    return run(arguments);
  } catch (const std::exception& error) {
    return report({oriel::ErrorCode::kRuntime, error.what(), ""});
  }
}
