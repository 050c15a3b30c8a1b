// Sharp light where light is known by texel: in maps, and of lamps that move.
#pragma once

#include <span>

#include "formats/assets/lightmap.h"
#include "formats/assets/sharp_light.h"
#include "formats/query/page_points.h"

namespace oriel {

// What lamps bring that shine so many times, by light group, as they were baked, lux; by point. Empty: the page has no
// such light.
std::vector<Vec3> sharp_at_points(const SharpLight& light, const LightmapPage& page, std::span<const PagePoint> points,
                                  std::span<const Vec3> factors);
// The same by texel of page `number`: LightmapPage::sharp, changed as the light at a texel's centre is, and as the
// page's on the whole where none comes there.
std::vector<Vec3> sharp_texels(const SharpLight& light, const Mesh& mesh, std::uint32_t number,
                               const LightmapPage& page, std::span<const Vec3> factors);

}  // namespace oriel
