#include "bake/radiance/capture.h"

#include <algorithm>
#include <utility>

#include "bake/radiance/reproject.h"
#include "bake/scene/sky.h"
#include "formats/core/check.h"

namespace oriel {

Vec3 usable_light(const Vec3& c) {
  const auto channel = [](float x) { return x > 0 && x <= kAbsurdLight ? x : 0.0f; };
  return {channel(c.r), channel(c.g), channel(c.b)};
}

SeenLight see(const LitSurroundings& lit, std::uint32_t reflector, const Vec3& from, const Vec3& direction,
              const Cone& cone) {
  const auto& [surroundings, outgoing] = lit;
  const FoundReflector& mirror = surroundings.reflectors()[reflector];
  const auto& emitters = mirror.emitters;
  SeenLight seen;
  std::uint64_t lobe_rays = 0;
  const auto add = [&](SeenSurface surface) {
    surface.rays = &lobe_rays;
    // The closed form shows the lamp itself; its images in other mirrors are here alone.
    surface.emission =
        surface.mirrors_passed > 0 || !std::binary_search(emitters.begin(), emitters.end(), surface.hit.triangle);
    const Vec3 share = std::exchange(surface.throughput, mirror.reflectance * surface.throughput);
    seen.radiance += share * usable_light(outgoing(surface));
    return true;
  };
  seen.sight = surroundings.look(reflector, from, direction, add, cone);
  seen.rays = seen.sight.rays + lobe_rays;
  if (seen.sight.sky_direction != Vec3(0))
    seen.radiance +=
        seen.sight.sky_throughput * usable_light(sky_radiance(surroundings.accel().scene(), seen.sight.sky_direction));
  seen.radiance = seen.sight.state == Sight::kNothing ? Vec3(0) : usable_light(seen.radiance);
  return seen;
}

CaptureRay capture_ray(const Reflector& reflector, const RadianceMap& map, const Vec2& at) {
  const Vec3 q(map_point(map, at), 0);
  const Mat3 to_pack(reflector.pack_from_reflector);
  const Vec3 way = q - map.eye;
  const float distance = glm::length(way);
  // A pixel of the plane, as wide as it looks from the eye on average over directions.
  const Vec2 size = glm::abs(map_point(map, at + 1.0f) - Vec2(q));
  const float width = std::sqrt(size.x * size.y * std::abs(way.z) / distance);
  return {pack_from_reflector(reflector, q), glm::normalize(to_pack * (way / distance)), {width, width / distance}};
}

namespace {

constexpr std::uint32_t kRowsABand = 32;
constexpr double kRaysAMapBand =
    1 << 17;  // about, many pixels see by way of lobes: a unit of its own (bake/jobs/units.cpp)

// Some rows of a map: a unit of work.
struct MapBand {
  std::uint32_t map = 0, first_row = 0, rows = 0;
};

void capture_pixel(const LitSurroundings& lit, std::uint32_t x, std::uint32_t y, RadianceMap& map,
                   std::uint64_t& rays) {
  const Reflector& reflector = lit.around.reflectors()[map.reflector].reflector;
  const CaptureRay ray = capture_ray(reflector, map, Vec2(x, y) + 0.5f);
  const auto [sight, light, traced] = see(lit, map.reflector, ray.from, ray.direction, ray.cone);
  rays += traced;
  const bool has_depth = sight.state == Sight::kSurface || sight.back;
  const float height = std::max(0.0f, glm::dot(sight.offset, Vec3(reflector.pack_from_reflector[2])));
  const std::size_t at = std::size_t{y} * map.width + x;
  map.radiance[at] = light;
  map.disparity[at] = has_depth ? disparity_of(map, height) : 0;
  map.valid[at] = static_cast<std::uint8_t>(sight.state);
}

// The maps in bands, with room for their pixels.
std::vector<MapBand> make_bands(const ReflectedSurroundings& surroundings, std::vector<RadianceMap>& maps) {
  std::vector<MapBand> bands;
  for (std::uint32_t i = 0; i < maps.size(); ++i) {
    RadianceMap& map = maps[i];
    ORIEL_CHECK_LT(map.reflector, surroundings.reflectors().size());
    const std::size_t pixels = std::size_t{map.width} * map.height;
    map.has_emission = surroundings.reflectors()[map.reflector].emitters.empty();
    map.radiance.resize(pixels);
    map.disparity.resize(pixels);
    map.valid.resize(pixels);
    for (std::uint32_t y = 0; y < map.height; y += kRowsABand)
      bands.push_back({i, y, std::min(kRowsABand, map.height - y)});
  }
  return bands;
}

}  // namespace

Status capture_maps(const LitSurroundings& lit, const Stage& stage, std::vector<RadianceMap>& maps) {
  const std::vector<MapBand> bands = make_bands(lit.around, maps);
  UnitLoop loop{.stage = "radiance", .count = bands.size(), .rays = kRaysAMapBand};
  loop.inputs = [&](std::size_t i, Archive& key) {
    key(frame_of(maps[bands[i].map]), bands[i].first_row, bands[i].rows);
  };
  loop.compute = [&](std::size_t i) {
    const MapBand& band = bands[i];
    RadianceMap& map = maps[band.map];
    std::uint64_t rays = 0;
    for (std::uint32_t y = band.first_row; y < band.first_row + band.rows; ++y)
      for (std::uint32_t x = 0; x < map.width; ++x) capture_pixel(lit, x, y, map, rays);
    return rays;
  };
  loop.results = [&](std::size_t i, Archive& archive) {
    RadianceMap& map = maps[bands[i].map];
    const std::size_t first = std::size_t{bands[i].first_row} * map.width;
    const std::size_t count = std::size_t{bands[i].rows} * map.width;
    archive(std::span(map.radiance).subspan(first, count), std::span(map.disparity).subspan(first, count),
            std::span(map.valid).subspan(first, count));
  };
  return parallel_units(stage, loop);
}

}  // namespace oriel
