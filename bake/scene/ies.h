// Measured luminaires: IES LM-63 files.
#pragma once

#include <string_view>

#include "bake/scene/scene.h"
#include "formats/core/result.h"

namespace oriel {

inline constexpr double kMostCandela = 1e12;  // of a profile

struct IesFile {
  LightProfile profile;
  std::vector<std::string> warnings;  // what the file says and the profile leaves out
};

// Reads ANSI/IES LM-63-1986, -1991, -1995, -2002 and -2019: photometry of type C. Tables of TILT tell of lamps that
// hang askew and are left out. Candela values are multiplied by the file's candela multiplier, ballast factor and,
// before 2019, ballast-lamp factor. Negative ones count as 0. There is no light beyond the vertical angles of the file.
// `name` stands in errors beside the line. Errors kInvalid: no line TILT=, photometry of type A or B, angles that do
// not ascend, horizontal angles that do not start and end where LM-63 says, values that are missing, no numbers, or too
// many.
Result<IesFile> parse_ies(std::string_view text, const std::string& name);

}  // namespace oriel
