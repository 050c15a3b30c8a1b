#include "bake/visibility/floor_plan.h"

#include <algorithm>

#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

constexpr int kMaxLayers = 64;  // surfaces under each other in a column
constexpr int kProbes = 8;      // directions in which a body's radius is probed

class Searcher {
 public:
  Searcher(const Accel& accel, const WalkOptions& options)
      : accel_(accel),
        scene_(accel.scene()),
        options_(options),
        min_up_(std::cos(options.max_slope_deg * kPi / 180)),
        gap_(1e-4f + 1e-6f * max_component(glm::max(glm::abs(scene_.lower), glm::abs(scene_.upper)))) {}

  // The places of a column, by rising height.
  std::vector<Place> column(const Vec2& at) const {
    std::vector<Place> places;
    float ceiling = scene_.upper.y + 2 * options_.head_room_m;
    bool covered = false;
    Ray ray{{at.x, ceiling, at.y}, {0, -1, 0}};
    for (int layer = 0; layer < kMaxLayers; ++layer) {
      const Hit hit = accel_.intersect(ray);
      if (!hit) break;
      const float y = point_on(scene_, hit.triangle, hit.barycentric).y;
      if (is_floor(hit) && ceiling - y >= options_.head_room_m && has_room({at.x, y, at.y}))
        places.push_back({y, covered && ceiling - y <= options_.roof_m});
      ceiling = y;
      covered = true;
      ray.origin.y = std::min(y, ray.origin.y) - gap_;
    }
    std::reverse(places.begin(), places.end());
    return places;
  }

  bool can_step(const Vec3& from, const Vec3& to) const {
    const Vec3 way = to - from;
    const float horizontal = glm::length(Vec2(way.x, way.z));
    if (std::abs(way.y) > std::max(options_.step_m, horizontal * std::tan(options_.max_slope_deg * kPi / 180)))
      return false;
    return std::ranges::all_of(heights(), [&](float h) { return free(from + Vec3(0, h, 0), way); });
  }

 private:
  bool is_floor(const Hit& hit) const {
    const SceneMaterial& m = scene_.material_of(hit.triangle);
    return (hit.front || m.double_sided) && std::abs(geometric_normal(scene_, hit.triangle).y) >= min_up_;
  }

  // Heights over the floor at which a body is probed sideways: over a step, its middle, its head.
  std::array<float, 3> heights() const {
    const float low = options_.step_m + 0.1f, high = options_.head_room_m - 0.1f;
    return {low, 0.5f * (low + high), high};
  }

  bool free(const Vec3& origin, const Vec3& way) const {
    const float length = glm::length(way);
    return !(length > 0) || !accel_.intersect({origin, way / length, length});
  }

  // Walls are met by rays sideways, table tops by rays down.
  bool has_room(const Vec3& floor) const {
    const float low = options_.step_m, high = options_.head_room_m - gap_;
    for (int i = 0; i < kProbes; ++i) {
      const float angle = 2 * kPi * static_cast<float>(i) / kProbes;
      const Vec3 aside = options_.radius_m * Vec3(std::cos(angle), 0, std::sin(angle));
      for (const float h : heights())
        if (!free(floor + Vec3(0, h, 0), aside)) return false;
      if (!free(floor + aside + Vec3(0, high, 0), {0, low - high, 0})) return false;
    }
    return true;
  }

  const Accel& accel_;
  const Scene& scene_;
  const WalkOptions& options_;
  float min_up_;
  float gap_;  // surfaces closer together than this are one
};

// Lays the columns over the area that is searched.
FloorPlan lay_out(const Scene& scene, std::span<const Vec3> starts, const WalkOptions& options) {
  Vec2 lower(scene.lower.x, scene.lower.z), upper(scene.upper.x, scene.upper.z);
  if (!starts.empty()) {
    Vec3 low = starts[0], high = starts[0];
    for (const Vec3& s : starts) {
      low = glm::min(low, s);
      high = glm::max(high, s);
    }
    lower = glm::max(lower, Vec2(low.x, low.z) - options.reach_m);
    upper = glm::min(upper, Vec2(high.x, high.z) + options.reach_m);
  }
  FloorPlan plan;
  plan.lower = lower;
  const DVec2 size = glm::max(DVec2(upper - lower), DVec2(0));
  double cell = options.cell_m;
  const auto counts = [&] { return glm::max(glm::ceil(size / cell), DVec2(1)); };
  while (counts().x * counts().y > options.max_columns) cell *= 1.05;
  plan.cell_m = static_cast<float>(cell);
  plan.width = static_cast<std::uint32_t>(counts().x);
  plan.height = static_cast<std::uint32_t>(counts().y);
  return plan;
}

Vec2 middle(const FloorPlan& plan, std::size_t column) {
  return plan.lower + (Vec2(column % plan.width, column / plan.width) + 0.5f) * plan.cell_m;
}

}  // namespace

WalkOptions WalkOptions::scaled(float size) const {
  WalkOptions out = *this;
  for (float* length : {&out.cell_m, &out.head_room_m, &out.step_m, &out.radius_m, &out.eye_height_m}) *length *= size;
  return out;
}

Result<FloorPlan> find_floors(const Accel& accel, std::span<const Vec3> starts, const WalkOptions& options,
                              Context& context) {
  const Searcher searcher(accel, options);
  FloorPlan plan = lay_out(accel.scene(), starts, options);
  const std::size_t columns = std::size_t{plan.width} * plan.height;
  std::vector<std::vector<Place>> found(columns);
  ORIEL_TRY_VOID(parallel_for(context, "walk", plan.height, [&](std::size_t row) {
    for (std::size_t c = row * plan.width; c < (row + 1) * plan.width; ++c) found[c] = searcher.column(middle(plan, c));
  }));
  plan.first.assign(columns + 1, 0);
  for (std::size_t c = 0; c < columns; ++c) {
    plan.first[c + 1] = plan.first[c] + static_cast<std::uint32_t>(found[c].size());
    plan.places.insert(plan.places.end(), found[c].begin(), found[c].end());
  }
  // Of the neighbour's places the nearest in height.
  const auto link = [&](std::size_t column, std::size_t neighbour, int axis) {
    const auto at = [&](std::size_t c, float y) { return Vec3(middle(plan, c).x, y, middle(plan, c).y); };
    for (std::uint32_t i = plan.first[column]; i < plan.first[column + 1]; ++i) {
      Place& place = plan.places[i];
      std::int32_t best = -1;
      for (std::uint32_t k = plan.first[neighbour]; k < plan.first[neighbour + 1]; ++k)
        if (best < 0 ||
            std::abs(plan.places[k].y - place.y) < std::abs(plan.places[static_cast<std::size_t>(best)].y - place.y))
          best = static_cast<std::int32_t>(k);
      if (best >= 0 &&
          searcher.can_step(at(column, place.y), at(neighbour, plan.places[static_cast<std::size_t>(best)].y)))
        place.next[static_cast<std::size_t>(axis)] = best;
    }
  };
  ORIEL_TRY_VOID(parallel_for(context, "", plan.height, [&](std::size_t row) {
    for (std::size_t c = row * plan.width; c < (row + 1) * plan.width; ++c) {
      if (c + 1 < (row + 1) * plan.width) link(c, c + 1, 0);
      if (row + 1 < plan.height) link(c, c + plan.width, 1);
    }
  }));
  return plan;
}

}  // namespace oriel
