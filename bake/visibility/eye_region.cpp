#include "bake/visibility/eye_region.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "bake/trace/sampler.h"
#include "bake/visibility/scene_unit.h"

namespace oriel {
namespace {

constexpr float kMaxDrop = 3;             // metres from a camera down to the floor that it stands on
constexpr float kStartReach = 1;          // metres from a camera to the column that it starts from
constexpr float kHeightVariation = 0.2f;  // of eyes, metres
constexpr float kBesideGiven = 0.2f;      // along each axis, metres: eyes held out from a given one

using Region = std::vector<std::uint32_t>;  // places, ascending

using Links = std::vector<std::vector<std::uint32_t>>;  // by place: those one step away

Links both_ways(const FloorPlan& plan) {
  Links links(plan.places.size());
  for (std::uint32_t i = 0; i < plan.places.size(); ++i)
    for (const std::int32_t next : plan.places[i].next)
      if (next >= 0) {
        links[i].push_back(static_cast<std::uint32_t>(next));
        links[static_cast<std::size_t>(next)].push_back(i);
      }
  return links;
}

// Connected regions, in the order of their first places.
std::vector<Region> connected_regions(const FloorPlan& plan, const Links& links) {
  std::vector<Region> regions;
  std::vector<char> seen(plan.places.size());
  for (std::uint32_t seed = 0; seed < plan.places.size(); ++seed) {
    if (seen[seed]) continue;
    Region region{seed};
    seen[seed] = 1;
    for (std::size_t at = 0; at < region.size(); ++at)
      for (const std::uint32_t next : links[region[at]])
        if (!seen[next]) {
          seen[next] = 1;
          region.push_back(next);
        }
    std::sort(region.begin(), region.end());
    regions.push_back(std::move(region));
  }
  return regions;
}

// The place under an eye: of the columns within reach the nearest one that has a floor not too far down.
std::optional<std::uint32_t> place_under(const FloorPlan& plan, const Vec3& eye, float size) {
  const Vec2 at = (Vec2(eye.x, eye.z) - plan.lower) / plan.cell_m - 0.5f;
  const float reach = std::max(size * kStartReach / plan.cell_m, 1.0f);
  std::optional<std::uint32_t> best;
  float nearest = reach;
  const auto range = [&](float middle, std::uint32_t count) {
    const float last = static_cast<float>(count) - 1;
    return std::pair{static_cast<std::uint32_t>(std::clamp(std::ceil(middle - reach), 0.0f, last)),
                     static_cast<std::uint32_t>(std::clamp(std::floor(middle + reach), 0.0f, last))};
  };
  const auto [x0, x1] = range(at.x, plan.width);
  const auto [z0, z1] = range(at.y, plan.height);
  for (std::uint32_t z = z0; z <= z1; ++z)
    for (std::uint32_t x = x0; x <= x1; ++x) {
      const float distance = glm::length(Vec2(x, z) - at);
      if (!(distance < nearest)) continue;
      const std::size_t column = std::size_t{z} * plan.width + x;
      for (std::uint32_t i = plan.first[column]; i < plan.first[column + 1]; ++i) {
        const float drop = eye.y - plan.places[i].y;
        if (drop < 0 || drop > size * kMaxDrop) continue;
        nearest = distance;
        best = i;  // places rise: the last is the one right under the eye
      }
    }
  return best;
}

// The regions that starts stand in; none: the one with the most covered places, then the most places.
Region reachable(const FloorPlan& plan, const Links& links, std::span<const Vec3> starts, float people) {
  const std::vector<Region> regions = connected_regions(plan, links);
  std::vector<std::size_t> region_of(plan.places.size());
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (const std::uint32_t place : regions[r]) region_of[place] = r;
  std::vector<char> chosen(regions.size());
  for (const Vec3& start : starts)
    if (const auto place = place_under(plan, start, people)) chosen[region_of[*place]] = 1;
  if (std::find(chosen.begin(), chosen.end(), 1) == chosen.end() && !regions.empty()) {
    const auto size = [&](const Region& region) {
      const auto covered =
          std::count_if(region.begin(), region.end(), [&](std::uint32_t p) { return plan.places[p].covered; });
      return std::pair<std::size_t, std::size_t>(covered, region.size());
    };
    const auto largest = std::max_element(regions.begin(), regions.end(),
                                          [&](const Region& a, const Region& b) { return size(a) < size(b); });
    chosen[static_cast<std::size_t>(largest - regions.begin())] = 1;
  }
  Region all;
  for (std::size_t r = 0; r < regions.size(); ++r)
    if (chosen[r]) all.insert(all.end(), regions[r].begin(), regions[r].end());
  return all;
}

// Of a region, what people walk on: all that has a roof, and of the open only what is near one or near a start. All of
// it where it has neither.
Region near_roofs(const FloorPlan& plan, const Links& links, const Region& region, std::span<const Vec3> starts,
                  const WalkOptions& options) {
  std::vector<float> left(plan.places.size(), -1);  // metres that may still be walked in the open
  std::vector<std::uint32_t> front;
  const auto begin = [&](std::uint32_t place, float metres) {
    if (left[place] < 0) front.push_back(place);
    left[place] = std::max(left[place], metres);
  };
  for (const std::uint32_t place : region)
    if (plan.places[place].covered) begin(place, options.doorstep_m);
  for (const Vec3& start : starts)
    if (const auto place = place_under(plan, start, options.size()); place && !plan.places[*place].covered)
      begin(*place, options.outdoors_m);
  if (front.empty()) return region;
  for (std::size_t at = 0; at < front.size(); ++at)  // a place is visited again where a longer walk reaches it
    for (const std::uint32_t next : links[front[at]])
      if (const float rest = left[front[at]] - plan.cell_m; rest >= 0 && rest > left[next]) {
        left[next] = rest;
        front.push_back(next);
      }
  Region kept = region;
  std::erase_if(kept, [&](std::uint32_t place) { return left[place] < 0; });
  return kept;
}

struct Standing {
  std::uint32_t x, z;
  float y;
};

// A grid just as large as its places, no two of which share a column.
WalkGrid make_grid(const FloorPlan& plan, std::span<const Standing> places, float eye_height) {
  UVec2 low(plan.width, plan.height), high(0);
  for (const Standing& p : places) {
    low = glm::min(low, UVec2(p.x, p.z));
    high = glm::max(high, UVec2(p.x, p.z));
  }
  WalkGrid grid;
  grid.lower = plan.lower + Vec2(low) * plan.cell_m;
  grid.cell_m = plan.cell_m;
  grid.width = high.x - low.x + 1;
  grid.height = high.y - low.y + 1;
  grid.eye_height_m = eye_height;
  grid.floor_y.assign(std::size_t{grid.width} * grid.height, std::numeric_limits<float>::quiet_NaN());
  for (const Standing& p : places) grid.floor_y[std::size_t{p.z - low.y} * grid.width + (p.x - low.x)] = p.y;
  return grid;
}

// Places by rising height, a new storey where they rise over the last one's lowest by the head room: two places of a
// column are further apart than that.
std::vector<WalkGrid> storeys(const FloorPlan& plan, const Region& region, const WalkOptions& options) {
  std::vector<Standing> places;
  std::size_t column = 0;
  for (const std::uint32_t place : region) places.push_back({0, place, plan.places[place].y});
  std::sort(places.begin(), places.end(), [](const Standing& a, const Standing& b) { return a.z < b.z; });
  for (Standing& p : places) {
    while (plan.first[column + 1] <= p.z) ++column;
    p.x = static_cast<std::uint32_t>(column % plan.width);
    p.z = static_cast<std::uint32_t>(column / plan.width);
  }
  std::stable_sort(places.begin(), places.end(), [](const Standing& a, const Standing& b) { return a.y < b.y; });
  std::vector<WalkGrid> grids;
  for (std::size_t from = 0, to = 0; from < places.size(); from = to) {
    while (to < places.size() && places[to].y < places[from].y + options.head_room_m) ++to;
    grids.push_back(make_grid(plan, std::span(places).subspan(from, to - from), options.eye_height_m));
  }
  return grids;
}

// Streams of random numbers, apart from those of reflectors, which are numbered from 0.
enum Stream : std::uint64_t { kPlannedFor = ~std::uint64_t{0}, kHeldOut = kPlannedFor - 1 };

std::vector<Vec3> draw_eyes(const EyeRegion& region, std::uint32_t count, std::uint64_t seed, Stream stream) {
  std::vector<Vec3> cells;
  std::vector<float> sides;
  for (const WalkGrid& grid : region.grids)
    for (std::size_t c = 0; c < grid.floor_y.size(); ++c)
      if (grid.walkable(c)) {
        cells.push_back(grid.eye(c));
        sides.push_back(grid.cell_m);
      }
  std::vector<Vec3> eyes;
  for (std::uint32_t i = 0; i < count; ++i) {
    Sampler sampler(seed, stream, i);
    const float pick = sampler.next1();
    const Vec2 in_cell = sampler.next2() - 0.5f;
    const float height = sampler.next1();
    const bool given = !region.points.empty() && (cells.empty() || i % 4 == 3);
    if (given) {
      const Vec3 beside = kBesideGiven * Vec3(2 * pick - 1, 2 * height - 1, 2 * in_cell.x);
      eyes.push_back(region.points[(cells.empty() ? i : i / 4) % region.points.size()] +
                     (stream == kHeldOut ? beside : Vec3(0)));
    } else if (!cells.empty()) {
      const auto c = std::min(static_cast<std::size_t>(pick * static_cast<float>(cells.size())), cells.size() - 1);
      const float up = (2 * height - 1) * kHeightVariation;
      eyes.push_back(cells[c] + Vec3(in_cell.x * sides[c], up, in_cell.y * sides[c]));
    } else {
      eyes.push_back(glm::mix(region.lower, region.upper, Vec3(pick, in_cell + 0.5f)));
    }
  }
  return eyes;
}

std::vector<Vec3> viewpoints(const Scene& scene) {
  std::vector<Vec3> eyes;
  for (const Camera& camera : scene.cameras)
    if (camera.vertical_fov_rad > 0) eyes.push_back(camera.eye);
  for (const CameraPath& path : scene.paths)
    for (const CameraKey& key : path.keys) eyes.push_back(key.eye);
  return eyes;
}

}  // namespace

Result<EyeRegion> find_eye_region(const Accel& accel, const EyeOptions& options, Context& context) {
  const Scene& scene = accel.scene();
  EyeRegion region;
  region.lower = scene.lower;
  region.upper = scene.upper;
  if (options.source == EyeSource::kBox) return region;
  if (options.source == EyeSource::kFile) {
    for (const DVec3& p : options.points) region.points.emplace_back(p - scene.origin);
    return region;
  }
  region.points = viewpoints(scene);
  // Without a camera buildings tell where to search: beside a ground plane of kilometres columns would be too coarse.
  const std::vector<Vec3> starts = region.points.empty() ? roofed_places(accel) : region.points;
  ORIEL_TRY(const FloorPlan plan, find_floors(accel, starts, options.walk, context));
  const Links links = both_ways(plan);
  const Region reached = reachable(plan, links, region.points, options.walk.size());
  const Region kept = near_roofs(plan, links, reached, region.points, options.walk);
  region.left_out_m2 = static_cast<float>(reached.size() - kept.size()) * plan.cell_m * plan.cell_m;
  region.grids = storeys(plan, kept, options.walk);
  if (region.grids.empty())
    region.note = fmt::format(
        "eye region: found no floor with {:.2g} m of head room to stand on; the bake is planned for {}",
        options.walk.head_room_m, region.points.empty() ? "eyes anywhere in the scene" : "the cameras' eyes");
  return region;
}

std::vector<Vec3> sample_eyes(const EyeRegion& region, std::uint32_t count, std::uint64_t seed) {
  return draw_eyes(region, count, seed, kPlannedFor);
}

std::vector<Vec3> held_out_eyes(const EyeRegion& region, std::uint32_t count, std::uint64_t seed) {
  return draw_eyes(region, count, seed, kHeldOut);
}

std::vector<EyeBox> eye_boxes(const EyeRegion& region) {
  std::vector<EyeBox> boxes;
  for (const WalkGrid& grid : region.grids) {
    float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
    for (const float y : grid.floor_y)
      if (!std::isnan(y)) low = std::min(low, y), high = std::max(high, y);
    const Vec2 far = grid.lower + grid.cell_m * Vec2(grid.width, grid.height);
    boxes.push_back({{grid.lower.x, low + grid.eye_height_m, grid.lower.y}, {far.x, high + grid.eye_height_m, far.y}});
  }
  for (const Vec3& eye : region.points) boxes.push_back({eye, eye});
  if (boxes.empty()) boxes.push_back({region.lower, region.upper});
  return boxes;
}

float distance_to(std::span<const EyeBox> boxes, const Vec3& point) {
  float nearest = std::numeric_limits<float>::max();
  for (const EyeBox& box : boxes)
    nearest = std::min(nearest, glm::distance(point, glm::clamp(point, box.lower, box.upper)));
  return nearest;
}

Result<std::vector<DVec3>> parse_eyes(std::string_view text, const std::string& name) {
  std::vector<DVec3> eyes;
  std::uint32_t line_number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    ++line_number;
    std::size_t read = std::min(line.find_first_not_of(" \t\r"), line.size());
    if (read == line.size() || line[read] == '#') continue;
    DVec3 eye(0);
    int numbers = 0;
    for (; read < line.size() && numbers < 3; ++numbers) {
      const auto [rest, error] = std::from_chars(line.data() + read, line.data() + line.size(), eye[numbers]);
      if (error != std::errc() || !std::isfinite(eye[numbers])) break;
      read = std::min(line.find_first_not_of(" \t\r", static_cast<std::size_t>(rest - line.data())), line.size());
    }
    if (numbers != 3 || read != line.size())
      return invalid(fmt::format("{}:{}", name, line_number), "found '{}', expected three numbers x y z", line);
    eyes.push_back(eye);
  }
  if (eyes.empty()) return invalid(name, "found no eye, expected lines of x y z");
  return eyes;
}

}  // namespace oriel
