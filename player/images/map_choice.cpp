#include "player/images/map_choice.h"

#include <algorithm>
#include <map>

namespace oriel {
namespace {

constexpr double kLeastCost = 1e-3;  // radians: as good as the eye's own image

// Pixels of a map per radian, seen straight.
double resolution(const RadianceMap& map) {
  return -map.eye.z *
         std::max(map.width / (double{map.upper.x} - map.lower.x), map.height / (double{map.upper.y} - map.lower.y));
}

double angle_between(const DVec3& a, const DVec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct Ranked {
  double cost;
  std::uint32_t map;
  auto operator<=>(const Ranked&) const = default;
};

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

std::vector<WeighedMap> weigh_maps(const ReflectorElement& element, std::span<const RadianceMap> maps,
                                   const Vec4& mirrored_eye, int count) {
  const DVec3 center(0.5 * (DVec2(element.lower) + DVec2(element.upper)), 0.0);
  const DVec3 eye(mirrored_eye);
  const DVec3 towards = mirrored_eye.w > 0 ? eye - center : eye;
  std::vector<Ranked> ranked;
  double finest = 0;
  for (std::uint32_t i = 0; i < element.maps.size(); ++i) {
    const RadianceMap& map = maps[element.maps[i]];
    ranked.push_back({angle_between(DVec3(map.eye) - center, towards), i});
    finest = std::max(finest, resolution(map));
  }
  std::sort(ranked.begin(), ranked.end());
  const std::size_t weighed = std::min(static_cast<std::size_t>(std::max(count, 0)), ranked.size());
  double end = 0;  // the cost at which weights are 0
  if (weighed > 0) end = weighed < ranked.size() ? ranked[weighed].cost : 2 * ranked[weighed - 1].cost;
  end = std::max(end, 2 * kLeastCost);
  std::vector<WeighedMap> out;
  double sum = 0;
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    double weight = 0;
    if (i < weighed) {
      const double near = std::max(1 - ranked[i].cost / end, 0.0) / std::max(ranked[i].cost, kLeastCost);
      weight = near * resolution(maps[element.maps[ranked[i].map]]) / std::max(finest, 1e-30);
    }
    sum += weight;
    out.push_back({ranked[i].map, static_cast<float>(weight)});
  }
  if (weighed > 0 && !(sum > 0)) {  // the first ones cost the same as the next
    for (std::size_t i = 0; i < weighed; ++i) out[i].weight = 1;
    sum = static_cast<double>(weighed);
  }
  for (WeighedMap& map : out) map.weight = sum > 0 ? static_cast<float>(map.weight / sum) : 0.0f;
  return out;
}

}  // namespace oriel
