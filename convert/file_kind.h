// What a file is, as its user would say it: by its first bytes, and by its name where these do not tell.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "formats/core/result.h"

namespace oriel {

// A format whose files oriel-import reads.
struct SourceFormat {
  std::string name;       // "FBX"
  std::string extension;  // "fbx"
  std::string advice;     // how else to get a glTF of it
};

// The format of a file; none where the file may be glTF. Error kInvalid for a file that neither is: what it is and how
// to get a glTF of it.
Result<std::optional<SourceFormat>> source_format(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace oriel
