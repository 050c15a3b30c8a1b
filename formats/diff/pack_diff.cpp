#include "formats/diff/pack_diff.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr double kDark = 0.01;  // of the scene's mean: darker surfaces are measured by it
using PartKey = std::tuple<std::string, std::string, std::size_t>;  // name, material, how many of these came before

struct Light {
  double lux = 0, variance = 0;
};

// Bilinear; texels that were not baked have light but no error.
Light light_at(const Pack& pack, const MeshPart& part, const Vec2& uv) {
  const LightmapPage& page = pack.lightmaps[static_cast<std::size_t>(part.lightmap_page)];
  const auto clamped = [](float at, std::uint32_t size) {
    return std::clamp(at * static_cast<float>(size) - 0.5f, 0.0f, static_cast<float>(size - 1));
  };
  const float x = clamped(uv.x, page.width), y = clamped(uv.y, page.height);
  const auto x0 = static_cast<std::size_t>(x), y0 = static_cast<std::size_t>(y);
  const std::size_t x1 = std::min<std::size_t>(x0 + 1, page.width - 1),
                    y1 = std::min<std::size_t>(y0 + 1, page.height - 1);
  const double tx = x - static_cast<float>(x0), ty = y - static_cast<float>(y0);
  Light light;
  const auto add = [&](std::size_t column, std::size_t row, double weight) {
    const std::size_t at = row * page.width + column;
    light.lux += weight * luminance(page.irradiance[at]);
    const double error = luminance(page.standard_error[at]);
    light.variance += weight * error * error;  // texels beside each other share their noise: no gain from blending
  };
  add(x0, y0, (1 - tx) * (1 - ty));
  add(x1, y0, tx * (1 - ty));
  add(x0, y1, (1 - tx) * ty);
  add(x1, y1, tx * ty);
  return light;
}

struct Sums {
  double weight = 0, lux = 0, variance = 0;
};

class PartSampler {
 public:
  PartSampler(const Pack& pack, const MeshPart& part) : pack_(pack), part_(part) {}

  std::size_t triangles() const { return part_.index_count / 3; }
  Vec3 corner(std::size_t t, std::size_t c) const { return pack_.mesh.positions[vertex(t, c)]; }
  double area(std::size_t t) const {
    return 0.5 * glm::length(glm::cross(DVec3(corner(t, 1) - corner(t, 0)), DVec3(corner(t, 2) - corner(t, 0))));
  }
  double area() const {
    double sum = 0;
    for (std::size_t t = 0; t < triangles(); ++t) sum += area(t);
    return sum;
  }
  Light at(std::size_t t, const Vec3& barycentric) const {
    Vec2 uv(0);
    for (std::size_t c = 0; c < 3; ++c) uv += barycentric[static_cast<int>(c)] * pack_.mesh.lightmap_uvs[vertex(t, c)];
    return light_at(pack_, part_, uv);
  }

 private:
  std::uint32_t vertex(std::size_t t, std::size_t c) const { return pack_.mesh.indices[part_.first_index + 3 * t + c]; }
  const Pack& pack_;
  const MeshPart& part_;
};

// Point i of a triangle, by the golden ratio in two dimensions (Roberts 2018), folded into the triangle.
Vec3 point_of(std::size_t i) {
  const double g = 1.32471795724474602596, n = static_cast<double>(i) + 1;
  double u = std::fmod(0.5 + n / g, 1.0), v = std::fmod(0.5 + n / (g * g), 1.0);
  if (u + v > 1) u = 1 - u, v = 1 - v;
  return {static_cast<float>(1 - u - v), static_cast<float>(u), static_cast<float>(v)};
}

template <class F>
void for_points(const PartSampler& part, std::size_t points, F&& visit) {
  const double area = part.area();
  for (std::size_t t = 0; t < part.triangles(); ++t) {
    const double share = area > 0 ? part.area(t) / area : 0;
    const auto n = std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(share * static_cast<double>(points))));
    for (std::size_t i = 0; i < n; ++i) visit(t, point_of(i), share / static_cast<double>(n));
  }
}

Sums mean_light(const PartSampler& part, std::size_t points) {
  Sums sums;
  for_points(part, points, [&](std::size_t t, const Vec3& at, double weight) {
    const Light light = part.at(t, at);
    sums.weight += weight;
    sums.lux += weight * light.lux;
    sums.variance += weight * light.variance;
  });
  return sums;
}

