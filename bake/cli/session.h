// What the commands of oriel-bake share while one of them runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bake/cli/progress.h"
#include "bake/import/import.h"
#include "formats/cli/command.h"

namespace oriel {

inline constexpr ErrorCode kUnmet{7};  // the exit code where --require or -W is not met

struct BakeSession {
  Context context;
  int threads = 0;
  std::uint64_t seed = 1;
  bool quiet = false, json_log = false;
  std::vector<std::string> errors;  // codes of warnings that end the program
  std::optional<Warning> fatal;     // that did
  std::optional<ProgressPrinter> printer;
  std::string less_memory = "a larger --texel, fewer --views or a smaller --memory";  // what to try

  // Threads, seed and progress of the context as the options have them.
  void begin();
  ProgressPrinter::Style style() const;
  // kUnmet where a warning was fatal.
  Status judged(Status status) const;
  void note(const std::string& text) { printer->note(text); }
};

// Threads, seed, progress.
std::vector<Option> run_options(BakeSession& session);
Option scene_argument(std::filesystem::path& scene);

// What the first SIGINT or SIGTERM does. A second one, or a second later, ends the program.
enum class OnStop {
  kFinish,  // ends the bake with what is there, if that makes a pack
  kStop,    // stops: nothing is written
  kKeep,    // stops once the part under way is done, which is kept
};
// output: the file that is written, whose temporary is removed; may be empty.
void stop_on_signals(Context& context, const std::filesystem::path& output, OnStop on_stop);
// The report's file and what it says where the process has to end itself: a library's long call did not stop.
void report_hard_stop(const std::filesystem::path& file, std::string text);
// What a user is told of an error.
std::string text_of_error(const Error& error);

std::vector<std::filesystem::path> inputs_of(const std::filesystem::path& scene, const ImportOptions& import);
// Fails before hours of work where their result could not be written, or would replace what is read.
Status check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);

}  // namespace oriel
