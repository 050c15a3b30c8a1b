#include "bake/visibility/find_sets.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <set>

#include "bake/jobs/parallel.h"
#include "bake/trace/sampler.h"
#include "bake/visibility/eye_cells.h"
#include "bake/visibility/sight_lines.h"

namespace oriel {
namespace {

constexpr std::uint32_t kEyesACell = 256;
constexpr std::uint32_t kAllAround = 4096;       // lines from a cell in all directions
constexpr std::uint32_t kThroughMirror = 65536;  // to what a mirror shows to all eyes
constexpr std::size_t kLinesALook = 64;          // lines between looks at whether a group was seen
constexpr float kNeighbour_m = 0.3f;             // groups and cells so near are neighbours
constexpr float kPixel_rad = 0.002f;             // of a frame of some 500 rows
constexpr int kMostRounds = 64;
constexpr std::uint32_t kFirstOfMirror = 4;  // times as many lines at first, to what all eyes see in a mirror

struct Box {
  Vec3 lower{0}, upper{0};
};

bool are_near(const Box& a, const Box& b) {
  return glm::all(glm::lessThanEqual(a.lower - kNeighbour_m, b.upper)) &&
         glm::all(glm::lessThanEqual(b.lower - kNeighbour_m, a.upper));
}

// By item the others near it.
std::vector<std::vector<std::uint32_t>> neighbours(const std::vector<Box>& boxes) {
  std::vector<std::vector<std::uint32_t>> near(boxes.size());
  for (std::uint32_t a = 0; a < boxes.size(); ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      if (are_near(boxes[a], boxes[b])) near[a].push_back(b), near[b].push_back(a);
  return near;
}

// By group those that have a corner in common with it.
std::vector<std::vector<std::uint32_t>> joined(const Scene& scene, std::span<const std::uint32_t> group,
                                               std::uint32_t groups) {
  std::vector<std::pair<std::array<float, 3>, std::uint32_t>> corners;
  for (std::uint32_t t = 0; t < group.size(); ++t)
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3& p = scene.positions[scene.triangles[t][corner]];
      corners.push_back({{p.x, p.y, p.z}, group[t]});
    }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  std::vector<std::set<std::uint32_t>> sets(groups);
  for (std::size_t first = 0, end = 0; first < corners.size(); first = end) {
    while (end < corners.size() && corners[end].first == corners[first].first) ++end;
    for (std::size_t a = first; a < end; ++a)
      for (std::size_t b = first; b < end; ++b)
        if (a != b) sets[corners[a].second].insert(corners[b].second);
  }
  std::vector<std::vector<std::uint32_t>> out;
  for (const auto& set : sets) out.emplace_back(set.begin(), set.end());
  return out;
}

// Random numbers in [0, 1), one after the other.
class Numbers {
 public:
  explicit Numbers(std::uint64_t key) : key_(mix64(key)) {}
  float next() { return static_cast<float>(mix64(key_ + ++count_) >> 40) * 0x1p-24f; }
  std::size_t below(std::size_t n) { return std::min(static_cast<std::size_t>(next() * static_cast<float>(n)), n - 1); }

