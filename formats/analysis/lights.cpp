#include "formats/analysis/lights.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "formats/core/color.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

constexpr std::size_t kMostLights = 32;
constexpr std::size_t kPointsOfLight = 16;
constexpr int kSkyRays = 32;
constexpr float kFar = std::numeric_limits<float>::infinity();

bool lets_pass(const Material& m) {
  return m.transmission > 0 || m.alpha_mode != AlphaMode::kOpaque;
}

// A point of a light, and where it shines: into a cone around a direction; none: all around.
struct LightPoint {
  Vec3 at{0};
  std::optional<Vec3> shines{};
  float cone_cos = 0;
};

struct LightSource {
  std::string name;
  std::vector<LightPoint> points;
  std::optional<Vec3> from_afar{};  // towards it
};

std::vector<LightSource> emitting_parts(const Pack& pack) {
  std::vector<LightSource> out;
  for (const MeshPart& part : pack.mesh.parts) {
    const Material& m = pack.materials[part.material];
    if (m.unlit || !(luminance(m.emission) > 0)) continue;
    LightSource light{part.name, {}, {}};
    const std::uint32_t triangles = part.index_count / 3;
    const std::uint32_t step = std::max<std::uint32_t>(1, triangles / kPointsOfLight);
    for (std::uint32_t t = 0; t < triangles; t += step) {
      const std::size_t first = part.first_index + std::size_t{3} * t;
      const Vec3 n = triangle_normal(pack.mesh, first);
      const auto corner = [&](std::size_t k) { return pack.mesh.positions[pack.mesh.indices[first + k]]; };
      // Three points of each triangle: a panel of two is more than its middle.
      for (int k = 0; k < 3; ++k) {
        Vec3 at = (corner(0) + corner(1) + corner(2)) / 6.0f;
        at += 0.5f * corner(static_cast<std::size_t>(k));
        light.points.push_back({at, m.double_sided ? std::nullopt : std::optional(n)});
      }
    }
    out.push_back(std::move(light));
  }
  return out;
}

std::optional<DVec3> vector_of(const Json& json, const char* name) {
  if (!json.contains(name) || !json[name].is_array() || json[name].size() != 3) return std::nullopt;
  DVec3 out(0);
  for (int i = 0; i < 3; ++i) {
    if (!json[name][static_cast<std::size_t>(i)].is_number()) return std::nullopt;
    out[i] = json[name][static_cast<std::size_t>(i)].get<double>();
  }
  return out;
}

// As the plan of the bake has them; a pack's text may be anything.
std::vector<LightSource> punctual_lights(const Pack& pack) {
  std::vector<LightSource> out;
  const Json plan = Json::parse(pack.plan).value_or(Json());
  if (!plan.is_object() || !plan.contains("lights") || !plan["lights"].is_array()) return out;
  for (const Json& json : plan["lights"]) {
    if (!json.is_object()) continue;
    LightSource light{json.value("name", std::string()), {}, {}};
    const auto at = vector_of(json, "at"), towards = vector_of(json, "towards");
    if (at) {
      LightPoint& point = light.points.emplace_back();
      point.at = Vec3(*at - pack.mesh.origin);
      if (towards) point.shines = normalize_or(Vec3(*towards), Vec3(0, -1, 0));
      if (json.contains("outer_cone_rad") && json["outer_cone_rad"].is_number())
        point.cone_cos = std::cos(std::clamp(json["outer_cone_rad"].get<float>(), 0.0f, kPi));
    } else if (towards) {
      light.from_afar = normalize_or(-Vec3(*towards), Vec3(0, 1, 0));
    } else {
      continue;
    }
    out.push_back(std::move(light));
  }
  return out;
}

using Hiders = std::map<std::string, std::size_t>;

