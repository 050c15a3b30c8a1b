#include "formats/analysis/leaves.h"

#include <nlohmann/json.hpp>

namespace oriel {
namespace {

// Leaves of a JSON object by their path.
void flatten(const nlohmann::json& json, const std::string& path, std::map<std::string, std::string>& leaves) {
  if (!json.is_object()) {
    leaves[path] = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return;
  }
  for (const auto& [key, value] : json.items()) flatten(value, path.empty() ? key : path + "." + key, leaves);
}

}  // namespace

std::map<std::string, std::string> leaves_of(const std::string& text) {
  std::map<std::string, std::string> leaves;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_discarded()) flatten(json, "", leaves);
  return leaves;
}

}  // namespace oriel
