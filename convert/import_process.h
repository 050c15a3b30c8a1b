// Files of other formats by oriel-import, a process of its own: it is the only code that sees their reader, and
// whatever that does to it is an error here.
#pragma once

#include <filesystem>
#include <functional>

#include "convert/file_kind.h"
#include "formats/core/bytes.h"

namespace oriel {

struct ImportProcess {
  std::filesystem::path program;            // empty: oriel-import beside this program
  double time_s = 300;                      // 82 MB of OBJ take 8 s of a core, and 1.6 GB
  std::uint64_t memory_bytes = 8ull << 30;  // of addresses
  char up = 0;                              // the file's axis, 'y' or 'z'; 0: as the file or its format has it
  std::function<void(std::string)> warn;    // what the user should read; may be empty
  std::function<void(std::string)> read;    // each file that the scene's names and that was read; may be empty
  std::function<bool()> stopped;            // the user wants no more of it; may be empty
};

// The .glb that oriel-import makes of a file. It lies in memory alone: nothing is left when either program is killed.
// Errors: those of oriel-import; kInvalid where it crashed; kRuntime where it is not there, or ran into a limit;
// kStopped.
Result<Bytes> import_by_process(const std::filesystem::path& file, const SourceFormat& format,
                                const ImportProcess& process);

}  // namespace oriel
