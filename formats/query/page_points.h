// Where on surfaces the light of a lightmap page lies.
#pragma once

#include <span>
#include <vector>

#include "formats/assets/bilinear.h"
#include "formats/assets/lightmap.h"
#include "formats/assets/mesh.h"

namespace oriel {

// A texel's centre, or a point of a finer cell; beside its chart: what of the chart is nearest.
struct PagePoint {
  std::uint32_t index = 0;                  // into LightmapPage::irradiance, or from its size on into detail
  Vec2 at{0};                               // in texels, (0, 0) being the centre of the first
  Vec3 position{0}, normal{0, 1, 0};        // normal: unit, of the front
  std::uint32_t part = 0, first_index = 0;  // of the mesh: the triangle that it is on
  Vec2 shares{0};                           // of its second and third corner there
};

// Of page `number`: its valid texels, and all points of finer cells, in the order of their index. Parts in `without`
// have none.
std::vector<PagePoint> page_points(const Mesh& mesh, std::span<const std::uint32_t> without, std::uint32_t number,
                                   const LightmapPage& page);

// The shares of the point's triangle at a place of the page beside it, by lightmap coordinates; those of the point
// where the triangle does not reach.
Vec2 shares_beside(const Mesh& mesh, const PagePoint& point, const Vec2& offset);

// The four texels around a point's place on its page.
TexelsAround texels_around(const LightmapPage& page, const PagePoint& point);

// Texels that surfaces do not need (filled from neighbours, buried) take the mean of those neighbours that have a
// value, round by round. known: by texel, which it changes.
void fill_from_neighbours(const LightmapPage& page, std::vector<std::uint8_t>& known, std::span<Vec3> values);

}  // namespace oriel
