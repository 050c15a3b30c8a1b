// What is told of a node by those above it.
#pragma once

#include <string>
#include <vector>

#include "bake/import/document.h"

namespace oriel::gltf {

// Keeps a reference to the document, whose nodes stay as they are.
class NodeNames {
 public:
  explicit NodeNames(const Document& document);

  // Names from a root down; of what is deeper the last steps: files may have chains of thousands.
  std::string path(std::uint32_t node) const;
  // Its extras.oriel.light_group, or that of the nearest above it; empty: none.
  const std::string& light_group(std::uint32_t node) const;

 private:
  const Document& document_;
  std::vector<std::int64_t> parent_;  // by node; -1: a root
};

}  // namespace oriel::gltf
