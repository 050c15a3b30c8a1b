#include "convert/import_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>

#include "formats/core/file.h"
#include "formats/core/process.h"

namespace oriel {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWarning = "oriel-import: warning: ", kError = "oriel-import: error: ",
                           kRead = "oriel-import: read: ";

// A file descriptor that is closed with it, and that no other child inherits.
struct Descriptor {
  int fd = -1;
  explicit Descriptor(int of = -1) : fd(of) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  void close() {
    if (fd >= 0) ::close(fd);
    fd = -1;
  }
};

class Child {
 public:
  Child(const fs::path& file, const SourceFormat& format, const ImportProcess& process)
      : file_(file), format_(format), process_(process), program_(process.program) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (pid_ > 0) end();
  }

  Result<Bytes> run() {
    ORIEL_TRY_VOID(start());
    ORIEL_TRY_VOID(listen());
    ORIEL_TRY_VOID(judge(wait()));
    const fs::path in_memory = fmt::format("/proc/self/fd/{}", out_.fd);
    ORIEL_TRY(Bytes glb, read_file(in_memory));
    if (glb.empty()) return broken("wrote nothing");
    return glb;
  }

 private:
  std::string name() const { return file_.filename().string(); }

  Status start() {
    if (program_.empty()) {
      ORIEL_TRY(program_, program_beside("oriel-import"));
    }
    if (::access(program_.c_str(), X_OK) != 0)
      return fail(ErrorCode::kRuntime, name(),
                  "this is {}, which oriel-import reads, expected beside this program as {}: install oriel-tools whole "
                  "(a build makes it with ninja oriel-import), or give a glTF: {}",
                  format_.name, program_.string(), format_.advice);
    out_.fd = ::memfd_create("oriel-import", MFD_CLOEXEC);
    int pipe[2] = {-1, -1};
    if (out_.fd < 0 || ::pipe2(pipe, O_CLOEXEC) != 0) return system_error("no pipe for oriel-import");
    said_.fd = pipe[0];
    Descriptor writes(pipe[1]);
    std::vector<std::string> words = {program_.string(),
                                      fs::absolute(file_).string(),
                                      "-o",
                                      "-",
                                      "--memory",
                                      fmt::format("{}B", process_.memory_bytes),
                                      "--time",
                                      fmt::format("{:.0f}s", std::max(1.0, process_.time_s))};
    if (process_.up) words.insert(words.end(), {"--up", std::string(1, process_.up)});
    ORIEL_TRY(pid_, start_program(std::move(words), {.out = out_.fd, .err = writes.fd}));
    return {};
  }

  // What it says, until it says no more.
  Status listen() {
    constexpr std::size_t kMostText = 1 << 20;  // what is longer nobody reads
    using Clock = std::chrono::steady_clock;
    const auto until = Clock::now() + std::chrono::duration<double>(process_.time_s);
    char text[4096];
    for (;;) {
      if (process_.stopped && process_.stopped()) return fail(ErrorCode::kStopped, name(), "stopped");
      if (Clock::now() >= until) return over_time();
      pollfd poll{said_.fd, POLLIN, 0};
      if (::poll(&poll, 1, 20) <= 0) continue;  // ms: how soon a stop is heard
      const ssize_t got = ::read(said_.fd, text, sizeof(text));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) break;
      if (heard_.size() < kMostText) heard_.append(text, static_cast<std::size_t>(got));
    }
    for (std::size_t at = 0, end; (end = heard_.find('\n', at)) != std::string::npos; at = end + 1) {
      const std::string_view line = std::string_view(heard_).substr(at, end - at);
      if (line.starts_with(kWarning) && process_.warn) process_.warn(std::string(line.substr(kWarning.size())));
      if (line.starts_with(kRead) && process_.read) process_.read(std::string(line.substr(kRead.size())));
      if (line.starts_with(kError)) error_ = line.substr(kError.size());
    }
    return {};
  }

  int wait() { return wait_for(std::exchange(pid_, -1)); }

  void end() {
    ::kill(pid_, SIGKILL);
    wait();
  }

  Status judge(int status) const {
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGXCPU) return over_time();
    if (signal == SIGKILL)
      return fail(ErrorCode::kRuntime, name(),
                  "oriel-import was killed as it read the {}, perhaps for want of memory: {}", format_.name,
                  by_hand("less other work on the machine"));
    if (signal == SIGINT || signal == SIGTERM) return fail(ErrorCode::kStopped, name(), "stopped");
    if (signal != 0) return broken(fmt::format("crashed on it ({})", ::strsignal(signal)));
    if (!error_.empty()) return tl::unexpected<Error>(Error(static_cast<ErrorCode>(WEXITSTATUS(status)), error_));
    return broken(fmt::format("ended with code {} and no word", WEXITSTATUS(status)));
  }

  std::string by_hand(const std::string& more) const { return fmt::format("{}, or a glTF: {}", more, format_.advice); }
  tl::unexpected<Error> over_time() const {
    return fail(ErrorCode::kRuntime, name(), "the {} was not read in {:g} s: expected {}", format_.name,
                process_.time_s,
                by_hand(fmt::format("oriel-import {} -o scene.glb --time 1h, and its scene.glb here", name())));
  }
  tl::unexpected<Error> broken(const std::string& what) const {
    return invalid(name(), "the reader of {} files {}: it is damaged, or of a version that is not read: {}",
                   format_.name, what, format_.advice);
  }
  static tl::unexpected<Error> system_error(const char* what) {
    return fail(ErrorCode::kRuntime, what, "{}", std::strerror(errno));
  }

  const fs::path& file_;
  const SourceFormat& format_;
  const ImportProcess& process_;
  fs::path program_;
  pid_t pid_ = -1;
  Descriptor out_, said_;
  std::string heard_, error_;
};

}  // namespace

Result<Bytes> import_by_process(const fs::path& file, const SourceFormat& format, const ImportProcess& process) {
  return Child(file, format, process).run();
}

}  // namespace oriel
