// The options of a bake as a table, and those that other commands share with it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bake/run/options.h"
#include "formats/cli/command.h"

namespace oriel {

// What the command line begins with; a BakeOptions alone is what tests and other code begin with.
BakeOptions command_line_defaults();

// Light that the scene file does not hold.
std::vector<Option> light_options(ImportOptions& import);
// Which nodes move.
std::vector<Option> mover_options(ImportOptions& import);
// Which scene of the file, and how it is read and traced.
std::vector<Option> scene_options(ImportOptions& import, bool& reproducible);
// What a unit of the file is; guess: whether rooms are to tell (guessed_unit).
Option unit_option(ImportOptions& import, bool& guess);
// All that can change a pack.
std::vector<Option> bake_options(BakeOptions& options);
// Once these are set: what follows from several of them. Error kUsage where they contradict.
Status settle(BakeOptions& options, const Given& given);

// The options that can change a pack's bytes, as JSON: for provenance. Threads and paths are not among them.
std::string options_json(const BakeOptions& options, std::uint64_t seed);

}  // namespace oriel
