#include "tests/bake/radiosity/calibration.h"

#include "bake/jobs/parallel.h"
#include "bake/radiosity/texels/frame_error.h"
#include "bake/radiosity/texels/texel_paths.h"

namespace oriel::test {
namespace {

constexpr std::uint32_t kEyes = 256;
constexpr std::uint64_t kSeed = 0x7247;  // of no bake

// The truth is that of paths from the points that pixels show, which share no code of the gather, the cache or the
// filter. Their own noise is taken off the squared error and added to the interval.
struct Truth {
  std::vector<FramePixel> pixels;
  std::vector<TexelSums> light;  // by pixel
};

Truth find_truth(const Baked& b, const CalibrationOptions& settings) {
  Context context;
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  const Transport transport{accel, lights, {}};
  const std::vector<Vec3> eyes = sample_view_positions(transport, kEyes, kSeed);
  Truth truth;
  truth.pixels = *find_frame_pixels(transport, b.atlas, {eyes, settings.pixels / kEyes}, kSeed, context);
  truth.light.resize(truth.pixels.size());
  (void)parallel_for(context, "", truth.pixels.size(), [&](std::size_t i) {
    std::uint64_t rays = 0;
    const SurfacePoint point = point_on_side(b.scene, truth.pixels[i].triangle, truth.pixels[i].barycentric);
    for (std::uint32_t k = 0; k < settings.truth_samples; ++k) {
      Sampler sampler(kSeed, i, k);
      truth.light[i].add(sample_irradiance(transport, point, sampler, rays));
    }
  });
  return truth;
}

// What the lightmap says at a pixel, and the squared error that its texels state; lux.
struct Read {
  DVec3 light{0}, error2{0};
};

Read read(const LightmapPage& page, const FramePixel& pixel) {
  Read r;
  double stated = 0;
  for (std::size_t k = 0; k < pixel.texel.size(); ++k) {
    const double share = pixel.share[k];
    const std::uint32_t t = pixel.texel[k];
    r.light += share * DVec3(page.irradiance[t]);
    if (page.state[t] != TexelState::kValid) continue;
    r.error2 += share * DVec3(page.standard_error[t]) * DVec3(page.standard_error[t]);
    stated += share;
  }
  if (stated > 0) r.error2 /= stated;
  return r;
}

}  // namespace

Calibration calibrate(const Scene& scene, const CalibrationOptions& settings) {
  Calibration c;
  Truth truth;
  std::vector<DVec3> floors2;
  double count = 0, pixels = 0, light = 0;
  for (int seed = 1; seed <= settings.bakes; ++seed) {
    const Baked b = bake(scene, settings.texel_m, settings.cached, 0, static_cast<std::uint64_t>(seed));
    if (seed == 1) {
      truth = find_truth(b, settings);
      floors2 = frame_floors2(
          truth.pixels, [&](std::size_t i) { return DVec3(truth.pixels[i].transfer) * truth.light[i].irradiance(); });
    }
    c.stated += std::pow(b.radiosity.report.relative_error, 2) / settings.bakes;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
      const FramePixel& pixel = truth.pixels[i];
      const Read r = read(b.radiosity.pages[pixel.page], pixel);
      const DVec3 value = truth.light[i].irradiance(), noise2 = truth.light[i].variance(), off = r.light - value;
      const DVec3 transfer(pixel.transfer), shown = transfer * value + DVec3(pixel.emitted);
      for (int k = 0; k < 3; ++k) {
        c.covered += std::abs(off[k]) <= 1.96 * std::sqrt(std::pow(settings.claimed, 2) * r.error2[k] + noise2[k]);
        c.bias += off[k], light += value[k], ++count;
      }
      c.error += relative_square(transfer * transfer * (off * off - noise2), shown * shown, floors2[pixel.view]);
      c.truth += relative_square(transfer * transfer * noise2, shown * shown, floors2[pixel.view]);
      ++pixels;
    }
  }
  c.covered /= count;
  c.error = std::sqrt(std::max(0.0, c.error / pixels));
  c.stated = std::sqrt(c.stated);
  c.truth = std::sqrt(c.truth / pixels);
  c.bias /= light;
  return c;
}

}  // namespace oriel::test
