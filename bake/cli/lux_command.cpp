#include "bake/cli/commands.h"
#include "bake/reference/table.h"
#include "bake/run/measure.h"
#include "bake/run/option_table.h"
#include "bake/run/option_values.h"
#include "formats/core/file.h"

namespace oriel {
namespace {

constexpr const char* kLuxFooter = R"(Examples:
  oriel-bake lux office.glb --grid floor,50cm,85cm > workplane.csv     a working plane 85 cm above the node "floor"
  oriel-bake lux office.glb --points meters.csv --error 0.2%           x,y,z,nx,ny,nz in metres, a line a point

The table has a header line. E, direct and indirect are lux as luminance and as linear R,G,B; error is one standard
deviation of E's own noise.)";

struct LuxArguments {
  MeasureJob job;
  std::filesystem::path output;  // empty: stdout
};

Status run_lux(const LuxArguments& args, BakeSession& session) {
  stop_on_signals(session.context, args.output, OnStop::kStop);
  session.less_memory = "a larger spacing of --grid";
  if (!args.output.empty()) {
    auto inputs = inputs_of(args.job.scene, args.job.import);
    inputs.push_back(args.job.points);
    ORIEL_TRY_VOID(check_output(args.output, inputs));
  }
  ORIEL_TRY(const Measurement measured, measure(args.job, session.context));
  const std::string csv = lux_csv(measured.points, measured.results);
  if (!args.output.empty()) return write_text_atomically(args.output, csv);
  return print(csv);
}

Status settle_lux(const Given& given, MeasureJob& job) {
  if (!given.has("--grid") && !given.has("--points"))
    return fail(ErrorCode::kUsage, "lux", "found no points, expected --points FILE.csv or --grid NODE,spacing,height");
  if (given.has("--samples") && !given.has("--error")) job.lux.relative_error = 0;
  return {};
}

OptionValue grid(GridSpec& target) {
  return {"NODE,LENGTH,LENGTH",
          [&target](const std::string& typed) -> Status {
            ORIEL_TRY(target, parse_grid(typed));
            return {};
          },
          [&target] {
            return target.node.empty() ? "" : fmt::format("{},{}m,{}m", target.node, target.spacing_m, target.height_m);
          }};
}

}  // namespace

ToolCommand lux_command(BakeSession& session) {
  const auto args = std::make_shared<LuxArguments>();
  MeasureJob& job = args->job;
  job.lux.relative_error = 0.01;
  job.import.clear_sky = true;
  ToolCommand out{
      .name = "lux",
      .help = "Prints the illuminance at points as CSV; no lightmap, no pack",
      .footer = kLuxFooter,
      .options = {
          scene_argument(job.scene),
          {"--points", "Meters",
           "CSV of x,y,z,nx,ny,nz: position in metres and the direction that the meter faces, in the scene's own "
           "space; one header line may come first",
           path(job.points, "FILE"), Use::kEveryday},
          {"--grid", "Meters", "A level grid over a node's upward faces: its name, the spacing, the height above it",
           grid(job.grid), Use::kEveryday, "", "", "--points"},
          {"-o,--output", "Meters", "File for the table instead of stdout", path(args->output, "FILE"), Use::kEveryday},
          {"--error", "Meters",
           "Standard error asked for, of luminance, relative to the point's illuminance plus 1 % of the mean "
           "over all points",
           quantity(job.lux.relative_error, "SHARE", parse_share, share_text), Use::kEveryday},
          {"--samples", "Meters",
           "Paths a point at most; without --error exactly so many. Rounded down to a power of two, at least "
           "1024",
           number(job.lux.max_samples, 1, 1u << 31), Use::kEveryday}}};
  append(out.options, light_options(job.import));
  append(out.options, scene_options(job.import, job.reproducible));
  append(out.options, run_options(session));
  out.settle = [args](const Given& given) { return settle_lux(given, args->job); };
  out.run = [args, &session] { return run_lux(*args, session); };
  return out;
}

}  // namespace oriel
