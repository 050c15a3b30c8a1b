#include "bake/radiosity/estimators/points.h"

#include <algorithm>

namespace oriel {

Result<DetailPoints> list_points(const Atlas& atlas, const CellLevels& levels, std::uint8_t level, Context& context) {
  DetailPoints points;
  points.side = 1u << level;
  points.atlas = atlas;
  const auto side = static_cast<double>(points.side);
  WantedTexels wanted(atlas.pages.size());
  for (std::size_t p = 0; p < atlas.pages.size(); ++p) {
    const AtlasPage& page = atlas.pages[p];
    AtlasPage& fine = points.atlas.pages[p];
    fine.width = (page.width + 2) * points.side, fine.height = (page.height + 2) * points.side;
    if (std::ranges::find(levels[p], level) == levels[p].end()) continue;
    wanted[p].resize(std::size_t{fine.width} * fine.height);
    for (std::uint32_t place = 0; place < levels[p].size(); ++place) {
      if (levels[p][place] != level) continue;
      const std::uint32_t x = DetailPoints::fine(place % page.width, 0, points.side);
      const std::uint32_t y = DetailPoints::fine(place / page.width, 0, points.side);
      for (std::uint32_t j = 0; j <= points.side; ++j)
        for (std::uint32_t i = 0; i <= points.side; ++i) wanted[p][std::size_t{y + j} * fine.width + x + i] = true;
    }
  }
  for (std::size_t t = 0; t < atlas.page.size(); ++t) {
    if (atlas.page[t] < 0) continue;
    const auto p = static_cast<std::size_t>(atlas.page[t]);
    if (wanted[p].empty()) {
      points.atlas.page[t] = -1;
      continue;
    }
    const DVec2 size(atlas.pages[p].width, atlas.pages[p].height);
    const DVec2 fine(points.atlas.pages[p].width, points.atlas.pages[p].height);
    for (Vec2& uv : points.atlas.uv[t]) uv = Vec2(((DVec2(uv) * size + 0.5) * side + 0.5) / fine);
  }
  ORIEL_TRY(points.map, build_texel_map(points.atlas, context, wanted));
  return points;
}

}  // namespace oriel
