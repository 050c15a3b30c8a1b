#include "preview/baking.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "formats/core/file.h"

namespace oriel {
namespace {

Result<std::string> program(const char* name) {
  std::error_code ec;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", ec);
  if (ec) return fail(ErrorCode::kRuntime, "/proc/self/exe", "cannot be read: {}", ec.message());
  return (self.parent_path() / name).string();
}

}  // namespace

Result<std::filesystem::path> save_copy(const std::filesystem::path& scene, const SceneEdits& edits) {
  ORIEL_TRY(const Bytes file, read_file(scene));
  ORIEL_TRY(const Bytes edited, edited_file(file, scene.filename().string(), edits));
  auto copy = scene;
  copy.replace_filename(scene.stem().string() + "-edited" + scene.extension().string());
  ORIEL_TRY_VOID(write_file_atomically(copy, edited));
  return copy;
}

Status begin_bake(const PreviewArguments& a, const SceneEdits& edits, BackgroundBake& bake) {
  ORIEL_TRY(const std::string baker, program("oriel-bake"));
  std::filesystem::path scene = a.scene.file;
  if (!edits.empty()) {
    ORIEL_TRY(scene, save_copy(scene, edits));
  }
  std::vector<std::string> words{baker, scene.string(), "-o", a.pack.string(), "--json-log"};
  words.insert(words.end(), a.bake_options.begin(), a.bake_options.end());
  return bake.start(std::move(words));
}

Status show_pack(const std::filesystem::path& pack, const Camera& eye) {
  ORIEL_TRY(const std::string player, program("oriel-play"));
  const Vec3 target = eye.eye + eye.forward;
  std::vector<std::string> words{
      player, pack.string(), "--camera",
      fmt::format("{},{},{},{},{},{}", eye.eye.x, eye.eye.y, eye.eye.z, target.x, target.y, target.z)};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  ::execv(arguments.front(), arguments.data());
  return fail(ErrorCode::kRuntime, words.front(), "cannot be started: {}", std::strerror(errno));
}

}  // namespace oriel
