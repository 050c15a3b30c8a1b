#include "bake/run/pipeline.h"

#include <algorithm>
#include <functional>
#include <optional>

#include "bake/jobs/parallel.h"
#include "bake/run/fit_maps.h"
#include "bake/run/forecast.h"
#include "bake/run/frosted_panes.h"
#include "bake/run/group_light.h"
#include "bake/run/idle_options.h"
#include "bake/run/inputs.h"
#include "bake/run/movers.h"
#include "bake/run/prepare.h"
#include "bake/run/report.h"
#include "bake/run/shortfalls.h"
#include "bake/run/start.h"
#include "bake/run/time_budget.h"
#include "bake/run/unlit.h"
#include "bake/run/visibility.h"

namespace oriel {
namespace {

constexpr double kLightField = 0.4;    // of the time that texels' first light takes a thread: measured on few scenes
constexpr double kFiltered_s = 8e-6;   // of a texel, for filters, seams and pages: 4 s for half a million of a hall
constexpr double kLeastLight_s = 0.1;  // that a lightmap takes
constexpr double kLedgerRays = 0.01;   // of the lightmap's

// What a stage makes that the bake can do without: none where --time is over before, or the user wants to finish.
template <class Made>
auto unless(const std::function<bool()>& late, Context& context, const Made& make)
    -> Result<std::optional<std::decay_t<decltype(*make())>>> {
  std::optional<std::decay_t<decltype(*make())>> made;
  ORIEL_TRY_VOID(done_in_time(context, late, [&] { return make().map([&](auto&& all) { made = std::move(all); }); }));
  return made;
}

// One bake: what its stages hand on to each other. Each stage is a function; run() names them in their order.
class Bake {
 public:
  Bake(const BakeOptions& options, Context& context) : options_(options), context_(context), budget_(options.time_s) {
    context_.foretold = [this](std::string_view part, double done) { forecast_.at(part, done, clock_.spent()); };
    context_.progress = [this](Progress progress) {
      // A loop of another stage's is a try, as that of the time that reflections take.
      if (progress.stage == stage_ || (stage_ == "radiance" && progress.stage == "surroundings"))
        forecast_.at(progress.stage, progress.fraction, clock_.spent());
      progress.left_s = std::min(forecast_.left(clock_.spent()).value_or(-1), budget_.left());
      if (listener_) listener_(progress);
    };
  }
  ~Bake() {
    context_.progress = listener_;
    context_.foretold = nullptr;
  }
  Bake(const Bake&) = delete;
  Bake& operator=(const Bake&) = delete;

  // Each step returns its product; what a pack holds of it is put there here alone.
  Result<BakeResult> run() {
    ORIEL_TRY_VOID(prepare());
    // What needs no light comes first: what it takes is known when the lightmap asks how long it may be refined.
    ORIEL_TRY(MaterialMaps materials, bake_material_maps());
    ORIEL_TRY(FoundReflections found, find_reflectors(materials));
    AssembledMesh mesh = assemble_mesh(scene(), prepared_.atlas);
    ORIEL_TRY(SceneSets sets, find_visible_sets(found, mesh));
    ORIEL_TRY(PlannedReflections planned, plan_views(std::move(found), std::move(sets.reflected_triangles)));
    tell_idle_options(planned);
    ORIEL_TRY(BakedMovers movers, bake_transfer_of_movers(materials));
    ORIEL_TRY(later_s_, fit_to_time(planned));
    ORIEL_TRY_VOID(foretell_reflections(planned));
    ORIEL_TRY(Radiosity light, bake_lightmap());
    ORIEL_TRY(result_.ledger, keep_energy_ledger(light));
    pack().lightmaps = std::move(light.pages), pack().sharp_light = std::move(light.sharp_light);
    const auto eyes = sample_eyes(prepared_.region, kLightmapEyes, context_.seed);
    ORIEL_TRY(unlit_white_, unlit_white(task(), path_options(options_), eyes));
    if (options_.with_radiance) pack().walk_grids = planned.all.region.grids;
    ORIEL_TRY(BakedReflections reflections, capture_reflections(std::move(planned), materials, mesh));
    put(std::move(sets.visible), std::move(sets.reflected), reflections);
    ORIEL_TRY(pack().light_field, bake_light_field_of_movers());
    pack().movers = std::move(movers.movers);
    ORIEL_TRY(pack().frosted_panes, find_frosted_panes(mesh, pack().emitters));
    ORIEL_TRY_VOID(assemble(std::move(materials), std::move(mesh), light.groups));
    ORIEL_TRY(const Start start, timed_("start", [&](auto&) { return choose_start(); }));
    hash_sets(pack());
    ORIEL_TRY_VOID(check());
    describe({start, sets.report, reflections.report, movers.reports});
    return std::move(result_);
  }

