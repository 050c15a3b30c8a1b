#include "bake/radiosity/texels/texel_paths.h"

#include "bake/radiosity/texels/texel_part.h"
#include "bake/trace/buried.h"

namespace oriel {

void TexelPaths::add(const TexelMapPage& map, std::size_t page, std::size_t i, std::uint32_t first, std::uint32_t last,
                     TexelSums& sums, std::uint64_t& rays) const {
  const std::uint64_t stream = static_cast<std::uint64_t>(page) << 32 | map.texel[i];
  const bool mixed = any_buried(map, i, stream, rays);
  const TexelPart part(t_, atlas_, map, i, Onlookers(t_, eyes_), rays);
  if (part.covered()) return;
  for (std::uint32_t k = first; k < last; ++k) {
    if (k % 256 == 0 && context_.stopped()) break;  // the result is thrown away
    Sampler sampler(context_.seed, stream, k);
    const Vec2 uv = sampler.next2();
    const SurfacePoint surface = point_of(map, i, Vec3(uv, sampler.next1()));
    if (mixed && is_buried(t_, surface, context_.seed, stream, k, rays)) continue;
    if (!part.holds(surface.triangle, surface.barycentric, rays)) continue;
    if (t_.listener) t_.listener->begin("irradiance, lux"), t_.listener->meet(surface, Vec3(1));
    sums.add(sample_irradiance(t_, surface, sampler, rays, directional_));
  }
}

SurfacePoint TexelPaths::point_of(const TexelMapPage& map, std::size_t i, const Vec3& u) const {
  const TexelPoint point = sample_texel(atlas_, map, i, u);
  return point_on_side(t_.accel.scene(), point.triangle, point.barycentric);
}

// Whether some of 64 points spread over the texel are buried: only then every path asks for its own point. Most texels
// answer with one ray a point.
bool TexelPaths::any_buried(const TexelMapPage& map, std::size_t i, std::uint64_t stream, std::uint64_t& rays) const {
  for (std::uint32_t k = 0; k < 64; ++k) {
    Sampler sampler(~context_.seed, stream, k);
    const Vec2 uv = sampler.next2();
    if (is_buried(t_, point_of(map, i, Vec3(uv, sampler.next1())), context_.seed, stream, ~k, rays)) return true;
  }
  return false;
}

}  // namespace oriel
