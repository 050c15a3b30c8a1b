#include "scenes/kit/walk_path.h"

#include <algorithm>

#include "formats/core/check.h"

namespace oriel::sample {
namespace {

// The path as a fine polyline with the length up to each point.
struct Line {
  std::vector<DVec3> points;
  std::vector<double> lengths;

  void add(const DVec3& p) {
    const double step = points.empty() ? 0 : glm::distance(points.back(), p);
    if (!points.empty() && step < 1e-9) return;
    lengths.push_back(points.empty() ? 0 : lengths.back() + step);
    points.push_back(p);
  }
  // Beyond the end it goes on straight.
  DVec3 at(double length) const {
    const auto it = std::upper_bound(lengths.begin() + 1, lengths.end() - 1, length);
    const auto i = static_cast<std::size_t>(it - lengths.begin());
    const double t = (length - lengths[i - 1]) / (lengths[i] - lengths[i - 1]);
    return points[i - 1] + t * (points[i] - points[i - 1]);
  }
};

Line rounded(std::span<const Vec3> waypoints, double radius) {
  Line line;
  line.add(DVec3(waypoints.front()));
  for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) {
    const DVec3 before(waypoints[i - 1]), here(waypoints[i]), after(waypoints[i + 1]);
    const double reach = std::min(radius, 0.499 * std::min(glm::distance(before, here), glm::distance(here, after)));
    const DVec3 from = here + reach * glm::normalize(before - here), to = here + reach * glm::normalize(after - here);
    constexpr int kSteps = 64;
    for (int k = 0; k <= kSteps; ++k) {
      const double t = static_cast<double>(k) / kSteps;
      line.add((1 - t) * (1 - t) * from + 2 * t * (1 - t) * here + t * t * to);
    }
  }
  line.add(DVec3(waypoints.back()));
  return line;
}

// Share of the way at share t of the time: speed rises and falls linearly at the ends.
double eased(double t, double ease) {
  const double full = 1.0 / (1.0 - ease);
  if (t < ease) return 0.5 * full * t * t / ease;
  if (t > 1 - ease) return 1.0 - 0.5 * full * (1 - t) * (1 - t) / ease;
  return full * (t - 0.5 * ease);
}

}  // namespace

Path walk_along(std::string name, std::span<const Vec3> waypoints, const TrackOptions& options) {
  ORIEL_CHECK_LE(std::size_t{2}, waypoints.size());
  const Line line = rounded(waypoints, options.corner_radius);
  const double total = line.lengths.back();
  Path path;
  path.name = std::move(name);
  path.vertical_fov_rad = options.vertical_fov_rad;
  for (int i = 0; i < options.frames; ++i) {
    const double length = total * eased(static_cast<double>(i) / (options.frames - 1), options.ease);
    const DVec3 eye = line.at(length);
    path.times_s.push_back(static_cast<float>(i / options.frames_per_second));
    path.eyes.push_back(Vec3(eye));
    path.forwards.push_back(normalize_or(Vec3(line.at(length + options.look_ahead) - eye), Vec3(0, 0, -1)));
  }
  return path;
}

}  // namespace oriel::sample
