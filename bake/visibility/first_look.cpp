#include "bake/visibility/first_look.h"

#include <algorithm>
#include <array>
#include <limits>

#include "bake/jobs/parallel.h"
#include "bake/scene/sky.h"
#include "formats/core/color.h"
#include "formats/query/camera.h"

namespace oriel {
namespace {

constexpr std::size_t kMostPlaces = 160;
constexpr int kStepDeg = 5, kColumns = 360 / kStepDeg, kRows = 18;   // of a panorama: from 45° below to 45° above
constexpr int kHalfWide = 45 / kStepDeg, kHalfHigh = 30 / kStepDeg;  // a frame of 16:9, in such steps
constexpr int kHalfAhead = 15 / kStepDeg;                            // of the middle, whose sight is measured
constexpr std::array<int, 2> kPitches{0, -10 / kStepDeg};            // level, and as people look at rooms
constexpr float kFovRad = kPi / 3;
constexpr float kClear_m = 0.5f, kClearDeg = 35;  // off what is within so much of eye height
constexpr double kLeastShown = 0.25;              // of the frame
constexpr int kMostBacks = 8;                     // that a ray passes: the player draws no backs
constexpr std::uint32_t kNothing = ~0u, kSky = ~0u - 1;

struct Seen {
  std::uint32_t part = kNothing;  // which surface, which way it faces
  float luminance = 0;            // cd/m²
  float distance = 0;             // metres; of surfaces
};

bool is_seen_through(const SceneMaterial& m) {
  return m.transmission >= 0.5f || (m.alpha_mode == AlphaMode::kBlend && m.alpha < 0.5f);
}

std::uint32_t facing(const Vec3& n) {
  const Vec3 a = glm::abs(n);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
  return static_cast<std::uint32_t>(2 * axis + (n[axis] < 0));
}

Seen look(const Accel& accel, const SurfaceLight& light, const Vec3& eye, const Vec3& direction) {
  const Scene& scene = accel.scene();
  Vec3 from = eye;
  for (int passed = 0; passed <= kMostBacks; ++passed) {
    const Hit hit = accel.intersect({from, direction});
    if (!hit) {
      const float sky = luminance(sky_radiance(scene, direction));
      return sky > 0 ? Seen{kSky, sky, 0} : Seen{};
    }
    const std::uint32_t surface = scene.triangle_surface[hit.triangle];
    const SceneMaterial& material = scene.materials[scene.surfaces[surface].material];
    if ((hit.front || material.double_sided) && !is_seen_through(material)) {
      const Vec3 at = point_on(scene, hit.triangle, hit.barycentric);
      const float shown = luminance(light(hit, -direction));
      return {surface * 6 + facing(geometric_normal(scene, hit.triangle)), shown, glm::distance(eye, at)};
    }
    from = spawn_origin(scene, hit.triangle, hit.barycentric, direction);
  }
  return {};
}

struct Weighed {
  Seen seen;
  double weight = 0;
};

struct View {
  double content = 0;  // light and variety
  double score = 0;    // with what else counts
  double shown = 0;    // share of the frame that shows surfaces
};

// By the light that surfaces typically send, so that one lamp in view does not outweigh a room; exp(entropy) is the
// number of parts where all fill the same share of the frame.
View judge(std::vector<Weighed>& frame, float typical) {
  std::sort(frame.begin(), frame.end(), [](const Weighed& a, const Weighed& b) { return a.seen.part < b.seen.part; });
  double all = 0, lit = 0, shown = 0, logs = 0;
  for (std::size_t i = 0; i < frame.size();) {
    double part = 0;
    const std::uint32_t id = frame[i].seen.part;
    for (; i < frame.size() && frame[i].seen.part == id; ++i) {
      const double w = frame[i].weight, y = frame[i].seen.luminance;
      all += w;
      if (id == kNothing) continue;
      if (id != kSky) shown += w;
      part += w * (typical > 0 ? std::min(y / typical, 1.0) : 1.0);
    }
    lit += part;
    if (part > 0) logs += part * std::log(part);
  }
  const double parts = lit > 0 ? std::exp(std::log(lit) - logs / lit) : 0;
  const double content = lit / all * std::log1p(parts);
  return {content, content, shown / all};
}

float typical_luminance(std::span<const std::vector<Seen>> seen) {
  std::vector<float> all;
  for (const std::vector<Seen>& views : seen)
    for (const Seen& s : views)
      if (s.part != kNothing && s.part != kSky && s.luminance > 0) all.push_back(s.luminance);
  if (all.empty()) return 0;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

float elevation_rad(int row) {
  return (static_cast<float>(row - kRows / 2) + 0.5f) * kStepDeg * kPi / 180;
}

float yaw_rad(int column) {
  return static_cast<float>(column) * kStepDeg * kPi / 180;
}

std::vector<Seen> panorama(const Accel& accel, const SurfaceLight& light, const Vec3& eye) {
  std::vector<Seen> seen;
  seen.reserve(std::size_t{kRows} * kColumns);
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      seen.push_back(look(accel, light, eye, forward_from(yaw_rad(column), elevation_rad(row))));
  return seen;
}

// How near something is at eye height, metres.
float clearance(const std::vector<Seen>& seen) {
  float nearest = std::numeric_limits<float>::max();
  for (int row = 0; row < kRows; ++row) {
    if (std::abs(elevation_rad(row)) > kClearDeg * kPi / 180) continue;
    for (int column = 0; column < kColumns; ++column) {
      const Seen& s = seen[static_cast<std::size_t>(row * kColumns + column)];
      if (s.distance > 0) nearest = std::min(nearest, s.distance * std::cos(elevation_rad(row)));
    }
  }
  return nearest;
}

// reach: the longest sight that counts, metres.
View judge_heading(const std::vector<Seen>& seen, int heading, int pitch, float typical, float reach) {
  std::vector<Weighed> frame;
  double ahead = 0, ahead_weight = 0;
  for (int row = pitch - kHalfHigh; row < pitch + kHalfHigh; ++row)
    for (int column = heading - kHalfWide; column <= heading + kHalfWide; ++column) {
      const int r = row + kRows / 2, c = (column + kColumns) % kColumns;
      const Seen& s = seen[static_cast<std::size_t>(r * kColumns + c)];
      const double weight = std::cos(elevation_rad(r));
      frame.push_back({s, weight});
      if (std::abs(column - heading) > kHalfAhead || std::abs(2 * (row - pitch) + 1) > 2 * kHalfAhead) continue;
      ahead += weight * std::min(s.distance, reach);
      ahead_weight += weight;
    }
  View view = judge(frame, typical);
  view.score *= std::sqrt(ahead / (ahead_weight * reach));
  return view;
}

std::vector<Vec3> places_on(std::span<const WalkGrid> grids) {
  std::vector<Vec3> all, chosen;
  for (const WalkGrid& grid : grids)
    for (std::size_t c = 0; c < grid.floor_y.size(); ++c)
      if (grid.walkable(c)) all.push_back(grid.eye(c));
  const std::size_t count = std::min(all.size(), kMostPlaces);
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(all[(2 * i + 1) * all.size() / (2 * count)]);
  return chosen;
}

// Whether most of what is overhead is the scene's, not sky.
bool is_roofed(const Accel& accel, const Vec3& eye) {
  int met = 0, all = 0;
  for (const float elevation_deg : {25.0f, 45.0f, 65.0f})
    for (int column = 0; column < kColumns; column += 9, ++all)
      met += bool(accel.intersect({eye, forward_from(yaw_rad(column), elevation_deg * kPi / 180)}));
  return 2 * met > all;
}

struct Choice {
  Camera camera;
  View view;
};

Result<Choice> look_from_floors(const Accel& accel, std::span<const Vec3> eyes, const SurfaceLight& light,
                                const std::function<bool()>& enough, Context& context) {
  std::vector<std::vector<Seen>> seen(eyes.size());  // empty where there was no time to look
  ORIEL_TRY_VOID(done_in_time(context, enough, [&] {
    return parallel_for(context, "", eyes.size(), [&](std::size_t i) { seen[i] = panorama(accel, light, eyes[i]); });
  }));
  if (seen[0].empty()) seen[0] = panorama(accel, light, eyes[0]);
  Vec3 low = eyes[0], high = eyes[0];
  float widest = 0;
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    low = glm::min(low, eyes[i]);
    high = glm::max(high, eyes[i]);
    if (!seen[i].empty()) widest = std::max(widest, clearance(seen[i]));
  }
  const float typical = typical_luminance(seen), reach = std::max(glm::distance(low, high), 2 * kClear_m);
  std::vector<Choice> best(eyes.size());
  ORIEL_TRY_VOID(parallel_for(context, "", eyes.size(), [&](std::size_t i) {
    if (seen[i].empty() || clearance(seen[i]) < std::min(kClear_m, widest)) return;
    for (int heading = 0; heading < kColumns; ++heading)
      for (const int pitch : kPitches) {
        const View view = judge_heading(seen[i], heading, pitch, typical, reach);
        if (view.score <= best[i].view.score) continue;
        const Vec3 forward = forward_from(yaw_rad(heading), static_cast<float>(pitch * kStepDeg) * kPi / 180);
        best[i] = {look_at(eyes[i], eyes[i] + forward, kFovRad), view};
      }
  }));
  return *std::max_element(best.begin(), best.end(),
                           [](const Choice& a, const Choice& b) { return a.view.score < b.view.score; });
}

// From twelve sides a little above, and from below where that shows twice as much.
Result<Choice> look_from_outside(const Accel& accel, const SurfaceLight& light, Context& context) {
  constexpr int kSides = 12, kWide = 32, kHigh = 18;
  std::vector<Camera> cameras;
  for (const bool above : {true, false})
    for (int side = 0; side < kSides; ++side)
      cameras.push_back(overview(accel.scene().lower, accel.scene().upper, 2 * kPi * side / kSides, above));
  std::vector<std::vector<Seen>> seen(cameras.size());
  ORIEL_TRY_VOID(parallel_for(context, "", cameras.size(), [&](std::size_t i) {
    for (int y = 0; y < kHigh; ++y)
      for (int x = 0; x < kWide; ++x) {
        const PixelRay ray =
            pixel_ray(cameras[i], static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, kWide, kHigh);
        seen[i].push_back(look(accel, light, ray.origin, ray.direction));
      }
  }));
  const float typical = typical_luminance(seen);
  Choice best{cameras[0], {}};
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    std::vector<Weighed> frame;
    for (const Seen& s : seen[i]) frame.push_back({s, 1});
    View view = judge(frame, typical);
    view.score *= i < kSides ? 1 : 0.5;
    if (view.score > best.view.score) best = {cameras[i], view};
  }
  return best;
}

}  // namespace

Result<FirstLook> find_first_look(const Accel& accel, std::span<const WalkGrid> grids, const SurfaceLight& light,
                                  Context& context, const std::function<bool()>& enough) {
  FirstLook first;
  bool roofed = false;
  double content = 0;
  if (const std::vector<Vec3> eyes = places_on(grids); !eyes.empty()) {
    ORIEL_TRY(const Choice choice, look_from_floors(accel, eyes, light, enough, context));
    first.camera = choice.camera;
    first.inside = choice.view.shown >= kLeastShown;
    content = choice.view.content;
    roofed = is_roofed(accel, choice.camera.eye);
  }
  if (!first.inside || !roofed) {
    ORIEL_TRY(const Choice choice, look_from_outside(accel, light, context));
    if (!first.inside || choice.view.content > content) first = {choice.camera, false};
  }
  first.camera.name = "start";
  return first;
}

}  // namespace oriel
