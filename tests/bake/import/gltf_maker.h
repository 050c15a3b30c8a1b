// Tiny glTF files made in memory, written to a temporary folder and imported.
#pragma once

#include <string>
#include <vector>

#include "bake/import/import.h"
#include "formats/core/json.h"

namespace oriel::test {

using json = Json;

// A folder that is gone when this is.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  std::filesystem::path write(const std::string& name, const std::string& bytes) const;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string base64(const std::string& bytes);

// A document with one embedded buffer that grows.
struct Gltf {
  json doc = {{"asset", {{"version", "2.0"}}}};
  std::string buffer;

  // Append data and return the index of a new accessor (or view).
  int view(const std::string& bytes);
  int accessor(const std::string& bytes, int component_type, const std::string& type, std::size_t count,
               bool normalized = false);
  int floats(const std::string& type, const std::vector<float>& values);
  int indices(const std::vector<std::uint16_t>& values);

  // Appends a mesh with one primitive, and a node for it in scene 0. Returns the node.
  json& add(const json& primitive);
  // A triangle (0,0,0) (1,0,0) (0,1,0), its front towards +Z. Returns the node.
  json& add_triangle();
  json& material();  // appends one
  void use(const char* extension, bool require = false);

  std::string text() const;  // .gltf with a data URI
  std::string glb() const;
};

Gltf triangle();

// Appends a channel to the first animation. path: "translation", "rotation" or "scale".
void animate(Gltf& g, int node, const char* path, const std::vector<float>& times, const std::vector<float>& values,
             const char* interpolation);

// An import and what it warned of.
struct Imported {
  Result<ImportedScene> result;
  std::vector<std::string> warnings;
  bool ok() const { return result.has_value(); }
  const Scene& scene() const { return result->scene; }
  std::string error() const { return result ? "" : result.error().text(); }
  // Whether a warning holds the text.
  bool warned(const std::string& text) const;
};
Imported import_file(const std::filesystem::path& path, const ImportOptions& options = {});
Imported import_bytes(const std::string& bytes, const ImportOptions& options = {});
Imported import(const Gltf& gltf, const ImportOptions& options = {});

// Every promise of scene.h that a later stage relies on; an empty string, or what is broken first.
std::string broken_promise(const Scene& scene);

}  // namespace oriel::test
