// The command line of what bakes share: the cache of finished units, and workers that fill it.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "bake/run/options.h"

namespace oriel {

inline constexpr const char* kDefaultCache = ".oriel-cache";  // beside the pack

struct CacheArguments {
  std::filesystem::path folder;  // empty: kDefaultCache
  bool off = false;
};

struct VerifyArguments {
  bool wanted = false;   // the subcommand was asked for
  double sample = 0.01;  // of the units in the cache that are computed again
};

struct SubmitArguments {
  bool wanted = false;  // the subcommand was asked for
  std::filesystem::path scene, output, cache;
  int workers = 8;
  bool dry_run = false;
  std::vector<std::string> forwarded;  // options of the bake, as typed
};

struct PruneArguments {
  bool wanted = false;  // the subcommand was asked for
  std::filesystem::path folder;
  bool prunes = false;
  std::uint64_t bytes = 0;  // to leave
};

struct PruneTexts {
  std::string size;
};

void add_cache_options(CLI::App& app, CacheArguments& args);

// `oriel-bake worker` without the options of the bake, which the caller adds to it.
CLI::App* add_worker(CLI::App& app, std::filesystem::path& scene, CacheArguments& args);

// `oriel-bake verify` without the options of the bake; SCENE and PACK become the bake's scene and output.
CLI::App* add_verify(CLI::App& app, BakeOptions& bake, CacheArguments& args, std::string& sample);

// `oriel-bake submit` without the options of the bake.
CLI::App* add_submit(CLI::App& app, SubmitArguments& args);
// Whether an option of `submit` is one that the bake takes too.
bool is_of_bake(const CLI::Option& option);
// A shell script that gives Slurm an array of workers and the bake that packs after them.
std::string slurm_script(const SubmitArguments& args, const std::string& program);
// Runs that script, or prints it. Error kRuntime where Slurm takes no job.
Status run_submit(const SubmitArguments& args);

// `oriel-bake cache`.
CLI::App* add_cache(CLI::App& app, PruneTexts& texts, PruneArguments& args);
// Error kUsage.
Status resolve_prune(const PruneTexts& texts, PruneArguments& args);
// Prints what a cache holds, or removes what was used longest ago. Error kIo.
Status run_cache(const PruneArguments& args);

}  // namespace oriel
