#include "player/scene/map_point.h"

#include <algorithm>

namespace oriel {

std::vector<ReflectorElement> group_by_element(const Reflector& reflector, std::span<const RadianceMap> maps) {
  std::vector<ReflectorElement> elements;
  for (std::uint32_t i = 0; i < reflector.map_count; ++i) {
    const std::uint32_t index = reflector.first_map + i;
    const RadianceMap& map = maps[index];
    if (elements.empty() || elements.back().lower != map.lower || elements.back().upper != map.upper) {
      elements.push_back({map.lower, map.upper, {}});
    }
    elements.back().maps.push_back(index);
  }
  return elements;
}

std::vector<std::uint32_t> select_maps(const ReflectorElement& element, std::span<const RadianceMap> maps,
                                       const Vec4& mirrored_eye, int count, Selection selection) {
  const DVec3 center(0.5 * (DVec2(element.lower) + DVec2(element.upper)), 0.0);
  const DVec3 eye(mirrored_eye);
  const DVec3 towards = mirrored_eye.w > 0 ? eye - center : eye;
  std::vector<std::pair<double, std::uint32_t>> ranked;
  for (const std::uint32_t index : element.maps) {
    const DVec3 map_eye(maps[index].eye);
    double cost = glm::length(map_eye - eye);
    if (selection == Selection::kAngle || !(mirrored_eye.w > 0)) {
      const DVec3 a = map_eye - center;
      const double lengths = glm::length(a) * glm::length(towards);
      cost = lengths > 0 ? -glm::dot(a, towards) / lengths : 1.0;  // falls as the angle falls
    }
    ranked.emplace_back(cost, index);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::uint32_t> chosen;
  for (std::size_t i = 0; i < ranked.size() && i < static_cast<std::size_t>(std::max(count, 0)); ++i) {
    chosen.push_back(ranked[i].second);
  }
  return chosen;
}

}  // namespace oriel
