#include "bake/import/node_names.h"

#include "formats/core/text.h"

namespace oriel::gltf {

std::string path_of(const Document& document, std::uint32_t node) {
  constexpr int kMostSteps = 32;
  std::string path;
  int steps = 0;
  for (std::int64_t at = node; at >= 0; at = document.nodes[static_cast<std::size_t>(at)].parent) {
    if (++steps > kMostSteps) return "…/" + path;
    const std::string& name = document.nodes[static_cast<std::size_t>(at)].name;
    const std::string step = name.empty() ? fmt::format("nodes[{}]", at) : name;
    path = path.empty() ? step : step + "/" + path;
  }
  return path;
}

Status hand_down_keys(std::span<const ObjectRule> rules, Document& document) {
  for (const ObjectRule& rule : rules) {
    bool found = false;
    std::vector<std::string> names;
    for (std::uint32_t n = 0; n < document.nodes.size(); ++n) {
      names.push_back(document.nodes[n].name);
      if (!fits_pattern(rule.nodes, names.back()) && !fits_pattern(rule.nodes, path_of(document, n))) continue;
      found = true;
      for (const auto& [key, value] : rule.keys) ORIEL_TRY_VOID(set_object_key(key, value, document.nodes[n].keys));
    }
    if (!found)
      return fail(ErrorCode::kUsage, "--object", "found the node \"{}\", expected one of the scene's: {}", rule.nodes,
                  names_like(rule.nodes, names));
  }
  std::vector<std::uint32_t> waiting;
  for (std::uint32_t n = 0; n < document.nodes.size(); ++n)
    if (document.nodes[n].parent < 0) waiting.push_back(n);
  while (!waiting.empty()) {
    const NodeDesc& node = document.nodes[waiting.back()];
    waiting.pop_back();
    for (const std::uint32_t child : node.children) {
      document.nodes[child].keys.inherit(node.keys);
      waiting.push_back(child);
    }
  }
  return {};
}

}  // namespace oriel::gltf
