// How reflections are shown, and a method to compare with.
#pragma once

#include "formats/cli/command.h"
#include "formats/pack/pack.h"
#include "player/session/arguments.h"

namespace oriel {

std::vector<Option> reflection_options(const char* group, PlayArguments& out);

// Sets what --method stands for, where it is not given otherwise; what contradicts it, or each other.
std::string settle_method(const Given& given, PlayArguments& out);

// The --method of oriel-bake that it is of, by its provenance; empty where that does not tell.
std::string method_of(const Pack& pack);

// What of the pack is not as the method that it is shown by; empty: all is.
std::string other_method(const Pack& pack, const PlayArguments& arguments);

}  // namespace oriel
