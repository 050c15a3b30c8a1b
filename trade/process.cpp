#include "trade/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "formats/core/file.h"
#include "formats/core/process.h"

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

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Result<Finished> run_program(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                             const std::atomic<bool>& stop) {
  if (stop.load()) return fail(ErrorCode::kStopped, "", "stopped by the user");
  const auto started = std::chrono::steady_clock::now();
  const int output = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (output < 0) return fail(ErrorCode::kIo, log.string(), "cannot be written");
  const Result<pid_t> program = start_program(arguments, {.out = output, .err = output});
  ::close(output);
  ORIEL_TRY(const pid_t child, program);
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
