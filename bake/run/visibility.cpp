#include "bake/run/visibility.h"

#include <algorithm>

#include "bake/jobs/units.h"
#include "bake/run/inputs.h"
#include "bake/run/stopwatch.h"
#include "bake/visibility/eye_cells.h"
#include "bake/visibility/triangle_groups.h"

namespace oriel {
namespace {

constexpr std::size_t kLeastTriangles =
    500'000;  // docs/notes/visibility.md: sets of fewer cost the bake more than they save frames
// Images of reflectors are made of fewer at once.
constexpr std::size_t kLeastReflected = 20'000;
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

// Triangles of each set.
std::vector<std::uint64_t> triangles_of(std::span<const std::uint8_t> seen, std::size_t set_bytes,
                                        const std::vector<std::uint32_t>& group_of_triangle) {
  std::vector<std::uint64_t> out;
  for (std::size_t first = 0; first < seen.size(); first += set_bytes) {
    std::uint64_t& count = out.emplace_back(0);
    for (const std::uint32_t g : group_of_triangle) count += seen[first + g / 8] >> (g % 8) & 1;
  }
  return out;
}

std::vector<SeenMirror> mirrors_of(std::span<const FoundReflector> reflectors) {
  std::vector<SeenMirror> out;
  for (const FoundReflector& found : reflectors) {
    const Reflector& r = found.reflector;
    const Vec3 normal(r.pack_from_reflector[2]);
    out.push_back({Vec4(normal, -glm::dot(normal, Vec3(r.pack_from_reflector[3]))),
                   r.flatness_m + 1e-5f * glm::length(r.upper - r.lower), found.triangles});
  }
  return out;
}

bool wants_reflected_sets(const BakeOptions& options, std::size_t triangles, const SetEyes& onlookers) {
  return options.visible_sets != VisibleSetsWanted::kOff && options.ways != WaysWanted::kMaps &&
         !onlookers.reflectors.empty() &&
         (triangles >= kLeastReflected || options.visible_sets == VisibleSetsWanted::kOn);
}

// Finds sets, as units of work, within a time.
class SetFinder {
 public:
  SetFinder(const BakeOptions& options, const GroupedScene& scene, const SetEyes& onlookers, double seconds,
            Context& context)
      : options_(options.visibility), scene_(scene), onlookers_(onlookers), seconds_(seconds), context_(context) {}

  // Whether there was time for it.
  Result<bool> visible(std::uint32_t side, std::vector<std::uint8_t>& seen, std::uint64_t& lines) {
    return find(
        "visibility",
        [&](Archive& key) {
          for (const WalkGrid& grid : onlookers_.grids)
            key(grid.lower, grid.cell_m, grid.width, grid.height, grid.floor_y, grid.eye_height_m);
          key(side);
        },
        [&] { return find_visible_sets(scene_, onlookers_.grids, side, options_, context_); }, seen, lines);
  }
  Result<bool> reflected(std::vector<std::uint8_t>& seen, std::uint64_t& lines) {
    const std::vector<SeenMirror> mirrors = mirrors_of(onlookers_.reflectors);
    return find(
        "reflected",
        [&](Archive& key) {
          key(onlookers_.eyes);
          for (const SeenMirror& mirror : mirrors) key(mirror.plane, mirror.lift, mirror.triangles);
        },
        [&] { return find_reflected_sets(scene_, mirrors, onlookers_.eyes, options_, context_); }, seen, lines);
  }

 private:
  template <class Inputs, class Compute>
  Result<bool> find(const char* name, const Inputs& inputs, const Compute& compute, std::vector<std::uint8_t>& seen,
                    std::uint64_t& lines) {
    FoundSets found;
    const auto find_all = [&] {
      return one_unit(
          context_, name,
          [&](Archive& key) {
            inputs(key);
            key(scene_.group, options_.first_lines, options_.least_lines, options_.most_lines);
          },
          [&]() -> Status {
            ORIEL_TRY(found, compute());
            return {};
          },
          [&](Archive& archive) { archive(found.seen, found.rays); });
    };
    ORIEL_TRY(const bool done, done_in_time(
                                   context_, [&] { return clock_.spent() > seconds_; }, find_all));
    if (done) seen = std::move(found.seen), lines += found.rays;
    return done;
  }

