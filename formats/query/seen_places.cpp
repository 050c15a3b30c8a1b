#include "formats/query/seen_places.h"

#include <algorithm>
#include <cmath>

#include "formats/core/octahedral.h"
#include "formats/core/parallel.h"

namespace oriel {
namespace {

constexpr float kSlack = 1e-3f;    // of the distance: maps and mesh are rounded apart
constexpr float kSteps = 65535;    // of a map's disparities or inverse distances, from 0 to the largest
constexpr int kMostLayers = 16;    // of surfaces at one place
constexpr int kMostMirrors = 6;    // on the way of a pixel
constexpr float kSmooth = 0.1f;    // roughness up to which maps follow what a reflector shows
constexpr float kImage = 0.5f;     // reflectance from which a map's distance is that of the image
constexpr float kOutside = 1e-4f;  // of the scene's diagonal
constexpr std::uint32_t kNoTriangle = ~0u;

std::uint16_t code_of(float share) {
  return static_cast<std::uint16_t>(std::clamp(share, 0.0f, 1.0f) * 65535 + 0.5f);
}

}  // namespace

SeenPlaces::SeenPlaces(const Mesh& mesh, std::span<const Material> materials, std::span<const Reflector> reflectors,
                       std::span<const FresnelMap> fresnel_maps)
    : rays_(mesh) {
  for (const Material& m : materials)
    surfaces_.push_back({m.double_sided, m.alpha_mode == AlphaMode::kBlend || m.transmission > 0,
                         m.unlit || max_component(m.emission) > 0});
  for (const Reflector& r : reflectors) {
    const Material& m = materials[r.material];
    if (m.roughness > kSmooth || m.fresnel_map < 0) continue;
    const std::vector<Vec3>& table = fresnel_maps[static_cast<std::size_t>(m.fresnel_map)].table;
    if (std::ranges::any_of(table, [](const Vec3& share) { return max_component(share) >= kImage; }))
      mirrors_.push_back(
          {glm::inverse(r.pack_from_reflector), Vec3(r.pack_from_reflector[2]), r.lower, r.upper, table});
  }
  if (mesh.positions.empty()) return;
  lower_ = upper_ = mesh.positions[0];
  for (const Vec3& p : mesh.positions) lower_ = glm::min(lower_, p), upper_ = glm::max(upper_, p);
}

// Fronts that have light or shine.
bool SeenPlaces::counts(const TriangleHit& hit) const {
  const auto part = rays_.part(hit.first_index);
  if (!part) return false;
  const MeshPart& of = rays_.mesh().parts[*part];
  const Surface& surface = surfaces_[of.material];
  return !surface.see_through && (hit.front || surface.two_sided) && (of.lightmap_page >= 0 || surface.shines);
}

SeenPlace SeenPlaces::place_at(const TriangleHit& hit) const {
  const Mesh& mesh = rays_.mesh();
  const MeshPart& part = mesh.parts[rays_.part(hit.first_index).value_or(0)];
  SeenPlace place;
  if (part.material < SeenPlace::kSky) place.material = static_cast<std::uint16_t>(part.material);
  if (part.lightmap_page < 0 || part.lightmap_page >= SeenPlace::kSky) return place;
  place.page = static_cast<std::uint16_t>(part.lightmap_page);
  const std::uint32_t* corners = &mesh.indices[hit.first_index];
  const Vec2 uv = (1 - hit.u - hit.v) * mesh.lightmap_uvs[corners[0]] + hit.u * mesh.lightmap_uvs[corners[1]] +
                  hit.v * mesh.lightmap_uvs[corners[2]];
  place.u = code_of(uv.x), place.v = code_of(uv.y);
  return place;
}

// last: the triangle that the pixel beside shows, which is asked first; becomes this one's.
std::optional<TriangleHit> SeenPlaces::meet(const Look& look, std::uint32_t& last) const {
  if (last != kNoTriangle) {
    const auto hit = meet_triangle(rays_.mesh(), last, look.from, look.direction);
    if (hit && std::abs(hit->distance - look.distance) <= look.slack && counts(*hit)) return hit;
  }
  float begin = std::max(look.distance - look.slack, 0.0f);
  const float end = look.distance + look.slack;
  for (int layer = 0; layer < kMostLayers && begin < end; ++layer) {
    auto hit = rays_.first(look.from + begin * look.direction, look.direction, end - begin);
    if (!hit) return std::nullopt;
    if (counts(*hit)) {
      last = static_cast<std::uint32_t>(hit->first_index);
      return hit;
    }
    begin = std::nextafter(begin + hit->distance * (1 + 1e-5f), end) + 1e-6f * look.distance;
  }
  return std::nullopt;
}

// Where the ray goes on from the first mirror on its way, if that shows an image there; the distance is what is left.
std::optional<SeenPlaces::Look> SeenPlaces::mirrored(const Look& look) const {
  const Mirror* nearest = nullptr;
  float way = look.distance - look.slack;
  for (const Mirror& mirror : mirrors_) {
    const float towards = -glm::dot(mirror.normal, look.direction);
    if (!(towards > 0)) continue;
    const Vec3 from(mirror.from_pack * Vec4(look.from, 1));
    const float t = from.z / towards;
    if (!(t > look.slack && t < way)) continue;
    const Vec2 at = Vec2(from) + t * Vec2(Mat3(mirror.from_pack) * look.direction);
    if (at != glm::clamp(at, mirror.lower, mirror.upper)) continue;
    if (max_component(lookup_by_cosine(mirror.reflectance, towards)) < kImage) continue;
    nearest = &mirror, way = t;
  }
  if (nearest == nullptr) return std::nullopt;
  // Its bounds may hold more than itself, and something may stand before it.
  const auto hit = rays_.first(look.from + look.slack * look.direction, look.direction, way);
  if (!hit || std::abs(hit->distance + look.slack - way) > look.slack) return std::nullopt;
  return Look{look.from + way * look.direction, glm::reflect(look.direction, nearest->normal), look.distance - way,
              look.slack};
}

bool SeenPlaces::is_outside(const Look& look) const {
  const Vec3 at = look.from + look.distance * look.direction;
  const float margin = kOutside * glm::length(upper_ - lower_);
  return at != glm::clamp(at, lower_ - margin, upper_ + margin);
}

SeenPlace SeenPlaces::find(const Look& look, std::uint32_t& last) const {
  Look left = look;
  for (int mirror = 0; mirror < kMostMirrors; ++mirror) {
    const auto next = mirrored(left);
    if (!next) break;
    left = *next;
    last = kNoTriangle;
  }
  if (const auto hit = meet(left, last)) return place_at(*hit);
  last = kNoTriangle;
  // Between two triangles, or by an edge: what is right beside.
  const Mat3 frame = frame_from_normal(left.direction);
  for (const Vec2& off : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
    Look beside = left;
    beside.from += left.slack * (off.x * frame[0] + off.y * frame[1]);
    beside.slack *= 2;
    if (const auto hit = meet(beside, last)) return place_at(*hit);
  }
  SeenPlace place;
  if (is_outside(left)) place.material = SeenPlace::kSky;
  return place;
}

// What is behind a surface that shines, which may be moved away; nothing where a mirror is on the way.
std::optional<SeenPixels::Behind> SeenPlaces::behind(const Look& look) const {
  if (mirrored(look)) return std::nullopt;
  float begin = look.distance + look.slack;
  for (int layer = 0; layer < kMostLayers; ++layer) {
    const auto hit = rays_.first(look.from + begin * look.direction, look.direction);
    if (!hit) return std::nullopt;
    begin += hit->distance;
    const auto part = rays_.part(hit->first_index);
    if (counts(*hit) && part && !surfaces_[rays_.mesh().parts[*part].material].shines)
      return SeenPixels::Behind{0, begin, place_at(*hit)};
    begin += look.slack;
  }
  return std::nullopt;
}

template <class Map, class RayOf, class SlackOf>
SeenPixels SeenPlaces::find_all(const Map& map, const IVec2& size, const RayOf& ray_of, const SlackOf& slack_of) const {
  SeenPixels out;
  out.places.resize(map.valid.size());
  std::vector<std::vector<SeenPixels::Behind>> behind_rows(static_cast<std::size_t>(size.y));
  for_each_parallel(behind_rows.size(), core_count(), [&](std::size_t y) {
    std::uint32_t last = kNoTriangle;
    for (std::size_t i = y * static_cast<std::size_t>(size.x); i < (y + 1) * static_cast<std::size_t>(size.x); ++i) {
      if (map.valid[i] == 0) continue;
      const SeenRay ray = ray_of(i);
      SeenPlace& place = out.places[i];
      if (!std::isfinite(ray.distance)) {
        place.material = SeenPlace::kSky;
        continue;
      }
      const Look look{ray.from, ray.direction, ray.distance, slack_of(i, ray)};
      place = find(look, last);
      if (place.material >= surfaces_.size() || !surfaces_[place.material].shines) continue;
      if (auto found = behind(look)) {
        found->pixel = static_cast<std::uint32_t>(i);
        behind_rows[y].push_back(*found);
      }
    }
  });
  for (const auto& row : behind_rows) out.behind.insert(out.behind.end(), row.begin(), row.end());
  return out;
}

SeenPixels SeenPlaces::of(const RadianceMap& map, const Reflector& reflector) const {
  float largest = 0;
  for (const float s : map.disparity) largest = std::max(largest, s);
  return find_all(
      map, {static_cast<int>(map.width), static_cast<int>(map.height)},
      [&](std::size_t i) { return seen_ray(map, reflector, i); },
      [&](std::size_t i, const SeenRay& ray) {
        const float s = map.disparity[i], to_plane = s < 1 ? ray.distance * s / (1 - s) : 0.0f;
        return kSlack * (ray.distance + to_plane) + largest / kSteps / (s * s) * to_plane;
      });
}

SeenPixels SeenPlaces::of(const SurroundMap& map) const {
  float largest = 0;
  for (const float inverse : map.inverse_distance) largest = std::max(largest, inverse);
  return find_all(
      map, IVec2(static_cast<int>(map.size)), [&](std::size_t i) { return seen_ray(map, i); },
      [&](std::size_t, const SeenRay& ray) {
        return kSlack * ray.distance + largest / kSteps * ray.distance * ray.distance;
      });
}

namespace {

// From the map's eye to the pixel's point of the plane, reflector space.
Vec3 way_to_plane(const RadianceMap& map, std::size_t pixel) {
  const Vec2 share = (Vec2(pixel % map.width, pixel / map.width) + 0.5f) / Vec2(map.width, map.height);
  return Vec3(glm::mix(map.lower, map.upper, share), 0) - map.eye;
}

}  // namespace

SeenRay seen_ray(const RadianceMap& map, const Reflector& reflector, std::size_t pixel) {
  const Vec3 way = way_to_plane(map, pixel);
  const float length = glm::length(way), s = map.disparity[pixel];
  const bool sky = map.valid[pixel] == 2 || !(s > 0);
  return {Vec3(reflector.pack_from_reflector * Vec4(map.eye + way, 1)),
          Mat3(reflector.pack_from_reflector) * (way / length),
          sky ? std::numeric_limits<float>::infinity() : (1 / s - 1) * length};
}

SeenRay seen_ray(const SurroundMap& map, std::size_t pixel) {
  const Vec2 at = (Vec2(pixel % map.size, pixel / map.size) + 0.5f) / static_cast<float>(map.size) * 2.0f - 1.0f;
  const float inverse = map.inverse_distance[pixel];
  return {map.centre, glm::normalize(direction_from_octahedral(at)),
          map.valid[pixel] == 2 || !(inverse > 0) ? std::numeric_limits<float>::infinity() : 1 / inverse};
}

void set_distance(SurroundMap& map, std::size_t pixel, float distance) {
  map.inverse_distance[pixel] = 1 / std::max(distance, 1e-12f);
  map.valid[pixel] = 1;
}

}  // namespace oriel