 private:
  std::uint64_t key_, count_ = 0;
};

// A line that met a group.
struct Witness {
  Vec3 eye{0};
  std::uint32_t triangle = ~0u;  // ~0u: the group has not been seen
  bool seen() const { return triangle != ~0u; }
};

struct Group {
  std::vector<std::uint32_t> triangles;
  std::vector<double> areas;  // added up
  Box box;
};

Vec3 mirrored(const Vec3& p, const Vec4& plane) {
  return p - 2 * glm::dot(plane, Vec4(p, 1)) * Vec3(plane);
}

class VisibleSetFinder {
 public:
  // mirrors: none, or by cell the one that its eyes, mirrored, look through.
  VisibleSetFinder(const GroupedScene& scene, const std::vector<CellOfEyes>& cells, const VisibilityOptions& options,
                   std::uint64_t seed, std::span<const SeenMirror> mirrors = {})
      : scene_(scene),
        geometry_(scene.accel.scene()),
        lines_(scene.accel),
        cells_(cells),
        options_(options),
        seed_(seed),
        mirrors_(mirrors) {
    groups_.resize(scene.groups);
    for (std::uint32_t t = 0; t < scene.group.size(); ++t) {
      Group& group = groups_[scene.group[t]];
      for (int corner = 0; corner < 3; ++corner) {
        const Vec3& p = geometry_.positions[geometry_.triangles[t][corner]];
        group.box = group.triangles.empty() && corner == 0
                        ? Box{p, p}
                        : Box{glm::min(group.box.lower, p), glm::max(group.box.upper, p)};
      }
      group.areas.push_back((group.areas.empty() ? 0 : group.areas.back()) + triangle_area(geometry_, t));
      group.triangles.push_back(t);
    }
    found_.assign(cells.size(), std::vector<Witness>(scene.groups));
    asked_.assign(cells.size(), std::vector<bool>(scene.groups));
    std::vector<Box> boxes, places;
    for (const Group& group : groups_) boxes.push_back(group.box);
    for (const CellOfEyes& cell : cells) places.push_back({cell.lower, cell.upper});
    near_groups_ = neighbours(boxes);
    near_cells_ = mirrors.empty() ? neighbours(places) : std::vector<std::vector<std::uint32_t>>(cells.size());
    joined_ = joined(geometry_, scene.group, scene.groups);
  }

  // All around, then to each group that was not met.
  void look(std::size_t cell) {
    std::vector<Witness>& found = found_[cell];
    Numbers random(seed_ + cell);
    const float far = 4 * geometry_.radius() + 1;
    std::vector<SightLines::Line> lines;
    for (std::uint32_t i = 0; i < (mirrors_.empty() ? kAllAround : kThroughMirror); ++i) {
      const Vec3& eye = cells_[cell].eyes[i % cells_[cell].eyes.size()];
      if (!mirrors_.empty()) {  // all that a mirror shows lies behind a point of it
        const auto& own = mirrors_[cell].triangles;
        const Vec3 through = point_of(own[random.below(own.size())], random);
        lines.push_back({eye, eye + far * normalize_or(through - eye, Vec3(0, 0, 1)), ~0u});
        continue;
      }
      const float z = 1 - 2 * random.next(), turn = 2 * kPi * random.next(), r = std::sqrt(std::max(1 - z * z, 0.0f));
      lines.push_back({eye, eye + far * Vec3(r * std::cos(turn), z, r * std::sin(turn)), ~0u});
    }
    trace(cell, lines, found);
    for (std::uint32_t g = 0; g < scene_.groups; ++g)
      if (!found[g].seen()) ask(cell, g, options_.first_lines, {}, found);
  }

  // Groups of a cell that are not known to be seen, but lie near one that is, or are seen from a cell near it. None
  // twice.
  std::vector<std::uint32_t> suspects(std::size_t cell) {
    std::vector<std::uint32_t> out;
    const auto& found = found_[cell];
    for (std::uint32_t g = 0; g < scene_.groups; ++g) {
      if (found[g].seen() || asked_[cell][g]) continue;
      const bool suspect = std::any_of(near_groups_[g].begin(), near_groups_[g].end(),
                                       [&](std::uint32_t n) { return found[n].seen(); }) ||
                           std::any_of(near_cells_[cell].begin(), near_cells_[cell].end(),
                                       [&](std::uint32_t n) { return found_[n][g].seen(); });
      if (suspect) out.push_back(g);
    }
    return out;
  }

  // What the cell's neighbours saw is asked for where they saw it. Changes `found` only, and what was asked.
  void look_again(std::size_t cell, std::span<const std::uint32_t> suspects, std::vector<Witness>& found) {
    for (const std::uint32_t g : suspects) {
      asked_[cell][g] = true;
      if (found[g].seen()) continue;
      std::vector<Witness> hints;
      for (const std::uint32_t n : near_cells_[cell])
        if (found_[n][g].seen()) hints.push_back(found_[n][g]);
      ask(cell, g, lines_for(cell, g), hints, found);
    }
  }

