#include "bake/reference/reference.h"

#include "bake/jobs/parallel.h"
#include "bake/reference/glints.h"
#include "bake/trace/albedo.h"
#include "bake/trace/glass.h"
#include "formats/image/display.h"
#include "formats/image/relative_error.h"
#include "formats/query/camera.h"

namespace oriel {
namespace {

struct PixelLight {
  Vec3 direct{0}, indirect{0}, specular{0}, emission{0};
  Vec3 total() const { return direct + indirect + specular + emission; }
};

PixelLight trace_pixel(const Transport& t, const Ray& ray, Sampler& sampler, std::uint64_t& rays) {
  PixelLight light;
  ++rays;
  const Hit hit = t.accel.intersect(ray);
  if (!hit) {
    light.emission = sky_radiance(t.accel.scene(), ray.direction);
    return light;
  }
  SurfacePoint surface = surface_at(t.accel, hit, ray.direction);
  if (t.accel.scene().material_of(hit.triangle).unlit) {
    light.emission = t.options.unlit_white * surface.shade.base_color;
    return light;
  }
  if (surface.shade.inside) {  // the eye is in glass
    const PathLight within = trace_path(t, ray, 0, sampler, rays);
    light.emission = within.emitted + within.sky + within.scattered;
    return light;
  }
  const float coverage = surface.shade.coverage;
  const float cos_o = glm::dot(surface.normal, -ray.direction);
  const bool bends = surface.shade.eta > 0 || (t.options.frosted_panes && is_frosted_pane(surface.shade));
  const Vec3 through = bends ? Vec3(1 - coverage) : straight_transmittance(surface.shade, cos_o);
  if (max_component(through) > 0) {
    const Ray rest{spawn_origin(t.accel.scene(), hit.triangle, hit.barycentric, ray.direction), ray.direction};
    const PathLight behind = trace_path(t, rest, 0, sampler, rays);
    light.emission += through * (behind.emitted + behind.sky + behind.scattered);
  }
  if (bends) light.emission += coverage * refracted_light(t, surface, -ray.direction, sampler, rays);
  if (surface.emits) light.emission += coverage * surface.shade.emission;
  if (!surface.reflects) return light;
  const float left = 1 - max_component(reflectance(surface.shade, cos_o));
  if (max_component(surface.shade.diffuse) > 0) {
    const IrradianceSample e = sample_irradiance(t, surface, sampler, rays);
    const Vec3 shown = coverage * left / kPi * surface.shade.diffuse;
    light.direct = shown * e.direct;
    light.indirect = shown * e.indirect;
  }
  surface.shade.diffuse = surface.shade.transmission = Vec3(0);
  light.specular = coverage * reflected_light(t, surface, -ray.direction, sampler, rays);
  return light;
}

PixelLight sample_pixel(const Transport& t, const Camera& camera, const ReferenceOptions& options,
                        const PixelSample& sample, std::uint64_t& rays) {
  Sampler sampler(sample.seed, std::uint64_t{sample.y} * static_cast<std::uint64_t>(options.width) + sample.x,
                  sample.number);
  const Vec2 spread = sampler.next2();
  const Vec2 at = Vec2(sample.x, sample.y) + (options.antialias ? spread : Vec2(0.5f));
  const PixelRay ray =
      pixel_ray(camera, at.x, at.y, static_cast<float>(options.width), static_cast<float>(options.height));
  return trace_pixel(t, {ray.origin, ray.direction}, sampler, rays);
}

// Sums over the samples of a pixel, and of squares where the noise is told.
struct PixelSums {
  DVec3 direct{0}, indirect{0}, specular{0}, emission{0};
  DVec3 total_squares{0}, diffuse_squares{0}, specular_squares{0};

