// A scene file as the preview needs it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "bake/import/import.h"
#include "bake/trace/emission.h"
#include "bake/trace/path.h"
#include "preview/frame/lamps.h"
#include "preview/frame/scene_parts.h"

namespace oriel {

// Its parts refer to each other: it stays where it is.
struct PreviewScene {
  ImportedScene imported;
  SceneParts parts;  // as it was read, whatever is edited since
  std::optional<Accel> accel;
  std::optional<LightSet> lights;
  std::optional<Sources> sources;
  Lamps lamps;
  double import_s = 0, rays_s = 0;  // that each part of loading took

  const Scene& scene() const { return imported.scene; }
  Transport transport() const { return {*accel, *lights, {}}; }
};

struct PreviewSceneOptions {
  std::filesystem::path file;
  ImportOptions import;
};

// Of a scene whose lamps or materials are new: what shines.
void find_lamps(PreviewScene& scene);

// The rest of a scene that is read. last: the one before, whose rays are taken where its shape is the same; null: none.
// Errors: as Accel::build(), kStopped.
Result<std::shared_ptr<const PreviewScene>> prepare_preview_scene(ImportedScene imported, Context& context,
                                                                  const PreviewScene* last = nullptr);

// Errors also: as import_gltf().
Result<std::shared_ptr<const PreviewScene>> load_preview_scene(const PreviewSceneOptions& options, Context& context,
                                                               const PreviewScene* last = nullptr);

}  // namespace oriel