 private:
  // The scene, where people can be, and the lightmap's layout.
  Status prepare() {
    ORIEL_TRY(prepared_, prepare_scene(options_, timed_, context_));
    BakeOptions layout = options_;
    if (budget_.limited()) layout.atlas.time_limit_s = budget_.for_atlas();
    ORIEL_TRY_VOID(lay_out_lightmap(layout, timed_, context_, prepared_, budget_.left()));
    result_.omissions = prepared_.omissions;
    for (const Surface& surface : scene().surfaces)
      for (const std::string& name : {surface.name, surface.mesh_name})
        result_.node_paths.try_emplace(name, surface.node_path);
    ORIEL_TRY_VOID(assign_light_groups(options_.light_groups, prepared_.imported->scene, context_));
    lights_.emplace(scene(), &accel());
    transport_.emplace(accel(), *lights_, path_options(options_));
    warn_about_light(scene(), *lights_, context_);
    foretell_light();
    return {};
  }

  void foretell_light() {
    const double light_s = Forecast::kTexel_s * prepared_.texels();
    forecast_.expect("probes", wants_light_field() ? kLightField * light_s : 0);
    forecast_.expect("first light", std::max(light_s / thread_count(context_), kLeastLight_s));
  }

  Result<MaterialMaps> bake_material_maps() {
    return timed_("material", [&](auto&) {
      const StageInputs inputs(context_, std::string("material"));
      return bake_materials(scene(), material_options(options_), context_);
    });
  }

  // None where reflections are left out.
  Result<FoundReflections> find_reflectors(const MaterialMaps& materials) {
    if (!options_.with_radiance) return FoundReflections();
    return timed_("reflectors", [&](auto&) {
      return find_reflections(options_, prepared_, materials.summaries, budget_.for_each_other(), context_);
    });
  }

  // Each reflector's way, by what it shows; the viewpoints of those that have maps.
  Result<PlannedReflections> plan_views(FoundReflections found, std::vector<std::uint64_t> reflected_triangles) {
    PlannedReflections planned;
    if (options_.with_radiance) {
      if (reflected_triangles.empty())
        reflected_triangles.assign(found.found.reflectors.size(), scene().triangles.size());
      choose_ways(options_.ways, options_.target, reflected_triangles, found.found.reflectors);
      ORIEL_TRY(planned, timed_("views", [&](auto&) {
                  return plan_reflections(task(), std::move(found), budget_.for_views());
                }));
    }
    if (planned.has_images())
      ORIEL_TRY_VOID(timed_("mips", [&](auto&) { return make_mips(prepared_.imported->scene, context_); }));
    return planned;
  }

  void tell_idle_options(const PlannedReflections& planned) {
    const auto is_sun = [](const Light& light) { return light.type == LightType::kDirectional; };
    const IdleFacts facts{std::any_of(scene().lights.begin(), scene().lights.end(), is_sun), !prepared_.movers.empty(),
                          wants_light_field(), !planned.empty(), !planned.plan.maps.empty()};
    for (const std::string& line : idle_options(options_, facts)) context_.warning("idle-option", line);
  }

