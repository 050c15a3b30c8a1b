#include "bake/visibility/scene_unit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"

namespace oriel {
namespace {

constexpr std::uint32_t kPoints = 2048;            // of each kind
constexpr double kLow = 1.9, kHigh = 30;           // heights of rooms, m
constexpr double kFew = 0.02;                      // of the points of one kind, under a roof of that height
constexpr double kRooms = 0.05;                    // of them in rooms of any height, for these to tell
constexpr double kWidest = 20;                     // a room is no wider than that many of its heights
constexpr double kUsualFrom = 1.2, kUsualTo = 40;  // medians that are odd, but may be metres
constexpr double kNobodys = 1000;                  // m: no room is that high
constexpr double kUsual = 2.7, kStorey = 6;        // m: height of a storey, and of the highest but halls
constexpr double kFoot = 0.3048;
constexpr double kUnits[] = {0.001, 0.01, 0.0254, kFoot, 10, 100, 1000};  // m: mm, cm, in; dm, cm, mm made metres twice

// Points are drawn in three ways, for no single one is fair to all scenes: evenly over surfaces (a room of a hundred
// surfaces beside a ground plane of one), over triangles, and over square metres.
enum Kind : std::uint64_t { kBySurface, kByTriangle, kByArea, kKinds };

class Probe {
 public:
  explicit Probe(const Accel& accel) : accel_(accel), scene_(accel.scene()) {
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t)
      area_until_.push_back(area_ += triangle_area(scene_, t));
  }

  struct Found {
    double height = 0;  // between floor and ceiling; 0: the point is neither
    Vec3 floor{0};
    bool room = false;   // with walls
    bool faces = false;  // floor and ceiling show each other their fronts: it is no body from within, as a board is
    bool open = false;   // a floor with nothing overhead, between walls as high as those of rooms for people
  };

  // What the k-th point of a kind belongs to, where it faces up or down.
  Found find(Kind kind, std::uint32_t k) const {
    Sampler sampler(0x0417, kind, k);
    const std::uint32_t t = pick(kind, sampler.next2());
    const float slope = geometric_normal(scene_, t).y;
    if (std::abs(slope) < 0.9f) return {};
    const bool two_sided = scene_.material_of(t).double_sided;
    const Vec2 at = square_to_triangle(sampler.next2());
    const float towards = slope > 0 || (two_sided && k % 2 == 0) ? 1.0f : -1.0f;
    const Vec3 way{0, towards, 0}, start = spawn_origin(scene_, t, at, way);
    const Hit other = accel_.intersect({start, way});
    if (!other) {
      const auto walls_reach = [&](double h) { return between_walls(start + static_cast<float>(h) * way, h); };
      return {.floor = start, .open = towards > 0 && walls_reach(kLow) && !walls_reach(kHigh)};
    }
    const Vec3 end = start + other.distance * way, middle = 0.5f * (start + end);
    const Walls walls = walls_around(middle, other.distance);
    return {.height = other.distance,
            .floor = towards > 0 ? start : end,
            .room = walls.count >= 3 && !walls.of_body,
            .faces = towards * slope > 0 && other.front && !walls.of_body};
  }

 private:
  struct Walls {
    int count = 0;         // of four sides, no further away than rooms of that height are wide
    bool of_body = false;  // seen from within, as a board's; a box on another has fronts above and below
  };

  // A box that holds most of the scene is a room, though modelled as a body.
  Walls walls_around(const Vec3& from, double height) const {
    const auto reach = static_cast<float>(kWidest * height);
    Walls walls;
    int behind = 0;
    Vec3 width{0};
    for (const Vec3& side : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}}) {
      const Hit wall = accel_.intersect({from, side, reach});
      if (!wall) continue;
      ++walls.count, behind += !wall.front;
      width += wall.distance * glm::abs(side);
    }
    width.y = static_cast<float>(height);
    walls.of_body = 2 * behind > walls.count && glm::any(glm::lessThan(2.0f * width, scene_.upper - scene_.lower));
    return walls;
  }

  bool between_walls(const Vec3& from, double height) const { return walls_around(from, height).count >= 3; }

  std::uint32_t pick(Kind kind, const Vec2& u) const {
    const auto index = [](float x, std::size_t count) {
      return static_cast<std::uint32_t>(std::min(static_cast<std::size_t>(x * static_cast<float>(count)), count - 1));
    };
    const auto count = static_cast<std::uint32_t>(scene_.triangles.size());
    if (kind == kBySurface) {
      const Surface& s = scene_.surfaces[index(u.x, scene_.surfaces.size())];
      return s.triangle_count > 0 ? s.first_triangle + index(u.y, s.triangle_count) : index(u.y, count);
    }
    if (kind == kByTriangle) return index(u.x, count);
    const auto at = std::upper_bound(area_until_.begin(), area_until_.end(), u.x * area_) - area_until_.begin();
    return std::min(static_cast<std::uint32_t>(at), count - 1);
  }

  const Accel& accel_;
  const Scene& scene_;
  std::vector<double> area_until_;
  double area_ = 0;
};

