#include "player/session/scene_name.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace oriel {

std::string scene_name(const Pack& pack, const std::string& file) {
  using Json = nlohmann::json;
  const Json provenance = Json::parse(pack.provenance, nullptr, false);  // a pack's text may be anything
  std::string name;
  if (provenance.is_object() && provenance.contains("inputs") && provenance["inputs"].is_array() &&
      !provenance["inputs"].empty()) {
    const Json& scene = provenance["inputs"][0];
    if (scene.is_object() && scene.contains("name") && scene["name"].is_string())
      name = std::filesystem::path(scene["name"].get<std::string>()).stem().string();
  }
  return name.empty() ? std::filesystem::path(file).stem().string() : name;
}

}  // namespace oriel
