// oriel-bake: a glTF scene into one .oriel pack, a table of illuminance, a path-traced frame, or what these cost.
#include <unistd.h>

#include <cstdio>
#include <new>
#include <string_view>

#include "bake/cli/commands.h"
#include "bake/jobs/unit_cache.h"
#include "bake/run/version.h"
#include "formats/core/json.h"

namespace oriel {

extern const char* const kCommit;  // written by the build: kCommitMark and 12 digits

namespace {

CommandLine command_line(BakeSession& session) {
  const std::string version = fmt::format("{} (commit {}, build {}, {})", kVersion, kCommit + kCommitMark.size(),
                                          build_id(), instruction_sets(false));
  CommandLine out{version, bake_command(session)};
  for (const auto make : {plan_command, lux_command, render_command, preview_command, trade_command, worker_command,
                          submit_command, verify_command, key_command, cache_command})
    out.command.commands.push_back(make(session));
  return out;
}

// Our code throws nothing, but the libraries and the allocator may.
Status run(const ToolCommand& command, const BakeSession& session) {
  try {
    return command.run();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kRuntime, "", "not enough memory: try {}", session.less_memory);
  } catch (const std::exception& error) {
    return fail(ErrorCode::kRuntime, "", "{}", error.what());
  }
}

int print_error(const Error& error, BakeSession& session) {
  session.printer->finish();
  if (session.style() == ProgressPrinter::Style::kJson) {
    const Json json = {{"event", "error"},
                       {"tool", "oriel-bake"},
                       {"code", static_cast<int>(error.code)},
                       {"message", error.message},
                       {"where", error.where}};
    std::fprintf(stderr, "%s\n", json.dump().c_str());
  } else {
    std::fprintf(stderr, "oriel-bake: %s\n", text_of_error(error).c_str());
  }
  return static_cast<int>(error.code);
}

int main_of_bake(int argc, char** argv) {
  BakeSession session;
  if (argc > 1 && std::string_view(argv[1]) == "preview") {  // its options are that program's
    const Status status = start_preview(std::vector<std::string>(argv + 2, argv + argc));
    session.begin();
    return print_error(status.error(), session);
  }
  const CommandLine line = command_line(session);
  const auto parsed = parse(line, argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  session.begin();
  stop_on_signals(session.context, {}, OnStop::kStop);
  const Status status = session.judged(run(*std::get<const ToolCommand*>(parsed), session));
  ::alarm(0);
  return status ? 0 : print_error(status.error(), session);
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  return oriel::main_of_bake(argc, argv);
}
