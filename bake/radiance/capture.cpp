#include "bake/radiance/capture.h"

#include <algorithm>
#include <array>

#include "bake/jobs/units.h"
#include "bake/radiance/reproject.h"
#include "bake/scene/light/sky.h"
#include "formats/core/check.h"

namespace oriel {

Vec3 usable_light(const Vec3& c) {
  const auto channel = [](float x) { return std::isfinite(x) && x > 0 ? x : 0.0f; };
  return {channel(c.r), channel(c.g), channel(c.b)};
}

namespace {

bool has_image(const SceneMaterial& material) {
  const auto slots = texture_slots(material);
  return std::any_of(slots.begin(), slots.end(), [](const TextureSlot* slot) { return slot->image >= 0; });
}

}  // namespace

SeenLight see(const Surroundings& surroundings, const OutgoingRadiance& outgoing, std::uint32_t reflector,
              const Vec3& from, const Vec3& direction) {
  const auto& emitters = surroundings.reflectors()[reflector].emitters;
  SeenLight seen;
  std::uint64_t lobe_rays = 0;
  const auto add = [&](SeenSurface surface) {
    const Scene& scene = surroundings.accel().scene();
    seen.textured |= has_image(scene.materials[scene.surfaces[scene.triangle_surface[surface.hit.triangle]].material]);
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
// From a pixel's centre: one place in each row and column of a 4 x 4 grid.
constexpr std::array<Vec2, 4> kPlaces = {Vec2(-0.125f, -0.375f), Vec2(0.375f, -0.125f), Vec2(-0.375f, 0.125f),
                                         Vec2(0.125f, 0.375f)};
constexpr float kSameDistance = 0.005f;  // of the distance: how far from its plane a surface goes on as the same,
constexpr float kSameNormal = 0.9f;      // while it turns by no more than this cosine

class MapRow {
 public:
  MapRow(const Surroundings& surroundings, const OutgoingRadiance& outgoing, RadianceMap& map)
      : surroundings_(surroundings),
        outgoing_(outgoing),
        map_(map),
        reflector_(surroundings.reflectors()[map.reflector].reflector),
        to_pack_(reflector_.pack_from_reflector) {}

  std::uint64_t capture(std::uint32_t y) {
    rays_ = 0;
    for (std::uint32_t x = 0; x < map_.width; ++x) capture_pixel(x, y);
    return rays_;
  }

 private:
  struct Seen {
    SeenLight light;
    Vec3 at{0};  // what it ended on, or its image; scene space
  };

  Seen look(const Vec2& place) {
    const Vec3 q(map_point(map_, place), 0);
    const Vec3 from = pack_from_reflector(reflector_, q);
    const Vec3 direction = glm::normalize(to_pack_ * glm::normalize(q - map_.eye));
    Seen seen{see(surroundings_, outgoing_, map_.reflector, from, direction)};
    seen.at = from + seen.light.sight.offset;
    rays_ += seen.light.rays;
    return seen;
  }

  static bool same_surface(const Seen& a, const Seen& b) {
    const Sight &s = a.light.sight, &t = b.light.sight;
    if (s.state != t.state || s.mirrored != t.mirrored) return false;
    if (s.state == Sight::kSky) return true;
    const float away = std::abs(glm::dot(s.normal, b.at - a.at));
    return away <= kSameDistance * glm::length(s.offset) && glm::dot(s.normal, t.normal) >= kSameNormal;
  }

  void capture_pixel(std::uint32_t x, std::uint32_t y) {
    const Vec2 middle = Vec2(x, y) + 0.5f;
    const Seen centre = look(middle);
    const Sight& sight = centre.light.sight;
    Vec3 light = centre.light.radiance;
    float count = 1;
    for (std::size_t i = 0; centre.light.textured && i < kPlaces.size(); ++i) {
      const Seen beside = look(middle + kPlaces[i]);
      if (same_surface(centre, beside)) light += beside.light.radiance, ++count;
    }
    const std::size_t at = std::size_t{y} * map_.width + x;
    map_.radiance[at] = light / count;
    map_.valid[at] = sight.state;
    map_.disparity[at] = sight.state == Sight::kSurface || sight.back
                             ? disparity_of(map_, std::max(0.0f, glm::dot(sight.offset, to_pack_[2])))
                             : 0;
  }

  const Surroundings& surroundings_;
  const OutgoingRadiance& outgoing_;
  RadianceMap& map_;
  const Reflector& reflector_;
  Mat3 to_pack_;
  std::uint64_t rays_ = 0;
};

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
  loop.compute = [&](std::size_t i) { return MapRow(surroundings, outgoing, maps[rows[i].x]).capture(rows[i].y); };
  loop.results = [&](std::size_t i, Archive& archive) {
    RadianceMap& map = maps[rows[i].x];
    const std::size_t first = std::size_t{rows[i].y} * map.width;
    archive(std::span(map.radiance).subspan(first, map.width), std::span(map.disparity).subspan(first, map.width),
            std::span(map.valid).subspan(first, map.width));
  };
  return parallel_units(context, loop, rays);
}

}  // namespace oriel
