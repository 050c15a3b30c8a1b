// What reflections need beside their maps: walk grids, emitters, lobes as cosines.
#include <algorithm>
#include <map>
#include <set>

#include "formats/pack/issues.h"

namespace oriel {
namespace {

// Convex, in a plane within a thousandth of its size, and of an area.
bool is_convex_polygon(const std::vector<Vec3>& corners) {
  const std::size_t n = corners.size();
  if (n < 3 || n > 4 || !std::all_of(corners.begin(), corners.end(), bounded)) return false;
  const auto corner = [&](std::size_t i) { return DVec3(corners[i % n]); };
  DVec3 normal(0);
  double size = 0;
  for (std::size_t i = 0; i < n; ++i) {
    normal += glm::cross(corner(i) - corner(0), corner(i + 1) - corner(0));
    size = std::max(size, glm::length(corner(i + 1) - corner(i)));
  }
  if (!(glm::length(normal) > 0)) return false;
  normal = glm::normalize(normal);
  for (std::size_t i = 0; i < n; ++i) {
    const DVec3 along = corner(i + 1) - corner(i), next = corner(i + 2) - corner(i + 1);
    if (std::abs(glm::dot(corner(i) - corner(0), normal)) > 1e-3 * size) return false;
    if (glm::dot(glm::cross(along, next), normal) < -1e-3 * glm::length(along) * glm::length(next)) return false;
  }
  return true;
}

using ElementKey = std::pair<std::uint32_t, std::uint32_t>;  // reflector and element

// What a reflector or a frosted pane lists of the emitters, and what its nodes see of them.
void validate_listed(const Pack& pack, std::size_t i, const Reflector& r, IssueList& list) {
  const auto bad = std::count_if(r.emitters.begin(), r.emitters.end(),
                                 [&](std::uint32_t emitter) { return emitter >= pack.emitters.size(); });
  if (bad > 0 || r.emitters.size() > kMaxReflectorEmitters)
    list.error(423, "reflector {} ('{}'): found {} emitters, {} of them out of range, expected at most {} below {}", i,
               r.name, r.emitters.size(), bad, kMaxReflectorEmitters, pack.emitters.size());
  const bool sides = r.emitters.empty() ? r.visibility_x == 0 && r.visibility_y == 0
                                        : within(static_cast<float>(r.visibility_x), 2, kMaxSide) &&
                                              within(static_cast<float>(r.visibility_y), 2, kMaxSide);
  if (!sides || r.visibility.size() != std::size_t{r.visibility_x} * r.visibility_y * r.emitters.size())
    list.error(424,
               "reflector {} ('{}'): found {} shares of visibility for {} emitters on {} x {} nodes, expected their "
               "product and at least 2 x 2 nodes",
               i, r.name, r.visibility.size(), r.emitters.size(), r.visibility_x, r.visibility_y);
}

}  // namespace

void validate_elements(const Pack& pack, IssueList& list) {
  std::map<ElementKey, std::size_t> counts;  // maps by element
  for (std::size_t i = 0; i < pack.radiance_maps.size(); ++i) {
    const RadianceMap& map = pack.radiance_maps[i];
    list.in_section(kRadianceMapSection, i);
    std::size_t& count = counts[{map.reflector, map.element}];
    const RadianceMap* before = i > 0 ? &pack.radiance_maps[i - 1] : nullptr;
    const bool beside = before != nullptr && before->reflector == map.reflector && before->element == map.element;
    if (count > 0 && !beside)
      list.error(419, "comes after the maps of another element, expected it beside those of its own");
    if (beside && (before->lower != map.lower || before->upper != map.upper))
      list.error(425, "found rectangle {} to {}, expected {} to {} as the map before, of the same element",
                 text_of(map.lower), text_of(map.upper), text_of(before->lower), text_of(before->upper));
    if (++count == kMostMapsPerElement + 1)
      list.warning(420, "is one of more than {} maps of an element: so many are shown at once", kMostMapsPerElement);
  }
  for (std::size_t i = 0; i < pack.radiance_maps.size(); ++i) {
    const RadianceMap& map = pack.radiance_maps[i];
    list.in_section(kRadianceMapSection, i);
    if (map.reflector >= pack.reflectors.size()) continue;  // another issue
    const Reflector& reflector = pack.reflectors[map.reflector];
    const std::uint64_t elements = std::uint64_t{reflector.elements_x} * reflector.elements_y;
    if (map.element >= elements)
      list.error(426, "found element {}, expected less than {} of reflector {}", map.element, elements, map.reflector);
  }
}

void validate_map_meshes(const Pack& pack, IssueList& list) {
  list.in_section(kMapMeshSection);
  const std::size_t meshes = pack.map_meshes.size();
  if (meshes != 0 && meshes != pack.radiance_maps.size())
    list.error(427, "found {} meshes of {} radiance maps, expected one each, or none", meshes,
               pack.radiance_maps.size());
  for (std::size_t i = 0; i < meshes; ++i) {
    const MapMesh& mesh = pack.map_meshes[i];
    list.in_section(kMapMeshSection, i);
    list.each(
        428, "vertices", mesh.vertices, [](const Vec3& v) { return within(v, 0, 1); }, "0 to 1");
    const auto bad = std::count_if(mesh.indices.begin(), mesh.indices.end(),
                                   [&](std::uint32_t v) { return v >= mesh.vertices.size(); });
    if (bad > 0 || mesh.indices.size() % 3 != 0)
      list.error(429, "found {} indices, {} of them not below {}, expected triangles of those vertices",
                 mesh.indices.size(), bad, mesh.vertices.size());
  }
}

void validate_emitters(const Pack& pack, IssueList& list) {
  list.in_section(kEmitterSection);
  for (std::size_t i = 0; i < pack.emitters.size(); ++i) {
    const Emitter& e = pack.emitters[i];
    if (!is_convex_polygon(e.corners))
      list.error(421, "emitter {}: found {} corners, expected 3 or 4 of a convex planar polygon", i, e.corners.size());
    if (!not_negative(e.radiance))
      list.error(422, "emitter {}: found radiance {}, expected finite numbers from 0 up", i, text_of(e.radiance));
  }
  list.in_section(kReflectorSection);
  for (std::size_t i = 0; i < pack.reflectors.size(); ++i) validate_listed(pack, i, pack.reflectors[i], list);
  list.in_section(kFrostedPaneSection);
  for (std::size_t i = 0; i < pack.frosted_panes.size(); ++i) validate_listed(pack, i, pack.frosted_panes[i], list);
}

void validate_kernel_fits(const Pack& pack, IssueList& list) {
  list.in_section(kKernelSection);
  for (std::size_t i = 0; i < pack.kernels.size(); ++i) {
    const BrdfKernel& kernel = pack.kernels[i];
    if (!kernel.fits.empty() && kernel.fits.size() != kernel.slices.size())
      list.error(521, "kernel {}: found {} cosine lobes for {} incidences, expected one each", i, kernel.fits.size(),
                 kernel.slices.size());
    for (const LobeFit& f : kernel.fits) {
      constexpr float kMost = 1e12f;  // alpha 1e-5 at a cosine of 1e-3 has 5e10
      const bool finite = within(f.m11, 0, kMost) && within(f.m22, 0, kMost) && within(f.m13, -kMost, kMost) &&
                          within(f.m31, -kMost, kMost);
      if (!finite || !(f.m22 > 0) || !(f.m11 - f.m13 * f.m31 > 0) || !within(f.amplitude, 0, 1))
        list.error(522,
                   "kernel {}: found matrix entries {}, {}, {}, {} and amplitude {}, expected a positive determinant "
                   "and 0 to 1",
                   i, f.m11, f.m13, f.m22, f.m31, f.amplitude);
    }
  }
}

void validate_walk_grids(const Pack& pack, IssueList& list) {
  list.in_section(kWalkSection);
  for (std::size_t i = 0; i < pack.walk_grids.size(); ++i) {
    const WalkGrid& g = pack.walk_grids[i];
    if (g.width == 0 || g.height == 0 || g.width > kMaxSide || g.height > kMaxSide ||
        g.floor_y.size() != std::size_t{g.width} * g.height)
      list.error(721, "walk grid {}: found {} heights for {} x {} cells, expected their product, 1 to {} a side", i,
                 g.floor_y.size(), g.width, g.height, kMaxSide);
    if (!is_finite(g.lower) || !within(g.cell_m, 1e-6f, kLengthLimit) || !within(g.eye_height_m, 0, kLengthLimit))
      list.error(722, "walk grid {}: found corner {}, cells of {} and eyes {} over the floor, expected finite numbers",
                 i, text_of(g.lower), g.cell_m, g.eye_height_m);
    list.each(
        723, "floor heights", g.floor_y,
        [](float y) { return std::isnan(y) || within(y, -kLengthLimit, kLengthLimit); }, "finite numbers, or none");
  }
}

}  // namespace oriel
