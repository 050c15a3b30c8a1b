// Materials that differ by object.
#pragma once

#include <map>
#include <tuple>

#include "bake/import/object_keys.h"
#include "bake/scene/scene.h"

namespace oriel {

// Materials as nodes want them (ObjectKeys): copies of their own, shared between nodes that ask for the same.
class MaterialVariants {
 public:
  explicit MaterialVariants(Scene& scene) : scene_(scene) {}

  std::uint32_t of(std::uint32_t material, const ObjectKeys& keys) {
    const SceneMaterial& from = scene_.materials[material];
    const Metal metal = keys.metal == Metal::kNone ? from.metal : keys.metal;
    const bool two_sided = keys.two_sided.value_or(from.double_sided),
               reflections = keys.reflections.value_or(from.reflections);
    if (metal == from.metal && two_sided == from.double_sided && reflections == from.reflections) return material;
    const auto [found, is_new] =
        copies_.try_emplace({material, metal, two_sided, reflections}, scene_.materials.size());
    if (!is_new) return found->second;
    SceneMaterial copy = from;
    if (metal != from.metal) copy.name += fmt::format(" ({})", constants_of(metal).name);
    copy.metal = metal, copy.double_sided = two_sided, copy.reflections = reflections;
    scene_.materials.push_back(std::move(copy));
    return found->second;
  }

 private:
  Scene& scene_;
  std::map<std::tuple<std::uint32_t, Metal, bool, bool>, std::uint32_t> copies_;
};

}  // namespace oriel
