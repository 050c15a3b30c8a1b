#include "bake/cli/session.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iterator>
#include <sstream>

#include "formats/core/file.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

// What the signal handlers need; set before they are installed.
Context* g_context = nullptr;
OnStop g_on_stop = OnStop::kStop;
char g_temporary[4096] = "", g_lock[4096] = "";
std::string g_report, g_report_text;
bool g_json = false;                      // lines on stderr are JSON
constexpr unsigned kMostAfterTerm_s = 9;  // for finishing after SIGTERM

// As a signal handler may.
template <std::size_t N>
void tell(const char (&text)[N]) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, N - 1);
}

// Stages look at the flag many times a second, but libraries' long calls do not: after a second the process ends
// itself. That loses nothing: a pack exists only once it is renamed into place.
void on_alarm(int) {
  ::unlink(g_temporary);
  ::unlink(g_lock);
  if (!g_report.empty())
    if (const int file = ::open(g_report.c_str(), O_WRONLY | O_TRUNC); file >= 0) {
      [[maybe_unused]] const ssize_t written = ::write(file, g_report_text.data(), g_report_text.size());
      ::close(file);
    }
  if (g_json)
    tell("{\"event\":\"error\",\"tool\":\"oriel-bake\",\"code\":130,\"message\":\"stopped; nothing was written\"}\n");
  else
    tell("\noriel-bake: stopped; nothing was written\n");
  ::_exit(static_cast<int>(ErrorCode::kStopped));
}

void on_stop(int signal) {
  if (g_on_stop == OnStop::kFinish && g_context->finishable && !g_context->finish.exchange(true)) {
    if (g_json)
      tell("{\"event\":\"note\",\"tool\":\"oriel-bake\",\"message\":\"finishing with what is there\"}\n");
    else
      tell("\noriel-bake: finishing with what is there; again to stop at once\n");
    // Who sends this waits for an end: schedulers kill after some seconds.
    if (signal == SIGTERM) ::alarm(kMostAfterTerm_s);
    return;
  }
  g_context->stop.store(true);
  if (g_on_stop != OnStop::kKeep) ::alarm(1);
}

std::vector<std::string> words_of(std::string_view text) {
  std::istringstream in{std::string(text)};
  return {std::istream_iterator<std::string>(in), {}};
}

// "error=CODE,CODE"
OptionValue fatal_warnings(std::vector<std::string>& codes) {
  OptionValue out{"error=LIST",
                  [&codes](const std::string& typed) -> Status {
                    std::istringstream list(typed.starts_with("error=") ? typed.substr(6) : "");
                    bool any = false;
                    for (std::string code; std::getline(list, code, ','); any = true) {
                      if (!is_warning_code(code))
                        return fail(ErrorCode::kUsage, "", "found '{}', expected the code of a warning: {}", code,
                                    names_like(code, words_of(kWarningCodes)));
                      codes.push_back(code);
                    }
                    if (any) return {};
                    return fail(ErrorCode::kUsage, "", "found '{}', expected error=CODE,…, as error=missing-texture",
                                typed);
                  },
                  [] { return std::string(); }};
  out.repeats = true;
  return out;
}

}  // namespace

ProgressPrinter::Style BakeSession::style() const {
  return json_log                  ? ProgressPrinter::Style::kJson
         : quiet                   ? ProgressPrinter::Style::kQuiet
         : ::isatty(STDERR_FILENO) ? ProgressPrinter::Style::kBar
                                   : ProgressPrinter::Style::kPlain;
}

void BakeSession::begin() {
  context.threads = threads;
  context.seed = seed;
  printer.emplace(style());
  g_json = json_log;
  context.progress = [this](const Progress& progress) { (*printer)(progress); };
  context.warn = [this](const Warning& warning) {
    printer->warning(warning);
    if (fatal || std::ranges::find(errors, warning.code.name()) == errors.end()) return;
    fatal = warning;
    context.stop = true;
  };
}

Status BakeSession::judged(Status status) const {
  if (!fatal) return status;
  return fail(kUnmet, "", "{} [{}]: expected none, by -W or --require; nothing was written", fatal->text,
              fatal->code.name());
}

std::vector<Option> run_options(BakeSession& session) {
  constexpr const char* kRun = "Run";
  return {
      {"--threads", kRun, "Threads; 0: all CPUs. The result does not depend on it", number(session.threads, 0, 1024),
       Use::kEveryday},
      {"--seed", kRun, "Of every random number: another seed gives another, equally good, estimate",
       number(session.seed, 0, 18446744073709551615.0)},
      {"--quiet", kRun, "No progress; warnings and errors only", flag(session.quiet), Use::kEveryday},
      {"-W,--warn", kRun, "Warnings with these codes end the program with exit code 7. May be repeated",
       fatal_warnings(session.errors), Use::kRare, "", "pipelines.md#warnings"},
      {"--json-log", kRun,
       "Every line on stderr is a JSON object: progress, notes, warnings and errors, those of usage and of signals too",
       flag(session.json_log), Use::kRare, "", "", "--quiet"},
  };
}

Option scene_argument(std::filesystem::path& scene) {
  return {"SCENE", "Arguments", "The scene: .glb, .gltf, or of another program: .fbx .dae .ifc .obj .3ds .ply .stl",
          path(scene, "FILE"), Use::kRequired};
}

void report_hard_stop(const std::filesystem::path& file, std::string text) {
  g_report_text = std::move(text);
  g_report = file.string();
}

void stop_on_signals(Context& context, const std::filesystem::path& output, OnStop on_stop_does) {
  g_context = &context;
  g_on_stop = on_stop_does;
  const auto set = [](auto& name, const std::filesystem::path& file) {
    std::ranges::fill(name, '\0');
    if (file.native().size() < sizeof(name)) std::ranges::copy(file.native(), name);
  };
  set(g_temporary, output.empty() ? output : temporary_name(output));
  set(g_lock, on_stop_does == OnStop::kFinish ? lock_name(output) : "");
  std::signal(SIGALRM, on_alarm);
  std::signal(SIGINT, on_stop);
  std::signal(SIGTERM, on_stop);
}

std::string text_of_error(const Error& error) {
  return error.code == ErrorCode::kStopped && g_on_stop != OnStop::kKeep ? "stopped; nothing was written"
                                                                         : error.text();
}

std::vector<std::filesystem::path> inputs_of(const std::filesystem::path& scene, const ImportOptions& import) {
  std::vector<std::filesystem::path> inputs{scene, import.sky_file};
  for (const auto& [node, file] : import.ies) inputs.push_back(file);
  return inputs;
}

Status check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs) {
  namespace fs = std::filesystem;
  std::error_code ec;
  const fs::path folder = output.has_parent_path() ? output.parent_path() : ".";
  if (!fs::is_directory(folder, ec))
    return fail(ErrorCode::kIo, output.string(), "there is no folder {}", folder.string());
  if (::access(folder.c_str(), W_OK) != 0)
    return fail(ErrorCode::kIo, output.string(), "the folder {} cannot be written: {}", folder.string(),
                std::strerror(errno));
  if (fs::is_directory(output, ec)) return fail(ErrorCode::kIo, output.string(), "is a folder, expected a file name");
  for (const fs::path& input : inputs)
    if (fs::equivalent(output, input, ec))
      return fail(ErrorCode::kUsage, output.string(), "is an input, which would be overwritten: expected another name");
  return {};
}

}  // namespace oriel
