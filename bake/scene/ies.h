// Measured luminaires: IES LM-63 files.
#pragma once

#include <string_view>

#include "bake/scene/scene.h"
#include "formats/core/result.h"

namespace oriel {

struct IesFile {
  LightProfile profile;
  std::vector<std::string> warnings;  // what the file says and the profile leaves out
};

// Reads ANSI/IESNA LM-63-2002, -1995 and -1991: photometry of type C, TILT=NONE or TILT=INCLUDE (whose table is checked
// and left out: it tells of lamps that hang askew). Candela values are multiplied by the file's candela multiplier,
// ballast factor and ballast-lamp factor. `name` stands in errors beside the line. Errors kInvalid: another header,
// photometry of type A or B, TILT in another file, angles that do not ascend or do not start and end where LM-63 says,
// values that are missing, no numbers, negative or too many.
Result<IesFile> parse_ies(std::string_view text, const std::string& name);

}  // namespace oriel
