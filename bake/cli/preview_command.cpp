#include <memory>

#include "bake/cli/commands.h"
#include "formats/core/process.h"

namespace oriel {
namespace {

constexpr const char* kPreviewFooter =
    R"(Starts oriel-preview, which lies beside this program, with whatever follows: oriel-preview --help tells of it.)";

}  // namespace

Status start_preview(std::vector<std::string> words) {
  ORIEL_TRY(const std::filesystem::path preview, program_beside("oriel-preview"));
  words.insert(words.begin(), preview.string());
  return become_program(std::move(words));
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
