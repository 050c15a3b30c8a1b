#include "preview/frame/traced.h"

#include <utility>

#include "bake/jobs/parallel.h"
#include "bake/trace/rounded.h"
#include "bake/trace/warp.h"
#include "preview/frame/streams.h"

namespace oriel {
namespace {

constexpr int kMostLobes = 6;   // of lobes after each other
constexpr int kLampPoints = 4;  // of lamps, and of what reflects, that light what rays meet
constexpr float kSame = 0.02f;  // of the distance: a point that the frame shows is the one that the ray meets

// The weights of the second and third corner at a point of a triangle.
Vec2 barycentric_of(const Scene& scene, std::uint32_t triangle, const Vec3& p) {
  const UVec3& t = scene.triangles[triangle];
  const DVec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
  const DVec3 n = glm::cross(b - a, c - a);
  const double area = std::max(glm::dot(n, n), 1e-300);
  const double u = glm::dot(glm::cross(DVec3(p) - a, c - a), n) / area;
  const double v = glm::dot(glm::cross(b - a, DVec3(p) - a), n) / area;
  const double x = std::clamp(u, 0.0, 1.0);
  return Vec2(DVec2(x, std::clamp(v, 0.0, 1.0 - x)));
}

class SpecularTracer {
 public:
  SpecularTracer(const PreviewScene& scene, const TracedFrame& frame)
      : scene_(scene), frame_(frame), transport_{*scene.accel, *scene.lights, {.max_bounces = kMostLobes}} {}

  Vec3 pixel(std::size_t i, Sampler& sampler) const {
    const Scene& scene = scene_.scene();
    const Vec3 place(frame_.seen.place[i]);
    const Vec3 wo = glm::normalize(frame_.eye.w > 0 ? Vec3(frame_.eye) - place : Vec3(frame_.eye));
    // The first object is known from the frame's own picture of items.
    const auto triangle = static_cast<std::uint32_t>(frame_.seen.place[i].w) - 1;
    const bool front = glm::dot(geometric_normal(scene, triangle), wo) >= 0;
    SurfacePoint surface = surface_at(*scene_.accel, {triangle, 0, barycentric_of(scene, triangle, place), front}, -wo);
    Vec3 light(0);
    const OnDiffuse on_diffuse = [&](const DiffuseVertex& v) {
      light += v.weight / kPi * irradiance(v, sampler);
      return 1.0f;
    };
    std::uint64_t rays = 0;
    const Vec3 through = straight_transmittance(surface.shade, glm::dot(surface.normal, wo));
    if (max_component(through) > 0) {
      const Ray behind{spawn_origin(surface, -wo), -wo};
      const Vec3 before = std::exchange(light, Vec3(0));
      const Hit hit = scene_.accel->intersect(behind);
      const PathLight seen = trace_to_diffuse(transport_, {behind, hit}, sampler, rays, on_diffuse);
      light = before + through * (light + seen.emitted + seen.sky + seen.scattered + seen.lamps);
    }
    if (!surface.reflects) return light;
    const float coverage = surface.shade.coverage;
    surface.shade.diffuse = surface.shade.transmission = Vec3(0);
    const Vec3 before = std::exchange(light, Vec3(0));
    const PathLight lobe = specular_light(transport_, {surface, wo}, sampler, rays, on_diffuse);
    return before + coverage * (light + lobe.scattered + lobe.lamps + lobe.emitted + lobe.sky);
  }

 private:
  Vec3 irradiance(const DiffuseVertex& v, Sampler& sampler) const {
    const SurfacePoint surface = point_on_side(*scene_.accel, v.triangle, v.barycentric, v.front);
    if (const auto seen = seen_again(surface)) return *seen;
    return from_elements(surface, sampler) + from_lamps(surface, sampler) + from_even_sky(surface, sampler);
  }

  // Which is none of the sampled lights.
  Vec3 from_even_sky(const SurfacePoint& surface, Sampler& sampler) const {
    const Scene& scene = scene_.scene();
    if (!(max_component(scene.sky) > 0) || !scene.sky_image.texels.empty()) return Vec3(0);
    const Vec3& g = surface.geometric_normal;
    const Vec3 direction = glm::normalize(frame_from_normal(g) * square_to_cosine_hemisphere(sampler.next2()));
    return kPi * scene.sky * transport_.accel.transmittance({spawn_origin(surface, g), direction});
  }

