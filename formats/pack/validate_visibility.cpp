// validate() of what is seen from where.
#include <algorithm>

#include "formats/pack/issues.h"
#include "formats/pack/layout.h"
#include "formats/pack/pack.h"

namespace oriel {

static std::string text_of(const TriangleRun& run) {
  return fmt::format("{} indices of group {}", run.index_count, run.group);
}
namespace {

constexpr float kMostAside_m = 100;  // of eyes over and under the height that grids tell

// That runs fill the parts: none is of two of them.
void validate_runs(const Pack& pack, IssueList& list) {
  const VisibleSets& sets = pack.visible_sets;
  list.each(
      751, "runs", sets.runs,
      [&](const TriangleRun& r) { return r.group < sets.groups && r.index_count > 0 && r.index_count % 3 == 0; },
      fmt::format("triangles of a group below {}", sets.groups).c_str());
  std::vector<std::uint64_t> ends;
  std::uint64_t end = 0;
  for (const TriangleRun& run : sets.runs) ends.push_back(end += run.index_count);
  if (end != pack.mesh.indices.size())
    list.error(752, "found runs of {} indices, expected the mesh's {}", end, pack.mesh.indices.size());
  for (std::size_t i = 0; i < pack.mesh.parts.size(); ++i) {
    const MeshPart& part = pack.mesh.parts[i];
    const std::uint64_t part_end = std::uint64_t{part.first_index} + part.index_count;
    if (part.index_count > 0 && !std::binary_search(ends.begin(), ends.end(), part_end))
      list.error(752, "no run ends where part {} ('{}') does, at index {}", i, part.name, part_end);
    if (part.first_index > 0 && part.index_count > 0 &&
        !std::binary_search(ends.begin(), ends.end(), std::uint64_t{part.first_index}))
      list.error(752, "no run begins where part {} ('{}') does, at index {}", i, part.name, part.first_index);
  }
}

}  // namespace

void validate_visible_sets(const Pack& pack, IssueList& list) {
  const VisibleSets& sets = pack.visible_sets;
  if (sets.empty()) return;
  list.in_section(kVisibleSetsSection);
  if (sets.groups > kMaxGroups || sets.side == 0 || sets.side > kMaxSide || !within(sets.below_m, 0, kMostAside_m) ||
      !within(sets.above_m, 0, kMostAside_m)) {
    list.error(753,
               "found {} groups, eye cells of {} walk cells, eyes {} m below and {} m above; expected 1 to {}, 1 to "
               "{}, and 0 to {} m",
               sets.groups, sets.side, sets.below_m, sets.above_m, kMaxGroups, kMaxSide, kMostAside_m);
    return;
  }
  for (const WalkGrid& grid : pack.walk_grids)
    if (grid.width == 0 || grid.floor_y.size() != std::size_t{grid.width} * grid.height) return;  // issue 721
  if (!made_for(sets, pack.mesh, pack.materials, pack.walk_grids)) {
    list.warning(755, "was made for another mesh or other walk grids and is ignored: all is drawn");
    return;
  }
  validate_runs(pack, list);
  const std::uint32_t cells = number_eye_cells(pack.walk_grids, sets.side).count;
  if (!sets.seen.empty() && sets.seen.size() != cells * sets.set_bytes())
    list.error(754, "found {} bytes of sets, expected none or {} for each of {} eye cells", sets.seen.size(),
               sets.set_bytes(), cells);
}

void validate_reflected_sets(const Pack& pack, IssueList& list) {
  const ReflectedSets& sets = pack.reflected_sets;
  if (sets.empty()) return;
  list.in_section(kReflectedSetsSection);
  if (sets.made_for != reflected_hash(pack.visible_sets, pack.reflectors)) {
    list.warning(757, "was made for other reflectors or other visible sets and is ignored: mirrors show all");
    return;
  }
  const std::size_t expected = pack.reflectors.size() * pack.visible_sets.set_bytes();
  if (pack.visible_sets.empty() || sets.seen.size() != expected)
    list.error(756, "found {} bytes of sets, expected {} for {} reflectors and {} groups", sets.seen.size(), expected,
               pack.reflectors.size(), pack.visible_sets.groups);
}

}  // namespace oriel
