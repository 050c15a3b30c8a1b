#include "player/session/scene_name.h"

#include <filesystem>

#include "formats/core/json.h"

namespace oriel {

std::string scene_name(const Pack& pack, const std::string& file) {
  const Json provenance = Json::parse(pack.provenance).value_or(Json());  // a pack's text may be anything
  std::string name;
  const Json& scene = provenance["inputs"][0]["name"];
  if (scene.is_string()) name = std::filesystem::path(scene.get<std::string>()).stem().string();
  return name.empty() ? std::filesystem::path(file).stem().string() : name;
}

}  // namespace oriel
