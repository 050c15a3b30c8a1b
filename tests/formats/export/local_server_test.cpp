// The server for a look, by its answers and over sockets.
#include "formats/export/local_server.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <thread>

#include "formats/core/file.h"
#include "tests/support/temporary_folder.h"

namespace oriel {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

int connected(std::uint16_t port, in_addr_t to = INADDR_LOOPBACK) {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET, place.sin_port = htons(port), place.sin_addr.s_addr = htonl(to);
  if (connect(fd, reinterpret_cast<sockaddr*>(&place), sizeof(place)) == 0) return fd;
  close(fd);
  return -1;
}

class LocalServerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(site() / "pieces");
    put("index.html", "<page>"), put("app.js", "script"), put("pieces/a.oriel", std::string(3'000'000, 'x'));
    put("not-told-of", "secret");
    std::ofstream(folder_.path() / "outside") << "secret";
    auto server = LocalServer::listen(site(), {"index.html", "app.js", "pieces/a.oriel", "gone.css"}, 0);
    ASSERT_TRUE(server) << server.error().text();
    server_.emplace(std::move(*server));
    ASSERT_EQ(pipe(stop_.data()), 0);
    thread_ = std::thread([this] { status_ = server_->run(stop_[0]); });
  }
  void TearDown() override {
    ASSERT_EQ(write(stop_[1], "", 1), 1);
    thread_.join();
    EXPECT_TRUE(status_);
    for (const int fd : stop_) close(fd);
  }

  std::filesystem::path site() const { return folder_.path() / "site"; }
  void put(const std::string& name, const std::string& text) const { std::ofstream(site() / name) << text; }

  std::string said(const std::string& bytes) const {
    const int fd = connected(server_->port());
    EXPECT_EQ(send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL), static_cast<ssize_t>(bytes.size()));
    std::string all;
    char buffer[65536];
    for (ssize_t n = 0; (n = recv(fd, buffer, sizeof(buffer), 0)) > 0;) all.append(buffer, static_cast<std::size_t>(n));
    close(fd);
    return all;
  }
  std::string get(const std::string& path, const char* method = "GET", const char* host = "localhost:1") const {
    return said(std::string(method) + " " + path + " HTTP/1.1\r\nHOST:  " + host + "\r\n\r\n");
  }

  testing::TemporaryFolder folder_;
  std::optional<LocalServer> server_;
  std::array<int, 2> stop_{};
  std::thread thread_;
  Status status_;
};

TEST_F(LocalServerTest, GivesTheFilesItWasToldOf) {
  EXPECT_THAT(get("/"), StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(get("/"), EndsWith("\r\n\r\n<page>"));
  EXPECT_THAT(get("/index.html?a=b#c"), HasSubstr("Content-Type: text/html; charset=utf-8\r\n"));
  EXPECT_THAT(get("/app.js"), HasSubstr("Content-Type: text/javascript; charset=utf-8\r\n"));
  const std::string large = get("/pieces/a.oriel");
  EXPECT_THAT(large, HasSubstr("Content-Length: 3000000\r\n"));
  EXPECT_EQ(large.size(), large.find("\r\n\r\n") + 4 + 3'000'000);
  const std::string head = get("/app.js", "HEAD");
  EXPECT_THAT(head, HasSubstr("Content-Length: 6\r\n"));
  EXPECT_THAT(head, EndsWith("\r\n\r\n"));
}

TEST_F(LocalServerTest, GivesNoOtherFile) {
  for (const char* path : {"/not-told-of", "/../outside", "/pieces/../../outside", "/%2e%2e/outside", "//etc/passwd",
                           "/pieces", "/pieces/", "/gone.css", "/index.html/", "index.html", "\\..\\outside", ""}) {
    const std::string answer = get(path);
    EXPECT_THAT(answer, ::testing::AnyOf(StartsWith("HTTP/1.1 404"), StartsWith("HTTP/1.1 400"))) << path;
    EXPECT_THAT(answer, Not(HasSubstr("secret"))) << path;
  }
}

TEST_F(LocalServerTest, RefusesWhatItDoesNotDo) {
  EXPECT_THAT(get("/", "POST"), StartsWith("HTTP/1.1 405"));
  EXPECT_THAT(get("/", "GET", "evil.example"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(said("GET / HTTP/1.1\r\n\r\n"), StartsWith("HTTP/1.1 403"));
  EXPECT_THAT(said("nonsense\r\n\r\n"), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(said(std::string("\0\xff\n\r\n\r\n", 7)), StartsWith("HTTP/1.1 400"));
  EXPECT_THAT(said("GET / HTTP/1.1\r\nx: " + std::string(20000, 'y')), StartsWith("HTTP/1.1 431"));
}

// Browsers open connections before they ask: nobody waits for them.
TEST_F(LocalServerTest, AnswersBesideThoseWhoOnlyConnect) {
  std::vector<int> idle;
  for (int i = 0; i < 20; ++i) idle.push_back(connected(server_->port()));
  EXPECT_THAT(get("/"), EndsWith("<page>"));
  for (const int fd : idle) close(fd);
  EXPECT_THAT(get("/"), EndsWith("<page>"));
}

TEST_F(LocalServerTest, IsForThisMachineAlone) {
  const int fd = connected(server_->port(), 0x7f000002);  // 127.0.0.2: this machine by another address
  EXPECT_LT(fd, 0);
  const auto second = LocalServer::listen(site(), {}, server_->port());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kIo);
  EXPECT_THAT(second.error().text(), HasSubstr("port " + std::to_string(server_->port())));
}

}  // namespace
}  // namespace oriel