  // By group: seen from the cell; or turned to it, and either joined to one that is seen, as it may show by a sliver,
  // or seen from a cell beside.
  std::vector<bool> may_see(std::size_t cell) const {
    std::vector<bool> out(scene_.groups);
    for (std::uint32_t g = 0; g < scene_.groups; ++g) {
      const auto joins = [&](std::uint32_t other) { return found_[cell][other].seen(); };
      const auto sees = [&](std::uint32_t beside) { return found_[beside][g].seen(); };
      out[g] = found_[cell][g].seen() || ((std::any_of(joined_[g].begin(), joined_[g].end(), joins) ||
                                           std::any_of(near_cells_[cell].begin(), near_cells_[cell].end(), sees)) &&
                                          may_be_seen(cell, g));
    }
    return out;
  }

  const std::vector<Witness>& found(std::size_t cell) const { return found_[cell]; }
  void set_found(std::size_t cell, std::vector<Witness> found) { found_[cell] = std::move(found); }
  std::uint64_t rays() const { return rays_; }

  // As VisibleSets::seen.
  std::vector<std::uint8_t> sets(std::size_t cells) const {
    const std::size_t set_bytes = (std::size_t{scene_.groups} + 7) / 8;
    std::vector<std::uint8_t> seen(cells * set_bytes);
    for (std::size_t c = 0; c < cells; ++c)
      for (std::uint32_t g = 0; const bool may : may_see(c)) {
        if (may) seen[c * set_bytes + g / 8] |= static_cast<std::uint8_t>(1u << (g % 8));
        ++g;
      }
    return seen;
  }

 private:
  // So many that what covers four pixels is met, as far as all of the group may be seen.
  std::uint32_t lines_for(std::size_t cell, std::uint32_t g) const {
    const Box& box = groups_[g].box;
    const CellOfEyes& eyes = cells_[cell];
    const Vec3 apart = glm::max(glm::max(box.lower - eyes.upper, eyes.lower - box.upper), Vec3(0));
    const float radius = 0.5f * glm::length(box.upper - box.lower);
    const float angle = radius / std::max(glm::length(apart), 0.1f) / kPixel_rad;
    const float lines = std::min(kPi * angle * angle / 2, static_cast<float>(options_.most_lines));
    return std::max(options_.least_lines, static_cast<std::uint32_t>(lines));
  }

  // False where no eye of the cell is before any of its triangles.
  bool may_be_seen(std::size_t cell, std::uint32_t g) const {
    const CellOfEyes& eyes = cells_[cell];
    for (const std::uint32_t t : groups_[g].triangles) {
      if (lines_.two_sided(t)) return true;
      const Vec3 n = geometric_normal(geometry_, t);
      const Vec3 foremost(n.x > 0 ? eyes.upper.x : eyes.lower.x, n.y > 0 ? eyes.upper.y : eyes.lower.y,
                          n.z > 0 ? eyes.upper.z : eyes.lower.z);
      if (glm::dot(n, foremost - geometry_.positions[geometry_.triangles[t][0]]) > 0) return true;
    }
    return false;
  }

  Vec3 point_of(std::uint32_t t, Numbers& random) const {
    const UVec3& corners = geometry_.triangles[t];
    const float u = std::sqrt(random.next()), v = random.next();
    return (1 - u) * geometry_.positions[corners[0]] + u * (1 - v) * geometry_.positions[corners[1]] +
           u * v * geometry_.positions[corners[2]];
  }

  // A quarter by area, the others by number, so that neither small nor large ones are forgotten.
  std::uint32_t triangle_of(const Group& group, bool by_area, Numbers& random) const {
    if (!by_area) return group.triangles[random.below(group.triangles.size())];
    const double at = double{random.next()} * group.areas.back();
    const auto it = std::upper_bound(group.areas.begin(), group.areas.end(), at);
    return group.triangles[std::min(static_cast<std::size_t>(it - group.areas.begin()), group.triangles.size() - 1)];
  }

