// Which extensions of glTF are read, and what leaving the others out means.
#pragma once

#include <string>

namespace oriel::gltf {

enum class Support {
  kFull,
  kByMaterial,   // left out, told of with the materials that have it; the scene is whole without it, required or not
  kWithout,      // left out; the scene is whole without it, required or not
  kOtherImages,  // left out where it may be, told of with the textures
  kNone          // left out where it may be
};

struct Extension {
  Support support = Support::kNone;
  const char* advice = "";  // what is missing, and what to do about it
};

Extension extension_named(const std::string& name);

}  // namespace oriel::gltf
