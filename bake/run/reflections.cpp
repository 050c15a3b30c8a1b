#include "bake/run/reflections.h"

#include <cmath>
#include <limits>
#include <utility>

#include "bake/jobs/parallel.h"
#include "bake/jobs/units.h"
#include "bake/radiance/emitters.h"
#include "bake/radiance/map_mesh.h"
#include "bake/radiance/surround_capture.h"
#include "bake/radiance/surround_viewpoints.h"
#include "bake/run/baked_light.h"
#include "bake/run/fit_maps.h"
#include "bake/run/inputs.h"

namespace oriel {
namespace {

constexpr std::uint32_t kTrainingEyes = 4096, kHeldOutEyes = 1000, kHeldOutSamples = 2048;
constexpr std::uint32_t kFewest = 16, kFewer = 4;  // that samples of planning are divided by

std::vector<ReflectorMaterial> reflector_materials(std::span<const MaterialSummary> materials) {
  std::vector<ReflectorMaterial> out;
  for (const MaterialSummary& m : materials) out.push_back({m.roughness, m.f0, m.f90, m.curve});
  return out;
}

// α by material, of those whose kernel blurs: closed forms need its lobe. 0: no kernel, or a mirror's.
std::vector<float> lobe_widths(const MaterialMaps& maps) {
  std::vector<float> out;
  for (const std::int32_t index : maps.kernel) {
    const BrdfKernel* kernel = index >= 0 ? &maps.kernels[static_cast<std::size_t>(index)] : nullptr;
    out.push_back(kernel != nullptr && kernel->size > 1 ? kernel->alpha : 0.0f);
  }
  return out;
}

template <class Line>
void append(std::vector<Warning>& lines, const std::vector<Line>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

// The reflectors that eyes see, most important first, and what shines without lying in a plane.
Status find_planar(const BakeOptions& options, const Accel& accel, Context& context, FoundReflections& all) {
  ReflectorOptions wide = options.reflectors;  // a large one that nobody sees must not push out a small one
  wide.max_reflectors = 4 * std::min(options.reflectors.max_reflectors, std::numeric_limits<std::uint32_t>::max() / 4);
  FoundReflectors& found = all.found = find_reflectors(accel, all.lobes, wide);
  ORIEL_TRY_VOID(keep_seen_reflectors(accel, all.eyes, options.reflectors.max_reflectors, context, found));
  append(all.omissions, found.omitted);
  if (found.reflectors.empty())
    all.omissions.emplace_back("radiance maps: no planar surface that is shiny and large enough is seen");
  return {};
}

// Whether there is a sky to be seen.
bool shines(const Scene& scene) {
  return max_component(scene.sky) > 0 || !scene.sky_image.texels.empty();
}

Result<ViewPlan> plan_maps(const BakeOptions& options, const Accel& accel, Context& context,
                           PlannedReflections& planned) {
  std::vector<FoundReflector>& reflectors = planned.all.found.reflectors;
  const std::vector<FoundReflector> as_found = reflectors;
  const StageInputs inputs(context, SurfacesOf{accel.scene()}, shines(accel.scene()), as_found, options.sight);
  PlannedViewOptions views = options.planned;
  views.eyes = planned.all.eyes;
  return plan_views_for_eyes(ReflectedSurroundings(accel, as_found, options.sight), views, context, reflectors);
}

// Of eyes that are given those that are asked one by one: the first, which are cameras, and some of the others, which
// may be hundreds of a path's keys.
std::vector<Vec3> cameras_of(std::span<const Vec3> given) {
  constexpr std::size_t kFirst = 16, kOthers = 8;
  const std::size_t first = std::min(given.size(), kFirst), others = given.size() - first;
  std::vector<Vec3> cameras;
  for (std::size_t i = 0; i < first; ++i) cameras.push_back(given[i]);
  for (std::size_t i = 0; i < std::min(others, kOthers); ++i) cameras.push_back(given[first + i * others / kOthers]);
  return cameras;
}

// Eyes that were not planned for, and cameras.
struct Judges {
  std::vector<Vec3> eyes, cameras;
};

Status judge(const LitSurroundings& lit, std::span<const RadianceMap> maps, const Judges& judges, const Stage& stage,
             ReflectionReport& report) {
  const ReflectedSurroundings& surroundings = lit.around;
  Context& context = stage.context;
  for (std::uint32_t r = 0; r < surroundings.reflectors().size(); ++r) {
    const Reflector& reflector = surroundings.reflectors()[r].reflector;
    const auto own = maps.subspan(reflector.first_map, reflector.map_count);
    ViewQuality q;
    ReflectedError e;
    if (reflector.map_count == 0) {
      report.quality.push_back(q);
      report.errors.push_back(e);
      continue;
    }
    std::uint64_t traced = 0;
    const auto inputs = [&](Archive& key) {
      key(r, judges.eyes, judges.cameras);
      for (const RadianceMap& map : own) key(frame_of(map));
    };
    const auto compute = [&]() -> Status {
      ORIEL_TRY(const auto samples,
                sample_reflections(surroundings, r, {judges.eyes, kHeldOutSamples, context.seed + 1}, context));
      q = judge_maps(surroundings, own, samples, context);
      std::atomic<std::uint64_t> judging{0};
      ORIEL_TRY(q.worst, worst_seen(surroundings, r, own, judges.cameras, context));
      ORIEL_TRY(e, judge_light(lit, r, own, samples, {context, &judging}));
      traced = judging;
      return {};
    };
    ORIEL_TRY_VOID(one_unit(context, "quality", inputs, compute, [&](Archive& archive) {
      archive(q.seen, q.sharp, q.worst, e.samples, e.seen, e.relative_error, e.seen_error, traced);
    }));
    stage.count(traced);
    report.quality.push_back(q);
    report.errors.push_back(e);
  }
  return {};
}

// leave_out_emitters() as a unit of work.
Status leave_out_lamps(const BakeTask& bake, const std::vector<float>& lobe_widths,
                       std::vector<FoundReflector>& reflectors, std::vector<Emitter>& emitters,
                       std::vector<Warning>& omissions) {
  const Accel& accel = bake.accel();
  Context& context = bake.context;
  const StageInputs inputs(context, SurfacesOf{accel.scene()}, LightsOf{accel.scene()}, lobe_widths, reflectors);
  std::vector<std::string> omitted;
  ORIEL_TRY_VOID(one_unit(
      context, "emitters", [](Archive&) {},
      [&] {
        return leave_out_emitters(accel, {.lobe_widths = lobe_widths}, context, {reflectors, emitters, omitted});
      },
      [&](Archive& archive) { archive(reflectors, emitters, omitted); }));
  append(omissions, omitted);
  return {};
}

template <class Found, class Kept>
void keep(std::vector<Found>& found, const AssembledMesh& mesh, std::vector<Kept>& kept) {
  for (Found& f : found) {
    f.reflector.indices = mesh_indices(mesh, f.triangles);
    kept.push_back(std::move(f.reflector));
  }
}

std::vector<SeenOfTriangle> seen_triangles(const TexelDemand& demand) {
  std::vector<SeenOfTriangle> seen;
  for (const TriangleDemand& t : demand.triangles) seen.push_back({t.pixels, t.inverse_square});
  return seen;
}

void mark(std::span<const std::uint32_t> triangles, std::vector<bool>& marked) {
  for (const std::uint32_t t : triangles) marked[t] = true;
}

// Of the units found so far, what computing them once took, over all threads.
double reused_s(const Context& context) {
  return context.units ? context.units->share().reused_s : 0;
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

Result<FoundReflections> find_reflections(const BakeOptions& options, const PreparedScene& prepared,
                                          std::span<const MaterialSummary> materials, double seconds,
                                          Context& context) {
  const ElapsedTime clock;
  const Interruptible until(context, [&] { return clock.spent() > seconds; });
  const Accel& accel = *prepared.accel;
  FoundReflections all;
  all.region = prepared.region;
  all.eyes = sample_eyes(all.region, kTrainingEyes, context.seed);
  all.lobes = reflector_materials(materials);
  const StageInputs inputs(context, SurfacesOf{accel.scene()}, shines(accel.scene()), all.lobes, options.reflectors);
  ORIEL_TRY_VOID(find_planar(options, accel, context, all));
  CurvedOptions curved = options.curved;
  curved.memory_bytes = std::min(curved.memory_bytes, options.planned.memory_bytes / 4);
  all.curved =
      find_curved_reflectors(accel.scene(), all.found.unplanar, all.lobes, seen_triangles(prepared.demand), curved);
  ORIEL_TRY_VOID(place_surround_maps(accel, all.eyes, context, all.curved));
  append(all.omissions, all.curved.omitted);
  return all;
}

Result<PlannedReflections> plan_reflections(const BakeTask& bake, FoundReflections found_ones, double seconds) {
  const BakeOptions& options = bake.options;
  const Accel& accel = bake.accel();
  Context& context = bake.context;
  PlannedReflections planned;
  planned.all = std::move(found_ones);
  const bool dark = bake.lights.empty() && max_component(accel.scene().sky) <= 0;
  if (dark && !planned.all.empty()) planned.all.omissions.emplace_back("radiance maps: the scene has no light");
  if (dark) planned.all.found = {}, planned.all.curved = {};
  if (planned.all.empty()) return planned;
  const std::vector<FoundReflector> found = planned.all.found.reflectors;
  BakeOptions fewer = options;
  // Planning that takes longer than twice its time ends: the maps of the round before stay, or there are none.
  const ElapsedTime whole;
  const double most = 2 * seconds;
  const Interruptible until(context, [&] { return whole.spent() > most; });
  for (std::uint32_t divisor = std::isfinite(seconds) ? kFewest : 1;; divisor /= kFewer) {
    const ElapsedTime clock;
    const double reused_before = reused_s(context);
    fewer.planned.samples = std::max(1u, options.planned.samples / divisor);
    const std::vector<FoundReflector> before = std::exchange(planned.all.found.reflectors, found);
    auto plan = plan_maps(fewer, accel, context, planned);
    if (!plan && !context.stop && whole.spent() > most) {
      planned.all.found.reflectors = before;
      if (divisor == kFewest) {
        leave_out_maps({"planning them takes too long for --time", "time-over"}, planned);
        planned.divisor = divisor, planned.seconds = whole.spent();
      }
      break;
    }
    if (!plan) return tl::unexpected(plan.error());
    planned.plan = std::move(*plan);
    planned.divisor = divisor;
    seconds -= clock.spent();
    planned.seconds = clock.spent() + (reused_s(context) - reused_before) / thread_count(context);
    if (divisor == 1 || kFewer * planned.seconds > seconds) break;
  }
  return planned;
}

double PlannedReflections::planar_pixels() const {
  double sum = 0;
  for (const RadianceMap& map : plan.maps) sum += double{1.0f * map.width} * map.height;
  return sum;
}

double PlannedReflections::surround_pixels() const {
  double sum = 0;
  for (const SurroundMap& map : all.curved.maps) sum += double{1.0f * map.size} * map.size;
  return sum;
}

Result<BakedReflections> bake_reflections(const BakeTask& bake, PlannedReflections planned,
                                          const MaterialMaps& materials, const AssembledMesh& mesh) {
  const BakeOptions& options = bake.options;
  const BakedScene baked = bake.baked();
  const Accel& accel = bake.accel();
  Context& context = bake.context;
  BakedReflections out;
  ReflectionReport& report = out.report;
  auto& [region, eyes, lobes, found, curved, omissions] = planned.all;
  ViewPlan& plan = planned.plan;
  report.omissions = std::move(omissions);
  if (planned.empty()) return out;
  std::vector<FoundReflector>& reflectors = found.reflectors;
  const std::vector<bool> is_curved = curved_triangles(accel.scene(), planned.all);
  const std::vector<bool> is_shiny = shiny_triangles(accel.scene(), planned.all);
  const OutgoingRadiance to_planar = with_lobes_of(is_curved, baked, context.seed);
  if (options.with_material)
    ORIEL_TRY_VOID(leave_out_lamps(bake, lobe_widths(materials), reflectors, out.emitters, report.omissions));
  const ReflectedSurroundings surroundings(accel, reflectors, options.sight);
  const StageInputs inputs(context, LitScene{baked}, reflectors, options.sight, found.unplanar, kLobePaths);
  std::atomic<std::uint64_t> rays{0};
  const Stage stage{context, &rays};
  const LitSurroundings lit{surroundings, to_planar};
  ORIEL_TRY_VOID(capture_maps(lit, stage, plan.maps));
  ORIEL_TRY_VOID(capture_surroundings(accel, curved, with_lobes_of(is_shiny, baked, context.seed), stage));
  add_punctual_lights(accel, curved);
  const Judges judges{held_out_eyes(region, kHeldOutEyes, context.seed), cameras_of(region.points)};
  report.omissions.insert(report.omissions.begin(), plan.omitted.begin(), plan.omitted.end());
  ORIEL_TRY_VOID(judge(lit, plan.maps, judges, stage, report));
  ORIEL_TRY(out.map_meshes, mesh_maps(surroundings, plan.maps, {}, context));
  report.rays = rays;
  out.radiance_maps = std::move(plan.maps);
  for (const FoundReflector& r : reflectors) report.ways.push_back(r.why);
  keep(reflectors, mesh, out.reflectors);
  out.surround_maps = std::move(curved.maps);
  keep(curved.reflectors, mesh, out.curved_reflectors);
  return out;
}

BakedReflections mirror_geometry(PlannedReflections planned, const AssembledMesh& mesh, const Warning& why) {
  BakedReflections out;
  ReflectionReport& report = out.report;
  FoundReflections& all = planned.all;
  const std::size_t curved = all.curved.reflectors.size();
  report.omissions = std::move(all.omissions);
  for (FoundReflector& r : all.found.reflectors) {
    Reflector& drawn = r.reflector;
    drawn.first_map = drawn.map_count = drawn.elements_x = drawn.elements_y = 0;
    report.ways.push_back(why.text);
  }
  if (!planned.plan.maps.empty())
    report.omissions.emplace_back(fmt::format("radiance maps: {}; mirrors are drawn as mirrored geometry", why.text),
                                  why.code);
  if (curved > 0)
    report.omissions.emplace_back(
        fmt::format("surround maps of {} curved reflectors: {}; they show no reflections", curved, why.text), why.code);
  keep(all.found.reflectors, mesh, out.reflectors);
  return out;
}

}  // namespace oriel
