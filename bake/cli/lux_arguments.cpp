#include "bake/cli/lux_arguments.h"

namespace oriel {
namespace {

constexpr const char* kFooter = R"(Examples:
  oriel-bake lux office.glb --grid floor,50cm,85cm > workplane.csv     a working plane 85 cm above the node "floor"
  oriel-bake lux office.glb --points meters.csv --error 0.2%           x,y,z,nx,ny,nz in metres, a line a point

The table has a header line. E, direct and indirect are lux as luminance and as linear R,G,B; error is one standard
deviation of E's own noise.)";

}  // namespace

CLI::App* add_lux(CLI::App& app, LuxTexts& texts, SharedTexts& shared, Arguments& args) {
  CLI::App* lux = app.add_subcommand("lux", "Prints the illuminance at points as CSV; no lightmap, no pack");
  lux->footer(kFooter);
  MeasureJob& job = args.lux;
  lux->add_option("SCENE", job.scene, "The scene: .glb, or .gltf with its buffers and textures")->required();
  auto* points = lux->add_option("--points", job.points,
                                 "CSV of x,y,z,nx,ny,nz: position in metres and the direction that the meter faces, in "
                                 "the scene's own space; one header line may come first");
  lux->add_option("--grid", texts.grid,
                  "A level grid over a node's upward faces: its name, the spacing, the height above it")
      ->check(checked(parse_grid, "NODE,LENGTH,LENGTH"))
      ->excludes(points);
  lux->add_option("-o,--output", args.lux_output, "File for the table instead of stdout");
  texts.error_option = lux->add_option("--error", texts.error,
                                       "Standard error asked for, of luminance, relative to the point's illuminance "
                                       "plus 1 % of the mean over all points")
                           ->check(checked(parse_fraction, "SHARE"))
                           ->capture_default_str();
  texts.samples_option =
      lux->add_option("--samples", job.lux.max_samples,
                      "Paths a point at most; without --error exactly so many. Rounded down to a power of two, at "
                      "least 1024")
          ->check(CLI::Range(1u, 1u << 31))
          ->capture_default_str();
  add_light_options(*lux, shared, args);
  add_run_options(*lux, shared, args);
  return lux;
}

Status resolve_lux(const LuxTexts& texts, Arguments& args) {
  MeasureJob& job = args.lux;
  if (texts.grid.empty() == job.points.empty())
    return fail(ErrorCode::kUsage, "lux", "found no points, expected --points FILE.csv or --grid NODE,spacing,height");
  if (!texts.grid.empty()) {
    ORIEL_TRY(job.grid, parse_grid(texts.grid));
  }
  ORIEL_TRY(job.lux.relative_error, parse_fraction(texts.error));
  if (texts.samples_option->count() > 0 && texts.error_option->count() == 0) job.lux.relative_error = 0;
  job.import = args.bake.import;
  job.reproducible = args.bake.reproducible;
  return {};
}

}  // namespace oriel
