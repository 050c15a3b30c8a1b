#include "formats/cli/command.h"

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "formats/cli/help.h"
#include "formats/core/json.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

constexpr const char* kHelpGroup = "Help";  // comes last
constexpr std::size_t kWidth = 100;         // of a line of help

std::string wrapped(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  const std::string margin(indent, ' ');
  std::string out, line = margin;
  for (std::string word; words >> word;) {
    if (line.size() > indent && line.size() + 1 + word.size() > kWidth) {
      out += line + "\n";
      line = margin;
    }
    if (line.size() > indent) line += " ";
    line += word;
  }
  return out + line + "\n";
}

// An option's description below its name, in lines of a terminal's width.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* command) const override { return command->get_description() + "\n"; }

  std::string make_help(const CLI::App* command, std::string name, CLI::AppFormatMode mode) const override {
    std::string out = make_description(command) + make_usage(command, std::move(name)) + make_positionals(command);
    std::vector<std::string> groups = command->get_groups();
    std::stable_partition(groups.begin(), groups.end(), [](const auto& group) { return group != kHelpGroup; });
    for (const std::string& group : groups) {
      const auto options = command->get_options(
          [&](const CLI::Option* option) { return option->get_group() == group && option->nonpositional(); });
      if (!group.empty() && !options.empty()) out += make_group(group, false, options);
    }
    return out + make_subcommands(command, mode) + "\n" + make_footer(command);
  }

  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    const std::string type = is_positional ? "" : make_option_opts(option);
    return fmt::format("  {}{}\n{}", make_option_name(option, is_positional), type,
                       wrapped(make_option_desc(option), 8));
  }

  std::string make_subcommand(const CLI::App* command) const override {
    return fmt::format("  {}\n{}", command->get_display_name(true), wrapped(command->get_description(), 8));
  }
};

// A command beside what CLI11 makes of it.
struct Mounted {
  const ToolCommand* command = nullptr;
  CLI::App* app = nullptr;
  std::vector<CLI::Option*> options;  // of command->options
  CLI::Option *print = nullptr, *preset = nullptr;
  std::vector<Mounted> commands = {};
};

const Option* find_option(const ToolCommand& command, const std::string& name) {
  for (const Option& option : command.options)
    if (long_name(option) == name) return &option;
  return nullptr;
}

CLI::Option* mount(const Option& option, bool all, CLI::App& app) {
  CLI::Option* out = nullptr;
  if (option.value.type.empty()) {
    out = app.add_flag(option.name)->description(option.help);
  } else {
    out = app.add_option(
        option.name, [](const CLI::results_t&) { return true; }, option.help);
    out->type_name(option.value.type)->allow_extra_args(false)->default_str(option.value.get());
    if (option.value.repeats) out->take_all();
    if (option.value.repeats && option.name[0] != '-') out->expected(-1);
    if (option.value.type[0] == '[') out->expected(0, 1);
  }
  return out->group(all || option.use != Use::kRare ? option.group : "");
}

Mounted mount(const ToolCommand& command, bool all, CLI::App& app) {
  Mounted out{&command, &app, {}};
  app.footer(command.footer);
  app.get_help_ptr()->group(kHelpGroup);
  for (const Option& option : command.options) out.options.push_back(mount(option, all, app));
  if (!command.options.empty()) {
    out.print = app.add_flag("--print-options")
                    ->description("List every option with its value and where that comes from, and stop")
                    ->group(kHelpGroup);
    out.preset = app.add_option(
        "--preset", [](const CLI::results_t&) { return true; },
        "Take options from a file, \"--texel 5cm\" a line; the command line wins");
    out.preset->type_name("FILE")->group(kHelpGroup);
  }
  for (const ToolCommand& child : command.commands)
    out.commands.push_back(mount(child, all, *app.add_subcommand(child.name, child.help)));
  return out;
}

// The first word that no option of the command explains.
Status unexpected_word(const Mounted& mounted) {
  std::vector<std::string> names{"--help", "--help-all", "--print-options", "--preset"};
  for (const Option& option : mounted.command->options) names.push_back(long_name(option));
  for (const ToolCommand& child : mounted.command->commands) names.push_back(child.name);
  const std::vector<std::string> words = mounted.app->remaining();
  if (words.empty()) return {};
  const auto dashed = std::find_if(words.begin(), words.end(), [](const auto& word) { return word[0] == '-'; });
  const std::string word = dashed != words.end() ? *dashed : words[0];
  const std::string wanted = word.substr(0, word.find('='));
  if (word[0] != '-') {
    std::string commands;
    for (const ToolCommand& child : mounted.command->commands) commands += (commands.empty() ? "" : ", ") + child.name;
    return fail(ErrorCode::kUsage, "", "found '{}' after all that {} takes, expected options from there on{}", word,
                mounted.app->get_name(),
                commands.empty() ? "" : fmt::format("; or, as the first word, a command: {}", commands));
  }
  return fail(ErrorCode::kUsage, "", "found '{}', expected an option that {} has: {}", word, mounted.app->get_name(),
              names_like(wanted, names));
}

