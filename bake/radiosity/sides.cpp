#include "bake/radiosity/sides.h"

#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kTexels = 16;    // a chart
constexpr std::uint32_t kSamples = 8;  // a texel and side

struct TexelRef {
  std::size_t page, index;
};

double light_on_side(const Transport& t, const Atlas& atlas, std::span<const TexelMapPage> map, const TexelRef& texel,
                     bool back, std::uint64_t seed, std::uint64_t& rays) {
  double sum = 0;
  const std::uint64_t stream = static_cast<std::uint64_t>(texel.page) << 32 | map[texel.page].texel[texel.index];
  for (std::uint32_t k = 0; k < kSamples; ++k) {
    Sampler sampler(mix64(seed), stream, k);
    const Vec2 uv = sampler.next2();
    const TexelPoint point = sample_texel(atlas, map[texel.page], texel.index, Vec3(uv, sampler.next1()));
    const IrradianceSample e = sample_irradiance(t, point_on_side(t.accel.scene(), point, back), sampler, rays);
    sum += luminance(e.direct + e.indirect);
  }
  return sum;
}

}  // namespace

SurfacePoint point_on_side(const Scene& scene, const TexelPoint& point, bool back) {
  const Vec3 normal = geometric_normal(scene, point.triangle);
  return geometry_at(scene, {point.triangle, 0, point.barycentric, !back}, back ? normal : -normal);
}

std::vector<char> choose_sides(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                               std::uint64_t seed, std::uint64_t& rays) {
  const Scene& scene = transport.accel.scene();
  std::vector<std::vector<TexelRef>> texels(atlas.chart_count);
  for (std::size_t p = 0; p < texel_map.size(); ++p)
    for (std::size_t i = 0; i < texel_map[p].texel.size(); ++i) {
      const std::uint32_t triangle = texel_map[p].fragments[texel_map[p].first[i]].triangle;
      if (scene.materials[scene.surfaces[scene.triangle_surface[triangle]].material].double_sided)
        texels[atlas.chart[triangle]].push_back({p, i});
    }
  std::vector<char> back(atlas.chart_count, 0);
  for (std::size_t chart = 0; chart < texels.size(); ++chart) {
    const auto& own = texels[chart];
    const std::size_t count = std::min(kTexels, own.size());
    double front_light = 0, back_light = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const TexelRef& texel = own[k * own.size() / count];
      front_light += light_on_side(transport, atlas, texel_map, texel, false, seed, rays);
      back_light += light_on_side(transport, atlas, texel_map, texel, true, seed, rays);
    }
    back[chart] = back_light > 2 * front_light;
  }
  return back;
}

}  // namespace oriel
