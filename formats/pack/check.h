// A file's bytes, damage and meaning, as one list of issues: what `oriel-inspect validate` tells.
#pragma once

#include <optional>
#include <span>

#include "formats/core/result.h"
#include "formats/pack/validate.h"

namespace oriel {

struct CheckedPack {
  std::optional<Pack> pack;  // none where the bytes are not a pack's: then issues says why
  std::vector<Issue> issues;
};

// Damage has number 1: the bytes are not what was written, so that nothing can be said about their meaning. All damaged
// sections are named, not only the first. The other issues are validate()'s. Error kRuntime when memory does not
// suffice.
Result<CheckedPack> check_pack(std::span<const std::byte> file);

}  // namespace oriel
