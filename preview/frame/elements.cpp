#include "preview/frame/elements.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "formats/core/color.h"
#include "preview/frame/landings.h"

namespace oriel {
namespace {

constexpr std::uint32_t kParticles = 64, kMostParticles = 8192;  // by element; of all
constexpr std::size_t kPlaces = 32;                              // of an element, that rays go to
constexpr int kMostCells = 64;                                   // along the scene's diameter

struct Landed {
  Vec3 place, normal, power;
  Vec3 origin;              // of rays to it
  std::uint32_t group = 0;  // of those that become one element
};

// Of six, the axis that the normal is nearest to.
int axis_of(const Vec3& n) {
  const Vec3 a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return 2 * axis + (n[axis] < 0 ? 1 : 0);
}

// Groups by place, on a grid of so many cells along the scene, and by normal. How many there are.
std::uint32_t group(std::vector<Landed>& landed, const Scene& scene, int cells) {
  const float cell = 2 * scene.radius() / static_cast<float>(cells) * 1.0001f;
  const auto key = [&](const Landed& l) {
    const glm::ivec3 at((l.place - scene.lower) / std::max(cell, 1e-20f));
    return std::tuple(axis_of(l.normal), at.x, at.y, at.z);
  };
  std::stable_sort(landed.begin(), landed.end(), [&](const Landed& x, const Landed& y) { return key(x) < key(y); });
  std::uint32_t groups = 0;
  for (std::size_t i = 0; i < landed.size(); ++i) {
    if (i == 0 || key(landed[i]) != key(landed[i - 1])) ++groups;
    landed[i].group = groups - 1;
  }
  return groups;
}

BounceElement element_of(std::span<const Landed> members) {
  DVec3 place(0), normal(0), power(0);
  double weight = 0, spread = 0;
  for (const Landed& l : members) {
    const double w = luminance(DVec3(l.power)) + 1e-300;
    place += w * DVec3(l.place);
    normal += w * DVec3(l.normal);
    power += DVec3(l.power);
    weight += w;
  }
  place /= weight;
  for (const Landed& l : members) {
    const DVec3 off = DVec3(l.place) - place;
    spread += (luminance(DVec3(l.power)) + 1e-300) * glm::dot(off, off);
  }
  // Of an even disk: mean square distance from its middle is half its radius' square.
  BounceElement out{Vec3(place),
                    normalize_or(Vec3(normal), members.front().normal),
                    static_cast<float>(2 * kPiD * spread / weight),
                    Vec3(power),
                    {}};
  for (std::size_t i = 0; i < std::min(members.size(), kPlaces); ++i)
    out.places.push_back(members[i * members.size() / std::min(members.size(), kPlaces)].origin);
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

std::vector<BounceElement> bounce_elements(const Transport& t, std::uint64_t seed, std::uint32_t count) {
  std::vector<BounceElement> elements;
  if (count == 0) return elements;
  std::vector<Landed> landed;
  for (const Landing& l : land_particles(t, seed, std::min(kParticles * count, kMostParticles)))
    landed.push_back({l.place, l.normal, l.power, offset_origin(l.place, l.normal, l.magnitude)});
  int cells = 1;
  for (int finer = 2; finer <= kMostCells && group(landed, t.accel.scene(), finer) <= count; ++finer) cells = finer;
  group(landed, t.accel.scene(), cells);
  for (std::size_t i = 0, end = 0; i < landed.size(); i = end) {
    for (end = i; end < landed.size() && landed[end].group == landed[i].group;) ++end;
    elements.push_back(element_of(std::span(landed).subspan(i, end - i)));
  }
  std::stable_sort(elements.begin(), elements.end(), [](const BounceElement& x, const BounceElement& y) {
    return luminance(x.power) > luminance(y.power);
  });
  if (elements.size() > count) elements.resize(count);  // fewer than the axes that normals have
  return elements;
}

}  // namespace oriel
