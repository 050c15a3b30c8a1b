#include "bake/run/lobe_share.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace oriel {
namespace {

constexpr std::uint32_t kEvery = 8;  // pixels along each axis

}  // namespace

Result<double> lobe_share(const BakedScene& baked, const ReflectedSurroundings& surroundings,
                          std::span<const RadianceMap> maps, const std::vector<bool>& glossy, Context& context) {
  std::vector<RadianceMap> few(maps.begin(), maps.end());
  double pixels = 0;
  for (RadianceMap& map : few) {
    map.width = std::max(1u, map.width / kEvery), map.height = std::max(1u, map.height / kEvery);
    pixels += double{1.0f * map.width} * map.height;
  }
  std::atomic<std::uint64_t> lobes{0};
  const OutgoingRadiance count = [&](const SeenSurface& seen) {
    lobes += traces_lobe(baked, seen);
    return Vec3(0);
  };
  UnitStore* const units = std::exchange(context.units, nullptr);  // what was found would not be counted
  const Status captured =
      capture_maps(surroundings, glossy.empty() ? count : with_lobes_of(glossy, count), context, few, nullptr);
  context.units = units;
  ORIEL_TRY_VOID(captured);
  return pixels > 0 ? static_cast<double>(lobes) / pixels : 0;
}

}  // namespace oriel
