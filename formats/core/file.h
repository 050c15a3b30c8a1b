// Whole files in and out.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "formats/core/bytes.h"
#include "formats/core/result.h"

namespace oriel {

// The bytes of a regular file. Error kIo when it is missing, a directory, unreadable, or larger than max_bytes.
Result<Bytes> read_file(const std::filesystem::path& path, std::uint64_t max_bytes = std::uint64_t{1} << 40);

// The name under which write_file_atomically writes first, for who must remove it after a kill.
std::filesystem::path temporary_name(const std::filesystem::path& path);

// Writes to a temporary name beside path, flushes to disk and renames: path holds either the old file or the whole new
// one. Error kIo names the reason of the system; the temporary file is removed.
Status write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

// Text to standard output, flushed. Error kIo.
Status print(std::string_view text);

}  // namespace oriel
