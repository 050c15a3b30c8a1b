#include "formats/cli/help.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

namespace oriel {
namespace {

bool stands_for_itself(const std::string& word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::islower(c) || std::isdigit(c) || c == '-' || c == '_' || c == '.';
  });
}

// "auto uv1" of "auto|uv1|LENGTH".
std::string choices_of(const std::string& type) {
  std::istringstream in(type);
  std::string out;
  for (std::string word; std::getline(in, word, '|');)
    if (stands_for_itself(word)) add_word(out, word);
  return out;
}

// "-o --output".
std::string names_of(const Option& option) {
  std::string names = option.name;
  std::replace(names.begin(), names.end(), ',', ' ');
  return names;
}

bool is_positional(const Option& option) {
  return option.name[0] != '-';
}

struct CompletionCases {
  std::string values, names;
  std::set<std::string> commands;
};

void add_cases(const ToolCommand& command, const std::string& path, CompletionCases& out) {
  std::string words = "--help --help-all --preset --print-options";
  for (const Option& option : command.options) {
    if (is_positional(option)) continue;
    add_word(words, names_of(option));
    if (const std::string choices = choices_of(option.value.type); !choices.empty())
      out.values += fmt::format("    '{} {}') words='{}' ;;\n", path, long_name(option), choices);
  }
  for (const ToolCommand& child : command.commands) {
    add_word(words, child.name);
    out.commands.insert(child.name);
    add_cases(child, path + "/" + child.name, out);
  }
  out.names += fmt::format("    '{}') words='{}' ;;\n", path, words);
}

void add_rows(const std::vector<const Option*>& options, std::string& page) {
  page += "| option | default | what it does |\n|---|---|---|\n";
  for (const Option* option : options) {
    std::string names = option->name;
    if (const std::size_t comma = names.find(','); comma != std::string::npos)
      names = names.substr(0, comma).append("`, `").append(names, comma + 1);
    std::string type = option->value.type.empty() ? "" : fmt::format(" {}", option->value.type);
    for (std::size_t at = 0; (at = type.find('|', at)) != std::string::npos; at += 2)
      type.insert(type.begin() + static_cast<std::ptrdiff_t>(at), '\\');
    std::string value = option->value.get();
    if (option->value.type.empty() || is_positional(*option)) value.clear();
    page += fmt::format("| `{}{}` | {} | {}{} |\n", names, is_positional(*option) ? "" : type, value, option->help,
                        *option->see == '\0' ? "" : fmt::format(" ([more]({}))", option->see));
  }
  page += "\n";
}

}  // namespace

std::string options_text(const ToolCommand& command, const Given& given, const std::vector<std::string>& values) {
  constexpr const char* kSources[] = {"default", "preset", "command line"};
  std::string out;
  for (std::size_t i = 0; i < command.options.size(); ++i) {
    const std::string name = long_name(command.options[i]);
    out += fmt::format("{:<24} {:<24} {}\n", name, values[i].empty() ? "-" : values[i],
                       kSources[static_cast<int>(given.source(name))]);
  }
  return out;
}

std::string bash_completion(const ToolCommand& program) {
  CompletionCases cases;
  add_cases(program, "", cases);
  std::string commands, function = fmt::format("_{}", program.name);
  std::replace(function.begin(), function.end(), '-', '_');
  for (const std::string& name : cases.commands) add_word(commands, name, "|");
  return fmt::format(
      "# Completion of {0} for bash: source it, or keep it as /usr/share/bash-completion/completions/{0}.\n"
      "{1}() {{\n"
      "  local path='' words='' i\n"
      "  for ((i = 1; i < COMP_CWORD; i++)); do\n"
      "    case \"${{COMP_WORDS[i]}}\" in {2}) path+=\"/${{COMP_WORDS[i]}}\" ;; esac\n"
      "  done\n"
      "  case \"$path ${{COMP_WORDS[COMP_CWORD-1]}}\" in\n{3}  esac\n"
      "  [ -n \"$words\" ] || case \"$path\" in\n{4}  esac\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"${{COMP_WORDS[COMP_CWORD]}}\"))\n"
      "}}\n"
      "complete -o default -F {1} {0}\n",
      program.name, function, commands.empty() ? "''" : commands, cases.values, cases.names);
}

std::string options_page(const ToolCommand& program) {
  std::set<std::string> known;
  std::vector<std::string_view> groups;
  for (const Option& option : program.options) {
    known.insert(option.name);
    if (std::find(groups.begin(), groups.end(), option.group) == groups.end()) groups.push_back(option.group);
  }
  std::string page;
  for (const std::string_view group : groups) {
    std::vector<const Option*> rows;
    for (const Option& option : program.options)
      if (option.group == group) rows.push_back(&option);
    page += fmt::format("### {}\n\n", group);
    add_rows(rows, page);
  }
  for (const ToolCommand& command : program.commands) {
    std::vector<const Option*> rows;
    for (const Option& option : command.options)
      if (!known.contains(option.name)) rows.push_back(&option);
    if (!rows.empty()) page += fmt::format("### `{} {}`\n\n{}.\n\n", program.name, command.name, command.help);
    if (!rows.empty()) add_rows(rows, page);
  }
  return page;
}

}  // namespace oriel
