#include "bake/run/visibility.h"

#include "bake/jobs/units.h"
#include "bake/run/inputs.h"
#include "bake/run/stopwatch.h"
#include "bake/visibility/eye_cells.h"
#include "bake/visibility/triangle_groups.h"

namespace oriel {
namespace {

constexpr std::size_t kLeastTriangles =
    500'000;                        // docs/visibility.md: sets of fewer cost the bake more than they save frames
constexpr double kMostSeen = 0.75;  // of the triangles: more is next to all

// By scene triangle: its group.
std::vector<std::uint32_t> groups_of_scene(const AssembledMesh& mesh, const TriangleGroups& groups) {
  std::vector<std::uint32_t> out;
  for (const std::uint32_t first : mesh.first_index) out.push_back(groups.groups[first / 3]);
  return out;
}

void sort_triangles(const std::vector<std::uint32_t>& order, AssembledMesh& mesh) {
  std::vector<std::uint32_t> indices, place(order.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    for (std::size_t corner = 0; corner < 3; ++corner)
      indices.push_back(mesh.mesh.indices[std::size_t{order[i]} * 3 + corner]);
  }
  mesh.mesh.indices = std::move(indices);
  for (std::uint32_t& first : mesh.first_index) first = 3 * place[first / 3];
}

double mean_share(const VisibleSets& sets, const std::vector<std::uint32_t>& group_of_triangle, std::size_t cells) {
  std::vector<double> triangles(sets.groups);
  for (const std::uint32_t g : group_of_triangle) ++triangles[g];
  double sum = 0;
  for (std::size_t c = 0; c < cells; ++c)
    for (std::size_t g = 0; g < sets.groups; ++g)
      if (sets.seen[c * sets.set_bytes() + g / 8] >> (g % 8) & 1) sum += triangles[g];
  return sum / static_cast<double>(cells) / static_cast<double>(group_of_triangle.size());
}

}  // namespace

std::string why_not_visible_sets(const BakeOptions& options, std::size_t triangles, std::span<const WalkGrid> grids) {
  if (options.visible_sets == VisibleSetsWanted::kOff) return "left out by --pvs off";
  if (grids.empty())
    return options.with_radiance ? "there is no floor to walk on: all is drawn from everywhere"
                                 : "left out by --only, which finds no floors";
  if (options.visible_sets == VisibleSetsWanted::kAuto && triangles < kLeastTriangles)
    return fmt::format(
        "{} triangles are few enough to draw all of them; from {} on, or with --pvs on, it is found which "
        "can be seen from where",
        triangles, kLeastTriangles);
  return {};
}

Result<VisibleSets> bake_visibility(const BakeOptions& options, const Accel& accel, std::span<const WalkGrid> grids,
                                    AssembledMesh& mesh, double seconds, Context& context, VisibilityReport& report,
                                    std::vector<Warning>& omissions) {
  const std::string why_not = why_not_visible_sets(options, mesh.first_index.size(), grids);
  if (!why_not.empty()) {
    omissions.push_back("visible sets: " + why_not);
    return VisibleSets();
  }
  const VisibilityOptions& o = options.visibility;
  const auto triangles = static_cast<std::uint32_t>(mesh.first_index.size());
  const TriangleGroups groups =
      group_triangles(mesh.mesh, std::max(o.group_triangles, triangles / o.most_groups * 2 + 1));
  const std::vector<std::uint32_t> group = groups_of_scene(mesh, groups);
  VisibleSets sets;
  sets.groups = groups.count;
  sets.runs = groups.runs;
  sets.side = eye_cell_side(grids, o);
  sets.below_m = kEyeBelow_m;
  sets.above_m = kEyeAbove_m;
  const StageInputs inputs(context, SurfacesOf{accel.scene()});
  const ElapsedTime clock;
  const auto late = [&] { return clock.spent() > seconds; };
  const Interruptible until(context, late);
  const Status done = one_unit(
      context, "visibility",
      [&](Archive& key) {
        for (const WalkGrid& grid : grids)
          key(grid.lower, grid.cell_m, grid.width, grid.height, grid.floor_y, grid.eye_height_m);
        key(group, sets.side, o.first_lines, o.least_lines, o.most_lines);
      },
      [&]() -> Status {
        ORIEL_TRY(sets.seen,
                  find_visible_sets({accel, group, groups.count}, grids, sets.side, o, context, report.lines));
        return {};
      },
      [&](Archive& archive) { archive(sets.seen, report.lines); });
  if (!done && done.error().code == ErrorCode::kStopped && !context.stop && late()) {
    omissions.emplace_back(fmt::format("visible sets: left out, they would take more than {:.3g} s of --time", seconds),
                           WarningKind::kTimeOver);
    return VisibleSets();
  }
  ORIEL_TRY_VOID(done);
  report.cells = static_cast<std::uint32_t>(sets.seen.size() / sets.set_bytes());
  report.groups = sets.groups;
  report.seen = mean_share(sets, group, report.cells);
  if (options.visible_sets == VisibleSetsWanted::kAuto && report.seen > kMostSeen) {
    omissions.push_back(fmt::format(
        "visible sets: {:.0f} % of the triangles are seen from where people walk, on the mean", 100 * report.seen));
    return VisibleSets();
  }
  sort_triangles(groups.order, mesh);
  return sets;
}

}  // namespace oriel
