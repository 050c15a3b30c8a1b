// Measured luminaires: EULUMDAT files.
#pragma once

#include "bake/scene/ies.h"

namespace oriel {

// Reads EULUMDAT (Stockmar 1990), one value a line. Luminous intensities are in cd per 1000 lm: they are multiplied by
// the flux of the first set of lamps and the file's conversion factor. Planes C and angles gamma are LM-63's horizontal
// and vertical angles. Symmetries 0 to 4. Negative intensities count as 0. `name` stands in errors beside the line.
// Errors kInvalid: a value that is missing, no number or out of range, and angles that do not ascend.
Result<IesFile> parse_ldt(std::string_view text, const std::string& name);

}  // namespace oriel
