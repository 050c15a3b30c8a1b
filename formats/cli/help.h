// What is printed of commands: help, values, completion, the table of the docs.
#pragma once

#include <CLI/CLI.hpp>

#include "formats/cli/command.h"

namespace oriel {

inline constexpr const char* kHelpGroup = "Help";  // comes last

// An option's description below its name, in lines of a terminal's width.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* command) const override;
  std::string make_help(const CLI::App* command, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_option(const CLI::Option* option, bool is_positional) const override;
  std::string make_subcommand(const CLI::App* command) const override;
};

// A line an option: name, value, source.
std::string options_text(const ToolCommand& command, const Given& given, const std::vector<std::string>& values);
// A script for bash.
std::string bash_completion(const ToolCommand& program);
// Markdown: the options of the program, and those that each of its commands has besides.
std::string options_page(const ToolCommand& program);

}  // namespace oriel
