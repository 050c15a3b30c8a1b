#include <fmt/format.h>

#include "formats/core/file.h"
#include "formats/export/pieces.h"
#include "formats/export/web_folder.h"
#include "formats/inspect/commands.h"
#include "formats/pack/reader.h"

namespace oriel::inspect {
namespace {

Status write_web(const std::filesystem::path& path, const WebRequest& request) {
  WebOptions options;
  options.title = request.title.empty() ? path.stem().string() : request.title;
  if (!request.picture.empty()) {
    ORIEL_TRY(options.picture, read_file(request.picture));
  }
  ORIEL_TRY(const Pack pack, read_pack(path));
  ORIEL_TRY(const WebFolder folder, write_web_folder(request.folder, pack, options));
  for (const WebFile& file : folder.files)
    fmt::print("{}: {} bytes\n", (request.folder / file.name).string(), file.bytes);
  fmt::print("{} bytes until one can walk, {} in all\n", folder.first_bytes, folder.all_bytes);
  for (const std::string& line : left_out_of_pieces(pack)) fmt::print(stderr, "left out: {}\n", line);
  return {};
}

}  // namespace

int web(const std::filesystem::path& path, const WebRequest& request) {
  const Status done = write_web(path, request);
  return done ? 0 : report(done.error());
}

}  // namespace oriel::inspect
