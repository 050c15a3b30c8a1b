#include "preview/baking.h"

#include "formats/core/file.h"
#include "formats/core/process.h"

namespace oriel {

Result<std::filesystem::path> save_copy(const std::filesystem::path& scene, const SceneEdits& edits) {
  ORIEL_TRY(const Bytes file, read_file(scene));
  ORIEL_TRY(const Bytes edited, edited_file(file, scene.filename().string(), edits));
  auto copy = scene;
  copy.replace_filename(scene.stem().string() + "-edited" + scene.extension().string());
  ORIEL_TRY_VOID(write_file_atomically(copy, edited));
  return copy;
}

Status begin_bake(const PreviewArguments& a, const SceneEdits& edits, BackgroundBake& bake) {
  ORIEL_TRY(const std::filesystem::path baker, program_beside("oriel-bake"));
  std::filesystem::path scene = a.scene.file;
  if (!edits.empty()) {
    ORIEL_TRY(scene, save_copy(scene, edits));
  }
  std::vector<std::string> words{baker.string(), scene.string(), "-o", a.pack.string(), "--json-log"};
  words.insert(words.end(), a.bake_options.begin(), a.bake_options.end());
  return bake.start(std::move(words));
}

Status show_pack(const std::filesystem::path& pack, const Camera& eye) {
  ORIEL_TRY(const std::filesystem::path player, program_beside("oriel-play"));
  const Vec3 target = eye.eye + eye.forward;
  return become_program(
      {player.string(), pack.string(), "--camera",
       fmt::format("{},{},{},{},{},{}", eye.eye.x, eye.eye.y, eye.eye.z, target.x, target.y, target.z)});
}

}  // namespace oriel
