// The command line of `oriel-bake lux`.
#pragma once

#include "bake/cli/option_groups.h"

namespace oriel {

// Values as typed, and the options that they belong to.
struct LuxTexts {
  std::string error = "1%", grid;
  CLI::Option *error_option = nullptr, *samples_option = nullptr;
};

// Adds the subcommand; it is told by parsed() whether the user asked for it.
CLI::App* add_lux(CLI::App& app, LuxTexts& texts, SharedTexts& shared, Arguments& args);
// Error kUsage. After resolve_shared().
Status resolve_lux(const LuxTexts& texts, Arguments& args);

}  // namespace oriel