  // Sorts the mesh's triangles by what is seen together, where sets pay.
  Result<SceneSets> find_visible_sets(const FoundReflections& found, AssembledMesh& mesh) {
    ORIEL_TRY(SceneSets sets, timed_("visibility", [&](std::uint64_t& rays) {
                auto baked = bake_visibility(task(), {found.region.grids, found.eyes, found.found.reflectors},
                                             budget_.for_visible_sets(), mesh);
                if (baked) rays += baked->report.lines;
                return baked;
              }));
    omit(sets.omissions);
    return sets;
  }

  Result<BakedMovers> bake_transfer_of_movers(MaterialMaps& materials) {
    if (prepared_.movers.empty()) return BakedMovers();
    return timed_("transfer",
                  [&](std::uint64_t& rays) { return bake_movers(task(), budget_.for_each_other(), materials, rays); });
  }

  // Makes maps as large as --time allows; the seconds that all stages behind the lightmap are likely to take.
  Result<double> fit_to_time(PlannedReflections& planned) {
    if (!budget_.limited()) return 0;
    return timed_("timing", [&](auto&) { return fit_reflections(task(), budget_, planned); });
  }

  // A few of their pixels tell how long all take.
  Status foretell_reflections(PlannedReflections& planned) {
    if (!planned.has_images()) return {};
    if (!budget_.limited()) {
      Pack dark;
      ORIEL_TRY_VOID(time_reflections(task(), dark, planned));
    }
    forecast_.expect("radiance", planned.capture_s - planned.surround_s);
    forecast_.expect("surroundings", planned.surround_s);
    return {};
  }

  Result<Radiosity> bake_lightmap() {
    RadiosityOptions radiosity = options_.radiosity;
    if (budget_.limited()) later_s_ += kFiltered_s * prepared_.texels();
    radiosity.enough = refined_enough(options_, budget_, later_s_, context_);
    if (budget_.limited()) {
      radiosity.left = [this] { return budget_.left() - later_s_; };
      radiosity.left_of_all = [this] { return budget_.left() - writing_s(); };
    }
    radiosity.directional = choose_directional(scene(), options_.directional, result_.omissions);
    radiosity.eyes = sample_eyes(prepared_.region, kLightmapEyes, context_.seed);
    radiosity.held_out = held_out_eyes(prepared_.region, kLightmapEyes, context_.seed);
    ORIEL_TRY(Radiosity light, timed_("radiosity", [&](std::uint64_t& rays) {
                const StageInputs inputs(context_, SurfacesOf{scene()}, LightsOf{scene()}, LayoutOf{prepared_.atlas},
                                         path_options(options_).max_bounces);
                auto baked = bake_radiosity(laid_out(), radiosity, context_);
                if (baked) rays = baked->report.rays;
                return baked;
              }));
    result_.radiosity = light.report;
    context_.finishable = true;
    judge_error(options_, light.report, budget_, context_, result_.shortfalls);
    if (!scene().light_groups.empty() && light.groups.empty())
      result_.omissions.emplace_back(
          "light groups: --estimator cached tells whose light it is, without --hidden-black");
    return light;
  }

  // Where the light goes; empty where there is no time for it.
  Result<Ledger> keep_energy_ledger(const Radiosity& light) {
    ORIEL_TRY(auto ledger, timed_("ledger", [&](std::uint64_t& rays) {
                const auto at_most = static_cast<std::uint64_t>(kLedgerRays * static_cast<double>(light.report.rays));
                auto kept = unless(late_, context_, [&] { return keep_ledger(laid_out(), light, at_most, context_); });
                if (kept && *kept) rays = (*kept)->rays;
                return kept;
              }));
    if (!ledger)
      result_.omissions.push_back({"energy ledger: left out, --time was over; a longer one has it", "time-over"});
    for (std::string& text : ledger_findings(ledger.value_or(Ledger())))
      result_.findings.push_back({std::move(text), "energy-ledger"});
    return ledger.value_or(Ledger());
  }

