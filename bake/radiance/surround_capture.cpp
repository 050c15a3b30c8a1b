#include "bake/radiance/surround_capture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/jobs/units.h"
#include "bake/radiance/surround_sight.h"
#include "bake/scene/sky.h"
#include "bake/trace/punctual.h"
#include "bake/trace/sampler.h"
#include "formats/core/octahedral.h"

namespace oriel {
namespace {

constexpr double kRaysARow = 2048;        // about
constexpr std::uint32_t kSunPoints = 64;  // of a disk
constexpr float kBeforeLight = 1e-4f;     // of its distance: what holds a light does not hide it

class SurroundCapture {
 public:
  SurroundCapture(const Accel& accel, const FoundCurvedReflectors& found, const FoundCurvedReflector& reflector,
                  const OutgoingRadiance& outgoing)
      : scene_(accel.scene()),
        outgoing_(outgoing),
        reflectance_(reflector.reflectance),
        lobe_texels_(std::pow(reflector.alpha * static_cast<float>(found.maps[reflector.reflector.map].size), 2.0f)),
        of_glass_(is_glass(scene_, reflector.triangles.front())),
        rays_(accel, found.objects[reflector.object], found.maps[reflector.reflector.map].centre, reflector.view) {}

  // The light of layers is asked for when it is known which of them lie outside: lobes are traced there, and a ray
  // leaves some bodies through dozens of surfaces.
  SurroundSight look(const Vec3& direction, Vec3& radiance) {
    SurroundSight sight = rays_.look(direction);
    radiance = Vec3(0);
    for (const SurroundSight::Layer& layer : sight.layers) {
      // What glass mirrors of what glass mirrors is a thousandth, but of a bulb too bright for a map's one distance.
      const bool faint = of_glass_ && is_glass(scene_, layer.hit.triangle);
      radiance += layer.share * usable_light(outgoing_({.hit = layer.hit,
                                                        .towards_eye = -direction,
                                                        .throughput = reflectance_ * layer.share,
                                                        .mirror = faint,
                                                        .averaged = std::max(1.0f, lobe_texels_),
                                                        .rays = &traced_}));
    }
    if (!sight.ended && sight.valid != 0) radiance += sight.throughput * usable_light(sky_radiance(scene_, direction));
    return sight;
  }
  std::uint64_t rays() const { return rays_.count() + traced_; }

  // The share of a light's light that comes from this far.
  Vec3 passed(const Vec3& direction, float distance) {
    const SurroundSight sight = rays_.look(direction, distance * (1 - kBeforeLight));
    return sight.ended || sight.valid == 0 ? Vec3(0) : sight.throughput;
  }

