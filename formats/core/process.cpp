#include "formats/core/process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace oriel {
namespace {

std::vector<char*> arguments_of(std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  return arguments;
}

tl::unexpected<Error> not_started(const std::string& program, int error) {
  return fail(ErrorCode::kRuntime, program, "cannot be started: {}", std::strerror(error));
}

}  // namespace

Result<std::filesystem::path> this_program() {
  std::error_code error;
  auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return fail(ErrorCode::kRuntime, "/proc/self/exe", "cannot be read: {}", error.message());
  return self;
}

Result<std::filesystem::path> program_beside(const std::string& name) {
  ORIEL_TRY(const std::filesystem::path self, this_program());
  return self.parent_path() / name;
}

Result<pid_t> start_program(std::vector<std::string> words, const ProgramStreams& streams) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  for (const auto& [own, its] : {std::pair(streams.in, 0), std::pair(streams.out, 1), std::pair(streams.err, 2)})
    if (own < 0)
      ::posix_spawn_file_actions_addopen(&actions, its, "/dev/null", its == 0 ? O_RDONLY : O_WRONLY, 0);
    else if (own != its)  // which may be closed
      ::posix_spawn_file_actions_adddup2(&actions, own, its);
  pid_t program = -1;
  const int error = ::posix_spawnp(&program, words[0].c_str(), &actions, nullptr, arguments_of(words).data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return not_started(words[0], error);
  return program;
}

Status become_program(std::vector<std::string> words) {
  ::execv(words[0].c_str(), arguments_of(words).data());
  return not_started(words[0], errno);
}

int wait_for(pid_t program) {
  int status = 0;
  while (::waitpid(program, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace oriel
