#include "player/images/map_choice.h"

#include <algorithm>
#include <map>

namespace oriel {
namespace {

double angle_between(const DVec3& a, const DVec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

std::vector<ReflectorElement> group_by_element(const Reflector& reflector, std::span<const RadianceMap> maps) {
  std::vector<ReflectorElement> elements;
  std::map<std::uint32_t, std::size_t> by_number;
  for (std::uint32_t i = 0; i < reflector.map_count; ++i) {
    const std::uint32_t index = reflector.first_map + i;
    const RadianceMap& map = maps[index];
    const auto [element, is_new] = by_number.try_emplace(map.element, elements.size());
    if (is_new) elements.push_back({map.lower, map.upper, {}});
    elements[element->second].maps.push_back(index);
  }
  return elements;
}

std::vector<std::uint32_t> maps_by_angle(const ReflectorElement& element, std::span<const RadianceMap> maps,
                                         const Vec4& mirrored_eye) {
  const DVec3 center(0.5 * (DVec2(element.lower) + DVec2(element.upper)), 0.0);
  const DVec3 eye(mirrored_eye);
  const DVec3 towards = mirrored_eye.w > 0 ? eye - center : eye;
  std::vector<std::pair<double, std::uint32_t>> ranked;
  for (std::uint32_t i = 0; i < element.maps.size(); ++i)
    ranked.emplace_back(angle_between(DVec3(maps[element.maps[i]].eye) - center, towards), i);
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::uint32_t> out;
  for (const auto& [angle, map] : ranked) out.push_back(map);
  return out;
}

}  // namespace oriel
