// Where a chart has a surface within its page's texels. Private to tile_lister.h.
#pragma once

#include <algorithm>

#include "bake/radiosity/texels/lightmap_scene.h"
#include "formats/core/convex_hull.h"

namespace oriel {

struct ChartSurface {
  const Atlas& atlas;
  const TexelMapPage& page;
  std::span<const std::uint32_t> charts;  // by the page's texels
  std::uint32_t chart = 0;

  bool is_of_texel(std::uint32_t x, std::uint32_t y) const {
    return x < page.width && y < page.height && charts[std::size_t{y} * page.width + x] == chart;
  }

  // Whether a part of it is in a square within a texel, or as close to that; side 0: at a place.
  bool meets(const DVec2& lower, double side, double close) const {
    const UVec2 at(glm::max(lower, DVec2(0)));
    if (glm::min(lower.x, lower.y) < 0 || !is_of_texel(at.x, at.y)) return false;
    const DVec2 from = lower - close, to = lower + side + close;
    const auto i = std::ranges::lower_bound(page.texel, at.y * page.width + at.x) - page.texel.begin();
    for (std::uint32_t f = page.first[i]; f < page.first[i + 1]; ++f) {
      const auto t = texel_triangle(atlas, page.fragments[f].triangle);
      const DVec2 least = glm::min(t[0], glm::min(t[1], t[2])), most = glm::max(t[0], glm::max(t[1], t[2]));
      bool apart = most.x < from.x || most.y < from.y || least.x > to.x || least.y > to.y;
      const double turn = cross2(t[1] - t[0], t[2] - t[0]) < 0 ? -1 : 1;
      for (std::size_t k = 0; k < 3 && !apart; ++k) {
        const DVec2 along = turn * (t[(k + 1) % 3] - t[k]);
        apart = cross2(along, DVec2(along.y < 0 ? to.x : from.x, along.x < 0 ? from.y : to.y) - t[k]) < 0;
      }
      if (!apart) return true;
    }
    return false;
  }
};

}  // namespace oriel