// Lines as on the command line; blank ones and those that begin with # are passed over.
Status read_preset(const std::string& file, const ToolCommand& command, Given& given) {
  std::ifstream in(file);
  if (!in) return fail(ErrorCode::kIo, file, "cannot be read");
  std::map<std::string, std::vector<std::string>> found;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const std::size_t begin = line.find_first_not_of(" \t\r"), end = line.find_last_not_of(" \t\r");
    if (begin == std::string::npos || line[begin] == '#') continue;
    line = line.substr(begin, end + 1 - begin);
    const std::size_t space = line.find_first_of(" \t=");
    const std::string name = line.substr(0, space);
    const Option* option = name[0] == '-' ? find_option(command, name) : nullptr;
    const bool has_value = space != std::string::npos;
    if (option == nullptr || has_value == option->value.type.empty())
      return fail(
          ErrorCode::kUsage, fmt::format("{}:{}", file, number), "found '{}', expected {}", line,
          option == nullptr ? "an option of " + command.name : fmt::format("{} {}", option->name, option->value.type));
    found[name].push_back(has_value ? line.substr(line.find_first_not_of(" \t=", space)) : "");
  }
  for (auto& [name, texts] : found) given.add(name, {Source::kPreset, std::move(texts)});
  return {};
}

Result<Given> collect(const Mounted& mounted) {
  Given given;
  if (mounted.preset != nullptr && mounted.preset->count() > 0)
    ORIEL_TRY_VOID(read_preset(mounted.preset->results().back(), *mounted.command, given));
  for (std::size_t i = 0; i < mounted.options.size(); ++i) {
    if (mounted.options[i]->count() == 0) continue;
    std::vector<std::string> texts = mounted.options[i]->results();
    if (mounted.command->options[i].value.type.empty()) texts = {""};
    given.add(long_name(mounted.command->options[i]), {Source::kCommandLine, std::move(texts)});
  }
  return given;
}

Status set_all(const ToolCommand& command, const Given& given) {
  for (const Option& option : command.options) {
    const std::string name = long_name(option);
    for (const std::string& text : given.texts(name))
      if (const Status set = option.value.set(text); !set)
        return fail(set.error().code, set.error().where.empty() ? name : name + " " + set.error().where, "{}",
                    set.error().message);
  }
  return {};
}

Status check_given(const ToolCommand& command, const Given& given) {
  for (const Option& option : command.options) {
    const std::string name = long_name(option);
    if (option.use == Use::kRequired && !given.has(name))
      return fail(ErrorCode::kUsage, "", "found no {}, expected it: {}", name, option.help);
    if (!given.has(name)) continue;
    std::istringstream others(option.excludes);
    for (std::string other; others >> other;)
      if (given.has(other))
        return fail(ErrorCode::kUsage, "", "found both {} and {}, expected one of them", name, other);
    if (*option.needs != '\0' && !given.has(option.needs))
      return fail(ErrorCode::kUsage, name, "needs {}", option.needs);
  }
  return {};
}

Result<std::variant<const ToolCommand*, int>> finish(const Mounted& mounted) {
  const ToolCommand& command = *mounted.command;
  const auto chosen = mounted.app->get_subcommands();
  ORIEL_TRY_VOID(unexpected_word(mounted));
  ORIEL_TRY(const Given given, collect(mounted));
  if (!chosen.empty()) {
    for (const Option& option : command.options)
      if (given.has(long_name(option)))
        return fail(ErrorCode::kUsage, long_name(option),
                    "found before {0}, expected one or the other; {0}'s own "
                    "options follow it",
                    chosen[0]->get_name());
    for (const Mounted& child : mounted.commands)
      if (child.app == chosen[0]) return finish(child);
  }
  ORIEL_TRY_VOID(set_all(command, given));
  const bool prints = mounted.print != nullptr && mounted.print->count() > 0;
  std::vector<std::string> values;
  for (const Option& option : command.options) values.push_back(option.value.get());
  if (prints) {
    std::fputs(options_text(command, given, values).c_str(), stdout);
    return 0;
  }
  if (!command.run && command.commands.size() > 0)
    return fail(ErrorCode::kUsage, mounted.app->get_parent() == nullptr ? "" : command.name,
                "found no command, expected one: see --help");
  ORIEL_TRY_VOID(check_given(command, given));
  if (command.settle) ORIEL_TRY_VOID(command.settle(given));
  return &command;
}

}  // namespace

