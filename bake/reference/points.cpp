#include "bake/reference/points.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>

namespace oriel {
namespace {

constexpr double kMaxGridPoints = 1e7;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t at = 0;;) {
    const std::size_t comma = line.find(',', at);
    fields.push_back(trimmed(line.substr(at, comma - at)));
    if (comma == std::string_view::npos) return fields;
    at = comma + 1;
  }
}

std::optional<double> number(std::string_view text) {
  double value = 0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<MeasurePoint> parse_point(const std::vector<std::string_view>& fields, const std::string& where) {
  if (fields.size() != 6)
    return invalid(where, "found {} value{}, expected six: x,y,z,nx,ny,nz", fields.size(),
                   fields.size() == 1 ? "" : "s");
  std::array<double, 6> values{};
  for (std::size_t i = 0; i < 6; ++i) {
    const auto value = number(fields[i]);
    if (!value) return invalid(where, "found '{}', expected a finite number", fields[i]);
    values[i] = *value;
  }
  const DVec3 normal(values[3], values[4], values[5]);
  if (normal == DVec3(0)) return invalid(where, "found the normal 0,0,0, expected a direction");
  return MeasurePoint{{values[0], values[1], values[2]}, normal, 0};
}

// Upward faces of one node, seen from above.
class UpwardFaces {
 public:
  UpwardFaces(const Scene& scene, const std::string& node) {
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
      if (scene.surfaces[scene.triangle_surface[t]].name != node) continue;
      named_ = true;
      if (geometric_normal(scene, t).y <= 0.5f) continue;
      std::array<DVec3, 3> corners;
      for (int i = 0; i < 3; ++i) {
        corners[static_cast<std::size_t>(i)] = DVec3(scene.positions[scene.triangles[t][i]]);
        lower_ = glm::min(lower_, corners[static_cast<std::size_t>(i)]);
        upper_ = glm::max(upper_, corners[static_cast<std::size_t>(i)]);
      }
      faces_.push_back(corners);
    }
  }

  bool named() const { return named_; }
  bool empty() const { return faces_.empty(); }
  const DVec3& lower() const { return lower_; }
  const DVec3& upper() const { return upper_; }

  // The height of the highest face at (x, z).
  std::optional<double> top(double x, double z) const {
    std::optional<double> highest;
    for (const auto& [a, b, c] : faces_) {
      const double area = cross(b - a, c - a);
      const double v = cross(DVec3(x, 0, z) - a, c - a) / area, w = cross(b - a, DVec3(x, 0, z) - a) / area;
      if (v < 0 || w < 0 || v + w > 1) continue;
      const double y = a.y + v * (b.y - a.y) + w * (c.y - a.y);
      highest = std::max(highest.value_or(y), y);
    }
    return highest;
  }

 private:
  static double cross(const DVec3& a, const DVec3& b) { return a.x * b.z - a.z * b.x; }

  bool named_ = false;
  std::vector<std::array<DVec3, 3>> faces_;
  DVec3 lower_{std::numeric_limits<double>::infinity()}, upper_{-std::numeric_limits<double>::infinity()};
};

}  // namespace

Result<std::vector<MeasurePoint>> parse_points(std::string_view table, const std::string& name) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (table.starts_with(kByteOrderMark)) table.remove_prefix(kByteOrderMark.size());
  std::vector<MeasurePoint> points;
  bool header_allowed = true;
  std::uint32_t line_number = 0;
  for (std::size_t at = 0; at < table.size();) {
    const std::size_t end = std::min(table.find('\n', at), table.size());
    const std::string_view line = trimmed(table.substr(at, end - at));
    at = end + 1;
    ++line_number;
    if (line.empty() || line.front() == '#') continue;
    const auto fields = fields_of(line);
    if (std::exchange(header_allowed, false) &&
        std::none_of(fields.begin(), fields.end(), [](auto field) { return number(field).has_value(); }))
      continue;
    ORIEL_TRY(MeasurePoint point, parse_point(fields, fmt::format("{}:{}", name, line_number)));
    point.line = line_number;
    points.push_back(point);
  }
  if (points.empty()) return invalid(name, "found no point, expected lines of x,y,z,nx,ny,nz");
  return points;
}

Result<std::vector<MeasurePoint>> grid_points(const Scene& scene, const GridSpec& grid) {
  const UpwardFaces faces(scene, grid.node);
  const std::string where = "--grid " + grid.node;
  if (!faces.named()) return fail(ErrorCode::kUsage, where, "found no node with a mesh of that name in the scene");
  if (faces.empty()) return fail(ErrorCode::kUsage, where, "found no upward face in this node, expected a floor");
  const DVec3 size = faces.upper() - faces.lower();
  const double nx = std::max(1.0, std::floor(size.x / grid.spacing_m * (1 + 1e-9)));
  const double nz = std::max(1.0, std::floor(size.z / grid.spacing_m * (1 + 1e-9)));
  if (nx * nz > kMaxGridPoints)
    return fail(ErrorCode::kUsage, where,
                "found {:.0f} x {:.0f} points, expected at most {:.0f}: choose a larger spacing", nx, nz,
                kMaxGridPoints);
  const DVec3 middle = 0.5 * (faces.lower() + faces.upper());
  std::vector<MeasurePoint> points;
  for (double j = 0; j < nz; ++j)
    for (double i = 0; i < nx; ++i) {
      const double x = middle.x + (i + 0.5 - nx / 2) * grid.spacing_m;
      const double z = middle.z + (j + 0.5 - nz / 2) * grid.spacing_m;
      if (const auto y = faces.top(x, z))
        points.push_back({scene.origin + DVec3(x, *y + grid.height_m, z), DVec3(0, 1, 0), 0});
    }
  return points;
}

}  // namespace oriel
