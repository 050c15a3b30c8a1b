// A whole section of a known kind.
#pragma once

#include "formats/pack/sections/parts.h"

namespace oriel {

// raw: its decompressed bytes. Error kInvalid names the section.
Status decode_section(std::span<const std::byte> raw, const SectionInfo& section, PackParts& parts);

}  // namespace oriel
