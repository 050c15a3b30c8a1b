#include "bake/run/fit_maps.h"

#include <fmt/format.h>

#include <utility>

#include "bake/jobs/parallel.h"
#include "bake/run/lobe_share.h"

namespace oriel {
namespace {

constexpr std::uint32_t kTried = 8;       // by which a map's sides are divided to time its capture
constexpr std::uint32_t kLeastSide = 16;  // of a map that is made smaller
constexpr double kPixel_s = 1e-6;         // of surround maps, where no planar map tells
constexpr double kJudging = 0.3;          // of the seconds of planning: residual maps and held-out eyes

Status time_capture(const BakeOptions& options, const BakedScene& dark, Context& context, PlannedReflections& planned) {
  std::vector<RadianceMap> maps = planned.plan.maps;
  double tried = 0;
  for (RadianceMap& map : maps) {
    map.width = std::max(1u, map.width / kTried), map.height = std::max(1u, map.height / kTried);
    tried += double{1.0f * map.width} * map.height;
  }
  std::uint32_t paths = 1;
  const OutgoingRadiance outgoing = [&](const SeenSurface& seen) {
    return baked_radiance_with_lobes(dark, seen, paths, context.seed, *seen.rays);
  };
  const ReflectedSurroundings surroundings(dark.accel, planned.all.found.reflectors, options.sight);
  ORIEL_TRY(const double share, lobe_share(dark, surroundings, planned.plan.maps, {}, context));
  paths = lobe_paths(share * planned.pixels());
  const ElapsedTime clock;
  UnitStore* const units = std::exchange(context.units, nullptr);  // what was found would take no time
  const Status captured = capture_maps(surroundings, outgoing, context, maps, nullptr);
  context.units = units;
  ORIEL_TRY_VOID(captured);
  const double a_pixel = tried > 0 ? clock.spent() / tried : kPixel_s;
  planned.capture_s = planned.pixels() * a_pixel + kJudging * planned.seconds;
  return {};
}

}  // namespace

void leave_out_maps(const Warning& why, PlannedReflections& planned) {
  planned.plan = {};
  for (FoundReflector& r : planned.all.found.reflectors)
    if (r.way == ReflectorWay::kMaps) r.way = ReflectorWay::kGeometry, r.why = why.text;
  planned.all.curved = {};
  planned.all.omissions.emplace_back("radiance maps: left out, " + why.text, why.kind);
}

void shrink_maps(double seconds, PlannedReflections& planned) {
  std::uint32_t halved = 0;
  const double judging = kJudging * planned.seconds;
  while (planned.capture_s > seconds && planned.capture_s > 1.1 * judging) {
    const double before = planned.pixels();
    for (RadianceMap& map : planned.plan.maps)
      map.width = std::max(kLeastSide, map.width / 2), map.height = std::max(kLeastSide, map.height / 2);
    for (SurroundMap& map : planned.all.curved.maps) map.size = std::max(kLeastSide, map.size / 2);
    if (planned.pixels() >= before) break;  // all are as small as they may be
    planned.capture_s = judging + (planned.capture_s - judging) * planned.pixels() / before;
    ++halved;
  }
  if (halved > 0)
    planned.plan.omitted.push_back(
        fmt::format("radiance maps: of 1/{} the pixels along each side, to stay within --time", 1u << halved));
}

double bytes_of(const Pack& pack, const PlannedReflections& planned) {
  double bytes = 0;
  for (const LightmapPage& page : pack.lightmaps) bytes += 8.0 * static_cast<double>(page.irradiance.size());
  for (const RadianceMap& map : planned.plan.maps) bytes += double{kMapBytesPerPixel} * map.width * map.height;
  return bytes;
}

Status time_reflections(const BakeOptions& options, const PreparedScene& prepared, const LightSet& lights, Pack& dark,
                        Context& context, PlannedReflections& planned) {
  dark.lightmaps.clear();
  for (const AtlasPage& page : prepared.atlas.pages) {
    const std::size_t texels = std::size_t{page.width} * page.height;
    dark.lightmaps.push_back({page.width, page.height, std::vector<Vec3>(texels), {}, {}});
  }
  return time_capture(options, {*prepared.accel, lights, prepared.atlas, dark.lightmaps}, context, planned);
}

Result<double> fit_reflections(const BakeOptions& options, const PreparedScene& prepared, const LightSet& lights,
                               const TimeBudget& budget, Context& context, PlannedReflections& planned) {
  Pack dark;
  if (planned.has_images()) {
    const double until = budget.left() - budget.for_timing();
    const auto late = [&] { return budget.left() < until; };
    Status tried;
    {
      const Interruptible interruptible(context, late);
      tried = time_reflections(options, prepared, lights, dark, context, planned);
    }
    if (!tried && (context.stop || !late())) return tl::unexpected(tried.error());
    if (!tried)
      leave_out_maps({"a few of their pixels already take too long for --time", WarningKind::kTimeOver}, planned);
    shrink_maps(budget.for_maps(), planned);
  }
  const double field = prepared.movers.empty() ? 0 : budget.for_light_field();
  return TimeBudget::kept_for(planned.capture_s + TimeBudget::writing(bytes_of(dark, planned))) + field;
}

}  // namespace oriel