bool same_shape(const PartSampler& a, const PartSampler& b, const DVec3& offset) {
  if (a.triangles() != b.triangles()) return false;
  const double close = 1e-4 * (1 + std::sqrt(a.area()));
  for (std::size_t t = 0; t < a.triangles(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      if (glm::length(DVec3(a.corner(t, c)) - DVec3(b.corner(t, c)) + offset) > close) return false;
  return true;
}

std::map<PartKey, const MeshPart*> parts_of(const Pack& pack) {
  std::map<std::pair<std::string, std::string>, std::size_t> counts;
  std::map<PartKey, const MeshPart*> parts;
  for (const MeshPart& part : pack.mesh.parts) {
    if (part.lightmap_page < 0 || part.index_count == 0) continue;
    const std::string& material = pack.materials[part.material].name;
    parts[{part.name, material, counts[{part.name, material}]++}] = &part;
  }
  return parts;
}

SurfaceChange compare(const Pack& before, const MeshPart& a, const Pack& after, const MeshPart& b, std::size_t points) {
  const PartSampler first(before, a), second(after, b);
  const Sums was = mean_light(first, points), is = mean_light(second, points);
  SurfaceChange change;
  change.same_shape = same_shape(first, second, before.mesh.origin - after.mesh.origin);
  change.area_m2 = first.area();
  change.before_lux = was.lux;
  change.after_lux = is.lux;
  change.before_error_lux = std::sqrt(was.variance);
  change.after_error_lux = std::sqrt(is.variance);
  if (!change.same_shape) {
    change.rms_lux = std::abs(is.lux - was.lux);
    return change;
  }
  double squares = 0, noise = 0;
  for_points(first, points, [&](std::size_t t, const Vec3& at, double weight) {
    const Light x = first.at(t, at), y = second.at(t, at);
    squares += weight * (x.lux - y.lux) * (x.lux - y.lux);
    noise += weight * (x.variance + y.variance);
  });
  change.rms_lux = std::sqrt(squares);
  change.noise_lux = std::sqrt(noise);
  return change;
}

SurfaceChange only(const Pack& pack, const MeshPart& part, SurfaceState state, std::size_t points) {
  const PartSampler sampler(pack, part);
  const Sums light = mean_light(sampler, points);
  SurfaceChange change;
  change.state = state;
  change.area_m2 = sampler.area();
  (state == SurfaceState::kOnlyInFirst ? change.before_lux : change.after_lux) = light.lux;
  (state == SurfaceState::kOnlyInFirst ? change.before_error_lux : change.after_error_lux) = std::sqrt(light.variance);
  change.rms_lux = light.lux;
  return change;
}

// Leaves of a JSON object by their path.
void flatten(const nlohmann::json& json, const std::string& path, std::map<std::string, std::string>& leaves) {
  if (!json.is_object()) {
    leaves[path] = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    return;
  }
  for (const auto& [key, value] : json.items()) flatten(value, path.empty() ? key : path + "." + key, leaves);
}

std::map<std::string, std::string> leaves_of(const std::string& text) {
  std::map<std::string, std::string> leaves;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_discarded()) flatten(json, "", leaves);
  return leaves;
}

std::vector<OptionChange> diff_options(const std::string& before, const std::string& after) {
  const auto a = leaves_of(before), b = leaves_of(after);
  std::vector<OptionChange> changes;
  for (const auto& [name, value] : a)
    if (const auto at = b.find(name); at == b.end() || at->second != value)
      changes.push_back({name, value, at == b.end() ? "" : at->second});
  for (const auto& [name, value] : b)
    if (!a.contains(name)) changes.push_back({name, "", value});
  return changes;
}

}  // namespace

double SurfaceChange::change_lux() const {
  return std::sqrt(std::max(0.0, rms_lux * rms_lux - noise_lux * noise_lux));
}

double PackDiff::share(const SurfaceChange& surface) const {
  const double by = std::max({surface.before_lux, surface.after_lux, kDark * mean_lux});
  return by > 0 ? surface.change_lux() / by : 0;
}

double PackDiff::largest() const {
  double most = 0;
  for (const SurfaceChange& surface : surfaces) most = std::max(most, share(surface));
  return most;
}

PackDiff diff_packs(const Pack& before, const Pack& after, std::size_t points) {
  PackDiff diff;
  const auto first = parts_of(before), second = parts_of(after);
  const auto add = [&](const PartKey& key, SurfaceChange change) {
    std::tie(change.name, change.material) = std::pair(std::get<0>(key), std::get<1>(key));
    diff.surfaces.push_back(std::move(change));
  };
  for (const auto& [key, part] : first) {
    const auto at = second.find(key);
    add(key, at == second.end() ? only(before, *part, SurfaceState::kOnlyInFirst, points)
                                : compare(before, *part, after, *at->second, points));
  }
  for (const auto& [key, part] : second)
    if (!first.contains(key)) add(key, only(after, *part, SurfaceState::kOnlyInSecond, points));
  double area = 0;
  for (const SurfaceChange& s : diff.surfaces)
    if (s.state != SurfaceState::kOnlyInSecond) diff.mean_lux += s.area_m2 * s.before_lux, area += s.area_m2;
  if (area > 0) diff.mean_lux /= area;
  std::stable_sort(diff.surfaces.begin(), diff.surfaces.end(), [](const SurfaceChange& a, const SurfaceChange& b) {
    return a.change_lux() * a.area_m2 > b.change_lux() * b.area_m2;
  });
  diff.options = diff_options(before.provenance, after.provenance);
  return diff;
}

}  // namespace oriel
