// A small web server on this machine alone, for a look at a folder of static files: GET and HEAD of the files that it
// was told of, on 127.0.0.1. Not for the world: no TLS, no compression, no ranges, one connection an answer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "formats/core/result.h"

namespace oriel {

// An answer of HTTP/1.1: its head, and the file that follows it; empty: nothing follows.
struct HttpAnswer {
  std::string head;
  std::filesystem::path body;
};

class LocalServer {
 public:
  // Listens on 127.0.0.1. names: of files below the folder; no other file is ever given, whatever path is asked for.
  // port 0: one that is free. Error: kIo where the port cannot be had.
  static Result<LocalServer> listen(const std::filesystem::path& folder, const std::vector<std::string>& names,
                                    std::uint16_t port);
  LocalServer(LocalServer&& other) noexcept;
  LocalServer& operator=(LocalServer&&) = delete;
  ~LocalServer();

  std::uint16_t port() const { return port_; }
  std::string address() const { return fmt::format("http://127.0.0.1:{}/", port_); }

  // Serves until `stop`, a file descriptor, can be read from or is closed. Error: kRuntime.
  Status run(int stop);

  // What is said to a request, whose head ends in an empty line.
  HttpAnswer answer(std::string_view request) const;

 private:
  LocalServer(int listener, std::uint16_t port) : listener_(listener), port_(port) {}

  int listener_ = -1;
  std::uint16_t port_ = 0;
  std::map<std::string, std::filesystem::path, std::less<>> files_;  // by path of the address
};

}  // namespace oriel
