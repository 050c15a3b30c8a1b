// Where the project's files are.
#pragma once

#include <filesystem>

namespace fs = std::filesystem;

inline const fs::path kRoot = ORIEL_SOURCE_DIR;
