// How the options of a bake are read and written: one function for each that is more than a number or a name.
#pragma once

#include <string>

#include "bake/run/options.h"
#include "formats/cli/option.h"
#include "formats/core/json.h"
#include "formats/core/text.h"

namespace oriel {

std::string verify_text(double share);
std::string length_text(float metres);
std::string time_text(double seconds);  // "" of 0
std::string bytes_text(std::uint64_t bytes);

// "auto", or what `inner` takes.
OptionValue or_auto(bool& chosen, const std::string& type, OptionValue inner);
OptionValue memory_limit(BakeOptions& o);
OptionValue samples(BakeOptions& o);
OptionValue hidden_black(BakeOptions& o);
OptionValue texel_means(BakeOptions& o);
OptionValue detail_steps(BakeOptions& o);
OptionValue parts(BakeOptions& o);  // --only
OptionValue eyes(BakeOptions& o);
OptionValue unit(double& unit_m, bool& guess);
OptionValue light_groups(BakeOptions& o);
OptionValue sky(ImportOptions& o);
OptionValue day(ImportOptions& o);
OptionValue hours(ImportOptions& o);
OptionValue objects(std::vector<ObjectRule>& rules);
OptionValue moves(std::vector<MoverMove>& moves);  // --move
OptionValue light_scales(std::vector<LightScale>& scales);
OptionValue profiles(ImportOptions& o);  // --ies

}  // namespace oriel
