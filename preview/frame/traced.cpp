#include "preview/frame/traced.h"

#include "bake/jobs/parallel.h"
#include "bake/scene/sky.h"
#include "bake/trace/albedo.h"
#include "bake/trace/polygon_light.h"
#include "bake/trace/sampler.h"
#include "bake/trace/shading.h"

namespace oriel {
namespace {

constexpr int kMostBounces = 4;      // of mirrors after each other
constexpr float kMirrorLike = 0.2f;  // alpha up to which a surface that a ray meets is followed
constexpr float kSame = 0.02f;       // of the distance: a point that the frame shows is the one that the ray meets

class SpecularTracer {
 public:
  SpecularTracer(const PreviewScene& scene, const TracedFrame& frame)
      : scene_(scene), frame_(frame), transport_(scene.transport()) {}

  Vec3 pixel(std::size_t i, Sampler& sampler) const {
    const Vec3 place(frame_.place[i]);
    const Vec3 to_eye = glm::normalize(frame_.eye.w > 0 ? Vec3(frame_.eye) - place : Vec3(frame_.eye));
    // The first object is known from the frame's own picture of items.
    const auto triangle = static_cast<std::uint32_t>(frame_.place[i].w) - 1;
    const Scene& s = scene_.scene();
    const bool front = glm::dot(geometric_normal(s, triangle), to_eye) >= 0;
    const Hit hit{triangle, 0, barycentric_of(triangle, place), front};
    return leaving(surface_at(s, hit, -to_eye), to_eye, 0, sampler);
  }

 private:
  Vec2 barycentric_of(std::uint32_t triangle, const Vec3& p) const {
    const UVec3& t = scene_.scene().triangles[triangle];
    const DVec3 a(scene_.scene().positions[t.x]), b(scene_.scene().positions[t.y]), c(scene_.scene().positions[t.z]);
    const DVec3 n = glm::cross(b - a, c - a);
    const double area = std::max(glm::dot(n, n), 1e-300);
    const double u = glm::dot(glm::cross(DVec3(p) - a, c - a), n) / area;
    const double v = glm::dot(glm::cross(b - a, DVec3(p) - a), n) / area;
    const double x = std::clamp(u, 0.0, 1.0), y = std::clamp(v, 0.0, 1.0 - x);
    return Vec2(DVec2(x, y));
  }

  // By the specular lobe, and from behind.
  Vec3 leaving(SurfacePoint surface, const Vec3& wo, int bounce, Sampler& sampler) const {
    const float cos_o = glm::dot(surface.normal, wo);
    const float coverage = surface.shade.coverage;
    const Vec3 through = straight_transmittance(surface.shade, cos_o);
    Vec3 light(0);
    if (max_component(through) > 0) light += through * along({spawn_origin(surface, -wo), -wo}, bounce + 1, sampler);
    if (!surface.reflects) return light;
    surface.shade.diffuse = surface.shade.transmission = Vec3(0);
    const Shading shading(surface, wo);
    const float u = sampler.next1();
    const auto sample = shading.sample(u, sampler.next2());
    if (!sample || max_component(sample->weight) <= 0) return light;
    const Vec3 wi = shading.above(sample->wi);
    return light + coverage * sample->weight * along({spawn_origin(surface, wi), wi}, bounce + 1, sampler);
  }

  // Radiance against a ray.
  Vec3 along(const Ray& ray, int bounce, Sampler& sampler) const {
    const Scene& s = scene_.scene();
    const Hit hit = transport_.accel.intersect(ray);
    if (!hit) return sky_radiance(s, ray.direction);
    const SurfacePoint surface = surface_at(s, hit, ray.direction);
    Vec3 light = surface.emits ? surface.shade.coverage * surface.shade.emission : Vec3(0);
    if (surface.reflects && max_component(surface.shade.diffuse) > 0) {
      const auto seen = seen_again(surface);
      light += seen ? *seen : diffuse(surface, -ray.direction, sampler);
    }
    const bool followed = surface.shade.alpha <= kMirrorLike || surface.shade.coverage < 1 ||
                          max_component(surface.shade.transmission) > 0;
    if (followed && bounce < kMostBounces) light += leaving(surface, -ray.direction, bounce, sampler);
    return light;
  }