Source Given::source(const std::string& name) const {
  const auto found = texts_.find(name);
  return found == texts_.end() ? Source::kDefault : found->second.source;
}

std::vector<std::string> Given::texts(const std::string& name) const {
  const auto found = texts_.find(name);
  return found == texts_.end() ? std::vector<std::string>() : found->second.texts;
}

std::vector<std::string> Given::typed() const {
  std::vector<std::string> names;
  for (const auto& [name, texts] : texts_)
    if (texts.source == Source::kCommandLine) names.push_back(name);
  return names;
}

std::vector<std::string> Given::words(const std::vector<Option>& options) const {
  std::vector<std::string> words;
  for (const Option& option : options)
    for (const std::string& text : texts(long_name(option))) {
      words.push_back(long_name(option));
      if (!option.value.type.empty()) words.push_back(text);
    }
  return words;
}

namespace {

// As a line of JSON where the words ask for that: logs are read by programs.
void complain(const CommandLine& program, const std::vector<std::string>& words, const std::string& message, int code,
              const char* after) {
  const bool json = std::find(words.begin(), words.end(), "--json-log") != words.end();
  if (json) {
    const Json line = {{"event", "error"}, {"tool", program.command.name}, {"code", code}, {"message", message}};
    std::fprintf(stderr, "%s\n", line.dump().c_str());
  } else {
    std::fprintf(stderr, "%s: %s%s\n", program.command.name.c_str(), message.c_str(), after);
  }
}

}  // namespace

std::variant<const ToolCommand*, int> parse(const CommandLine& program, int argc, const char* const* argv) {
  const ToolCommand& command = program.command;
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool all = std::find(words.begin(), words.end(), "--help-all") != words.end();
  CLI::App app(command.help, command.name);
  app.formatter(std::make_shared<HelpFormatter>());
  app.set_help_flag("-h,--help,--help-all", "Tell of everyday options; --help-all: of all");
  app.set_version_flag("--version", command.name + " " + program.version)->group(kHelpGroup);
  app.allow_extras()->require_subcommand(0, 1);
  std::string shell;
  bool page = false;
  app.add_option("--completion", shell, "Print a script that lets the shell complete commands, options and values")
      ->type_name("bash")
      ->group(kHelpGroup);
  app.add_flag("--options-page", page, "Print the tables of options that the docs hold")->group("");
  Mounted mounted = mount(command, all, app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& done) {
    return app.exit(done);
  } catch (const CLI::ParseError& error) {
    complain(program, words, error.what(), static_cast<int>(ErrorCode::kUsage),
             "\nRun with --help for more information.");
    return static_cast<int>(ErrorCode::kUsage);
  }
  if (page || shell == "bash") {
    std::fputs((page ? options_page(command) : bash_completion(command)).c_str(), stdout);
    return 0;
  }
  auto done = finish(mounted);
  if (done && !shell.empty()) done = fail(ErrorCode::kUsage, "--completion", "found '{}', expected bash", shell);
  if (done) return *done;
  complain(program, words, done.error().text(), static_cast<int>(done.error().code), "");
  return static_cast<int>(done.error().code);
}

int run_program(const CommandLine& program, int argc, const char* const* argv) {
  Status done;
  try {
    const auto parsed = parse(program, argc, argv);
    if (const int* code = std::get_if<int>(&parsed)) return *code;
    done = std::get<const ToolCommand*>(parsed)->run();
  } catch (const std::exception& error) {
    done = fail(ErrorCode::kRuntime, "", "{}", error.what());
  }
  if (done) return 0;
  std::fprintf(stderr, "%s: error: %s\n", program.command.name.c_str(), done.error().text().c_str());
  return static_cast<int>(done.error().code);
}

std::optional<int> parse_options(int argc, const char* const* argv, const char* help, std::vector<Option> options) {
  for (Option& option : options)
    if (option.use == Use::kRare) option.use = Use::kEveryday;
  CommandLine line{"", {std::filesystem::path(argv[0]).filename().string(), help, "", std::move(options)}};
  line.command.run = []() -> Status { return {}; };
  const auto parsed = parse(line, argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  return {};
}

}  // namespace oriel
