#include "bake/radiance/capture.h"

#include <algorithm>

#include "bake/jobs/units.h"
#include "bake/radiance/reproject.h"
#include "bake/scene/light/sky.h"
#include "formats/core/check.h"

namespace oriel {

Vec3 usable_light(const Vec3& c) {
  const auto channel = [](float x) { return std::isfinite(x) && x > 0 ? x : 0.0f; };
  return {channel(c.r), channel(c.g), channel(c.b)};
}

SeenLight see(const Surroundings& surroundings, const OutgoingRadiance& outgoing, std::uint32_t reflector,
              const Vec3& from, const Vec3& direction) {
  const auto& emitters = surroundings.reflectors()[reflector].emitters;
  SeenLight seen;
  std::uint64_t lobe_rays = 0;
  const auto add = [&](SeenSurface surface) {
    surface.rays = &lobe_rays;
    // The closed form shows the lamp itself; its images in other mirrors are here alone.
    surface.emission =
        surface.mirrors_passed > 0 || !std::binary_search(emitters.begin(), emitters.end(), surface.hit.triangle);
    seen.radiance += surface.throughput * usable_light(outgoing(surface));
    return true;
  };
  seen.sight = surroundings.look(reflector, from, direction, add);
  seen.rays = seen.sight.rays + lobe_rays;
  if (seen.sight.sky_direction != Vec3(0))
    seen.radiance +=
        seen.sight.sky_throughput * usable_light(sky_radiance(surroundings.accel().scene(), seen.sight.sky_direction));
  seen.radiance = seen.sight.state == Sight::kNothing ? Vec3(0) : usable_light(seen.radiance);
  return seen;
}

namespace {

constexpr double kRaysARow = 4096;  // about: many pixels see by way of lobes

std::uint64_t capture_row(const Surroundings& surroundings, const OutgoingRadiance& outgoing, std::uint32_t y,
                          RadianceMap& map) {
  const Reflector& reflector = surroundings.reflectors()[map.reflector].reflector;
  const Mat3 to_pack(reflector.pack_from_reflector);
  std::uint64_t rays = 0;
  for (std::uint32_t x = 0; x < map.width; ++x) {
    const Vec3 q(map_point(map, Vec2(x, y) + 0.5f), 0);
    const Vec3 direction = glm::normalize(to_pack * glm::normalize(q - map.eye));
    const SeenLight seen = see(surroundings, outgoing, map.reflector, pack_from_reflector(reflector, q), direction);
    const std::size_t at = std::size_t{y} * map.width + x;
    map.radiance[at] = seen.radiance;
    map.valid[at] = seen.sight.state;
    map.disparity[at] = seen.sight.state == Sight::kSurface || seen.sight.back
                            ? disparity_of(map, std::max(0.0f, glm::dot(seen.sight.offset, to_pack[2])))
                            : 0;
    rays += seen.rays;
  }
  return rays;
}

}  // namespace

Status capture_maps(const Surroundings& surroundings, const OutgoingRadiance& outgoing, Context& context,
                    std::vector<RadianceMap>& maps, std::atomic<std::uint64_t>* rays) {
  std::vector<UVec2> rows;  // map, row: large maps are shared by the threads too
  for (std::uint32_t i = 0; i < maps.size(); ++i) {
    RadianceMap& map = maps[i];
    ORIEL_CHECK_LT(map.reflector, surroundings.reflectors().size());
    const std::size_t pixels = std::size_t{map.width} * map.height;
    map.has_emission = surroundings.reflectors()[map.reflector].emitters.empty();
    map.radiance.resize(pixels);
    map.disparity.resize(pixels);
    map.valid.resize(pixels);
    for (std::uint32_t y = 0; y < map.height; ++y) rows.emplace_back(i, y);
  }
  UnitLoop loop{.stage = "radiance", .count = rows.size(), .rays = kRaysARow};
  loop.inputs = [&](std::size_t i, Archive& key) { key(frame_of(maps[rows[i].x]), rows[i].y); };
  loop.compute = [&](std::size_t i) { return capture_row(surroundings, outgoing, rows[i].y, maps[rows[i].x]); };
  loop.results = [&](std::size_t i, Archive& archive) {
    RadianceMap& map = maps[rows[i].x];
    const std::size_t first = std::size_t{rows[i].y} * map.width;
    archive(std::span(map.radiance).subspan(first, map.width), std::span(map.disparity).subspan(first, map.width),
            std::span(map.valid).subspan(first, map.width));
  };
  return parallel_units(context, loop, rays);
}

}  // namespace oriel
