#include "bake/radiosity/texels/texel_paths.h"

#include "bake/radiosity/texels/texel_part.h"
#include "bake/trace/buried.h"

namespace oriel {

void TexelPaths::add(const MapTexel& texel, const PathNumbers& paths, TexelSums& sums, std::uint64_t& rays) const {
  const TexelMapPage& map = scene_.map[texel.page];
  const std::uint64_t stream = static_cast<std::uint64_t>(texel.page) << 32 | map.texel[texel.index];
  const bool mixed = any_buried(texel, stream, rays);
  const TexelPart part(t_, {scene_.atlas, map, texel.index}, ViewSamples(t_, eyes_), rays);
  if (part.covered()) return;
  for (std::uint32_t k = paths.first; k < paths.end; ++k) {
    if (k % 256 == 0 && context_.stopped()) break;  // the result is thrown away
    Sampler sampler(seed_, stream, k);
    const Vec2 uv = sampler.next2();
    const SurfacePoint surface = point_of(texel, Vec3(uv, sampler.next1()));
    if (mixed && is_buried(t_, surface, {seed_, stream, k}, rays)) continue;
    if (!part.holds(surface.triangle, surface.barycentric, rays)) continue;
    sums.add(sample_irradiance(t_, surface, sampler, rays, directional_));
  }
}

SurfacePoint TexelPaths::point_of(const MapTexel& texel, const Vec3& u) const {
  const TexelPoint point = sample_texel(scene_.atlas, scene_.map[texel.page], texel.index, u);
  return point_on_side(t_.accel, point.triangle, point.barycentric);
}

// True if one of 64 points spread over the texel is buried: only then does every path test its own point. Most texels
// take one ray a point.
bool TexelPaths::any_buried(const MapTexel& texel, std::uint64_t stream, std::uint64_t& rays) const {
  for (std::uint32_t k = 0; k < 64; ++k) {
    Sampler sampler(~seed_, stream, k);
    const Vec2 uv = sampler.next2();
    if (is_buried(t_, point_of(texel, Vec3(uv, sampler.next1())), {seed_, stream, ~k}, rays)) return true;
  }
  return false;
}

}  // namespace oriel