  Result<BakedReflections> capture_reflections(PlannedReflections planned, const MaterialMaps& materials,
                                               const AssembledMesh& mesh) {
    if (!options_.with_radiance) {
      result_.omissions.push_back({"reflections: left out by --only", "no-reflections"});
      return BakedReflections();
    }
    ORIEL_TRY(BakedReflections reflections, timed_("radiance", [&](std::uint64_t& rays) {
                auto made = reflections_in_time(std::move(planned), materials, mesh);
                if (made) rays = made->report.rays;
                return made;
              }));
    omit(reflections.report.omissions);
    return reflections;
  }

  // Left out where the user or the time wants the bake to finish.
  Result<BakedReflections> reflections_in_time(PlannedReflections planned, const MaterialMaps& materials,
                                               const AssembledMesh& mesh) {
    const Interruptible until(context_, late_);
    auto made = bake_reflections(task(), planned, materials, mesh);
    if (made || made.error().code != ErrorCode::kStopped || context_.stop) return made;
    const Warning why =
        context_.finish
            ? Warning("left out, the user asked the bake to finish")
            : Warning(fmt::format("left out, --time was over; {:.0f} s more have them", std::ceil(planned.capture_s)),
                      "time-over");
    return mirror_geometry(std::move(planned), mesh, why);
  }

  void put(VisibleSets visible, ReflectedSets reflected, BakedReflections& reflections) {
    pack().visible_sets = std::move(visible);
    pack().reflected_sets = std::move(reflected);
    pack().reflectors = std::move(reflections.reflectors);
    pack().radiance_maps = std::move(reflections.radiance_maps);
    pack().map_meshes = std::move(reflections.map_meshes);
    pack().emitters = std::move(reflections.emitters);
    pack().curved_reflectors = std::move(reflections.curved_reflectors);
    pack().surround_maps = std::move(reflections.surround_maps);
  }

  // None where nothing moves.
  Result<LightField> bake_light_field_of_movers() {
    if (!wants_light_field()) {
      if (options_.with_transfer)
        result_.omissions.emplace_back("movers: no node is marked (--object NODE:mover) or animated");
      return LightField();
    }
    const auto left = [this] { return context_.finish ? 0 : budget_.left() - writing_s(); };
    ORIEL_TRY(LightField field, timed_("probes", [&](std::uint64_t& rays) {
                return bake_light_field(task(), pack().walk_grids, left, rays);
              }));
    if (late_()) result_.omissions.emplace_back("light field: its last refinement is left out, the bake was to end");
    return field;
  }

  // Appends to `emitters` those that only panes show.
  Result<std::vector<Reflector>> find_frosted_panes(const AssembledMesh& mesh, std::vector<Emitter>& emitters) {
    context_.foretell("writing", 0);
    return timed_("panes", [&](auto&) { return list_frosted_panes(task(), mesh, late_, emitters, result_.omissions); });
  }

  // groups: as Radiosity::groups.
  Status assemble(MaterialMaps materials, AssembledMesh mesh, const std::vector<std::vector<LightmapPage>>& groups) {
    if (!options_.with_material) {
      result_.omissions.emplace_back("kernels: left out by --only");
      materials.kernels.clear(), materials.kernel.assign(materials.kernel.size(), -1);
    }
    if (const auto names = averaged_roughness(scene(), materials); !names.empty())
      result_.omissions.emplace_back(
          fmt::format("roughness textures are shown as their averages: of {}", fmt::join(names, ", ")));
    assemble_scene(scene(), std::move(materials), std::move(mesh), pack());
    for (Material& material : pack().materials)
      if (material.unlit) material.emission = Vec3(unlit_white_);
    return timed_("light groups", [&](std::uint64_t& rays) {
      std::atomic<std::uint64_t> traced{0};
      const Status status = assemble_light_groups(task().baked(), groups, late_, {context_, &traced}, pack());
      rays += traced;
      return status;
    });
  }

