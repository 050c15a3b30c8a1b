// What is told of a node by those above it.
#pragma once

#include <span>
#include <string>

#include "bake/import/document.h"

namespace oriel::gltf {

// Names from a root down; of what is deeper the last steps: files may have chains of thousands.
std::string path_of(const Document& document, std::uint32_t node);

// Sets the rules' keys in the scene of these roots, over what the file says, then hands all keys down to the nodes
// below. Error kUsage for a rule that no node fits.
Status hand_down_keys(std::span<const ObjectRule> rules, std::span<const std::uint32_t> roots, Document& document);

}  // namespace oriel::gltf
