#include "bake/import/node_names.h"

namespace oriel::gltf {

NodeNames::NodeNames(const Document& document) : document_(document), parent_(document.nodes.size(), -1) {
  for (std::size_t n = 0; n < document.nodes.size(); ++n)
    for (const std::uint32_t child : document.nodes[n].children) parent_[child] = static_cast<std::int64_t>(n);
}

std::string NodeNames::path(std::uint32_t node) const {
  constexpr int kMostSteps = 32;
  std::string path;
  int steps = 0;
  for (std::int64_t at = node; at >= 0; at = parent_[static_cast<std::size_t>(at)]) {
    if (++steps > kMostSteps) return "…/" + path;
    const std::string& name = document_.nodes[static_cast<std::size_t>(at)].name;
    const std::string step = name.empty() ? fmt::format("nodes[{}]", at) : name;
    path = path.empty() ? step : step + "/" + path;
  }
  return path;
}

const std::string& NodeNames::light_group(std::uint32_t node) const {
  static const std::string none;
  for (std::int64_t at = node; at >= 0; at = parent_[static_cast<std::size_t>(at)])
    if (const std::string& name = document_.nodes[static_cast<std::size_t>(at)].light_group; !name.empty()) return name;
  return none;
}

}  // namespace oriel::gltf
