// Programs as child processes, without a shell.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/core/result.h"

namespace oriel::trade {

struct Finished {
  double seconds = 0;      // wall clock
  double cpu_seconds = 0;  // of all its threads, user and system
};

// Runs arguments[0], a path, and waits. Its output replaces the file `log`. When `stop` is set the child gets SIGTERM
// and is waited for. Errors: kRuntime where it cannot be started or ends with another code than 0, with that code and
// the last line of its output; kStopped.
Result<Finished> run_program(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                             const std::atomic<bool>& stop);

}  // namespace oriel::trade
