// Commands as data, and the command line that is made of them.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "formats/cli/option.h"

namespace oriel {

// Where an option's value comes from.
enum class Source { kDefault, kPreset, kCommandLine };

// What was given for a command's options.
class Given {
 public:
  struct Texts {
    Source source;
    std::vector<std::string> texts;  // one for each time it was given; "" for a flag
  };
  void add(const std::string& name, Texts texts) { texts_.insert_or_assign(name, std::move(texts)); }
  // By long name.
  bool has(const std::string& name) const { return texts_.contains(name); }
  Source source(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;
  // Those that the command line itself has.
  std::vector<std::string> typed() const;
  // The words of a command line that gives these options the same values.
  std::vector<std::string> words(const std::vector<Option>& options) const;

 private:
  std::map<std::string, Texts> texts_;
};

struct ToolCommand {
  std::string name, help, footer;
  std::vector<Option> options;
  // Once all options are set: what contradicts is an error kUsage, what follows from others is filled in.
  std::function<Status(const Given&)> settle = {};
  std::function<Status()> run = {};  // none: one of `commands` must be named
  std::vector<ToolCommand> commands = {};
};

struct CommandLine {
  std::string version;
  ToolCommand command;  // of the program's own name
};

// The command that was asked for, its options set; or the exit code, after help, a list or a complaint was printed.
// Every command also takes
//   --help, --help-all   its everyday options, all of them
//   --print-options      lists each option with its value and where that comes from
//   --preset FILE        takes options from a file, "--texel 5cm" a line; what the command line says wins
// and the program --version and --completion bash.
std::variant<const ToolCommand*, int> parse(const CommandLine& program, int argc, const char* const* argv);

// A program: runs the command that was asked for, and tells on standard error why it fails; the exit code.
int run_program(const CommandLine& program, int argc, const char* const* argv);

// Of a program without commands: its options are set, or it ends with the code. All options are everyday ones.
std::optional<int> parse_options(int argc, const char* const* argv, const char* help, std::vector<Option> options);

}  // namespace oriel
