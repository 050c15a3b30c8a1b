#include "preview/frame/elements.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kPlaces = 32;       // of an element, that rays go to
constexpr std::uint32_t kMostCells = 64;  // along the scene's diameter

// Of six, the axis that the normal is nearest to.
std::uint32_t axis_of(const Vec3& n) {
  const Vec3 a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return 2 * static_cast<std::uint32_t>(axis) + (n[axis] < 0 ? 1 : 0);
}

// By landing, which group it is of: those with one normal's axis and one cell of a grid of so many along the scene.
std::vector<std::uint32_t> groups_of(std::span<const Landing> landings, const Scene& scene, std::uint32_t cells) {
  const float cell = std::max(2 * scene.radius() / static_cast<float>(cells) * 1.0001f, 1e-20f);
  std::vector<std::uint32_t> groups;
  groups.reserve(landings.size());
  for (const Landing& l : landings) {
    const UVec3 at = glm::min(UVec3(glm::max((l.place - scene.lower) / cell, Vec3(0))), UVec3(cells - 1));
    groups.push_back(((axis_of(l.normal) * cells + at.x) * cells + at.y) * cells + at.z);
  }
  return groups;
}

std::size_t count_of(std::span<const std::uint32_t> groups, std::uint32_t cells) {
  std::vector<bool> there(std::size_t{6} * cells * cells * cells);
  std::size_t count = 0;
  for (const std::uint32_t group : groups)
    if (!there[group]) there[group] = true, ++count;
  return count;
}

BounceElement element_of(std::span<const Landing> members) {
  DVec3 place(0), normal(0), power(0);
  double weight = 0, spread = 0;
  for (const Landing& l : members) {
    const double w = luminance(DVec3(l.power)) + 1e-300;
    place += w * DVec3(l.place);
    normal += w * DVec3(l.normal);
    power += DVec3(l.power);
    weight += w;
  }
  place /= weight;
  for (const Landing& l : members) {
    const DVec3 off = DVec3(l.place) - place;
    spread += (luminance(DVec3(l.power)) + 1e-300) * glm::dot(off, off);
  }
  // Of an even disk: mean square distance from its middle is half its radius' square.
  BounceElement out{Vec3(place),
                    normalize_or(Vec3(normal), members.front().normal),
                    static_cast<float>(2 * kPiD * spread / weight),
                    Vec3(power),
                    {}};
  for (std::size_t i = 0; i < std::min(members.size(), kPlaces); ++i) {
    const Landing& l = members[i * members.size() / std::min(members.size(), kPlaces)];
    out.places.push_back(offset_origin(l.place, l.normal, l.magnitude));
  }
  return out;
}

}  // namespace

std::vector<BounceElement> some_of(std::span<const BounceElement> elements, std::size_t count, float u) {
  std::vector<BounceElement> some;
  double total = 0, run = 0;
  for (const BounceElement& e : elements) total += double{luminance(e.power)};
  const double step = total / static_cast<double>(count);
  for (const BounceElement& e : elements) {
    const double power = double{luminance(e.power)}, from = run / step - double{u},
                 to = (run += power) / step - double{u};
    const double times = std::ceil(to) - std::ceil(from);  // whole steps within it
    if (times <= 0 || some.size() == count) continue;
    some.push_back(e);
    some.back().power *= static_cast<float>(times * step / power);
  }
  return some;
}

std::vector<BounceElement> bounce_elements(std::span<const Landing> landings, const Scene& scene, std::uint32_t count) {
  std::vector<BounceElement> elements;
  if (count == 0) return elements;
  std::vector<std::uint32_t> groups = groups_of(landings, scene, 1);
  for (std::uint32_t cells = 2; cells <= kMostCells; ++cells) {
    std::vector<std::uint32_t> finer = groups_of(landings, scene, cells);
    if (count_of(finer, cells) > count) break;
    groups = std::move(finer);
  }
  std::vector<std::uint32_t> order(landings.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return groups[i] < groups[j]; });
  std::vector<Landing> members;
  for (std::size_t i = 0; i < order.size(); ++i) {
    members.push_back(landings[order[i]]);
    if (i + 1 < order.size() && groups[order[i + 1]] == groups[order[i]]) continue;
    elements.push_back(element_of(members));
    members.clear();
  }
  std::stable_sort(elements.begin(), elements.end(), [](const BounceElement& x, const BounceElement& y) {
    return luminance(x.power) > luminance(y.power);
  });
  if (elements.size() > count) elements.resize(count);  // fewer than the axes that normals have
  return elements;
}

}  // namespace oriel