  void add(const PixelLight& light) {
    const DVec3 diffuse(light.direct + light.indirect), total = diffuse + DVec3(light.specular + light.emission);
    direct += DVec3(light.direct);
    indirect += DVec3(light.indirect);
    specular += DVec3(light.specular);
    emission += DVec3(light.emission);
    total_squares += total * total;
    diffuse_squares += diffuse * diffuse;
    specular_squares += DVec3(light.specular) * DVec3(light.specular);
  }
};

DVec3 standard_error(const DVec3& sum, const DVec3& squares, double n) {
  const DVec3 mean = sum / n;
  return glm::sqrt(glm::max(DVec3(0), squares / n - mean * mean) / std::max(1.0, n - 1));
}

void push(FloatImage& image, const DVec3& v) {
  for (int c = 0; c < 3; ++c) image.pixels.push_back(static_cast<float>(v[c]));
}

ReferenceFrame frame_of(const std::vector<PixelSums>& sums, const ReferenceOptions& options, std::uint32_t samples) {
  const FloatImage empty{static_cast<std::uint32_t>(options.width), static_cast<std::uint32_t>(options.height), 3, {}};
  ReferenceFrame frame{samples, empty, empty, empty, empty, empty, empty, empty, empty};
  const double n = samples;
  for (const PixelSums& s : sums) {
    const DVec3 diffuse = s.direct + s.indirect, total = diffuse + s.specular + s.emission;
    push(frame.total, total / n);
    push(frame.direct, s.direct / n);
    push(frame.indirect, s.indirect / n);
    push(frame.specular, s.specular / n);
    push(frame.emission, s.emission / n);
    push(frame.noise, standard_error(total, s.total_squares, n));
    push(frame.diffuse_noise, standard_error(diffuse, s.diffuse_squares, n));
    push(frame.specular_noise, standard_error(s.specular, s.specular_squares, n));
  }
  frame.relative_noise = relative_error(frame.total, frame.total, frame.noise)->noise;
  return frame;
}

}  // namespace

Transport for_eyes(const Transport& t, const Camera& camera, ReferenceOptions options, std::uint64_t seed) {
  constexpr int kRows = 24;
  constexpr std::uint32_t kPaths = 64;  // few make the mean of logarithms too small
  Transport out = t;
  out.options.frosted_panes = true;
  std::uint64_t rays = 0;
  const auto is_unlit = [](const SceneMaterial& m) { return m.unlit; };
  const std::vector<SceneMaterial>& materials = t.accel.scene().materials;
  if (out.options.unlit_white > 0 || std::none_of(materials.begin(), materials.end(), is_unlit)) return out;
  options.width = std::max(1, kRows * options.width / options.height);
  options.height = kRows;
  options.antialias = false;  // a pixel is lit or it is not
  FloatImage lit{static_cast<std::uint32_t>(options.width), kRows, 3, {}};
  for (std::uint32_t i = 0; i < lit.width * lit.height; ++i) {
    DVec3 sum(0);
    for (std::uint32_t k = 0; k < kPaths; ++k)
      sum += DVec3(sample_pixel(out, camera, options, {seed, i % lit.width, i / lit.width, k}, rays).total());
    push(lit, sum / double{kPaths});
  }
  out.options.unlit_white = white_of(lit);
  return out;
}

Vec3 trace_sample(const Transport& transport, const Camera& camera, const ReferenceOptions& options,
                  const PixelSample& sample) {
  std::uint64_t rays = 0;
  return sample_pixel(transport, camera, options, sample, rays).total();
}

Result<ReferenceFrame> render_reference(const Transport& transport, const Camera& camera,
                                        const ReferenceOptions& options, Context& context) {
  constexpr std::uint32_t kFirstRound = 16;  // fewer do not tell their noise
  const auto width = static_cast<std::size_t>(options.width), height = static_cast<std::size_t>(options.height);
  std::vector<PixelSums> sums(width * height);
  std::atomic<std::uint64_t> total_rays{0};
  const Transport seen = for_eyes(transport, camera, options, context.seed);
  const auto round = [&](std::uint32_t from, std::uint32_t to) {
    const auto row = [&](std::size_t y) {
      std::uint64_t rays = 0;
      for (std::size_t x = 0; x < width && !context.stopped(); ++x)
        for (std::uint32_t i = from; i < to; ++i)
          sums[y * width + x].add(
              sample_pixel(seen, camera, options,
                           {context.seed, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), i}, rays));
      total_rays += rays;
    };
    return parallel_for({context, &total_rays}, "reference", height, row);
  };
  const std::uint32_t most = std::max(options.samples, 1u);
  std::uint32_t done = 0;
  for (std::uint32_t next = options.error > 0 ? std::min(kFirstRound, most) : most;; next = std::min(2 * done, most)) {
    ORIEL_TRY_VOID(round(done, next));
    done = next;
    ReferenceFrame frame = frame_of(sums, options, done);
    if (done < most && frame.relative_noise > options.error) continue;
    add_glints(transport, camera, options, context.seed, frame);
    return frame;
  }
}

}  // namespace oriel
