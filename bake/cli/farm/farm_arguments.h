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

// `oriel-bake cache`.
CLI::App* add_cache(CLI::App& app, PruneTexts& texts, PruneArguments& args);
// Error kUsage.
Status resolve_prune(const PruneTexts& texts, PruneArguments& args);
// Prints what a cache holds, or removes what was used longest ago. Error kIo.
Status run_cache(const PruneArguments& args);

}  // namespace oriel
