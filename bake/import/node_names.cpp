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

Status hand_down_keys(std::span<const ObjectRule> rules, std::span<const std::uint32_t> roots, Document& document) {
  std::vector<std::uint32_t> nodes(roots.begin(), roots.end());  // of the scene, parents first
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::uint32_t child : document.nodes[nodes[i]].children) nodes.push_back(child);
  std::vector<std::string> names, paths;
  for (const std::uint32_t n : nodes) names.push_back(document.nodes[n].name);
  if (!rules.empty())
    for (const std::uint32_t n : nodes) paths.push_back(path_of(document, n));
  for (const ObjectRule& rule : rules) {
    bool found = false;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!fits_pattern(rule.nodes, names[i]) && !fits_pattern(rule.nodes, paths[i])) continue;
      found = true;
      for (const auto& [key, value] : rule.keys)
        ORIEL_TRY_VOID(set_object_key(key, value, document.nodes[nodes[i]].keys));
    }
    if (!found)
      return fail(ErrorCode::kUsage, "--object", "found the node \"{}\", expected one of the scene's: {}", rule.nodes,
                  names_like(rule.nodes, names));
  }
  for (const std::uint32_t n : nodes)
    for (const std::uint32_t child : document.nodes[n].children)
      document.nodes[child].keys.inherit(document.nodes[n].keys);
  return {};
}

}  // namespace oriel::gltf
