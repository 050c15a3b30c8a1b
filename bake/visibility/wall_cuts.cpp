#include "bake/visibility/wall_cuts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "bake/jobs/parallel.h"
#include "bake/scene/box_tree.h"

namespace oriel {
namespace {

// Metres, for people of usual size.
constexpr float kLift = 0.02f;       // over the surface: carpets and thresholds are no walls
constexpr float kLeastWall = 0.5f;   // its length; legs of furniture are no walls
constexpr float kNarrow = 0.15f;     // strips beside a line, at least; between probes along a wall
constexpr float kSameWall = 0.05f;   // between the lines of a wall's two faces
constexpr float kStraight = 0.003f;  // off a line; a piece of a wall's foot, at least: shorter ones tell no direction
constexpr std::array kReach{0.1f, 0.2f, 0.4f};  // from a wall's face to open surface on either side

constexpr std::uint32_t kBlock = 64;  // triangles that share their bounds

// A part of a surface in one plane.
struct FlatPart {
  std::uint32_t surface = 0;
  Vec3 normal{0}, u{0}, v{0}, origin{0};  // u, v, normal: an orthonormal frame
  Vec2 lower{0}, upper{0};                // bounds along u and v from origin
  double area = 0;

  Vec2 flat(const Vec3& p) const { return {glm::dot(p - origin, u), glm::dot(p - origin, v)}; }
  Vec3 at(const Vec2& p, float height = 0) const { return origin + p.x * u + p.y * v + height * normal; }
};

Vec2 left_of(const Vec2& along) {
  return {-along.y, along.x};
}

// A straight line of a flat part, in metres along it.
struct WallLine {
  Vec2 on{0}, along{1, 0};  // along: unit
  float first = 0, last = 0, length = 0;
  std::vector<Vec2> pieces;  // from and to, along it

  float off(const Vec2& p) const { return glm::dot(p - on, left_of(along)); }
  float place(const Vec2& p) const { return glm::dot(p - on, along); }
  void add(float from, float to) {
    pieces.emplace_back(std::min(from, to), std::max(from, to));
    first = std::min(first, pieces.back().x), last = std::max(last, pieces.back().y);
    length += std::abs(to - from);
  }
  bool runs_along(const WallLine& other, float distance) const {
    const Vec2 middle = other.on + 0.5f * (other.first + other.last) * other.along;
    const float beside = 0.5f * (other.last - other.first);
    return std::abs(glm::dot(left_of(along), other.along)) < kStraight / kLeastWall &&
           std::abs(off(middle)) < distance && place(middle) + beside > first && place(middle) - beside < last;
  }
};

// Lines by their angle and by how far they pass from the middle of what they lie in.
class LineIndex {
 public:
  static constexpr float kTurned = kStraight / kLeastWall;  // radians between what runs along one line

  // reach: how far from the middle anything is, metres.
  LineIndex(const Vec2& middle, float reach, float scale)
      : middle_(middle), off_step_(kTurned * reach + kStraight * scale) {}
  void add(const WallLine& line, std::uint32_t index) { lines_[place(line, 0, 0)].push_back(index); }
  // The first one that is accepted, of those that nearly run along the line.
  template <class Accepts>
  std::optional<std::uint32_t> find(const WallLine& line, const Accepts& accepts) const {
    std::optional<std::uint32_t> first;
    for (const long turn : {-1, 0, 1})
      for (const long shift : {-1, 0, 1})
        if (const auto at = lines_.find(place(line, turn, shift)); at != lines_.end())
          for (const std::uint32_t i : at->second)
            if ((!first || i < *first) && accepts(i)) first = i;
    return first;
  }

 private:
  // A line has no sense: half a turn further it is the same one, which passes on the other side.
  std::pair<long, long> place(const WallLine& line, long turn, long shift) const {
    constexpr long kHalfTurn = static_cast<long>(kPi / kTurned);
    const long angle = std::lround(std::atan2(line.along.y, line.along.x) / kPi * kHalfTurn) + turn;
    const long within = (angle + 2 * kHalfTurn) % kHalfTurn;
    const float off = (angle - within) / kHalfTurn % 2 == 0 ? line.off(middle_) : -line.off(middle_);
    return {within, std::lround(off / off_step_) + shift};
  }

  Vec2 middle_;
  float off_step_;
  std::map<std::pair<long, long>, std::vector<std::uint32_t>> lines_;
};

class WallFinder {
 public:
  WallFinder(const Accel& accel, float scale, Context& context)
      : accel_(accel), scene_(accel.scene()), scale_(scale), context_(context), tree_(blocks()) {}