  // What the frame shows of a surface, if it does.
  std::optional<Vec3> seen_again(const SurfacePoint& surface) const {
    const Vec4 clip = frame_.clip_from_pack * Vec4(surface.position, 1);
    if (clip.w <= 0) return std::nullopt;
    const Vec2 at = (Vec2(clip) / clip.w * 0.5f + 0.5f) * Vec2(IVec2(frame_.width, frame_.height));
    if (!(at.x >= 0 && at.y >= 0 && at.x < static_cast<float>(frame_.width) &&
          at.y < static_cast<float>(frame_.height)))
      return std::nullopt;
    const std::size_t i =
        static_cast<std::size_t>(at.y) * static_cast<std::size_t>(frame_.width) + static_cast<std::size_t>(at.x);
    if (frame_.place[i].w != static_cast<float>(surface.triangle + 1)) return std::nullopt;
    const float far = glm::distance(Vec3(frame_.eye), surface.position);
    if (frame_.eye.w > 0 && glm::distance(Vec3(frame_.place[i]), surface.position) > kSame * far) return std::nullopt;
    return Vec3(frame_.reflected[i]);
  }

  // One lamp with its shadow, and one bounce without.
  Vec3 diffuse(const SurfacePoint& surface, const Vec3& wo, Sampler& sampler) const {
    const Receiver receiver{surface.position, surface.normal, surface.geometric_normal};
    Vec3 irradiance(0);
    for (const BounceElement& e : scene_.elements) {
      const Vec3 to = e.place - surface.position;
      const float d2 = std::max(length2(to), 1e-30f);
      const Vec3 direction = to / std::sqrt(d2);
      const float share = std::max(-glm::dot(e.normal, direction), 0.0f) * incidence(receiver, direction);
      irradiance += share / (d2 + e.area / kPi) * e.power;
    }
    const float u = sampler.next1();
    const Vec2 v = sampler.next2();
    if (!transport_.lights.empty()) {
      const Vec3 origin = spawn_origin(surface, surface.geometric_normal);
      const LightSample light = transport_.lights.sample(origin, u, v);
      const float cosine =
          glm::dot(light.direction, surface.geometric_normal) > 0 ? incidence(receiver, light.direction) : 0;
      if (cosine > 0 && max_component(light.estimate) > 0 && is_finite(light.estimate))
        irradiance +=
            cosine * light.estimate *
            (light.distance > 0 ? transport_.accel.transmittance({origin, light.direction, light.distance}) : Vec3(1));
    }
    const float left = 1 - max_component(reflectance(surface.shade, std::max(0.0f, glm::dot(surface.normal, wo))));
    return surface.shade.coverage * left / kPi * surface.shade.diffuse * irradiance;
  }

  const PreviewScene& scene_;
  const TracedFrame& frame_;
  const Transport transport_;
};

}  // namespace

Result<TracedLight> trace_specular(const PreviewScene& scene, const TracedFrame& frame, std::uint32_t pass,
                                   Context& context) {
  constexpr std::uint64_t kStream = std::uint64_t{1} << 40;
  const auto width = static_cast<std::size_t>(frame.width);
  TracedLight out{std::vector<Vec4>(frame.place.size(), Vec4(0)), 0};
  std::atomic<std::size_t> traced{0};
  const SpecularTracer tracer(scene, frame);
  const auto row = [&](std::size_t y) {
    std::size_t count = 0;
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      if (frame.place[i].w == 0 || frame.normal[i].w < 0.5f) continue;
      Sampler sampler(context.seed, kStream + i, pass);
      const Vec3 light = tracer.pixel(i, sampler);
      if (is_usable(light)) out.light[i] = Vec4(light, 1);
      ++count;
    }
    traced += count;
  };
  ORIEL_TRY_VOID(parallel_for(context, "", static_cast<std::size_t>(frame.height), row));
  out.pixels = traced;
  return out;
}

}  // namespace oriel
