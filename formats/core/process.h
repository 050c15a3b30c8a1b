// Other programs as processes of their own, without a shell.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "formats/core/result.h"

namespace oriel {

// Where this program lies, and the program of that name in its folder. Error kRuntime.
Result<std::filesystem::path> this_program();
Result<std::filesystem::path> program_beside(const std::string& name);

// Descriptors of this process that a program gets as its own 0, 1 and 2; -1: /dev/null.
struct ProgramStreams {
  int in = -1, out = -1, err = -1;
};

// Starts words[0], a path or a name that PATH leads to, with the others as its arguments. Error kRuntime.
Result<pid_t> start_program(std::vector<std::string> words, const ProgramStreams& streams);

// This process becomes that program. Returns, with error kRuntime, where it cannot.
Status become_program(std::vector<std::string> words);

// Waits until it ends: its status, as waitpid() has it.
int wait_for(pid_t program);

}  // namespace oriel
