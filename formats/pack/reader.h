// Packs from files. Every byte is treated as hostile.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "formats/core/bytes.h"
#include "formats/core/result.h"
#include "formats/pack/validate.h"

namespace oriel {

// Checks the table and all checksums, and decodes every section: all numbers are what the file holds, and enums have
// their named values, but ranges and references are not checked (validate.h). Errors: kInvalid names the section,
// kRuntime when memory does not suffice.
Result<Pack> decode_pack(std::span<const std::byte> file);

// What `oriel-inspect validate` tells: damage and meaning as one list.
struct CheckedPack {
  std::optional<Pack> pack;  // none where the bytes are not a pack's: then issues says why
  std::vector<Issue> issues;
};

// Damage has number 1: the bytes are not what was written, so that nothing can be said about their meaning. All damaged
// sections are named, not only the first. The other issues are validate()'s. Error kRuntime when memory does not
// suffice.
Result<CheckedPack> check_pack(std::span<const std::byte> file);

// A pack that may be used without further checks: the file is read and decoded, and validate() finds no error in it.
// Errors: kIo; kInvalid names the file, the section, what was found and what was expected; kRuntime.
Result<Pack> read_pack(const std::filesystem::path& path);

}  // namespace oriel
