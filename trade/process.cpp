#include "trade/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "formats/core/file.h"

namespace oriel::trade {
namespace {

std::string last_line(const std::filesystem::path& log) {
  const auto bytes = read_file(log);
  if (!bytes) return {};
  std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const std::size_t end = text.rfind('\n');
  return end == std::string::npos ? text : text.substr(end + 1);
}

// 0, or errno. The child reads nothing.
int start(const std::vector<std::string>& arguments, const std::filesystem::path& log, pid_t& child) {
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  const int error = ::posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Result<Finished> run_program(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                             const std::atomic<bool>& stop) {
  if (stop.load()) return fail(ErrorCode::kStopped, "", "stopped by the user");
  const auto started = std::chrono::steady_clock::now();
  pid_t child = 0;
  if (const int error = start(arguments, log, child); error != 0)
    return fail(ErrorCode::kRuntime, arguments[0], "cannot be started: {}", std::strerror(error));
  int status = 0;
  rusage usage{};
  for (bool told = false; ::wait4(child, &status, WNOHANG, &usage) == 0;) {
    if (stop.load() && !told) told = ::kill(child, SIGTERM) == 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
  if (stop.load()) return fail(ErrorCode::kStopped, "", "stopped by the user");
  if (WIFSIGNALED(status)) return fail(ErrorCode::kRuntime, arguments[0], "was ended by signal {}", WTERMSIG(status));
  if (WEXITSTATUS(status) != 0)
    return fail(ErrorCode::kRuntime, arguments[0], "exit code {}: {}", WEXITSTATUS(status), last_line(log));
  return Finished{took.count(), seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime)};
}

}  // namespace oriel::trade
