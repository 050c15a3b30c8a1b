#include "bake/run/fit_maps.h"

#include <fmt/format.h>

#include "bake/radiance/surround_capture.h"

namespace oriel {
namespace {

constexpr std::uint32_t kTried = 8;       // by which a map's sides are divided to time its capture
constexpr std::uint32_t kLeastSide = 16;  // of a map that is made smaller
constexpr double kTriangleBytes = 12;     // of a pack, about: checked and written
constexpr double kJudging = 0.3;          // of the seconds of planning: held-out eyes

// What capturing all surround maps takes, by a 64th of their texels.
Result<double> surround_seconds(const BakedScene& baked, const FoundReflections& all, Context& context) {
  const std::vector<bool> is_shiny = shiny_triangles(baked.accel.scene(), all);
  FoundCurvedReflectors curved = all.curved;
  const double texels = make_coarser(1, curved.maps), tried = make_coarser(kTried, curved.maps);
  if (!(tried > 0)) return 0;
  for (FoundCurvedReflector& reflector : curved.reflectors) reflector.alpha *= kTried;  // as many paths a texel
  const Trial trial(context);
  const ElapsedTime clock;
  ORIEL_TRY_VOID(capture_surroundings(baked.accel, curved, with_lobes_of(is_shiny, baked, context.seed), context));
  return texels / tried * clock.spent();
}

// Captures maps whose sides are divided: what all of them are likely to take.
Status time_capture(const BakeOptions& options, const BakedScene& dark, Context& context, PlannedReflections& planned) {
  const FoundReflections& all = planned.all;
  const ReflectedSurroundings surroundings(dark.accel, all.found.reflectors, options.sight);
  std::vector<RadianceMap> maps = planned.plan.maps;
  double pixels = 0;
  for (RadianceMap& map : maps) {
    map.width = std::max(1u, map.width / kTried), map.height = std::max(1u, map.height / kTried);
    pixels += double{1.0f * map.width} * map.height;
  }
  const std::vector<bool> is_curved = curved_triangles(dark.accel.scene(), all);
  const ElapsedTime clock;
  {
    const Trial trial(context);
    ORIEL_TRY_VOID(capture_maps({surroundings, with_lobes_of(is_curved, dark, context.seed)}, context, maps));
  }
  const double planar_s = clock.spent() * planned.planar_pixels() / std::max(pixels, 1.0);
  ORIEL_TRY(planned.surround_s, surround_seconds(dark, all, context));
  planned.capture_s = planar_s + planned.surround_s + kJudging * planned.seconds;
  return {};
}

}  // namespace

void leave_out_maps(const Warning& why, PlannedReflections& planned) {
  planned.plan = {};
  for (FoundReflector& r : planned.all.found.reflectors)
    if (r.way == ReflectorWay::kMaps) r.way = ReflectorWay::kGeometry, r.why = why.text;
  planned.all.curved = {};
  planned.all.omissions.emplace_back("radiance maps: left out, " + why.text, why.code);
}

void shrink_maps(double seconds, PlannedReflections& planned) {
  std::uint32_t halved = 0;
  const double judging = kJudging * planned.seconds;
  while (planned.capture_s > seconds && planned.capture_s > 1.1 * judging) {
    const double planar = planned.planar_pixels(), surround = planned.surround_pixels();
    const double planar_s = planned.capture_s - judging - planned.surround_s;
    for (RadianceMap& map : planned.plan.maps)
      map.width = std::max(kLeastSide, map.width / 2), map.height = std::max(kLeastSide, map.height / 2);
    for (SurroundMap& map : planned.all.curved.maps) map.size = std::max(kLeastSide, map.size / 2);
    if (planned.planar_pixels() + planned.surround_pixels() >= planar + surround) break;  // as small as they may be
    planned.surround_s *= planned.surround_pixels() / std::max(surround, 1.0);
    planned.capture_s = judging + planar_s * planned.planar_pixels() / std::max(planar, 1.0) + planned.surround_s;
    ++halved;
  }
  if (halved > 0)
    planned.plan.omitted.push_back(
        fmt::format("radiance maps: of 1/{} the pixels along each side, to stay within --time", 1u << halved));
}

double bytes_of(const PreparedScene& prepared, const PlannedReflections& planned) {
  double bytes = kTriangleBytes * static_cast<double>(prepared.scene().triangles.size());
  for (const AtlasPage& page : prepared.atlas.pages) bytes += 8.0 * page.width * page.height;
  for (const RadianceMap& map : planned.plan.maps) bytes += double{kMapBytesPerPixel} * map.width * map.height;
  return bytes;
}

Status time_reflections(const BakeTask& bake, Pack& dark, PlannedReflections& planned) {
  const Atlas& atlas = bake.prepared.atlas;
  dark.lightmaps.clear();
  for (const AtlasPage& page : atlas.pages) {
    const std::size_t texels = std::size_t{page.width} * page.height;
    dark.lightmaps.push_back({page.width, page.height, std::vector<Vec3>(texels), {}, {}});
  }
  return time_capture(bake.options, {bake.accel(), bake.lights, atlas, dark.lightmaps}, bake.context, planned);
}

Result<double> fit_reflections(const BakeTask& bake, const TimeBudget& budget, PlannedReflections& planned) {
  Pack dark;
  if (planned.has_images()) {
    const double until = budget.left() - budget.for_each_other();
    ORIEL_TRY(const bool tried, done_in_time(
                                    bake.context, [&] { return budget.left() < until; },
                                    [&] { return time_reflections(bake, dark, planned); }));
    if (!tried) leave_out_maps({"a few of their pixels already take too long for --time", "time-over"}, planned);
    shrink_maps(budget.for_maps(), planned);
  }
  const double field = bake.options.with_transfer && bake.prepared.wants_light_field() ? budget.for_light_field() : 0;
  return TimeBudget::kept_for(planned.capture_s + TimeBudget::writing(bytes_of(bake.prepared, planned))) + field;
}

}  // namespace oriel