  const Vec3& nearest_eye(std::size_t cell, const Vec3& to, Numbers& random) const {
    const std::vector<Vec3>& eyes = cells_[cell].eyes;
    const Vec3* best = &eyes[random.below(eyes.size())];
    for (int i = 0; i < 7; ++i) {
      const Vec3& other = eyes[random.below(eyes.size())];
      if (glm::distance(other, to) < glm::distance(*best, to)) best = &other;
    }
    return *best;
  }

  // Lines from the cell's eyes to the group until one meets it.
  void ask(std::size_t cell, std::uint32_t g, std::uint32_t count, std::span<const Witness> hints,
           std::vector<Witness>& found) {
    if (!may_be_seen(cell, g)) return;
    Numbers random(seed_ ^
                   mix64(cell * std::uint64_t{scene_.groups} + g + (hints.empty() ? 0 : std::uint64_t{1} << 60)));
    const Group& group = groups_[g];
    std::vector<SightLines::Line> lines;
    for (std::uint32_t i = 0; i < count && !found[g].seen();) {
      lines.clear();
      for (; i < count && lines.size() < kLinesALook; ++i) {
        const bool hinted = !hints.empty() && i % 2 == 0;
        const Witness hint = hinted ? hints[random.below(hints.size())] : Witness{};
        const Vec3& eye =
            hinted ? nearest_eye(cell, hint.eye, random) : cells_[cell].eyes[random.below(cells_[cell].eyes.size())];
        const std::uint32_t t = hinted && i % 4 == 0 ? hint.triangle : triangle_of(group, i % 4 == 1, random);
        if (lines_.is_drawn(t, eye)) lines.push_back({eye, point_of(t, random), t});
      }
      trace(cell, lines, found);
    }
  }

  void trace(std::size_t cell, std::span<const SightLines::Line> lines, std::vector<Witness>& found) {
    std::vector<SightLines::Line> behind;
    if (!mirrors_.empty()) lines = through_mirror(mirrors_[cell], lines, behind);
    rays_.fetch_add(lines.size(), std::memory_order_relaxed);
    lines_.trace(lines, [&](std::size_t line, std::uint32_t triangle) {
      Witness& witness = found[scene_.group[triangle]];
      if (!witness.seen()) witness = {lines[line].eye, triangle};
    });
  }

  // Of lines from mirrored eyes those that the eyes see go through the mirror, from there on.
  std::span<const SightLines::Line> through_mirror(const SeenMirror& mirror, std::span<const SightLines::Line> lines,
                                                   std::vector<SightLines::Line>& behind) {
    std::vector<SightLines::Line> to_mirror, from_mirror;
    for (const SightLines::Line& line : lines) {
      const float under = glm::dot(mirror.plane, Vec4(line.eye, 1)),
                  over = glm::dot(mirror.plane, Vec4(line.target, 1));
      if (!(under < 0 && over > mirror.lift)) continue;
      const auto at = [&](float height) {
        return line.eye + (height - under) / (over - under) * (line.target - line.eye);
      };
      to_mirror.push_back({mirrored(line.eye, mirror.plane), at(0), ~0u});
      from_mirror.push_back({at(mirror.lift), line.target, line.triangle});
    }
    std::vector<bool> meets(to_mirror.size());
    rays_.fetch_add(to_mirror.size(), std::memory_order_relaxed);
    lines_.trace(to_mirror, [&](std::size_t line, std::uint32_t triangle) {
      if (std::binary_search(mirror.triangles.begin(), mirror.triangles.end(), triangle)) meets[line] = true;
    });
    for (std::size_t i = 0; i < meets.size(); ++i)
      if (meets[i]) behind.push_back(from_mirror[i]);
    return behind;
  }

