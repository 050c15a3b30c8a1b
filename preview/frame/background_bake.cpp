#include "preview/frame/background_bake.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "formats/core/json.h"
#include "formats/core/process.h"

namespace oriel {

BackgroundBake::~BackgroundBake() {
  stop();
}

Status BackgroundBake::start(std::vector<std::string> words) {
  stop();
  stage_.clear(), failure_.clear(), last_error_.clear(), text_.clear();
  fraction_ = 0, left_s_ = -1;
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    return fail(ErrorCode::kRuntime, words.front(), "cannot be listened to: {}", std::strerror(errno));
  ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
  const Result<pid_t> started = start_program(std::move(words), {.err = ends[1]});
  ::close(ends[1]);
  pipe_ = ends[0];
  if (!started) {
    stop();
    return tl::unexpected(started.error());
  }
  child_ = *started;
  return {};
}

void BackgroundBake::stop() {
  if (child_ > 0) {
    ::kill(child_, SIGTERM);
    wait_for(std::exchange(child_, -1));
  }
  if (pipe_ >= 0) ::close(std::exchange(pipe_, -1));
}

bool BackgroundBake::ended_well() {
  if (child_ <= 0) return false;
  int status = 0;
  const pid_t ended = ::waitpid(child_, &status, WNOHANG);
  read_pipe();
  if (ended == 0) return false;
  child_ = -1;
  ::close(std::exchange(pipe_, -1));
  constexpr int kPartial = 6;  // a pack that ended early is one to show (docs/notes/conventions.md)
  if (WIFEXITED(status) && (WEXITSTATUS(status) == 0 || WEXITSTATUS(status) == kPartial)) return true;
  failure_ = !last_error_.empty() ? last_error_
             : WIFEXITED(status)  ? fmt::format("the bake ended with exit code {}", WEXITSTATUS(status))
                                  : fmt::format("the bake was ended by signal {}", WTERMSIG(status));
  return false;
}

void BackgroundBake::read_pipe() {
  char bytes[4096];
  for (ssize_t n = 0; (n = ::read(pipe_, bytes, sizeof bytes)) > 0;) text_.append(bytes, static_cast<std::size_t>(n));
  for (std::size_t end = 0; (end = text_.find('\n')) != std::string::npos; text_.erase(0, end + 1))
    take_line(text_.substr(0, end));
}

// A line of --json-log; what is none is the last word of a program that fails.
void BackgroundBake::take_line(const std::string& line) {
  const auto json = Json::parse(line).value_or(Json());
  if (!json.is_object()) {
    if (!line.empty()) last_error_ = line;
    return;
  }
  const std::string event = json.value("event", "");
  if (event == "error") last_error_ = json.value("message", "");
  if (event != "progress") return;
  stage_ = json.value("stage", "");
  fraction_ = json.value("fraction", 0.0);
  const Json& left = json["seconds_left"];
  left_s_ = left.is_number() ? left.get<double>() : -1;
}

}  // namespace oriel
