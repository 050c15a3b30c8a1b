#include "formats/analysis/leaves.h"

#include "formats/core/json.h"

namespace oriel {
namespace {

// Leaves of a JSON object by their path.
void flatten(const Json& json, const std::string& path, std::map<std::string, std::string>& leaves) {
  if (!json.is_object()) {
    leaves[path] = json.sorted().dump();
    return;
  }
  for (const auto& [key, value] : json.items()) flatten(value, path.empty() ? key : path + "." + key, leaves);
}

}  // namespace

std::map<std::string, std::string> leaves_of(const std::string& text) {
  std::map<std::string, std::string> leaves;
  if (const auto json = Json::parse(text)) flatten(*json, "", leaves);
  return leaves;
}

}  // namespace oriel
