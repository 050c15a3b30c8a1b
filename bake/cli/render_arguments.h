// The command line of `oriel-bake render`.
#pragma once

#include "bake/cli/option_groups.h"

namespace oriel {

// Values as typed, and the options that they belong to.
struct RenderTexts {
  std::string size = "1280x720", error;
  std::vector<std::string> moves;
};

// Adds the subcommand; it is told by parsed() whether the user asked for it.
CLI::App* add_render(CLI::App& app, RenderTexts& texts, SharedTexts& shared, Arguments& args);
// Error kUsage. After resolve_shared().
Status resolve_render(const RenderTexts& texts, Arguments& args);
// Traces the frame and writes it. Errors: kUsage where there is no such camera, kIo, kInvalid, kStopped.
Status run_render(const RenderArguments& args, Context& context);

}  // namespace oriel