  const VisibilityOptions& options_;
  const GroupedScene& scene_;
  const SetEyes& onlookers_;
  double seconds_;
  Context& context_;
  ElapsedTime clock_;
};

}  // namespace

std::string why_not_visible_sets(const BakeOptions& options, std::size_t triangles, std::span<const WalkGrid> grids) {
  if (options.visible_sets == VisibleSetsWanted::kOff) return "left out by --pvs off";
  if (grids.empty())
    return options.with_radiance ? "there is no floor to walk on: all is drawn from everywhere"
                                 : "left out by --only, which finds no floors";
  if (options.visible_sets == VisibleSetsWanted::kAuto && triangles < kLeastTriangles)
    return fmt::format(
        "{} triangles are few enough to draw all of them; from {} on, or with --pvs on, the bake finds out "
        "which can be seen from where people walk",
        triangles, kLeastTriangles);
  return {};
}

Result<SceneSets> bake_visibility(const BakeTask& bake, const SetEyes& onlookers, double seconds, AssembledMesh& mesh) {
  const BakeOptions& options = bake.options;
  SceneSets sets;
  VisibilityReport& report = sets.report;
  std::vector<Warning>& omissions = sets.omissions;
  const std::string why_not = why_not_visible_sets(options, mesh.first_index.size(), onlookers.grids);
  if (!why_not.empty()) omissions.push_back("visible sets: " + why_not);
  const bool reflected = wants_reflected_sets(options, mesh.first_index.size(), onlookers);
  if (!why_not.empty() && !reflected) return sets;
  const auto too_long = [&](const char* what) {
    omissions.push_back(
        {fmt::format("{}: left out, they would take more than {:.3g} s of --time", what, std::max(seconds, 0.0)),
         "time-over"});
  };
  if (seconds <= 0) {
    too_long(why_not.empty() ? "visible sets" : "visible sets of reflectors");
    return sets;
  }
  const VisibilityOptions& o = options.visibility;
  const auto triangles = static_cast<std::uint32_t>(mesh.first_index.size());
  const TriangleGroups groups =
      group_triangles(mesh.mesh, std::max(o.group_triangles, triangles / o.most_groups * 2 + 1));
  const std::vector<std::uint32_t> group = groups_of_scene(mesh, groups);
  VisibleSets& visible = sets.visible;
  visible.groups = report.groups = groups.count;
  visible.runs = groups.runs;
  visible.side = eye_cell_side(onlookers.grids, o);
  visible.below_m = kEyeBelow_m;
  visible.above_m = kEyeAbove_m;
  const GroupedScene scene{bake.accel(), group, groups.count};
  SetFinder finder(options, scene, onlookers, seconds, bake.context);
  const StageInputs inputs(bake.context, SurfacesOf{bake.scene()});
  if (why_not.empty()) {
    ORIEL_TRY(const bool done, finder.visible(visible.side, visible.seen, report.lines));
    if (!done) visible.seen.clear(), too_long("visible sets");
  }
  if (!visible.seen.empty()) {
    report.cells = static_cast<std::uint32_t>(visible.seen.size() / visible.set_bytes());
    report.seen = mean_share(visible, group, report.cells);
    if (options.visible_sets == VisibleSetsWanted::kAuto && report.seen > kMostSeen) {
      omissions.push_back(fmt::format(
          "visible sets: {:.0f} % of the triangles are seen from where people walk, on the mean", 100 * report.seen));
      visible.seen.clear();
    }
  }
  if (reflected) {
    ORIEL_TRY(const bool done, finder.reflected(sets.reflected.seen, report.lines));
    if (!done) sets.reflected.seen.clear(), too_long("what is seen in reflectors");
    sets.reflected_triangles = triangles_of(sets.reflected.seen, visible.set_bytes(), group);
  }
  if (visible.seen.empty() && sets.reflected.seen.empty()) {
    visible = {}, sets.reflected_triangles.clear();
    return sets;
  }
  sort_triangles(groups.order, mesh);
  return sets;
}

void hash_sets(Pack& pack) {
  if (!pack.visible_sets.empty())
    pack.visible_sets.made_for = visibility_hash(pack.mesh, pack.materials, pack.walk_grids);
  if (pack.reflectors.empty()) pack.reflected_sets = {};
  if (!pack.reflected_sets.empty()) pack.reflected_sets.made_for = reflected_hash(pack.visible_sets, pack.reflectors);
}

}  // namespace oriel