 private:
  const Scene& scene_;
  const OutgoingRadiance& outgoing_;
  float reflectance_;
  float lobe_texels_;  // of 4π sr in all: a lobe has 4πα²
  bool of_glass_;
  SurroundRays rays_;
  std::uint64_t traced_ = 0;  // by outgoing_
};

// Spreads over the four texels around a direction what has that integral over all directions.
void splat(SurroundMap& map, const Vec3& direction, const Vec3& lux) {
  const auto side = static_cast<float>(map.size);
  const Vec2 at = (octahedral_from_direction(direction) * 0.5f + 0.5f) * side - 0.5f, low = glm::floor(at);
  for (int i = 0; i < 4; ++i) {
    const Vec2 corner(i % 2, i / 2), share = glm::mix(1.0f - (at - low), at - low, corner);
    const IVec2 texel = wrap_octahedral(IVec2(low + corner), static_cast<int>(map.size));
    const float length = glm::length(direction_from_octahedral((Vec2(texel) + 0.5f) / side * 2.0f - 1.0f));
    const float steradians = 4 / (side * side * length * length * length);
    map.radiance[static_cast<std::size_t>(texel.y) * map.size + static_cast<std::size_t>(texel.x)] +=
        share.x * share.y / steradians * lux;
  }
}

void add_light(const Scene& scene, const Light& light, SurroundCapture& capture, SurroundMap& map) {
  if (light.type != LightType::kDirectional) {
    const Vec3 way = light.position - map.centre;
    const float distance = glm::length(way);
    if (!(distance > 0)) return;
    const Vec3 direction = way / distance, candela = punctual_intensity(scene, light, -direction);
    if (max_component(candela) > 0)
      splat(map, direction, usable_light(candela / (distance * distance) * capture.passed(direction, distance)));
    return;
  }
  const std::uint32_t points = light.angular_radius_rad > 0 ? kSunPoints : 1;
  for (std::uint32_t i = 0; i < points; ++i) {
    Sampler sampler(0, 0, i);
    const Vec3 direction =
        points > 1 ? sample_cone(-light.direction, light.angular_radius_rad, sampler.next2()) : -light.direction;
    const Vec3 through = capture.passed(direction, std::numeric_limits<float>::max());
    splat(map, direction, usable_light(light.intensity / static_cast<float>(points) * through));
  }
}

}  // namespace

void add_punctual_lights(const Accel& accel, FoundCurvedReflectors& found) {
  const Scene& scene = accel.scene();
  const OutgoingRadiance none;
  const bool hours = scene.day.hours.size() > 1;
  for (std::size_t i = 0; i < found.maps.size(); ++i) {
    SurroundCapture capture(accel, found, found.reflectors[i], none);
    for (const Light& light : scene.lights)
      if (!(hours && light.hour >= 0)) add_light(scene, light, capture, found.maps[i]);
  }
}

Status capture_surroundings(const Accel& accel, FoundCurvedReflectors& found, const OutgoingRadiance& outgoing,
                            const Stage& stage) {
  std::vector<UVec2> rows;  // map, row
  for (std::uint32_t i = 0; i < found.maps.size(); ++i) {
    SurroundMap& map = found.maps[i];
    const std::size_t texels = std::size_t{map.size} * map.size;
    map.radiance.resize(texels);
    map.inverse_distance.resize(texels);
    map.valid.resize(texels);
    for (std::uint32_t y = 0; y < map.size; ++y) rows.emplace_back(i, y);
  }
  UnitLoop loop{.stage = "surroundings", .count = rows.size(), .rays = kRaysARow};
  loop.inputs = [&](std::size_t row, Archive& key) {
    const SurroundMap& map = found.maps[rows[row].x];
    const FoundCurvedReflector& reflector = found.reflectors[rows[row].x];
    key(map.centre, map.size, rows[row].y, found.objects[reflector.object].triangles, reflector.reflectance,
        reflector.alpha, reflector.view);
  };
  loop.compute = [&](std::size_t row) {
    SurroundMap& map = found.maps[rows[row].x];
    SurroundCapture capture(accel, found, found.reflectors[rows[row].x], outgoing);
    const std::uint32_t y = rows[row].y;
    for (std::uint32_t x = 0; x < map.size; ++x) {
      const Vec2 at = (Vec2(x, y) + 0.5f) / static_cast<float>(map.size) * 2.0f - 1.0f;
      Vec3 radiance;
      const SurroundSight sight = capture.look(glm::normalize(direction_from_octahedral(at)), radiance);
      const std::size_t texel = std::size_t{y} * map.size + x;
      map.radiance[texel] = usable_light(radiance);
      map.inverse_distance[texel] = sight.inverse_distance;
      map.valid[texel] = sight.valid;
    }
    return capture.rays();
  };
  loop.results = [&](std::size_t row, Archive& archive) {
    SurroundMap& map = found.maps[rows[row].x];
    const std::size_t first = std::size_t{rows[row].y} * map.size;
    archive(std::span(map.radiance).subspan(first, map.size), std::span(map.inverse_distance).subspan(first, map.size),
            std::span(map.valid).subspan(first, map.size));
  };
  return parallel_units(stage, loop);
}

}  // namespace oriel
