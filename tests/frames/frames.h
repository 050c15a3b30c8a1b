// The real programs, run one after the other.
#pragma once

#include <filesystem>
#include <string>

#include "bake/reference/reference.h"
#include "formats/image/relative_error.h"

namespace oriel::test {

// Runs a program of the build with arguments (shell syntax); its exit code. Output goes to `log` in the working folder.
int run(const std::filesystem::path& folder, const std::string& command);

// D of a reference.
FloatImage diffuse(const ReferenceFrame& frame);

}  // namespace oriel::test
