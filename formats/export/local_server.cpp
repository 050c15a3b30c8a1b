#include "formats/export/local_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>

#include "formats/core/file.h"

namespace oriel {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMostRequest = 16384, kMostClients = 64;
constexpr auto kPatience = std::chrono::seconds(30);  // with who neither asks nor takes

std::string_view type_of(const std::filesystem::path& file) {
  static const std::map<std::string, std::string_view, std::less<>> kTypes = {{".html", "text/html; charset=utf-8"},
                                                                              {".js", "text/javascript; charset=utf-8"},
                                                                              {".css", "text/css; charset=utf-8"},
                                                                              {".json", "application/json"},
                                                                              {".svg", "image/svg+xml"},
                                                                              {".png", "image/png"},
                                                                              {".txt", "text/plain; charset=utf-8"}};
  const auto found = kTypes.find(file.extension().string());
  return found == kTypes.end() ? "application/octet-stream" : found->second;
}

std::string head_of(std::string_view status, std::string_view type, std::uint64_t bytes, std::string_view more = {}) {
  return fmt::format(
      "HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-cache\r\nX-Content-Type-Options: "
      "nosniff\r\nCross-Origin-Resource-Policy: same-origin\r\n{}Connection: close\r\n\r\n",
      status, type, bytes, more);
}

std::string refusal(std::string_view status, bool with_body, std::string_view more = {}) {
  return head_of(status, "text/plain; charset=utf-8", status.size(), more) + std::string(with_body ? status : "");
}

// The value of a field of a request's head, without the spaces around it; names in lower case.
std::string_view field(std::string_view request, std::string_view name) {
  for (std::size_t at = request.find("\r\n"); at != std::string_view::npos; at = request.find("\r\n", at)) {
    at += 2;
    const std::string_view line = request.substr(at, request.find("\r\n", at) - at);
    if (line.size() <= name.size() || line[name.size()] != ':') continue;
    bool same = true;
    for (std::size_t i = 0; i < name.size(); ++i)
      same = same && (line[i] | 0x20) == (name[i] | 0x20);  // ASCII letters and '-'
    if (!same) continue;
    std::string_view value = line.substr(name.size() + 1);
    while (value.starts_with(' ') || value.starts_with('\t')) value.remove_prefix(1);
    return value;
  }
  return {};
}

// A page elsewhere whose name is made to lead here must not read what is here.
bool names_this_machine(std::string_view host) {
  const std::string_view name = host.substr(0, host.rfind(':'));
  return name == "127.0.0.1" || name == "localhost";
}

struct Client {
  int fd = -1;
  std::string request;
  std::string head;
  Bytes body;
  std::size_t sent = 0;
  Clock::time_point until;
  bool answering = false, done = false;
};

// What has come of a request; the answer once it is whole.
void read_from(Client& client, const LocalServer& server) {
  char buffer[4096];
  const ssize_t n = recv(client.fd, buffer, sizeof(buffer), 0);
  if (n <= 0) {
    client.done = n == 0 || (errno != EAGAIN && errno != EINTR);
    return;
  }
  client.request.append(buffer, static_cast<std::size_t>(n));
  if (client.request.find("\r\n\r\n") == std::string::npos) {
    if (client.request.size() < kMostRequest) return;
    client.head = refusal("431 Request Header Fields Too Large", true);
  } else {
    HttpAnswer answer = server.answer(client.request);
    client.head = std::move(answer.head);
    if (!answer.body.empty()) {
      auto bytes = read_file(answer.body);
      if (bytes)
        client.head = head_of("200 OK", type_of(answer.body), bytes->size()), client.body = std::move(*bytes);
      else
        client.head = refusal("404 Not Found", true);
    }
  }
  client.answering = true;
}

void write_to(Client& client) {
  const bool in_head = client.sent < client.head.size();
  const char* from = in_head ? client.head.data() + client.sent
                             : reinterpret_cast<const char*>(client.body.data()) + (client.sent - client.head.size());
  const std::size_t left =
      in_head ? client.head.size() - client.sent : client.head.size() + client.body.size() - client.sent;
  const ssize_t n = left > 0 ? send(client.fd, from, left, MSG_NOSIGNAL) : 0;
  if (n < 0) {
    client.done = errno != EAGAIN && errno != EINTR;
    return;
  }
  client.sent += static_cast<std::size_t>(n);
  client.until = Clock::now() + kPatience;
  if (client.sent == client.head.size() + client.body.size()) {
    shutdown(client.fd, SHUT_WR);
    client.done = true;
  }
}

Status failed(const char* what) {
  return fail(ErrorCode::kRuntime, "--serve", "{}: {}", what, std::generic_category().message(errno));
}

void drop_done(std::vector<Client>& clients) {
  std::erase_if(clients, [](Client& client) {
    if (!client.done && Clock::now() < client.until) return false;
    close(client.fd);
    return true;
  });
}

}  // namespace

