// oriel-preview: a scene as it will be lit, before any bake.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>

#include "preview/offscreen.h"
#include "preview/window.h"

namespace oriel {
namespace {

Context* g_context = nullptr;  // of the signal handler

// A second signal ends the program at once, should it not come back to ask.
void on_signal(int number) {
  g_context->stop.store(true);
  std::signal(number, SIG_DFL);
}

Status preview(const PreviewArguments& arguments, Context& context, std::chrono::steady_clock::time_point started) {
  context.threads = arguments.threads;
  context.seed = arguments.seed;
  context.warn = [](const Warning& warning) { fmt::print(stderr, "oriel-preview: {}\n", warning.text); };
  if (arguments.offscreen) return preview_offscreen(arguments, context, started);
  return preview_in_window(arguments, context, started);
}

int main_of_preview(int argc, char** argv) {
  const auto started = std::chrono::steady_clock::now();
  Context context;
  PreviewArguments arguments;
  const CommandLine line = preview_command_line(arguments, [&] { return preview(arguments, context, started); });
  const auto parsed = parse(line, argc, argv);
  if (const int* code = std::get_if<int>(&parsed)) return *code;
  g_context = &context;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  const Status status = std::get<const ToolCommand*>(parsed)->run();
  if (status) return 0;
  fmt::print(stderr, "oriel-preview: {}\n", status.error().text());
  return static_cast<int>(status.error().code);
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  try {
    return oriel::main_of_preview(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "oriel-preview: %s\n", error.what());
    return 4;
  }
}