std::string most_of(const Hiders& hiders) {
  const auto most =
      std::max_element(hiders.begin(), hiders.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == hiders.end() ? std::string() : most->first;
}

LightVerdict judge(const Pack& pack, const MeshRays& rays, const SeenPoint& point, const LightSource& light) {
  LightVerdict out{light.name, LightVerdict::Kind::kFacesAway, {}, 0, 0};
  Hiders hiders;
  std::size_t seen = 0, turned = 0, before = 0;
  float nearest = kFar;
  for (const LightPoint& p : light.points) {
    const Vec3 way = p.at - point.at;
    const float distance = glm::length(way);
    nearest = std::min(nearest, distance);
    if (!(distance > 0) || glm::dot(way, point.normal) <= 0) continue;
    ++before;
    if (p.shines && -glm::dot(*p.shines, way) <= p.cone_cos * distance) {
      ++turned;
      continue;
    }
    const auto hit = first_blocker(pack, rays, point.at, way / distance, distance * (1 - 1e-4f) - point.eps);
    if (hit) {
      ++hiders[hit->name];
    } else {
      ++seen;
    }
  }
  out.distance_m = nearest == kFar ? 0 : nearest;
  if (seen > 0) {
    out.kind = LightVerdict::Kind::kLights;
    out.share = static_cast<float>(seen) / static_cast<float>(light.points.size());
  } else if (!hiders.empty()) {
    out.kind = LightVerdict::Kind::kHidden;
    out.by = most_of(hiders);
  } else if (before > 0 && turned == before) {
    out.kind = LightVerdict::Kind::kTurnedAway;
  }
  return out;
}

LightVerdict judge_from_afar(const Pack& pack, const MeshRays& rays, const SeenPoint& point, const std::string& name,
                             const std::vector<Vec3>& ways) {
  LightVerdict out{name, LightVerdict::Kind::kFacesAway, {}, 0, 0};
  Hiders hiders;
  std::size_t seen = 0;
  for (const Vec3& way : ways) {
    if (glm::dot(way, point.normal) <= 0) continue;
    const auto hit = first_blocker(pack, rays, point.at, way, kFar);
    if (hit) {
      ++hiders[hit->name];
    } else {
      ++seen;
    }
  }
  if (seen > 0) {
    out.kind = LightVerdict::Kind::kLights;
    out.share = static_cast<float>(seen) / static_cast<float>(ways.size());
  } else if (!hiders.empty()) {
    out.kind = LightVerdict::Kind::kHidden;
    out.by = most_of(hiders);
  }
  return out;
}

}  // namespace

std::optional<Blocker> first_blocker(const Pack& pack, const MeshRays& rays, const Vec3& from, const Vec3& direction,
                                     float farthest) {
  Vec3 start = from;
  float gone = 0;
  constexpr int kMostPanes = 8;
  for (int i = 0; i < kMostPanes; ++i) {
    const auto hit = rays.first(start, direction, farthest - gone);
    if (!hit) return std::nullopt;
    const auto part = rays.part(hit->first_index);
    if (!part) return std::nullopt;
    const bool front = glm::dot(triangle_normal(pack.mesh, hit->first_index), direction) < 0;
    if (!lets_pass(pack.materials[pack.mesh.parts[*part].material]))
      return Blocker{pack.mesh.parts[*part].name, *part, gone + hit->distance, front};
    const float on = hit->distance * (1 + 1e-5f) + 1e-6f;
    gone += on;
    start += on * direction;
  }
  return std::nullopt;
}

std::vector<Vec3> cosine_directions(const Vec3& normal, int count) {
  const Vec3 side =
      normalize_or(glm::cross(normal, std::fabs(normal.y) < 0.9f ? Vec3(0, 1, 0) : Vec3(1, 0, 0)), Vec3(1, 0, 0));
  const Vec3 other = glm::cross(normal, side);
  std::vector<Vec3> out;
  for (int i = 0; i < count; ++i) {
    // Vogel's spiral over the disk under the hemisphere.
    const float r2 = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
    const float turn = 2.39996323f * static_cast<float>(i);
    const float r = std::sqrt(r2);
    out.push_back(r * std::cos(turn) * side + r * std::sin(turn) * other + std::sqrt(1 - r2) * normal);
  }
  return out;
}

std::vector<LightVerdict> judge_lights(const Pack& pack, const MeshRays& rays, const SeenPoint& point,
                                       std::size_t& left_out) {
  std::vector<LightSource> lights = emitting_parts(pack);
  for (LightSource& light : punctual_lights(pack)) lights.push_back(std::move(light));
  left_out = lights.size() - std::min(lights.size(), kMostLights);
  // The nearest ones: of many lamps those tell.
  const auto distance = [&](const LightSource& light) {
    float nearest = light.from_afar ? 0 : kFar;
    for (const LightPoint& p : light.points) nearest = std::min(nearest, glm::distance(p.at, point.at));
    return nearest;
  };
  std::stable_sort(lights.begin(), lights.end(),
                   [&](const LightSource& a, const LightSource& b) { return distance(a) < distance(b); });
  lights.resize(lights.size() - left_out);
  std::vector<LightVerdict> out;
  for (const LightSource& light : lights)
    out.push_back(light.from_afar ? judge_from_afar(pack, rays, point, light.name, {*light.from_afar})
                                  : judge(pack, rays, point, light));
  if (luminance(pack.sky) > 0)
    out.push_back(judge_from_afar(pack, rays, point, "the sky", cosine_directions(point.normal, kSkyRays)));
  return out;
}

}  // namespace oriel
