#include "bake/radiance/capture.h"

#include <algorithm>

#include "bake/jobs/parallel.h"
#include "bake/radiance/reproject.h"
#include "bake/scene/light/sky.h"
#include "formats/core/check.h"

namespace oriel {
namespace {

struct Pixel {
  Vec3 radiance{0};
  float disparity = 0;
  std::uint8_t valid = 0;
};

float finite_or_zero(float x) {
  return std::isfinite(x) && x > 0 ? x : 0.0f;
}
Vec3 finite_or_zero(const Vec3& c) {
  return {finite_or_zero(c.r), finite_or_zero(c.g), finite_or_zero(c.b)};
}

class Capture {
 public:
  Capture(const Surroundings& surroundings, const OutgoingRadiance& outgoing, const RadianceMap& map)
      : surroundings_(surroundings), found_(surroundings.reflectors()[map.reflector]), outgoing_(outgoing), map_(map) {}

  Pixel trace(std::uint32_t x, std::uint32_t y) {
    const Vec3 q(map_point(map_, Vec2(x, y) + 0.5f), 0);
    const Mat3 to_pack(found_.reflector.pack_from_reflector);
    const Vec3 direction = glm::normalize(to_pack * glm::normalize(q - map_.eye)), normal = to_pack[2];
    Pixel pixel;
    const auto add = [&](SeenSurface surface) {
      const auto& emitters = found_.emitters;
      surface.emission = !std::binary_search(emitters.begin(), emitters.end(), surface.hit.triangle);
      pixel.radiance += surface.throughput * finite_or_zero(outgoing_(surface));
      return true;
    };
    const Sight sight = surroundings_.look(map_.reflector, pack_from_reflector(found_.reflector, q), direction, add);
    rays_ += sight.rays;
    pixel.valid = sight.state;
    if (sight.state == Sight::kNothing)
      pixel.radiance = Vec3(0);
    else if (sight.sky_direction != Vec3(0))
      pixel.radiance +=
          sight.sky_throughput * finite_or_zero(sky_radiance(surroundings_.accel().scene(), sight.sky_direction));
    if (sight.state == Sight::kSurface || sight.back)
      pixel.disparity = disparity_of(map_, std::max(0.0f, glm::dot(sight.offset, normal)));
    return pixel;
  }
  std::uint64_t rays() const { return rays_; }

 private:
  const Surroundings& surroundings_;
  const FoundReflector& found_;
  const OutgoingRadiance& outgoing_;
  const RadianceMap& map_;
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
  return parallel_for(
      context, "radiance", rows.size(),
      [&](std::size_t i) {
        RadianceMap& map = maps[rows[i].x];
        const std::uint32_t y = rows[i].y;
        Capture capture(surroundings, outgoing, map);
        for (std::uint32_t x = 0; x < map.width; ++x) {
          const Pixel pixel = capture.trace(x, y);
          const std::size_t at = std::size_t{y} * map.width + x;
          map.radiance[at] = finite_or_zero(pixel.radiance);
          map.disparity[at] = pixel.disparity;
          map.valid[at] = pixel.valid;
        }
        if (rays) *rays += capture.rays();
      },
      rays);
}

}  // namespace oriel
