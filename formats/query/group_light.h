// Light of lamps that were switched, dimmed or coloured.
#pragma once

#include <span>

#include "formats/assets/light_group.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// What a page's light is made of, but for sharp light. light: by group and page, as many pages of each group, whose sum
// is the page's.
PageGroups groups_of_page(const LightmapPage& page, std::uint32_t number,
                          std::span<const std::vector<LightmapPage>> light);

// By group, how many times the light that was baked its lamps shine; R, G, B.
using GroupFactors = std::span<const Vec3>;

// Texels `first` to `first` + whole.size() of a page, or of its details (rest and codes being theirs): the light that
// was baked becomes that of the groups times their factors. Factors of 1 leave it to the bit. Not negative.
void relight(const PageGroups& page, bool details, GroupFactors factors, std::size_t first, std::span<Vec3> whole);

}  // namespace oriel
