// Where the images of a pack are seen.
#pragma once

#include <algorithm>
#include <functional>
#include <span>

#include "formats/pack/pack.h"
#include "player/images/scene_images.h"
#include "player/scene/gpu_mesh.h"

namespace oriel {

// The element of a list by rising material, or null.
template <class Element>
const Element* of_material(const std::vector<Element>& list, std::uint32_t material) {
  const auto found = std::ranges::lower_bound(list, material, {}, &Element::material);
  return found != list.end() && found->material == material ? &*found : nullptr;
}

// Adds those of ranges' materials and lightmaps. placed: where the bounds of a range may be.
void add_uses(const Pack& pack, std::span<const DrawRange> ranges, const std::function<Bounds(const Bounds&)>& placed,
              std::vector<ImageUse>& uses);

}  // namespace oriel
