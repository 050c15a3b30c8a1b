// Textures as images of the glTF.
#pragma once

#include <assimp/scene.h>

#include <functional>
#include <optional>
#include <string>

#include "convert/importer/source_files.h"
#include "formats/core/glb.h"
#include "formats/image/image.h"

namespace oriel {

// What is to be read: the scene as assimp has it, and what that does not tell.
struct SourceScene {
  const aiScene& scene;
  const SourceFiles& files;
  std::string extension;  // of the format: "fbx"
  bool by_blender = false;
  double unit_m = 1;  // of what assimp takes for its unit
  std::function<void(const std::string&)> warn;
};

class Textures {
 public:
  Textures(const SourceScene& source, Glb& glb) : source_(source), glb_(glb) {}

  // A texture reference of a material, {"index": …}: its image is found, read, and added once. Null where there is no
  // such texture, or it cannot be read, of which a warning tells.
  Json reference(const aiMaterial& material, aiTextureType type);
  // The same with the grey (or alpha) of another as its alpha; sets `cut_out` where that is nearly all on or off.
  Json with_alpha(const aiMaterial& material, aiTextureType color, aiTextureType alpha, bool& cut_out);
  // Whether a picture is a normal map: of tangent space, where blue is the most.
  bool is_normal_map(const aiMaterial& material, aiTextureType type);

 private:
  struct Picture {
    std::string name;
    std::filesystem::path path;  // empty: it lies in the scene's file
    Bytes bytes;                 // as it is stored; empty: as pixels
    ByteImage pixels;            // RGBA; empty until asked for
  };

  // Of a path in the scene's file; nullptr where it cannot be found.
  Picture* picture(const aiMaterial& material, aiTextureType type);
  const ByteImage* pixels(Picture& picture);
  Json add(const std::string& key, Picture& picture, const aiMaterial& material, aiTextureType type);

  const SourceScene& source_;
  Glb& glb_;
  std::map<std::string, std::optional<Picture>> pictures_;
  std::map<std::string, std::size_t> images_;
};

}  // namespace oriel
