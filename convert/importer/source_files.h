// The files that a scene's file names: beside it, however they are written.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <map>
#include <set>
#include <vector>

namespace oriel {

// Finds files as their user would: as the scene's file says; else by their bare name, whatever the case of its letters,
// for the path may be that of another machine; in the scene's folder first, then below it. Of regular files alone.
class SourceFiles : public Assimp::DefaultIOSystem {
 public:
  // `scene` is also found as its own name with `extension`, by which readers are chosen.
  SourceFiles(std::filesystem::path scene, const std::string& extension);

  // Empty: there is none.
  std::filesystem::path find(const std::string& name) const;
  // What readers open as the scene.
  std::string scene_name() const { return alias_.string(); }

  bool Exists(const char* name) const override { return !find(name).empty(); }
  std::string name() const { return scene_.filename().string(); }
  // What else was read: materials, textures.
  const std::set<std::filesystem::path>& read() const { return read_; }
  void note_read(const std::filesystem::path& file) const { read_.insert(file.lexically_normal()); }
  // What is read in place of the scene.
  void replace_scene(std::string text) { text_ = std::move(text); }

  Assimp::IOStream* Open(const char* name, const char* mode = "rb") override;

 private:
  std::filesystem::path scene_, alias_;
  std::string text_;
  mutable std::set<std::filesystem::path> read_;
  std::multimap<std::string, std::filesystem::path> around_;  // in lower case; those near the scene first
};

}  // namespace oriel
