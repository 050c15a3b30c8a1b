#include <cstdlib>

#include "bake/cli/farm/farm_arguments.h"
#include "formats/core/file.h"

namespace oriel {
namespace {

// One word of a shell's, whatever it holds.
std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string command_of(const std::vector<std::string>& words) {
  std::string out = "exec";
  for (const std::string& word : words) out += " " + quoted(word);
  return out;
}

}  // namespace

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
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return fail(ErrorCode::kRuntime, "/proc/self/exe", "cannot be read: {}", error.message());
  const std::string script = slurm_script(args, program.string());
  if (args.dry_run) return print(script);
  if (std::system(script.c_str()) != 0)
    return fail(ErrorCode::kRuntime, "sbatch", "took no job: its message is above; --dry-run prints what is run");
  return {};
}

}  // namespace oriel