Result<LocalServer> LocalServer::listen(const std::filesystem::path& folder, const std::vector<std::string>& names,
                                        std::uint16_t port) {
  const auto refused = [&](const char* what) {
    return fail(ErrorCode::kIo, "--serve", "port {} of 127.0.0.1: {}: {}; without a number a free port is taken", port,
                what, std::generic_category().message(errno));
  };
  const int fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) return refused("cannot be opened");
  LocalServer server(fd, port);
  const int on = 1;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* const address = reinterpret_cast<sockaddr*>(&place);
  socklen_t size = sizeof(place);
  if (bind(fd, address, size) != 0) return refused("cannot be had");
  if (::listen(fd, SOMAXCONN) != 0) return refused("cannot be listened on");
  if (getsockname(fd, address, &size) != 0) return refused("has no name");
  server.port_ = ntohs(place.sin_port);
  for (const std::string& name : names) server.files_["/" + name] = folder / name;
  if (const auto page = server.files_.find("/index.html"); page != server.files_.end())
    server.files_["/"] = page->second;
  return server;
}

LocalServer::LocalServer(LocalServer&& other) noexcept
    : listener_(std::exchange(other.listener_, -1)), port_(other.port_), files_(std::move(other.files_)) {}

LocalServer::~LocalServer() {
  if (listener_ >= 0) close(listener_);
}

HttpAnswer LocalServer::answer(std::string_view request) const {
  const std::string_view line = request.substr(0, request.find("\r\n"));
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == std::string_view::npos || last <= first || !line.substr(last + 1).starts_with("HTTP/1."))
    return {refusal("400 Bad Request", true), {}};
  const std::string_view method = line.substr(0, first);
  std::string_view path = line.substr(first + 1, last - first - 1);
  path = path.substr(0, path.find_first_of("?#"));
  const bool head = method == "HEAD";
  if (!names_this_machine(field(request, "host"))) return {refusal("403 Forbidden", !head), {}};
  if (method != "GET" && !head) return {refusal("405 Method Not Allowed", true, "Allow: GET, HEAD\r\n"), {}};
  const auto found = files_.find(path);
  std::error_code error;
  const auto bytes = found == files_.end() ? 0 : std::filesystem::file_size(found->second, error);
  if (found == files_.end() || error) return {refusal("404 Not Found", !head), {}};
  return {head_of("200 OK", type_of(found->second), bytes), head ? std::filesystem::path() : found->second};
}

Status LocalServer::run(int stop) {
  std::vector<Client> clients;
  for (;;) {
    std::vector<pollfd> polled = {{stop, POLLIN, 0}, {clients.size() < kMostClients ? listener_ : -1, POLLIN, 0}};
    for (const Client& client : clients)
      polled.push_back({client.fd, static_cast<short>(client.answering ? POLLOUT : POLLIN), 0});
    if (poll(polled.data(), polled.size(), 1000) < 0 && errno != EINTR) return failed("waiting for requests");
    if (polled[0].revents != 0) break;
    for (std::size_t i = 0; i < clients.size(); ++i) {
      if (polled[i + 2].revents == 0) continue;
      if (clients[i].answering)
        write_to(clients[i]);
      else
        read_from(clients[i], *this);
    }
    drop_done(clients);
    if (polled[1].revents == 0) continue;
    const int fd = accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd >= 0) clients.push_back({fd, {}, {}, {}, 0, Clock::now() + kPatience});
  }
  for (const Client& client : clients) close(client.fd);
  return {};
}

}  // namespace oriel
