// The light of groups of lamps on the lightmap's pages.
#pragma once

#include <vector>

#include "bake/radiosity/texels/booked.h"
#include "bake/radiosity/texels/texels.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// What visible texels have of each group goes to its pages. pages: by group and page.
void write_booked(const Texels& texels, const BookedLight& booked, std::vector<std::vector<LightmapPage>>& pages);

// Makes the groups' light sum to that of the whole page, texel by texel and point by point (share_out).
void share_out_page(const LightmapPage& whole, std::size_t page, std::vector<std::vector<LightmapPage>>& groups);

}  // namespace oriel