bool fits_people(double height) {
  return height >= kLow && height <= kHigh;
}

// The median, each weighted by its square: a room counts for as much as people see of it, and the many gaps between
// boards and tiles for next to nothing. Not empty.
double typical_height(std::vector<double> heights) {
  std::sort(heights.begin(), heights.end());
  double sum = 0, run = 0;
  for (const double h : heights) sum += h * h;
  const auto middle =
      std::find_if(heights.begin(), heights.end() - 1, [&](double h) { return (run += h * h) >= sum / 2; });
  return *middle;
}

// The unit in which rooms of that height are likest to a storey. A whole scene smaller than a metre may have been
// scaled twice; a larger one with low rooms is a cupboard.
double likeliest_unit(double height, double extent) {
  double best = 1, least = std::fabs(std::log(height / kUsual));
  for (const double unit : kUnits) {
    const double off = std::fabs(std::log(unit * height / kUsual));
    if (unit * height >= kLow && off < least && (unit < 1 || extent < 1)) best = unit, least = off;
  }
  return best;
}

}  // namespace

std::vector<Vec3> roofed_places(const Accel& accel) {
  const Probe probe(accel);
  std::vector<Vec3> places;
  for (const Kind kind : {kBySurface, kByTriangle, kByArea})
    for (std::uint32_t k = 0; k < kPoints; ++k)
      if (const Probe::Found found = probe.find(kind, k); fits_people(found.height)) places.push_back(found.floor);
  return places;
}

std::optional<double> typical_room_height(const Accel& accel) {
  const Probe probe(accel);
  std::vector<double> heights;
  for (const Kind kind : {kBySurface, kByTriangle, kByArea})
    for (std::uint32_t k = 0; k < kPoints; ++k)
      if (const Probe::Found found = probe.find(kind, k); found.room) heights.push_back(found.height);
  if (heights.size() < kFew * kPoints) return std::nullopt;
  return typical_height(std::move(heights));
}

std::optional<UnitGuess> guess_unit(const Accel& accel) {
  const Probe probe(accel);
  std::vector<double> heights;  // of rooms
  // Some places are for people, if these are metres: of any height, and storeys; shelves in centimetres are as halls.
  bool rooms = false, fits = false, storeys = false;
  for (const Kind kind : {kBySurface, kByTriangle, kByArea}) {
    std::uint32_t people = 0, low = 0, here = 0;
    for (std::uint32_t k = 0; k < kPoints; ++k) {
      const Probe::Found found = probe.find(kind, k);
      const bool place = (fits_people(found.height) && found.faces) || found.open;
      people += place, low += place && found.height <= kStorey;
      if (found.room) heights.push_back(found.height), ++here;
    }
    fits = fits || people >= kFew * kPoints;
    storeys = storeys || low >= kFew * kPoints;
    rooms = rooms || here >= kRooms * kPoints;
  }
  if (!rooms) return std::nullopt;
  const Vec3 extent = accel.scene().upper - accel.scene().lower;
  const double height = typical_height(std::move(heights));
  const double unit = likeliest_unit(height, std::max({extent.x, extent.y, extent.z}));
  if (height >= kUsualFrom && height <= kUsualTo) {
    const bool feet = height * kFoot >= kLow && height * kFoot <= kStorey / 1.5 && accel.scene().cameras.empty();
    return feet ? std::optional(UnitGuess{1, height}) : std::nullopt;
  }
  const bool as_storeys = unit < 1 && unit * height <= kStorey;
  if ((as_storeys ? storeys : fits) && height < kNobodys) return std::nullopt;
  return unit == 1 ? std::nullopt : std::optional(UnitGuess{unit, height});
}

}  // namespace oriel