  const GroupedScene& scene_;
  const Scene& geometry_;
  SightLines lines_;
  const std::vector<CellOfEyes>& cells_;
  VisibilityOptions options_;
  std::uint64_t seed_;
  std::span<const SeenMirror> mirrors_;
  std::vector<Group> groups_;
  std::vector<std::vector<std::uint32_t>> near_groups_, near_cells_, joined_;
  std::vector<std::vector<Witness>> found_;  // by cell and group
  std::vector<std::vector<bool>> asked_;     // as a suspect
  std::atomic<std::uint64_t> rays_{0};
};

// Until no cell has a suspect left.
Status follow_suspects(VisibleSetFinder& finder, std::size_t cells, Context& context) {
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<std::vector<std::uint32_t>> suspects(cells);
    ORIEL_TRY_VOID(parallel_for(context, "", cells, [&](std::size_t c) { suspects[c] = finder.suspects(c); }));
    if (std::all_of(suspects.begin(), suspects.end(), [](const auto& s) { return s.empty(); })) break;
    // All look at what was known before the round.
    std::vector<std::vector<Witness>> found(cells);
    ORIEL_TRY_VOID(parallel_for(context, round == 0 ? "sight lines" : "", cells, [&](std::size_t c) {
      if (suspects[c].empty()) return;
      found[c] = finder.found(c);
      finder.look_again(c, suspects[c], found[c]);
    }));
    for (std::size_t c = 0; c < cells; ++c)
      if (!suspects[c].empty()) finder.set_found(c, std::move(found[c]));
  }
  return {};
}

}  // namespace

std::uint32_t eye_cell_side(std::span<const WalkGrid> grids, const VisibilityOptions& options) {
  float cell_m = 0;
  for (const WalkGrid& grid : grids) cell_m = std::max(cell_m, grid.cell_m);
  auto side = static_cast<std::uint32_t>(std::max(1.0f, std::round(options.cell_m / std::max(cell_m, 1e-6f))));
  while (number_eye_cells(grids, side).count > options.most_cells) ++side;
  return side;
}

Result<FoundSets> find_visible_sets(const GroupedScene& scene, std::span<const WalkGrid> grids, std::uint32_t side,
                                    const VisibilityOptions& options, Context& context) {
  ORIEL_TRY(const std::vector<CellOfEyes> cells, eyes_by_cell(scene.accel, grids, side, kEyesACell, context));
  VisibleSetFinder finder(scene, cells, options, context.seed);
  ORIEL_TRY_VOID(parallel_for(context, "visibility", cells.size(), [&](std::size_t c) { finder.look(c); }));
  ORIEL_TRY_VOID(follow_suspects(finder, cells.size(), context));
  return FoundSets{finder.sets(cells.size()), finder.rays()};
}

Result<FoundSets> find_reflected_sets(const GroupedScene& scene, std::span<const SeenMirror> mirrors,
                                      std::span<const Vec3> eyes, const VisibilityOptions& options, Context& context) {
  std::vector<CellOfEyes> cells;
  for (const SeenMirror& mirror : mirrors) {
    CellOfEyes& cell = cells.emplace_back();
    for (const Vec3& eye : eyes)
      if (glm::dot(mirror.plane, Vec4(eye, 1)) > 0) cell.eyes.push_back(mirrored(eye, mirror.plane));
    if (cell.eyes.empty()) cell.eyes.push_back(eyes.empty() ? Vec3(0) : eyes[0]);  // sees nothing by it
    cell.lower = cell.upper = cell.eyes[0];
    for (const Vec3& eye : cell.eyes) cell.lower = glm::min(cell.lower, eye), cell.upper = glm::max(cell.upper, eye);
  }
  VisibilityOptions more = options;
  more.first_lines *= kFirstOfMirror;
  VisibleSetFinder finder(scene, cells, more, context.seed, mirrors);
  ORIEL_TRY_VOID(parallel_for(context, "reflected", cells.size(), [&](std::size_t c) { finder.look(c); }));
  ORIEL_TRY_VOID(follow_suspects(finder, cells.size(), context));
  return FoundSets{finder.sets(cells.size()), finder.rays()};
}

}  // namespace oriel
