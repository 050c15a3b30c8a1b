#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "bake/cli/commands.h"

namespace oriel {
namespace {

constexpr const char* kPreviewFooter =
    R"(Starts oriel-preview, which lies beside this program, with whatever follows: oriel-preview --help tells of it.)";

}  // namespace

Status start_preview(std::vector<std::string> words) {
  std::error_code ec;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", ec);
  if (ec) return fail(ErrorCode::kRuntime, "/proc/self/exe", "cannot be read: {}", ec.message());
  words.insert(words.begin(), (self.parent_path() / "oriel-preview").string());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(arguments.front(), arguments.data());
  return fail(ErrorCode::kRuntime, words.front(), "cannot be started: {}", std::strerror(errno));
}

ToolCommand preview_command(BakeSession&) {
  const auto scene = std::make_shared<std::filesystem::path>();
  ToolCommand out{.name = "preview",
                  .help = "Opens a window on the scene at once, before any bake",
                  .footer = kPreviewFooter,
                  .options = {scene_argument(*scene)}};
  out.run = [scene] { return start_preview({scene->string()}); };
  return out;
}

}  // namespace oriel