  Result<std::vector<ChartCut>> run() const {
    std::vector<FlatPart> parts;
    for (std::uint32_t s = 0; s < scene_.surfaces.size() && !context_.stopped(); ++s) {
      if (scene_.surfaces[s].mover >= 0 || scene_.materials[scene_.surfaces[s].material].unlit) continue;
      for (FlatPart& part : flat_parts(s)) parts.push_back(std::move(part));
    }
    std::vector<std::vector<ChartCut>> of_part(parts.size());
    // Ended early: what is there is kept.
    (void)parallel_for(context_, "walls", parts.size(), [&](std::size_t i) { of_part[i] = cuts_of(parts[i]); });
    if (context_.stop) return fail(ErrorCode::kStopped, "walls", "stopped");
    if (context_.stopped())
      context_.warning("time-over",
                       "walls: the light of rooms may mix under some of them, which were left out for want of --time; "
                       "a longer one finds them");
    std::vector<ChartCut> cuts;
    for (const auto& own : of_part) cuts.insert(cuts.end(), own.begin(), own.end());
    return cuts;
  }

 private:
  // Triangles of a surface in a row.
  struct Block {
    std::uint32_t first, count;
  };

  // Fills in blocks_.
  std::vector<TreeBox> blocks() {
    std::vector<TreeBox> bounds;
    for (const Surface& surface : scene_.surfaces)
      for (std::uint32_t i = 0; i < surface.triangle_count && surface.mover < 0; i += kBlock) {
        const Block& block =
            blocks_.emplace_back(surface.first_triangle + i, std::min(kBlock, surface.triangle_count - i));
        TreeBox& box = bounds.emplace_back();
        for (std::uint32_t t = block.first; t < block.first + block.count; ++t)
          for (const Vec3& p : corners(t)) box.add(DVec3(p));
      }
    return bounds;
  }

  std::array<Vec3, 3> corners(std::uint32_t triangle) const {
    const UVec3& t = scene_.triangles[triangle];
    return {scene_.positions[t.x], scene_.positions[t.y], scene_.positions[t.z]};
  }

  // Those that a wall fits on.
  std::vector<FlatPart> flat_parts(std::uint32_t s) const {
    const Surface& surface = scene_.surfaces[s];
    std::map<std::array<long, 4>, FlatPart> parts;
    for (std::uint32_t i = 0; i < surface.triangle_count; ++i) {
      const std::uint32_t t = surface.first_triangle + i;
      const Vec3 n = geometric_normal(scene_, t);
      const auto c = corners(t);
      const auto key = [](float value, float step) { return std::lround(value / step); };
      FlatPart& part =
          parts[{key(n.x, 1e-3f), key(n.y, 1e-3f), key(n.z, 1e-3f), key(glm::dot(n, c[0]), 0.1f * kLift * scale_)}];
      if (part.area == 0) {
        const Mat3 frame = frame_from_normal(n);
        part = {s, n, frame[0], frame[1], c[0], Vec2(0), Vec2(0), 0};
      }
      part.area += triangle_area(scene_, t);
      for (const Vec3& p : c)
        part.lower = glm::min(part.lower, part.flat(p)), part.upper = glm::max(part.upper, part.flat(p));
    }
    std::vector<FlatPart> wide;
    for (auto& [key, part] : parts) {
      const Vec2 size = part.upper - part.lower;
      if (std::min(size.x, size.y) > 2 * kNarrow * scale_ && std::max(size.x, size.y) > kLeastWall * scale_)
        wide.push_back(part);
    }
    return wide;
  }

  // What cuts the plane just above the part.
  std::vector<std::array<Vec2, 2>> feet(const FlatPart& part) const {
    const float lift = kLift * scale_;
    TreeBox box;
    for (const Vec2& p : {part.lower, Vec2(part.upper.x, part.lower.y), part.upper, Vec2(part.lower.x, part.upper.y)})
      box.add(DVec3(part.at(p, lift)));
    std::vector<std::uint32_t> near;
    tree_.near(box, near);
    std::vector<std::array<Vec2, 2>> found;
    for (const std::uint32_t b : near)
      for (std::uint32_t i = 0; i < blocks_[b].count; ++i) add_foot(part, corners(blocks_[b].first + i), found);
    std::ranges::stable_sort(found, std::greater(), [](const auto& e) { return glm::distance(e[0], e[1]); });
    return found;
  }

