#include "bake/radiance/capture.h"

#include <algorithm>

#include "bake/jobs/parallel.h"
#include "bake/radiance/reproject.h"
#include "bake/scene/light/sky.h"
#include "bake/trace/albedo.h"
#include "formats/core/check.h"

namespace oriel {
namespace {

constexpr int kMaxLayers = 64;             // of transmitting surfaces before the first opaque one
constexpr float kSeeThrough = 0.5f;        // transmittance from which depth is that of what lies behind
constexpr float kStep = 1.0f / (1 << 20);  // by which rays leave surfaces, relative to the size of coordinates

struct Pixel {
  Vec3 radiance{0};
  float disparity = 0;
  std::uint8_t valid = 2;
};

float finite_or_zero(float x) {
  return std::isfinite(x) && x > 0 ? x : 0.0f;
}
Vec3 finite_or_zero(const Vec3& c) {
  return {finite_or_zero(c.r), finite_or_zero(c.g), finite_or_zero(c.b)};
}

class Capture {
 public:
  Capture(const Accel& accel, const FoundReflector& found, const OutgoingRadiance& outgoing, const RadianceMap& map)
      : accel_(accel),
        scene_(accel.scene()),
        found_(found),
        outgoing_(outgoing),
        map_(map),
        normal_(Vec3(found.reflector.pack_from_reflector[2])) {
    // Coordinates' rounding near the reflector, and how far its triangles bulge from its plane.
    const Vec3 origin(found.reflector.pack_from_reflector[3]);
    step_ = kStep * (max_component(glm::abs(origin)) + glm::length(map.upper - map.lower));
  }

  Pixel trace(std::uint32_t x, std::uint32_t y) {
    const Vec3 q(map_point(map_, Vec2(x, y) + 0.5f), 0);
    const Vec3 direction = glm::normalize(Mat3(found_.reflector.pack_from_reflector) * glm::normalize(q - map_.eye));
    Ray ray{pack_from_reflector(found_.reflector, q) + step_ * normal_, direction};
    Pixel pixel;
    Vec3 throughput(1);
    std::uint32_t last = ~0u;
    for (int layer = 0; layer < kMaxLayers; ++layer) {
      const Hit hit = accel_.intersect(ray);
      ++rays_;
      if (!hit) {
        pixel.radiance += throughput * finite_or_zero(sky_radiance(scene_, direction));
        return pixel;
      }
      const Vec3 p = point_on(scene_, hit.triangle, hit.barycentric);
      if (!own(hit.triangle) && hit.triangle != last && end_at(hit, p, direction, throughput, pixel)) return pixel;
      last = hit.triangle;
      ray.origin = p + direction * (kStep * (max_component(glm::abs(p)) + step_) + 1e-7f * hit.distance);
    }
    return {Vec3(0), 0, 0};  // nothing opaque within reason
  }
  std::uint64_t rays() const { return rays_; }

 private:
  bool own(std::uint32_t triangle) const {
    const auto listed = [&](std::uint32_t t) {
      return std::binary_search(found_.triangles.begin(), found_.triangles.end(), t);
    };
    return listed(triangle) || (!scene_.twin.empty() && listed(scene_.twin[triangle]));
  }

  // Adds what the surface shows. True where the ray ends there.
  bool end_at(const Hit& hit, const Vec3& p, const Vec3& direction, Vec3& throughput, Pixel& pixel) const {
    const SceneMaterial& material = scene_.materials[scene_.surfaces[scene_.triangle_surface[hit.triangle]].material];
    Vec3 through(0);
    float coverage = 1;
    if (may_transmit(material) && !material.unlit) {  // light passes unlit surfaces, but eyes see them
      const ShadePoint point = shade_point(scene_, hit.triangle, hit.barycentric);
      coverage = point.coverage;
      through = straight_transmittance(point, std::abs(glm::dot(geometric_normal(scene_, hit.triangle), direction)));
    }
    const bool back = !hit.front && !material.double_sided;
    if (coverage > 0 && !back) pixel.radiance += throughput * coverage * finite_or_zero(outgoing_(hit, -direction));
    if (max_component(through) >= kSeeThrough) {
      throughput *= through;
      return false;
    }
    const float z = std::max(0.0f, reflector_from_pack(found_.reflector, p).z);
    pixel.disparity = disparity_of(map_, z);
    pixel.valid = back ? 0 : 1;
    if (back) pixel.radiance = Vec3(0);
    return true;
  }

  const Accel& accel_;
  const Scene& scene_;
  const FoundReflector& found_;
  const OutgoingRadiance& outgoing_;
  const RadianceMap& map_;
  Vec3 normal_;
  float step_;
  std::uint64_t rays_ = 0;
};

}  // namespace

Status capture_maps(const Accel& accel, std::span<const FoundReflector> reflectors, const OutgoingRadiance& outgoing,
                    const CaptureOptions& options, Context& context, std::vector<RadianceMap>& maps,
                    std::atomic<std::uint64_t>* rays) {
  for (const RadianceMap& map : maps) ORIEL_CHECK_LT(map.reflector, reflectors.size());
  return parallel_for(
      context, "radiance", maps.size(),
      [&](std::size_t i) {
        RadianceMap& map = maps[i];
        const std::size_t pixels = std::size_t{map.width} * map.height;
        map.has_emission = options.has_emission;
        map.radiance.resize(pixels);
        map.disparity.resize(pixels);
        map.valid.resize(pixels);
        Capture capture(accel, reflectors[map.reflector], outgoing, map);
        for (std::uint32_t y = 0; y < map.height && !context.stopped(); ++y)
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
