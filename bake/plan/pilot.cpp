#include "bake/plan/pilot.h"

#include <algorithm>

#include "bake/radiance/capture.h"
#include "bake/run/assemble.h"
#include "bake/run/fit_maps.h"
#include "bake/run/lobe_share.h"
#include "formats/pack/writer.h"

namespace oriel {
namespace {

constexpr std::uint32_t kFewest = 16, kFewer = 4;  // that samples are divided by
constexpr std::uint32_t kStrips = 4, kPart = 16;   // of a map that is captured: a sixteenth, in strips

double pixels(const RadianceMap& map) {
  return double{1.0f * map.width} * map.height;
}

struct SmallPlan {
  std::vector<FoundReflector> reflectors;  // with their maps
  std::vector<RadianceMap> maps;           // without pixels
  double seconds = 0;
  double pixels = 0;
};

Result<SmallPlan> plan_with_fewer(const CensusInput& in, std::uint32_t divisor, Context& context) {
  const std::vector<FoundReflector>& found = in.reflections.found.reflectors;
  SmallPlan small{found, {}, 0, 0};
  const ElapsedTime clock;
  PlannedViewOptions fewer = in.options.planned;
  fewer.samples = std::max(1u, fewer.samples / divisor);
  fewer.memory_bytes = ~std::uint64_t{0};  // how much all would take is asked
  const ReflectedSurroundings surroundings(*in.prepared.accel, found, in.options.sight);
  fewer.eyes = in.reflections.eyes;
  KnownPlans known;
  ORIEL_TRY(ViewPlan plan, plan_views_for_eyes(surroundings, fewer, context, small.reflectors, known));
  small.maps = std::move(plan.maps);
  small.seconds = clock.spent();
  for (const RadianceMap& map : small.maps) small.pixels += pixels(map);
  return small;
}

// What a pixel of a reflector's maps costs.
struct Rate {
  double seconds = 0, rays = 0, bytes = 0;
};

// Rows of one map in strips spread over it, pixels as fine as they will be: neighbours are as alike.
std::vector<RadianceMap> strips_of(const RadianceMap& whole) {
  std::vector<RadianceMap> strips(kStrips, whole);
  const std::uint32_t rows = std::max(1u, whole.height / (kStrips * kPart));
  const float row = (whole.upper.y - whole.lower.y) / static_cast<float>(whole.height);
  for (std::uint32_t i = 0; i < kStrips; ++i) {
    const std::uint32_t first = std::min(whole.height - rows, (2 * i + 1) * whole.height / (2 * kStrips));
    strips[i].height = rows;
    strips[i].lower.y = whole.lower.y + static_cast<float>(first) * row;
    strips[i].upper.y = strips[i].lower.y + static_cast<float>(rows) * row;
  }
  return strips;
}

// What these maps, all of one reflector, add to a pack.
Result<double> stored_bytes(const CensusInput& in, const BakedScene& coarse, Reflector reflector,
                            std::vector<RadianceMap> maps) {
  Pack pack = pack_of_scene(in.prepared.scene(), coarse.atlas);
  pack.lightmaps.assign(coarse.pages.begin(), coarse.pages.end());
  ORIEL_TRY(const Bytes without, encode_pack(pack));
  reflector.elements_x = 1;
  reflector.elements_y =
      static_cast<std::uint32_t>(maps.size());  // parts of one map, which are no views of one element
  reflector.first_map = 0;
  reflector.map_count = static_cast<std::uint32_t>(maps.size());
  for (std::uint32_t i = 0; i < maps.size(); ++i) maps[i].reflector = 0, maps[i].element = i;
  pack.reflectors.push_back(std::move(reflector));
  pack.radiance_maps = std::move(maps);
  ORIEL_TRY(const Bytes with, encode_pack(pack));
  return static_cast<double>(with.size()) - static_cast<double>(without.size());
}

// Parts of one map, captured and stored.
struct CoarseReflections {
  const BakedScene& coarse;
  const ReflectedSurroundings& surroundings;
  std::uint32_t paths = 0;  // of a lobe
};
Result<Rate> capture_parts(const CensusInput& in, const CoarseReflections& seen_in, const RadianceMap& whole,
                           Context& context) {
  const BakedScene& coarse = seen_in.coarse;
  const ReflectedSurroundings& surroundings = seen_in.surroundings;
  std::vector<RadianceMap> strips = strips_of(whole);
  std::atomic<std::uint64_t> rays{0};
  const OutgoingRadiance outgoing = [&](const SeenSurface& seen) {
    std::uint64_t lobe_rays = 0;
    const Vec3 radiance = baked_radiance_with_lobes(coarse, seen, seen_in.paths, context.seed, lobe_rays);
    rays += lobe_rays;
    return radiance;
  };
  const ElapsedTime clock;
  ORIEL_TRY_VOID(capture_maps({surroundings, outgoing}, {context, &rays}, strips));
  const double seconds = clock.spent(), count = kStrips * pixels(strips.front());
  ORIEL_TRY(const double bytes,
            stored_bytes(in, coarse, surroundings.reflectors()[whole.reflector].reflector, std::move(strips)));
  return Rate{seconds / count, static_cast<double>(rays) / count, bytes / count};
}

}  // namespace

Pack pack_of_scene(const Scene& scene, const Atlas& atlas) {
  Pack pack;
  pack.mesh = assemble_mesh(scene, atlas).mesh;
  MaterialMaps none;
  none.summaries.resize(scene.materials.size());
  none.kernel.assign(scene.materials.size(), -1);
  none.fresnel_map.assign(scene.materials.size(), -1);
  assemble_materials(scene, none, pack);
  return pack;
}

Result<Component> pilot_reflections(const CensusInput& in, const BakedScene& coarse, Context& context) {
  ORIEL_TRY(const SmallPlan fewest, plan_with_fewer(in, kFewest, context));
  ORIEL_TRY(const SmallPlan fewer, plan_with_fewer(in, kFewer, context));
  // Greedy choice: as many pixels more with the last factor of four as with the one before.
  const double more = fewer.pixels > 0 ? std::max(1.0, 2 - fewest.pixels / fewer.pixels) : 1;
  Component c{.name = "radiance"};
  c.seconds = kFewer * fewer.seconds;
  const ReflectedSurroundings surroundings(coarse.accel, fewer.reflectors, in.options.sight);
  double surround = 0;
  for (const SurroundMap& map : in.reflections.curved.maps) surround += double{1.0f * map.size} * map.size;
  ORIEL_TRY(const LobeShares shares, lobe_shares(coarse, surroundings, fewer.maps, in.reflections, context));
  const std::uint32_t paths = lobe_paths(shares.planar * more * fewer.pixels + shares.surround * surround);
  double rays = 0, bytes = 0, seconds = 0, all = 0;
  for (const FoundReflector& found : fewer.reflectors) {
    const Reflector& r = found.reflector;
    if (r.map_count == 0) continue;
    ORIEL_TRY(const Rate rate, capture_parts(in, {coarse, surroundings, paths}, fewer.maps[r.first_map], context));
    double own = 0;
    for (std::uint32_t m = 0; m < r.map_count; ++m) own += more * pixels(fewer.maps[r.first_map + m]);
    seconds += own * rate.seconds, rays += own * rate.rays, bytes += own * rate.bytes, all += own;
  }
  ORIEL_TRY(const SurroundCost cost, surround_cost(coarse, in.reflections, paths, context));
  c.seconds += seconds + cost.seconds;
  c.rays = static_cast<std::uint64_t>(rays + cost.rays);
  c.bytes = static_cast<std::uint64_t>(bytes + (all > 0 ? bytes / all : kMapBytesPerPixel) * surround);
  c.raw_bytes = static_cast<std::uint64_t>(kMapBytesPerPixel * (all + surround));
  return c;
}

}  // namespace oriel
