// Options that the bake and `lux` share: declared once, so that they mean the same.
#pragma once

#include <CLI/CLI.hpp>

#include "bake/cli/arguments.h"

namespace oriel {

// A CLI11 validator out of one of our parsers: the message says what was found and what was expected.
template <class Parser>
CLI::Validator checked(Parser parse, const char* name) {
  return CLI::Validator(
      [parse](std::string& text) {
        const auto result = parse(text);
        return result ? std::string() : result.error().message;
      },
      name);
}

// Values as typed, until resolve_shared() turns them into options.
struct SharedTexts {
  std::string sky = "0";
  std::vector<std::string> ies;
  bool quiet = false, json_log = false;
};

// Light that the scene file does not hold.
void add_light_options(CLI::App& app, SharedTexts& texts, Arguments& args);
// Which nodes move.
void add_mover_option(CLI::App& app, Arguments& args);
// Scene of the file, threads, seed, progress.
void add_run_options(CLI::App& app, SharedTexts& texts, Arguments& args);
Status resolve_shared(const SharedTexts& texts, Arguments& args);

// The words that gave an option its values.
std::vector<std::string> as_typed(const CLI::Option& option);

}  // namespace oriel
