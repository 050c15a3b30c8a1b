// Whether a pack means something: ranges, references, units. The bytes are the reader's concern.
#pragma once

#include <string>
#include <vector>

#include "formats/pack/pack.h"

namespace oriel {

enum class Severity { kWarning, kError };

// Numbers are permanent: docs/notes/format.md lists them, a retired one is not used again.
struct Issue {
  int number = 0;
  Severity severity = Severity::kError;
  std::string section;     // "section LMAP 2 (lightmap page)"
  std::string message;     // how many, the first one, what was found and what was expected
  std::uint32_t kind = 0;  // of the section (layout.h)
};

// Whether textures, lightmap pages and maps have their pixels, or are without until somebody wants them (deferred.h).
enum class ImagePixels { kHere, kDeferred };

// Everything that is wrong, in the order of the sections; one issue for all elements of an array that break the same
// rule. A pack without errors is safe to draw: every index is in range and every number is finite. Never fails.
std::vector<Issue> validate(const Pack& pack, ImagePixels pixels = ImagePixels::kHere);

}  // namespace oriel
