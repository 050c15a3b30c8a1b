// Published methods, for comparison: reflections by Bastos, Hoff, Wynn and Lastra 1999.
#pragma once

#include "bake/run/options.h"
#include "formats/cli/command.h"

namespace oriel {

// What of BakeOptions says how reflections are baked, in that group of the help.
std::vector<Option> method_options(const char* group, BakeOptions& options);

// With Method::kBastos1999 what was not given becomes what the paper has: hemispheres of 64 viewpoints, maps of 128
// pixels (those of four of its five reflectors, table 1), first-order reflections, Beckmann's D·G at one incidence,
// sphere maps of equation (4). Error kUsage where an option is for the other method.
Status settle_method(const Given& given, BakeOptions& options);

}  // namespace oriel
