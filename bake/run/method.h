// Frames of many passes by Diefenbach and Badler 1997, for comparison.
#pragma once

#include "bake/run/options.h"
#include "formats/cli/command.h"

namespace oriel {

// What of BakeOptions says how reflections are baked, in that group of the help.
std::vector<Option> method_options(const char* group, BakeOptions& options);

// With Method::kDiefenbach1997 the lightmap is RadiosityOptions::indirect, and mirrors show the scene drawn again.
// Error kUsage where an option is for the other method.
Status settle_method(const Given& given, BakeOptions& options);

}  // namespace oriel
