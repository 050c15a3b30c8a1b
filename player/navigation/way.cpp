#include "player/navigation/way.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <unordered_map>

namespace oriel {
namespace {

constexpr float kMostTime_s = 5;  // of a way, however long
constexpr float kStuck_s = 0.5f;
constexpr std::size_t kMostCells = 2'000'000;  // that are looked at: a second or two

// A* over the places where Floors::stand finds a floor, from cell to cell and across corners where both sides are free.
class Search {
 public:
  Search(const Floors& floors, const StepOptions& options, const Vec3& towards)
      : floors_(floors), options_(options), towards_(towards) {}

  // Stands from the start to the goal, or none.
  std::vector<Stand> find(const Stand& start, const Stand& goal) {
    std::vector<Stand> found;
    visit(start, [&](std::size_t at) {
      if (key(nodes_[at].stand) != key(goal)) return false;
      found = back_from(at);
      return true;
    });
    return found;
  }

  // To the stand whose feet are nearest to a point, of all that are reached.
  std::vector<Stand> find_nearest(const Stand& start, const Vec3& point) {
    std::size_t best = 0;
    float nearest = std::numeric_limits<float>::infinity();
    visit(start, [&](std::size_t at) {
      const float distance = glm::distance(floors_.floor_of(nodes_[at].stand), point);
      if (distance < nearest) nearest = distance, best = at;
      return false;
    });
    return back_from(best);
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Node {
    Stand stand;
    float cost = 0;
    std::size_t from = kNone;
    bool done = false;
  };

  // Stands in the order of what they cost until `ends` says so of one, all are done, or too many.
  template <class Ends>
  void visit(const Stand& start, const Ends& ends) {
    open(start, 0, kNone);
    while (!queue_.empty()) {
      const auto [cost, at] = queue_.top();
      queue_.pop();
      if (nodes_[at].done) continue;
      nodes_[at].done = true;
      if (ends(at) || nodes_.size() > kMostCells) return;
      expand(at);
    }
  }
  static std::uint64_t key(const Stand& s) { return std::uint64_t{s.grid} << 40 | s.cell; }

  void open(const Stand& stand, float cost, std::size_t from) {
    const auto [known, is_new] = by_key_.try_emplace(key(stand), nodes_.size());
    if (is_new) {
      nodes_.push_back({stand, cost, from, false});
    } else {
      Node& node = nodes_[known->second];
      if (node.done || cost >= node.cost) return;
      node.cost = cost;
      node.from = from;
    }
    queue_.push({cost + glm::distance(stand.eye, towards_), known->second});
  }

  std::optional<Stand> beside(const Stand& from, const Vec2& by) const {
    const auto next = floors_.stand(on_map(from.eye) + by, from.eye.y, options_);
    if (!next || from.eye.y - next->eye.y > options_.step_m) return std::nullopt;
    return next;
  }

  void expand(std::size_t at) {
    const Stand from = nodes_[at].stand;
    const float cost = nodes_[at].cost, cell = floors_.cell_of(from);
    const std::optional<Stand> sides[4] = {beside(from, {cell, 0}), beside(from, {-cell, 0}), beside(from, {0, cell}),
                                           beside(from, {0, -cell})};
    const auto take = [&](const std::optional<Stand>& to) {
      if (to) open(*to, cost + glm::distance(from.eye, to->eye), at);
    };
    for (const auto& side : sides) take(side);
    for (const int x : {0, 1})
      for (const int z : {2, 3})
        if (sides[x] && sides[z]) take(beside(from, {x == 0 ? cell : -cell, z == 2 ? cell : -cell}));
  }

  std::vector<Stand> back_from(std::size_t at) const {
    std::vector<Stand> out;
    for (; at != kNone; at = nodes_[at].from) out.push_back(nodes_[at].stand);
    std::reverse(out.begin(), out.end());
    return out;
  }

  const Floors& floors_;
  const StepOptions& options_;
  const Vec3 towards_;  // an eye: places on the way to it are looked at first
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, std::size_t> by_key_;
  using Entry = std::pair<float, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

// Whether somebody comes straight from one eye to the other, and a little beside that too: a way that grazes a corner
// is none.
bool is_straight(const Floors& floors, const Vec3& from, const Vec3& to, const StepOptions& options, float cell) {
  const Vec2 way = on_map(to) - on_map(from);
  const float length = glm::length(way);
  if (!(length > 0)) return true;
  const Vec2 aside = 0.25f * cell * Vec2(-way.y, way.x) / length;
  const int strides = static_cast<int>(std::ceil(length / (0.25f * cell)));
  float level = from.y;
  for (int i = 1; i <= strides; ++i) {
    const Vec2 at = on_map(from) + way * (static_cast<float>(i) / static_cast<float>(strides));
    for (const Vec2& beside : {at + aside, at - aside}) {
      const auto next = floors.stand(beside, level, options);
      if (!next || level - next->eye.y > options.step_m) return false;
    }
    const auto next = floors.stand(at, level, options);
    if (!next || level - next->eye.y > options.step_m) return false;
    level = next->eye.y;
  }
  return std::fabs(level - to.y) <= options.step_m;
}

// The corners of a way over stands: the last stand that is straight ahead is the next one.
std::vector<Vec3> corners_of(const Floors& floors, const Vec3& eye, const std::vector<Stand>& stands,
                             const StepOptions& step) {
  std::vector<Vec3> way;
  std::size_t at = 0;
  if (on_map(stands.front().eye) != on_map(eye)) way.push_back(stands.front().eye);
  while (at + 1 < stands.size()) {
    std::size_t next = at + 1;
    // Doubling steps first: long ways across halls are looked at a few times, not at each of their cells.
    for (std::size_t step_by = 2; at + step_by < stands.size(); step_by *= 2) {
      if (!is_straight(floors, stands[at].eye, stands[at + step_by].eye, step, floors.cell_of(stands[at]))) break;
      next = at + step_by;
    }
    while (next + 1 < stands.size() &&
           is_straight(floors, stands[at].eye, stands[next + 1].eye, step, floors.cell_of(stands[at])))
      ++next;
    way.push_back(stands[next].eye);
    at = next;
  }
  if (way.empty()) way.push_back(stands.back().eye);
  return way;
}

// As Floors::walk: coarse columns take a stair's several steps at once.
StepOptions steps_on(const Floors& floors, const WayOptions& options) {
  StepOptions step = options.step;
  step.step_m = std::max(step.step_m, floors.coarsest_cell_m());
  return step;
}

}  // namespace

std::vector<Vec3> find_way(const Floors& floors, const Vec3& eye, const Vec3& goal, const WayOptions& options) {
  const StepOptions step = steps_on(floors, options);
  const auto start = floors.nearest_stand(eye, options.reach_m, step);
  const auto end = floors.nearest_stand_on(goal, options.reach_m, step);
  if (!start || !end) return {};
  const std::vector<Stand> stands = Search(floors, step, end->eye).find(*start, *end);
  return stands.empty() ? std::vector<Vec3>() : corners_of(floors, eye, stands, step);
}

std::optional<NearestWay> find_nearest_way(const Floors& floors, const Vec3& eye, const Vec3& goal,
                                           const WayOptions& options) {
  const StepOptions step = steps_on(floors, options);
  const auto short_of = [&](const Stand& stand) { return glm::distance(floors.floor_of(stand), goal); };
  if (const auto start = floors.nearest_stand(eye, options.reach_m, step)) {
    const std::vector<Stand> stands = Search(floors, step, goal).find_nearest(*start, goal);
    return NearestWay{corners_of(floors, eye, stands, step), short_of(stands.back()), false};
  }
  const auto end = floors.nearest_to(goal);
  if (!end) return std::nullopt;
  return NearestWay{{end->eye}, short_of(*end), true};
}

Walker start_walking(const Vec3& eye, std::vector<Vec3> way, float speed_m_s) {
  float length = 0;
  Vec3 last = eye;
  for (const Vec3& corner : way) {
    length += glm::distance(last, corner);
    last = corner;
  }
  Walker walker;
  walker.way = std::move(way);
  walker.speed_m_s = std::max(speed_m_s, length / kMostTime_s);
  return walker;
}

namespace {

// Straight through the air, as fast as the way's length asks for.
Vec3 glide_on(Walker& walker, const Vec3& eye, float dt) {
  if (!walker.on()) return eye;
  const Vec3 way = walker.way.front() - eye;
  const float distance = glm::length(way), by = walker.speed_m_s * dt;
  if (by < distance) return eye + way * (by / distance);
  const Vec3 there = walker.way.front();
  walker.way.erase(walker.way.begin());
  return there;
}

}  // namespace

Vec3 walk_on(Walker& walker, const Vec3& eye, float dt_s) {
  constexpr float kThere_m = 1e-3f;
  const float dt = std::clamp(dt_s, 0.0f, 0.1f);
  if (walker.glides) return glide_on(walker, eye, dt);
  while (walker.on() && glm::distance(on_map(walker.way.front()), on_map(eye)) < kThere_m) {
    walker.way.erase(walker.way.begin());
    walker.nearest_m = std::numeric_limits<float>::infinity();
  }
  if (!walker.on()) return eye;
  const Vec2 way = on_map(walker.way.front()) - on_map(eye);
  const float distance = glm::length(way);
  walker.stuck_s += dt;
  if (distance < walker.nearest_m - kThere_m) {
    walker.nearest_m = distance;
    walker.stuck_s = 0;
  }
  if (walker.stuck_s > kStuck_s) {
    walker.way.clear();
    return eye;
  }
  const Vec2 to = on_map(eye) + way * std::min(walker.speed_m_s * dt / distance, 1.0f);
  return {to.x, eye.y, to.y};
}

}  // namespace oriel
