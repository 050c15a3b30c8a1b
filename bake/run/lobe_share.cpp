#include "bake/run/lobe_share.h"

#include <algorithm>
#include <atomic>

#include "bake/radiance/surround_capture.h"

namespace oriel {
namespace {

constexpr std::uint32_t kEvery = 8;  // pixels along each axis

void mark(std::span<const std::uint32_t> triangles, std::vector<bool>& marked) {
  for (const std::uint32_t t : triangles) marked[t] = true;
}

}  // namespace

std::vector<bool> curved_triangles(const Scene& scene, const FoundReflections& all) {
  std::vector<bool> marked(scene.triangles.size());
  mark(all.found.unplanar, marked);
  return marked;
}

std::vector<bool> shiny_triangles(const Scene& scene, const FoundReflections& all) {
  std::vector<bool> marked = curved_triangles(scene, all);
  for (const FoundReflector& r : all.found.reflectors) mark(r.triangles, marked);
  return marked;
}

Result<LobeShares> lobe_shares(const BakedScene& baked, const ReflectedSurroundings& surroundings,
                               std::span<const RadianceMap> maps, const FoundReflections& all, Context& context) {
  std::vector<RadianceMap> few(maps.begin(), maps.end());
  double pixels = 0;
  for (RadianceMap& map : few) {
    map.width = std::max(1u, map.width / kEvery), map.height = std::max(1u, map.height / kEvery);
    pixels += double{1.0f * map.width} * map.height;
  }
  FoundCurvedReflectors curved = all.curved;
  const double texels = make_coarser(kEvery, curved.maps);
  std::atomic<std::uint64_t> lobes{0};
  const OutgoingRadiance count = [&](const SeenSurface& seen) {
    lobes += traces_lobe(baked, seen);
    return Vec3(0);
  };
  const auto share_of = [&](double all_pixels) {
    return all_pixels > 0 ? static_cast<double>(lobes.exchange(0)) / all_pixels : 0.0;
  };
  const Scene& scene = baked.accel.scene();
  const std::vector<bool> is_curved = curved_triangles(scene, all), is_shiny = shiny_triangles(scene, all);
  const Trial trial(context);
  LobeShares shares;
  ORIEL_TRY_VOID(capture_maps({surroundings, with_lobes_of(is_curved, count)}, context, few));
  shares.planar = share_of(pixels);
  ORIEL_TRY_VOID(capture_surroundings(baked.accel, curved, with_lobes_of(is_shiny, count), context));
  shares.surround = share_of(texels);
  return shares;
}

}  // namespace oriel
