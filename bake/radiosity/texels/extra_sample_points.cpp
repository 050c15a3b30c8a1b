#include "bake/radiosity/texels/extra_sample_points.h"

#include "bake/radiosity/texels/seeds.h"
#include "bake/trace/buried.h"
#include "bake/trace/rounded.h"
#include "bake/trace/view_samples.h"

namespace oriel {
namespace {

// Attempts for one point where most of the texel is hidden. After these a stored point is used again; it has the same
// distribution.
constexpr std::uint32_t kTries = 16;
constexpr std::uint32_t kServe = 4;  // uses of a stored point of such a texel: a new one takes dozens of rays

}  // namespace

SurfacePoint texel_candidate(const LightmapScene& scene, const Texels& texels, const TexelSampleId& of,
                             std::uint64_t seed) {
  const std::size_t i = of.texel;
  const TexelMapPage& map = scene.map[texels.page[i]];
  const std::uint64_t stream = std::uint64_t{texels.page[i]} << 32 | map.texel[texels.index[i]];
  Sampler sampler(seed + static_cast<std::uint64_t>(of.half), stream, of.k);
  const Vec2 uv = sampler.next2();
  const TexelPoint point = sample_texel(scene.atlas, map, texels.index[i], Vec3(uv, sampler.next1()));
  return point_on_side(scene.transport.accel, point.triangle, point.barycentric);
}

SamplePoint sample_point_of(const SurfacePoint& s) {
  const Receiver at = receiver_of(s);
  return {at.position, at.normal, at.geometric_normal, at.rounded};
}

std::uint32_t ExtraSamplePoints::cached_count(std::uint32_t i, int half) const {
  return (texels_.occlusion_heavy[i] ? kServe : 1) * texels_.sample_point_count(i, half);
}

SurfacePoint ExtraSamplePoints::candidate(std::uint32_t i, int half, std::uint32_t k) const {
  return texel_candidate(scene_, texels_, {i, half, k}, seed_ + seeds::kBright);
}

float ExtraSamplePoints::area_texels2(std::uint32_t i) const {
  const TexelMapPage& map = scene_.map[texels_.page[i]];
  float sum = 0;
  for (std::uint32_t f = map.first[texels_.index[i]]; f < map.first[texels_.index[i] + 1]; ++f)
    sum += map.fragments[f].area;
  return sum;
}

SamplePoint ExtraSamplePoints::at(std::uint32_t i, int half, std::uint32_t k, std::uint64_t& rays) const {
  if (k < cached_count(i, half)) return texels_.sample_point(i, half, k);
  const auto cut = texels_.cut.find(i);
  const bool divided = cut != texels_.cut.end();
  const bool occlusion_heavy = texels_.occlusion_heavy[i];  // a point close to an occluder may lie in a gap
  const ViewSamples views(scene_.transport, texels_.eyes);
  ViewSamples::Nearest eyes;
  const std::uint32_t first = occlusion_heavy ? 1 : 0;  // points of attempt 0 are stored already
  for (std::uint32_t attempt = first; attempt < first + kTries; ++attempt) {
    const SurfacePoint point = texel_candidate(scene_, texels_, {i, half, k}, seed_ + std::uint64_t{kHalves} * attempt);
    const std::uint64_t stream = std::uint64_t{texels_.page[i]} << 32 | texels_.index[i];
    const std::uint64_t seed =
        seed_ + seeds::kExtraSamplePoints + std::uint64_t{kHalves} * attempt + static_cast<std::uint64_t>(half);
    if (is_buried(scene_.transport, point, {seed, stream, k}, rays)) continue;
    if (occlusion_heavy && !views.sees(point, texels_.gap_reach(i), {seed, stream, k}, eyes, rays)) continue;
    if (!divided || cut->second.holds(point.triangle, point.barycentric, rays)) return sample_point_of(point);
  }
  return texels_.sample_point(i, half, k);
}

}  // namespace oriel
