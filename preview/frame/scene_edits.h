// What a panel changes of a scene's lamps and materials, and the file that says the same.
#pragma once

#include <map>
#include <span>

#include "formats/core/bytes.h"
#include "preview/frame/preview_scene.h"

namespace oriel {

struct MaterialEdit {
  Vec3 base_color{1};  // linear, [0,1]
  float roughness = 1;
  Vec3 emission{0};  // cd/m²
};

struct LightEdit {
  Vec3 color{1};        // linear
  float intensity = 0;  // cd, or lux of a directional one
  Vec3 place{0};        // scene space; of directional ones it tells nothing
  Vec3 moved{0};        // to there, from where the file has it: world metres
};

struct SceneEdits {
  std::map<std::uint32_t, MaterialEdit> materials;  // into the file's
  std::map<std::string, LightEdit> lights;          // by Scene::lights' name: that of the node, or else the light's
  bool empty() const { return materials.empty() && lights.empty(); }
};

// Whether no other light has that name: else edits of it are edits of all, and nobody can say which is moved.
bool is_alone(const Scene& scene, const std::string& light);

// What a scene has now, to begin with.
MaterialEdit edit_of(const SceneMaterial& material);
LightEdit edit_of(const Light& light);
// All of it: what undoes edits.
SceneEdits edits_of(const Scene& scene);

// Sets them, and the lamps that follow from them. Rays and all geometry stay. Nobody else may read the
// scene meanwhile.
void edit_scene(PreviewScene& scene, const SceneEdits& edits);

// Of a file that was saved anew: lights that were moved stay where they are, from where it has them now; others go
// where it has them. shift: of scene space, from the scene before.
void follow_places(const SceneEdits& originals, const Vec3& shift, SceneEdits& edits);

// A .glb or .gltf with these edits: its JSON alone differs. A light that several nodes share changes with each of them,
// but for its place, which is the node's. Error kInvalid where it is no such file, or has not what was edited, or a
// node whose parents have no size and so cannot be moved.
Result<Bytes> edited_file(std::span<const std::byte> file, const std::string& name, const SceneEdits& edits);

}  // namespace oriel
