// What is printed of commands: help, values, completion, the table of the docs.
#pragma once

#include "formats/cli/command.h"

namespace oriel {

// A line an option: name, value, source.
std::string options_text(const ToolCommand& command, const Given& given, const std::vector<std::string>& values);
// A script for bash.
std::string bash_completion(const ToolCommand& program);
// Markdown: the options of the program, and those that each of its commands has besides.
std::string options_page(const ToolCommand& program);

}  // namespace oriel
