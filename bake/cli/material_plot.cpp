#include "bake/cli/material_plot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "formats/core/file.h"

namespace oriel {
namespace {

Status list_materials() {
  std::string text = fmt::format("{:<10} {:>35} {:>35}  {}\n", "name", "F at 0 degrees (R G B)", "F at 80 degrees",
                                 "index at 630, 532, 465 nm");
  for (const NamedMaterial& m : named_materials()) {
    const auto fresnel = [&](double cos_theta) {
      const Vec3 f = specular_fresnel(m.lobe, cos_theta);
      return fmt::format("{:11.5g} {:11.5g} {:11.5g}", f.r, f.g, f.b);
    };
    text += fmt::format("{:<10} {} {}  {}\n", m.name, fresnel(1), fresnel(std::cos(80 * kPiD / 180)), m.index);
  }
  return print(text);
}

// Runs gnuplot in the folder.
Status draw(const std::filesystem::path& folder, const std::string& script) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  std::string program = "gnuplot", argument = script;
  char* const arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (error == 0)
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  if (error == ENOENT || (error == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 127))
    return fail(ErrorCode::kRuntime, folder.string(),
                "gnuplot is not installed (Debian: gnuplot-nox), so there are no pictures; the tables and {} are there",
                script);
  if (error != 0 || status != 0)
    return fail(ErrorCode::kRuntime, (folder / script).string(), "gnuplot failed; the tables are there");
  return {};
}

}  // namespace

std::vector<Option> plot_options(MaterialPlotArguments& args) {
  constexpr const char* kPlot = "Plot";
  return {
      {"--list", kPlot, "Prints the materials that --plot knows, with their Fresnel reflectance", flag(args.list),
       Use::kEveryday},
      {"--plot", kPlot,
       "Writes K and R of a material (a name of --list, or a metal's symbol) as CSV, and pictures of them where "
       "gnuplot "
       "is installed",
       text(args.plot, "NAME"), Use::kEveryday, "", "", "", "--output"},
      {"-o,--output", kPlot, "Folder of --plot's files; made where it is missing", path(args.folder, "DIR"),
       Use::kEveryday, "", "", "", "--plot"},
      {"--alpha", kPlot, "Width of the lobe: the square of glTF's roughness", number(args.alpha, 1e-4, 1),
       Use::kEveryday},
      {"--model", kPlot, "Distribution of K's facets",
       choice(args.model, {{"ggx", FacetModel::kGgx}, {"beckmann", FacetModel::kBeckmann}}), Use::kEveryday},
      {"--no-pictures", kPlot, "CSV only: gnuplot is not asked for", flag(args.pictures, false), Use::kEveryday},
  };
}

Status run_material_plot(const MaterialPlotArguments& args) {
  if (!args.list && args.plot.empty())
    return fail(ErrorCode::kUsage, "material", "found nothing to do, expected --list, --plot, eval or fit");
  if (args.list) ORIEL_TRY_VOID(list_materials());
  if (args.plot.empty()) return {};
  auto material = material_by_name(args.plot);
  if (!material) {
    std::string known;
    for (const NamedMaterial& m : named_materials()) known += (known.empty() ? "" : ", ") + m.name;
    return fail(ErrorCode::kUsage, "--plot", "found '{}', expected one of {}", args.plot, known);
  }
  material->lobe.alpha = args.alpha;
  std::error_code ec;
  std::filesystem::create_directories(args.folder, ec);
  if (ec) return fail(ErrorCode::kIo, args.folder.string(), "cannot be made: {}", ec.message());
  const std::vector<PlotFile> files = plot_files(*material, args.model);
  for (const PlotFile& file : files) ORIEL_TRY_VOID(write_text_atomically(args.folder / file.name, file.text));
  return args.pictures ? draw(args.folder, files.back().name) : Status();
}

}  // namespace oriel