  // Adds a camera to a scene that has none.
  Result<Start> choose_start() {
    if (!pack().cameras.empty() || !pack().paths.empty()) return Start::kOfScene;
    ORIEL_TRY(FirstLook first, find_start(task(), late_));
    pack().cameras.push_back(std::move(first.camera));
    return first.inside ? Start::kInside : Start::kOutside;
  }

  Status check() {
    if (context_.stopped()) return fail(ErrorCode::kStopped, "bake", "stopped");
    ORIEL_TRY_VOID(timed_("checks", [&](auto&) { return leave_out_unsound(pack(), result_.left_out); }));
    omit(result_.left_out);
    return {};
  }

  struct Reports {
    Start start;
    const VisibilityReport& visibility;
    const ReflectionReport& reflections;
    const std::vector<MoverReport>& movers;
  };
  // What the pack says of itself.
  void describe(const Reports& reports) {
    tell_dropped(accel(), result_.findings);
    if (!late_())
      tell_backs(accel(), sample_eyes(prepared_.region, kLightmapEyes, context_.seed), context_.seed, result_.findings);
    judge_stages(result_, context_, result_.shortfalls);
    // With --time alone it goes on as long as that lasts: nobody asked for an error.
    const double asked = budget_.limited() && !options_.error_named ? 0 : options_.radiosity.error;
    pack().plan = plan_json({scene(), prepared_.atlas, prepared_.sides, result_.radiosity, result_.ledger, pack(),
                             result_.omissions, lights_->power(), reports.reflections, reports.movers,
                             reports.visibility, options_.radiosity.estimator == Estimator::kCached, asked,
                             reports.start, result_.findings, result_.warnings});
    pack().provenance = provenance_json(options_, context_.seed, prepared_.imported->inputs);
    judge_time(options_, budget_, result_.times, context_, result_.shortfalls);
    const std::size_t warned = result_.warnings.size();
    for (const Warning& finding : result_.findings) context_.warning(finding);
    result_.warnings.erase(result_.warnings.begin() + static_cast<std::ptrdiff_t>(warned),
                           result_.warnings.end());  // findings have a list of their own
    if (context_.units) result_.units = context_.units->share();
  }

  // Whether the bake is to end with what there is.
  const std::function<bool()> late_ = [this] { return context_.finish || budget_.left() <= writing_s(); };
  double writing_s() const { return TimeBudget::writing(bytes_of(prepared_, {})); }
  bool wants_light_field() const { return options_.with_transfer && prepared_.wants_light_field(); }
  const Scene& scene() const { return prepared_.scene(); }
  const Accel& accel() const { return *prepared_.accel; }
  Pack& pack() { return result_.pack; }
  LightmapScene laid_out() const { return {*transport_, prepared_.atlas, prepared_.texel_map}; }
  BakeTask task() {
    return {options_, prepared_, *lights_, context_, pack().lightmaps, unlit_white_, &pack().sharp_light};
  }
  template <class Lines>
  void omit(const Lines& lines) {
    result_.omissions.insert(result_.omissions.end(), lines.begin(), lines.end());
  }

  const BakeOptions& options_;
  Context& context_;
  TimeBudget budget_;
  BakeResult result_;
  WarningLog log_{context_, result_.warnings};
  const std::function<void(const Progress&)> listener_ = context_.progress;
  const ElapsedTime clock_;
  Forecast forecast_;
  std::string_view stage_;
  Stopwatch timed_{result_.times, [this](const char* stage) { context_.foretell(stage_ = stage, 0); }};
  PreparedScene prepared_;
  std::optional<LightSet> lights_;      // of the prepared scene
  std::optional<Transport> transport_;  // likewise
  float unlit_white_ = 1;
  double later_s_ = 0;  // that all stages behind the lightmap are likely to take
};

}  // namespace

Result<BakeResult> bake(const BakeOptions& options, Context& context) {
  return Bake(options, context).run();
}

}  // namespace oriel
