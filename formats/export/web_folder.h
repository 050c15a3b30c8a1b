// A walkthrough as static files: a page, the viewer, and the pack in pieces (docs/notes/web.md).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "formats/core/result.h"
#include "formats/pack/pack.h"

namespace oriel {

// Of the files that a page, its manifest and the viewer make together: a viewer refuses another one.
inline constexpr int kWebVersion = 2;

struct WebOptions {
  std::string title;  // of the page, as people read it
  Bytes picture;      // PNG that is shown where the viewer cannot run; empty: there is none
};

struct WebFile {
  std::string name;  // inside the folder
  std::uint64_t bytes = 0;
};

// What was written, in the order in which a browser loads it.
struct WebFolder {
  std::vector<WebFile> files;
  std::uint64_t first_bytes = 0;  // until the page can be used
  std::uint64_t all_bytes = 0;
};

// Writes into the folder, which is made where it is missing. Names of pieces follow from their bytes, and the page
// comes last: who loads while it is written sees the old walkthrough or the new one. Errors: kIo, kRuntime.
Result<WebFolder> write_web_folder(const std::filesystem::path& folder, const Pack& pack, const WebOptions& options);

}  // namespace oriel