  // What the frame has of a point, if it shows it.
  std::optional<Vec3> seen_again(const SurfacePoint& surface) const {
    const Vec4 clip = frame_.clip_from_pack * Vec4(surface.position, 1);
    if (clip.w <= 0) return std::nullopt;
    const Vec2 size(IVec2(frame_.seen.width, frame_.seen.height)), at = (Vec2(clip) / clip.w * 0.5f + 0.5f) * size;
    if (!(at.x >= 0 && at.y >= 0 && at.x < size.x && at.y < size.y)) return std::nullopt;
    const std::size_t i =
        static_cast<std::size_t>(at.y) * static_cast<std::size_t>(frame_.seen.width) + static_cast<std::size_t>(at.x);
    if (frame_.seen.place[i].w != static_cast<float>(surface.triangle + 1)) return std::nullopt;
    const float far =
        frame_.eye.w > 0 ? glm::distance(Vec3(frame_.eye), surface.position) : 2 * scene_.scene().radius();
    if (glm::distance(Vec3(frame_.seen.place[i]), surface.position) > kSame * far) return std::nullopt;
    return Vec3(frame_.light[i]);
  }

  Vec3 from_elements(const SurfacePoint& surface, Sampler& sampler) const {
    const EyePoint at{receiver_of(surface), spawn_origin(surface, surface.geometric_normal)};
    const std::size_t count = frame_.reflecting.size();
    Vec3 sum(0);
    for (int i = 0; i < kLampPoints && count > 0; ++i) {
      const auto chosen = static_cast<std::size_t>(sampler.next1() * static_cast<float>(count));
      const auto shone = shine(frame_.reflecting[std::min(chosen, count - 1)], at, scene_.scene());
      if (shone) sum += shone->light * transport_.accel.transmittance(shone->ray);
    }
    return sum * (static_cast<float>(count) / static_cast<float>(kLampPoints));
  }

  Vec3 from_lamps(const SurfacePoint& surface, Sampler& sampler) const {
    const Receiver receiver = receiver_of(surface);
    Vec3 sum(0);
    for (int i = 0; i < kLampPoints && !transport_.lights.empty(); ++i) {
      const float u = sampler.next1();
      const LightSample light = transport_.lights.sample(receiver.position, u, sampler.next2());
      if (max_component(light.estimate) <= 0) continue;
      const Ray ray = leaving(receiver, {receiver.position, light.direction, light.distance});
      const Vec3 passed = light.distance > 0 ? transport_.accel.transmittance(ray) : Vec3(1);
      const Vec3 value = incidence(receiver, light.direction, light.pdf == 0) * light.estimate * passed;
      if (is_usable(value)) sum += value;
    }
    return sum / static_cast<float>(kLampPoints);
  }

  const PreviewScene& scene_;
  const TracedFrame& frame_;
  const Transport transport_;
};

}  // namespace

Result<TracedLight> trace_specular(const PreviewScene& scene, const TracedFrame& frame, std::uint32_t pass,
                                   Context& context) {
  const auto width = static_cast<std::size_t>(frame.seen.width);
  TracedLight out{std::vector<Vec4>(frame.seen.place.size(), Vec4(0)), 0};
  std::atomic<std::size_t> traced{0};
  const SpecularTracer tracer(scene, frame);
  const auto row = [&](std::size_t y) {
    std::size_t count = 0;
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      if (frame.seen.place[i].w == 0 || frame.seen.normal[i].w < 0.5f) continue;
      Sampler sampler(context.seed, kTracedStream + i, pass);
      const Vec3 light = tracer.pixel(i, sampler);
      if (is_usable(light)) out.light[i] = Vec4(light, 1);
      ++count;
    }
    traced += count;
  };
  ORIEL_TRY_VOID(parallel_for(context, "", static_cast<std::size_t>(frame.seen.height), row));
  out.pixels = traced;
  return out;
}

}  // namespace oriel
