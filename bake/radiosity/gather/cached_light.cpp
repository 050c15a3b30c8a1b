#include "bake/radiosity/gather/cached_light.h"

#include "bake/jobs/parallel.h"

namespace oriel {
namespace {

Vec3 centre_of(const Texels& texels, std::size_t i) {
  Vec3 sum(0);
  for (const SamplePoint& point : texels.sample_points[i]) sum += point.origin;
  return sum / static_cast<float>(kSamplePoints);
}

// The least-squares gradient along the surface by the neighbours' light.
void fit_slope(const TexelGraph& graph, const Vec3& normal, std::size_t i, std::span<const CachedTexel> all,
               CachedTexel& texel) {
  const Mat3 frame = frame_from_normal(normal);
  double xx = 0, xy = 0, yy = 0;
  DVec3 x_light(0), y_light(0);
  for (const std::uint32_t j : graph.of(i)) {
    const Vec3 off = all[j].centre - texel.centre;
    const double x = glm::dot(off, frame[0]), y = glm::dot(off, frame[1]);
    const DVec3 difference(all[j].radiance - texel.radiance);
    xx += x * x, xy += x * y, yy += y * y;
    x_light += x * difference, y_light += y * difference;
  }
  // The ridge picks the smallest slope where neighbours lie in one line.
  const double ridge = 1e-3 * (xx + yy);
  xx += ridge, yy += ridge;
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0)) return;
  const DVec3 along_x = (yy * x_light - xy * y_light) / determinant,
              along_y = (xx * y_light - xy * x_light) / determinant;
  // Texels without extent give no finite slope: their light is constant.
  for (int c = 0; c < 3; ++c) {
    texel.slope[c] = static_cast<float>(along_x[c]) * frame[0] + static_cast<float>(along_y[c]) * frame[1];
    if (!is_finite(texel.slope[c])) texel.slope[c] = Vec3(0);
  }
}

// Shortens slopes until radiance is at least 0 at all sample points. An estimate may itself be negative, as a
// difference of two: then it has no slope.
void limit_slope(const Texels& texels, std::size_t i, CachedTexel& texel) {
  for (int c = 0; c < 3; ++c) {
    float most = 0;
    for (const SamplePoint& point : texels.sample_points[i])
      most = std::max(most, std::abs(glm::dot(texel.slope[c], point.origin - texel.centre)));
    if (!(texel.radiance[c] > 0))
      texel.slope[c] = Vec3(0);
    else if (most > texel.radiance[c])
      texel.slope[c] *= texel.radiance[c] / most;
  }
}

}  // namespace

CachedLight cache_light(const Texels& texels, const TexelGraph& graph, std::span<const Vec3> irradiance,
                        Context& context) {
  constexpr std::size_t kRun = 1024;
  const std::size_t n = texels.count();
  CachedLight light{irradiance, std::vector<CachedTexel>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    light.texels[i].radiance = texels.albedo[i] * irradiance[i] / kPi;
    light.texels[i].centre = centre_of(texels, i);
  }
  (void)parallel_for(context, "", (n + kRun - 1) / kRun, [&](std::size_t run) {
    for (std::size_t i = run * kRun; i < std::min(n, (run + 1) * kRun); ++i) {
      if (texels.visible[i] == 0) continue;
      fit_slope(graph, texels.sample_points[i][0].geometric_normal, i, light.texels, light.texels[i]);
      limit_slope(texels, i, light.texels[i]);
    }
  });
  return light;
}

}  // namespace oriel