  void add_foot(const FlatPart& part, const std::array<Vec3, 3>& c, std::vector<std::array<Vec2, 2>>& found) const {
    std::array<float, 3> height;
    for (std::size_t k = 0; k < 3; ++k) height[k] = glm::dot(part.normal, c[k] - part.origin) - kLift * scale_;
    std::array<Vec2, 2> foot;
    std::size_t ends = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      if ((height[k] > 0) == (height[next] > 0)) continue;
      if (ends < 2) foot[ends++] = part.flat(glm::mix(c[k], c[next], height[k] / (height[k] - height[next])));
    }
    if (ends < 2 || glm::distance(foot[0], foot[1]) < kStraight * scale_) return;
    const Vec2 lower = glm::min(foot[0], foot[1]), upper = glm::max(foot[0], foot[1]);
    if (glm::any(glm::lessThan(upper, part.lower)) || glm::any(glm::greaterThan(lower, part.upper))) return;
    found.push_back(foot);
  }

  // Feet in one line without an opening as wide as the shortest wall: those of a wall or more.
  std::vector<WallLine> lines(const FlatPart& part) const {
    std::vector<WallLine> found;
    const Vec2 middle = 0.5f * (part.lower + part.upper);
    LineIndex known(middle, glm::distance(middle, part.upper), scale_);
    for (const auto& [a, b] : feet(part)) {
      if (context_.stopped()) return {};
      WallLine own{a, glm::normalize(b - a), 0, 0, 0, {}};
      const auto on = known.find(own, [&](std::uint32_t i) {
        const WallLine& line = found[i];
        return std::abs(glm::dot(left_of(line.along), own.along)) < LineIndex::kTurned &&
               std::max(std::abs(line.off(a)), std::abs(line.off(b))) < kStraight * scale_;
      });
      if (on) {
        found[*on].add(found[*on].place(a), found[*on].place(b));
      } else {
        own.add(0, glm::distance(a, b));
        known.add(own, static_cast<std::uint32_t>(found.size()));
        found.push_back(std::move(own));
      }
    }
    std::vector<WallLine> walls;
    for (WallLine& line : found) {
      std::ranges::sort(line.pieces, {}, [](const Vec2& piece) { return std::pair(piece.x, piece.y); });
      std::vector<Vec2> joined;
      for (const Vec2& piece : line.pieces)
        if (!joined.empty() && piece.x <= joined.back().y + kStraight * scale_)
          joined.back().y = std::max(joined.back().y, piece.y);
        else
          joined.push_back(piece);
      const std::size_t before = walls.size();
      for (const Vec2& piece : joined) {
        if (walls.size() == before || piece.x > walls.back().last + kLeastWall * scale_)
          walls.push_back({line.on, line.along, piece.x, piece.x, 0, {}});
        walls.back().add(piece.x, piece.y);
      }
    }
    std::erase_if(walls, [&](const WallLine& wall) { return wall.length < kLeastWall * scale_; });
    return walls;
  }

  // Whether the flat part is there, seen from the lifted plane.
  bool open(const FlatPart& part, const Vec2& p) const {
    const float lift = kLift * scale_;
    const Hit hit = accel_.intersect({part.at(p, lift), -part.normal, 2 * lift});
    return hit && hit.front && scene_.triangle_surface[hit.triangle] == part.surface &&
           glm::dot(geometric_normal(scene_, hit.triangle), part.normal) > 0.999f;
  }

  // Metres to what stands in the way, from open space.
  std::optional<float> blocked(const FlatPart& part, const Vec2& from, const Vec2& towards, float distance) const {
    const Vec3 direction = towards.x * part.u + towards.y * part.v;
    const Hit hit = accel_.intersect({part.at(from, kLift * scale_), direction, distance});
    if (!hit) return std::nullopt;
    const bool inside = !hit.front && !scene_.material_of(hit.triangle).double_sided;
    return inside ? std::nullopt : std::optional(hit.distance);
  }

  // From a point at a wall's foot to the wall's middle, across the line; none where no wall parts the surface.
  std::optional<float> to_middle(const FlatPart& part, const Vec2& p, const Vec2& across) const {
    for (const float usual : kReach) {
      const float reach = usual * scale_;
      const Vec2 left = p + reach * across, right = p - reach * across;
      if (!open(part, left) || !open(part, right)) continue;
      const auto to_left = blocked(part, left, -across, 2 * reach), to_right = blocked(part, right, across, 2 * reach);
      if (to_left && to_right) return 0.5f * (*to_right - *to_left);
    }
    return std::nullopt;
  }

