#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "formats/core/file.h"
#include "formats/export/local_server.h"
#include "formats/export/pieces.h"
#include "formats/export/web_folder.h"
#include "formats/inspect/commands.h"
#include "formats/pack/reader.h"

namespace oriel::inspect {
namespace {

// Written to by the handler, which may do nothing else.
int g_stop = -1;

void on_signal(int number) {
  (void)!write(g_stop, "", 1);
  std::signal(number, SIG_DFL);  // a second one ends the program at once
}

// Until Ctrl-C or SIGTERM, which is how it is meant to end: no error.
Status serve(const WebFolder& written, const std::filesystem::path& folder, std::uint16_t port) {
  std::vector<std::string> names;
  for (const WebFile& file : written.files) names.push_back(file.name);
  ORIEL_TRY(LocalServer server, LocalServer::listen(folder, names, port));
  std::array<int, 2> pipe{};
  if (pipe2(pipe.data(), O_CLOEXEC) != 0) return fail(ErrorCode::kRuntime, "--serve", "found no pipe to be stopped by");
  g_stop = pipe[1];
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  fmt::print("{}: to be seen on this machine, until Ctrl-C\n", server.address());
  (void)std::fflush(stdout);
  return server.run(pipe[0]);
}

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
  return request.serve ? serve(folder, request.folder, *request.serve) : Status();
}

}  // namespace

int web(const std::filesystem::path& path, const WebRequest& request) {
  const Status done = write_web(path, request);
  return done ? 0 : report(done.error());
}

}  // namespace oriel::inspect
