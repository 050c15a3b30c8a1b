#include "bake/trace/reference.h"

#include "bake/jobs/parallel.h"
#include "bake/trace/albedo.h"

namespace oriel {
namespace {

struct PixelLight {
  Vec3 diffuse{0}, specular{0}, other{0};
};

PixelLight trace_pixel(const Transport& t, const Ray& ray, Sampler& sampler, std::uint64_t& rays) {
  PixelLight light;
  ++rays;
  const Hit hit = t.accel.intersect(ray);
  if (!hit) {
    light.other = sky_radiance(t.accel.scene(), ray.direction);
    return light;
  }
  SurfacePoint surface = surface_at(t.accel.scene(), hit, ray.direction);
  const float coverage = surface.shade.coverage;
  const float cos_o = glm::dot(surface.normal, -ray.direction);
  const Vec3 through = straight_transmittance(surface.shade, cos_o);
  if (max_component(through) > 0) {
    const Ray rest{spawn_origin(t.accel.scene(), hit.triangle, hit.barycentric, ray.direction), ray.direction};
    const PathLight behind = trace_path(t, rest, 0, sampler, rays);
    light.other += through * (behind.emitted + behind.sky + behind.scattered);
  }
  if (surface.emits) light.other += coverage * surface.shade.emission;
  if (!surface.reflects) return light;
  const float left = 1 - max_component(reflectance(surface.shade, cos_o));
  if (max_component(surface.shade.diffuse) > 0) {
    const IrradianceSample e = sample_irradiance(t, surface, sampler, rays);
    light.diffuse = coverage * left / kPi * surface.shade.diffuse * (e.direct + e.indirect);
  }
  surface.shade.diffuse = surface.shade.transmission = Vec3(0);
  light.specular = coverage * reflected_light(t, surface, -ray.direction, sampler, rays);
  return light;
}

Vec3 standard_error(const DVec3& sum, const DVec3& squares, double n) {
  const DVec3 mean = sum / n;
  return Vec3(glm::sqrt(glm::max(DVec3(0), squares / n - mean * mean) / std::max(1.0, n - 1)));
}

}  // namespace

Ray camera_ray(const Camera& camera, float x, float y, int width, int height) {
  const Vec3 right = glm::normalize(glm::cross(camera.forward, camera.up));
  const Vec3 up = glm::cross(right, camera.forward);
  const float sx = (2 * x - static_cast<float>(width)) / static_cast<float>(height);
  const float sy = 1 - 2 * y / static_cast<float>(height);
  if (camera.vertical_fov_rad <= 0)
    return {camera.eye + camera.half_height * (sx * right + sy * up), glm::normalize(camera.forward)};
  const float t = std::tan(0.5f * camera.vertical_fov_rad);
  return {camera.eye, glm::normalize(camera.forward + t * (sx * right + sy * up))};
}

Result<ReferenceFrame> render_reference(const Transport& transport, const Camera& camera,
                                        const ReferenceOptions& options, Context& context) {
  ReferenceFrame frame;
  frame.width = options.width;
  frame.height = options.height;
  const std::size_t pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  for (auto* image : {&frame.total, &frame.diffuse, &frame.specular, &frame.noise, &frame.diffuse_noise})
    image->resize(pixels);
  std::atomic<std::uint64_t> total_rays{0};
  const auto row = [&](std::size_t y) {
    std::uint64_t rays = 0;
    for (int x = 0; x < options.width; ++x) {
      const std::size_t pixel = y * static_cast<std::size_t>(options.width) + static_cast<std::size_t>(x);
      DVec3 diffuse(0), diffuse_squares(0), specular(0), sum(0), squares(0);
      for (std::uint32_t i = 0; i < options.samples; ++i) {
        Sampler sampler(context.seed, pixel, i);
        const Vec2 spread = sampler.next2();
        const Vec2 jitter = options.antialias ? spread : Vec2(0.5f);
        const Ray ray = camera_ray(camera, static_cast<float>(x) + jitter.x, static_cast<float>(y) + jitter.y,
                                   options.width, options.height);
        const PixelLight light = trace_pixel(transport, ray, sampler, rays);
        const DVec3 all(light.diffuse + light.specular + light.other);
        diffuse += DVec3(light.diffuse);
        diffuse_squares += DVec3(light.diffuse) * DVec3(light.diffuse);
        specular += DVec3(light.specular);
        sum += all;
        squares += all * all;
      }
      const double n = options.samples;
      frame.diffuse[pixel] = Vec3(diffuse / n);
      frame.specular[pixel] = Vec3(specular / n);
      frame.total[pixel] = Vec3(sum / n);
      frame.noise[pixel] = standard_error(sum, squares, n);
      frame.diffuse_noise[pixel] = standard_error(diffuse, diffuse_squares, n);
    }
    total_rays += rays;
  };
  ORIEL_TRY_VOID(parallel_for(context, "reference", static_cast<std::size_t>(options.height), row, &total_rays));
  return frame;
}

}  // namespace oriel