  // The middle of the wall whose foot a line is, as far as it parts the surface.
  std::optional<WallLine> wall(const FlatPart& part, const WallLine& line) const {
    struct WallProbe {
      float off, from, to;
    };
    std::vector<WallProbe> probes;
    for (const Vec2& piece : line.pieces) {
      const int count = static_cast<int>(std::min(1024.0f, std::ceil((piece.y - piece.x) / (kNarrow * scale_))));
      const float step = (piece.y - piece.x) / static_cast<float>(count);
      for (int k = 0; k < count; ++k) {
        const float from = piece.x + static_cast<float>(k) * step;
        const Vec2 p = line.on + (from + 0.5f * step) * line.along;
        if (const auto off = to_middle(part, p, left_of(line.along))) probes.push_back({*off, from, from + step});
      }
    }
    if (probes.empty()) return std::nullopt;
    std::ranges::nth_element(probes, probes.begin() + static_cast<long>(probes.size() / 2), {}, &WallProbe::off);
    WallLine middle{line.on + probes[probes.size() / 2].off * left_of(line.along),
                    line.along,
                    probes[0].from,
                    probes[0].from,
                    0,
                    {}};
    for (const WallProbe& probe : probes) middle.add(probe.from, probe.to);
    if (middle.length < kLeastWall * scale_) return std::nullopt;
    return middle;
  }

  std::vector<WallLine> walls(const FlatPart& part) const {
    const std::vector<WallLine> feet = lines(part);
    std::vector<std::optional<WallLine>> middles(feet.size());
    // Stopped: run() notices.
    (void)parallel_for(context_, "", feet.size(), [&](std::size_t i) { middles[i] = wall(part, feet[i]); });
    std::vector<WallLine> found;
    for (auto& middle : middles) {
      if (!middle) continue;
      const auto other_face = std::ranges::find_if(
          found, [&](const WallLine& other) { return other.runs_along(*middle, kSameWall * scale_); });
      if (other_face == found.end()) {
        found.push_back(std::move(*middle));
      } else {
        for (const float end : {middle->first, middle->last}) {
          const float at = other_face->place(middle->on + end * middle->along);
          other_face->first = std::min(other_face->first, at), other_face->last = std::max(other_face->last, at);
        }
      }
    }
    std::ranges::stable_sort(found, std::greater(), [](const WallLine& line) { return line.last - line.first; });
    return found;
  }

  // Cuts cells, convex polygons, each by those walls that run through it.
  std::vector<ChartCut> cuts_of(const FlatPart& part) const {
    std::vector<ChartCut> cuts;
    using Cell = std::vector<Vec2>;
    std::vector<Cell> cells{
        {part.lower, Vec2(part.upper.x, part.lower.y), part.upper, Vec2(part.lower.x, part.upper.y)}};
    for (const WallLine& wall : walls(part)) {
      if (context_.stopped()) return {};  // run() notices
      const std::size_t count = cells.size();
      for (std::size_t c = 0; c < count; ++c) {
        Cell left, right;
        std::vector<float> crossings;
        float most_left = 0, most_right = 0;
        for (std::size_t k = 0; k < cells[c].size(); ++k) {
          const Vec2 &a = cells[c][k], &b = cells[c][(k + 1) % cells[c].size()];
          const float da = wall.off(a), db = wall.off(b);
          (da >= 0 ? left : right).push_back(a);
          most_left = std::max(most_left, da), most_right = std::max(most_right, -da);
          if ((da >= 0) == (db >= 0)) continue;
          const Vec2 on = glm::mix(a, b, da / (da - db));
          left.push_back(on), right.push_back(on);
          crossings.push_back(wall.place(on));
        }
        if (crossings.size() != 2 || std::min(most_left, most_right) < kNarrow * scale_) continue;
        const float from = std::min(crossings[0], crossings[1]), to = std::max(crossings[0], crossings[1]);
        if (std::min(to, wall.last) - std::max(from, wall.first) < 0.5f * kLeastWall * scale_) continue;
        cuts.push_back({part.at(wall.on + from * wall.along), part.at(wall.on + to * wall.along)});
        cells[c] = std::move(left);
        cells.push_back(std::move(right));
      }
    }
    return cuts;
  }

  const Accel& accel_;
  const Scene& scene_;
  float scale_;
  Context& context_;
  std::vector<Block> blocks_;  // of all that stands still
  BoxTree tree_;               // of them
};

}  // namespace

Result<std::vector<ChartCut>> find_wall_cuts(const Accel& accel, float scale, Context& context) {
  return WallFinder(accel, scale, context).run();
}

}  // namespace oriel
