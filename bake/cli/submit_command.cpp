#include <cstdlib>

#include "bake/cli/commands.h"
#include "bake/run/option_table.h"
#include "formats/core/process.h"

namespace oriel {
namespace {

constexpr const char* kSubmitFooter = R"(Example:
  oriel-bake submit --slurm -N 8 house.glb -o house.oriel --cache /shared/cache --reproducible --error 1%

Takes the options of the bake. A worker that is cancelled, requeued or dead is replaced by the others, in the end by the
job that packs.)";

struct SubmitArguments {
  std::filesystem::path scene, output, cache;
  int workers = 8;
  bool slurm = false, dry_run = false;
  BakeOptions bake = command_line_defaults();  // checked here, and forwarded as typed
  std::vector<std::string> forwarded;
};

// One word of a shell's, whatever it holds.
std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string command_of(const std::vector<std::string>& words) {
  std::string out = "exec";
  for (const std::string& word : words) add_word(out, quoted(word));
  return out;
}

// Gives Slurm an array of workers and the bake that packs after them.
std::string slurm_script(const SubmitArguments& args, const std::string& program) {
  const auto job = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--cache", args.cache.string(), "--quiet"});
    words.insert(words.end(), args.forwarded.begin(), args.forwarded.end());
    return quoted(command_of(words));
  };
  // afterany: the bake packs whatever became of the workers, and computes what they left.
  return fmt::format(
      "set -eu\n"
      "workers=$(sbatch --parsable --requeue --job-name=oriel-worker --array=0-{} --wrap {})\n"
      "pack=$(sbatch --parsable --requeue --job-name=oriel-pack --dependency=afterany:\"$workers\" --wrap {})\n"
      "echo \"workers $workers, pack $pack\"\n",
      args.workers - 1, job({program, "worker", args.scene.string()}),
      job({program, args.scene.string(), "-o", args.output.string()}));
}

Status run_submit(const SubmitArguments& args) {
  ORIEL_TRY(const std::filesystem::path program, this_program());
  const std::string script = slurm_script(args, program.string());
  if (args.dry_run) return print(script);
  if (std::system(script.c_str()) != 0)
    return fail(ErrorCode::kRuntime, "sbatch", "took no job: its message is above; --dry-run prints what is run");
  return {};
}

}  // namespace

ToolCommand submit_command(BakeSession& session) {
  const auto args = std::make_shared<SubmitArguments>();
  ToolCommand out{
      .name = "submit",
      .help = "Gives a cluster's scheduler a bake: an array of workers, and a job that packs after them",
      .footer = kSubmitFooter,
      .options = {{"SCENE", "Arguments", "The scene, at a path that all machines know", path(args->scene, "FILE"),
                   Use::kRequired},
                  {"-o,--output", "Run", "The pack to write", path(args->output, "PACK"), Use::kRequired},
                  {"--cache", "Run", "The folder that all machines share", path(args->cache, "DIR"), Use::kRequired},
                  {"--slurm", "Run", "The scheduler: Slurm (sbatch)", flag(args->slurm), Use::kRequired},
                  {"-N,--workers", "Run", "Workers", number(args->workers, 1, 10000), Use::kEveryday},
                  {"--dry-run", "Run", "Print the script that would be run", flag(args->dry_run), Use::kEveryday}}};
  std::vector<Option> of_bake = bake_options(args->bake);
  const std::vector<Option> of_run = run_options(session);  // threads and seed; the jobs' logs are not the user's
  of_bake.insert(of_bake.end(), of_run.begin(), of_run.begin() + 2);
  append(out.options, of_bake);
  out.options.insert(out.options.end(), of_run.begin() + 2, of_run.end());
  out.settle = [args, of_bake](const Given& given) {
    args->forwarded = given.words(of_bake);
    return settle(args->bake, given);
  };
  out.run = [args] { return run_submit(*args); };
  return out;
}

}  // namespace oriel
