#include "bake/radiosity/estimators/cached.h"

#include <algorithm>
#include <functional>

#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/filter.h"
#include "bake/radiosity/estimators/first_direct.h"
#include "bake/radiosity/estimators/lamp_light.h"
#include "bake/radiosity/estimators/light_component.h"
#include "bake/radiosity/estimators/patches.h"
#include "bake/radiosity/estimators/progress_estimate.h"
#include "bake/radiosity/estimators/write_pages.h"
#include "bake/radiosity/gather/bright_texels.h"
#include "bake/radiosity/gather/survival.h"
#include "bake/radiosity/texels/frame_error.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint32_t kOccludedDirect = 16;           // the same in occlusion-heavy texels
constexpr std::uint32_t kFirstGather = 4;               // rays a half and texel
constexpr std::uint32_t kFirstOccluded = 32;            // the same in occlusion-heavy texels
constexpr std::uint32_t kMostDark = 512;                // the same where these find nearly no light,
constexpr float kDark = 0.002f;                         // a fraction of the mean
constexpr double kLittleSeen = 0.1;                     // of the squared error asked for
constexpr float kCoarseError = 0.25f;                   // relative, of bounces without gather rays
constexpr double kGatherGain = 0.5, kDirectGain = 0.6;  // of the squared error, by a refinement

class CachedEstimator : public LightEstimator {
 public:
  CachedEstimator(const RadiosityTask& task, Texels texels)
      : task_(task),
        options_(task.options),
        context_(task.context),
        texels_(std::move(texels)),
        order_(coherent_order(texels_)),
        sample_points_(task, texels_, task.context.seed),
        direct_light_(task.transport, texels_, sample_points_, task.context.seed, {task.sharp}),
        query_(task.transport, texels_, direct_light_.closed_form(), task.context.seed),
        direct_(texels_.count(), options_.directional, query_.groups()),
        gathered_(texels_.count(), options_.directional, query_.groups()),
        lamps_(texels_.count(), options_.directional, query_.groups()),
        frames_(task.pixels, task.map, texels_.has_light()),
        most_rays_(options_) {}

  Status refine(double error) override {
    ORIEL_TRY_VOID(begin(error));
    return refine_to(error / noise_of_hours(query_, importance_, {direct_, gathered_}));
  }

  void write(Radiosity& light) const override {
    RadiosityReport& report = light.report;
    report.sweeps = sweeps_.count, report.sweep_tail = sweeps_.tail, report.sweep_growth = sweeps_.growth;
    report.bounded_patches = sweeps_.bounded;
    report.filter_drift = std::max(std::fabs(smooth_direct_.energy_drift), std::fabs(estimate_.energy_drift));
    report.ended_early = ended_early_, report.out_of_rays = out_of_rays_, report.first_rays = first_rays_;
    const std::vector<Vec4> of_gathered = smoothed_moments(graph_, gathered_, context_);
    write_texels({texels_, smooth_direct_, estimate_, direct_.sharp, direct_.moments, of_gathered}, light);
  }

  bool write_groups(std::vector<std::vector<LightmapPage>>& groups) const override {
    write_grouped(texels_, filter_groups(texels_, graph_, {direct_, gathered_}, options_.filter, context_), groups);
    return true;
  }

  std::optional<TexelLight> texel_light() const override {
    auto [extra, grouped] = smooth_additional(lamps_, texels_, graph_, gathered_, context_);
    const GroupHalves gathered{gathered_.grouped_halves(), false};
    GroupedLight reflected = filter_groups(texels_, graph_, gathered, options_.filter, context_);
    return TexelLight{
        texels_, query_, cached_, std::move(extra), std::move(grouped), estimate_, std::move(reflected), importance_};
  }

 private:
  // Computes direct light, its bounces on coarse patches, and the first gather.
  Status begin(double error) {
    ORIEL_TRY(const bool all, first_direct_.everywhere(order_));
    if (!all) frames_ = FrameError(task_.pixels, task_.map, texels_.has_light());
    ORIEL_TRY(graph_, find_neighbours(query_.transport(), texels_, task_.paths));
    error_graph_ = with_chart_neighbours(graph_, texels_);
    importance_ = typical_errors(error_graph_, frames_.importance(), context_);
    little_seen_ = little_seen(order_, importance_, kLittleSeen * error * error);
    ORIEL_TRY_VOID(first_direct());
    // With limited bounces rays find this light, which count bounces.
    if (options_.bounces == 0) ORIEL_TRY_VOID(follow_lamps(first_particles(texels_.count(), options_)));
    irradiance_ = direct_.value;
    for (std::size_t i = 0; i < irradiance_.size(); ++i) irradiance_[i] += gathered_.mean(i);
    const SweepOptions how = sweep_options(options_, error, texels_.count());
    const GroupedLight* grouped = query_.groups() > 0 ? &grouped_ : nullptr;
    if (grouped) grouped_ = direct_.grouped;
    for (int h = 0; grouped && h < kHalves; ++h) grouped_.add(gathered_.additional_grouped[h], 0.5f);
    ORIEL_TRY(sweeps_, sweep({texels_, graph_, query_, irradiance_, grouped}, how, task_.paths));
    for (std::size_t i = 0; i < sweeps_.gathered.size(); ++i) irradiance_[i] += sweeps_.gathered[i];
    cached_ = cache_light(texels_, graph_, irradiance_, context_);
    if (grouped) grouped_.add(sweeps_.grouped), cached_.grouped = grouped;
    bright_ = BrightTexels(query_, {texels_, sample_points_, cached_, sweeps_.gathered, importance_}, context_.seed);
    if (!bright_.empty()) cached_.bright = &bright_;
    ORIEL_TRY_VOID(refine([&] { return learn_survival(texels_, query_, order_, cached_, task_.paths); }));
    ORIEL_TRY_VOID(first_gather());
    first_work_ = task_.work(), first_rays_ = task_.paths.traced() + task_.quick.traced();
    return {};
  }

  // If time runs out, the particles so far count; without any, rays find their light.
  Status follow_lamps(std::uint64_t per_half) {
    ORIEL_TRY_VOID(refine([&] { return trace_lamps(texels_, query_, per_half, task_.paths, lamps_); }));
    if (lamps_.particles == 0) return {};
    set_additional(lamps_, gathered_);
    query_.leave_out_lamps();
    return {};
  }

  // Texels of little importance do not count.
  bool is_occlusion_heavy(std::size_t i) const { return texels_.occlusion_heavy[i] && !little_seen_[i]; }

  // Takes more samples where a neighbour's visibility differs: a shadow edge is near.
  Status first_direct() {
    // Few points see a light through a gap: a handful that see none is no evidence.
    std::vector<std::uint32_t> occluded = order_;
    std::erase_if(occluded, [&](std::uint32_t i) { return !is_occlusion_heavy(i); });
    const std::uint32_t first = first_direct_.samples();
    const auto enough = first_direct_.time_is_over();
    ORIEL_TRY_VOID(first_direct_.estimate(occluded, std::max(first, kOccludedDirect), enough));
    // Bounces start from direct light: an error of more than a few percent would tint them all, and without a goal
    // stay.
    std::uint32_t per_half = first;
    const double least = (1 - FirstDirect::kTime) * seconds_left();
    for (int round = 0; round < (options_.error > 0 ? 1 : 2); ++round) {
      per_half *= 4;
      // A fixed number of gather rays brings a fixed number of shadow rays with it.
      if (options_.error <= 0) per_half = std::max(per_half, options_.samples / (4 * kHalves));
      std::vector<std::uint32_t> list = order_;
      std::erase_if(list, [&](std::uint32_t i) { return little_seen_[i] || direct_.per_half[i] >= per_half; });
      keep_uncertain(direct_, error_graph_, round == 0 ? 0 : kUncertain, context_, list);
      // A round that would not end in time is not begun.
      const double more = 1.0 * per_half / first * (double(list.size()) / double(order_.size()));
      if (options_.left && first_direct_.seconds() * more > seconds_left() - least) break;
      ORIEL_TRY_VOID(first_direct_.estimate(list, per_half, enough));
    }
    return {};
  }

  double seconds_left() const { return options_.left ? options_.left() : 0; }
  double refined() const { return static_cast<double>(task_.work() - first_work_); }
  bool out_of_rays() const { return refined() >= task_.most_work(texels_.count()); }
  bool done() const { return ended_early_ || context_.stopped() || (options_.enough && options_.enough()); }

  // Runs a refinement until `enough`; each texel gets it whole or not at all.
  Status refine(const std::function<Status()>& refinement) {
    ORIEL_TRY(const bool all, done_in_time(context_, options_.enough, refinement));
    ended_early_ = ended_early_ || !all;
    return {};
  }

  // Refines a list by groups of texels with the same number of samples.
  template <class Work>
  Status by_samples(const std::vector<std::uint32_t>& list, const std::vector<std::uint32_t>& samples,
                    const Work& work) {
    for (const SameSamples& group : groups_of(list, samples))
      if (!ended_early_) ORIEL_TRY_VOID(refine([&] { return work(group.texels, group.samples); }));
    return {};
  }

  void update_direct() {
    smooth_direct_ = filter(texels_, graph_, halves_of(direct_, estimate_.value), narrow(options_.filter), context_);
  }

  void update_estimate() {
    estimate_ = filter(texels_, graph_, halves_of(gathered_, context_), options_.filter, context_);
    mean_luminance_ = mean_luminance(texels_, direct_.value, estimate_.value);
  }

  std::vector<Vec3> light() const {
    std::vector<Vec3> light(smooth_direct_.value);
    for (std::size_t i = 0; i < light.size(); ++i) light[i] += estimate_.value[i] + direct_.sharp[i];
    return light;
  }

  LightComponent component(LightComponent component) const {
    component.measure(order_, frames_.importance());
    return component;
  }

  bool is_dark(std::size_t i) const {
    return luminance(direct_.value[i] + estimate_.value[i]) < kDark * mean_luminance_;
  }

  std::uint32_t most_gathered() const { return std::max(1u, most_rays_.of_both() / kHalves); }

  // Texels without any gather ray, for lack of time, take the light of the bounces.
  Status first_gather() {
    const std::uint32_t per_half = options_.error > 0 ? std::min(most_gathered(), kFirstGather) : most_gathered();
    std::vector<std::uint32_t> list = order_;
    const auto gather_list = [&](std::uint32_t n) {
      return refine([&] { return gather_.run(list, n, task_.paths, gathered_); });
    };
    ORIEL_TRY_VOID(gather_list(per_half));
    for (const std::uint32_t i : list)
      if (gathered_.samples[i] == 0 && texels_.visible[i] > 0)
        gathered_.set_assumed(i, irradiance_[i] - direct_.value[i] - gathered_.mean(i), kCoarseError, sweeps_.grouped);
    std::erase_if(list, [&](std::uint32_t i) { return !is_occlusion_heavy(i); });
    if (const std::uint32_t more = std::min(most_gathered(), kFirstOccluded); more > per_half && !ended_early_)
      ORIEL_TRY_VOID(gather_list(more));
    update_estimate();
    // Few rays find light in a gap: a handful that find none is no evidence.
    for (std::uint32_t more = 2 * kFirstOccluded; more <= std::min(most_gathered(), kMostDark); more *= 2) {
      std::erase_if(list, [&](std::uint32_t i) { return !is_dark(i) || gathered_.samples[i] >= more; });
      if (list.empty() || ended_early_) break;
      ORIEL_TRY_VOID(gather_list(more));
      update_estimate();
    }
    return {};
  }

  // Refines direct or gathered light, whichever reduces the error more for its cost. Texels with all their samples may
  // miss the goal by themselves: the others are then refined to the goal without them.
  Status refine_to(double error) {
    update_direct();
    if (error <= 0) return {};
    if (options_.enough) context_.finishable = true;
    const double goal = error * error;
    ProgressEstimate progress(goal, static_cast<double>(first_work_), task_.most_work(texels_.count()));
    for (;;) {
      const LightComponent direct =
          component({direct_.per_half, std::max(FirstDirect::kSamples, most_gathered()), kDirectGain,
                     static_cast<double>(direct_rays_), frames_.squares(light(), smooth_direct_.variance)});
      const LightComponent gathered = component({gathered_.samples, most_gathered(), kGatherGain,
                                                 RadiosityTask::kQuickRays * static_cast<double>(gather_rays_),
                                                 frames_.squares(light(), estimate_.variance)});
      double now = direct.mean + gathered.mean;
      if (const double converged = direct.converged + gathered.converged; converged > goal) now -= converged;
      context_.foretell("refinement", progress.fraction(refined(), now));
      if (now <= goal && (direct.mean + gathered.mean <= goal || !most_rays_.raise())) return {};
      if ((ended_early_ = done()) || (out_of_rays_ = out_of_rays())) return {};
      const FrameGoal to_reach{importance_, now, goal};
      const auto worst = [&](const auto& p) { return worst_of(error_graph_, order_, p, to_reach, context_); };
      std::vector<std::uint32_t> list;
      if (direct.pays_more_than(gathered) && !(list = worst(direct)).empty()) {
        ORIEL_TRY_VOID(refine_direct(list, direct.max_samples));
      } else if (particles_pay(lamps_, gathered_, light(), frames_)) {
        ORIEL_TRY_VOID(follow_lamps(2 * lamps_.particles));
        update_estimate();
      } else if (!(list = worst(gathered)).empty()) {
        ORIEL_TRY_VOID(refine_gathered(list));
      } else if (!(list = worst(direct)).empty()) {
        ORIEL_TRY_VOID(refine_direct(list, direct.max_samples));
      } else if (!most_rays_.raise()) {
        return {};
      }
    }
  }

  Status refine_gathered(const std::vector<std::uint32_t>& list) {
    const std::uint64_t before = task_.paths.traced();
    ORIEL_TRY_VOID(by_samples(list, gathered_.samples, [&](const auto& same, std::uint32_t samples) {
      const std::uint32_t per_half = std::min(most_gathered(), 2 * std::max(1u, samples));
      return gather_.run(same, per_half, task_.paths, gathered_);
    }));
    update_estimate();
    gather_rays_ += task_.paths.traced() - before;
    return {};
  }

  Status refine_direct(const std::vector<std::uint32_t>& list, std::uint32_t most) {
    const std::uint64_t before = task_.quick.traced();
    ORIEL_TRY_VOID(by_samples(list, direct_.per_half, [&](const auto& same, std::uint32_t samples) {
      return direct_light_.estimate(same, std::min(most, 2 * samples), task_.quick, direct_);
    }));
    update_direct();
    direct_rays_ += task_.quick.traced() - before;
    return {};
  }

  const RadiosityTask& task_;
  const RadiosityOptions& options_;
  Context& context_;
  Texels texels_;
  std::vector<std::uint32_t> order_;
  ExtraSamplePoints sample_points_;
  DirectLight direct_light_;
  CacheQuery query_;
  TexelGraph graph_, error_graph_;  // for smoothing light; for averaging errors
  Sweeps sweeps_;                   // bounces on patches
  DirectSums direct_;
  HalfSums gathered_;
  FirstDirect first_direct_{task_, direct_light_, texels_, direct_};
  LampLight lamps_;
  Estimate smooth_direct_;        // of the direct light
  Estimate estimate_;             // of the gathered light
  std::vector<Vec3> irradiance_;  // of texels as gather rays find it, lux
  CachedLight cached_;            // irradiance_ with slopes
  const FinalGather gather_{sample_points_, query_, cached_};
  BrightTexels bright_;   // importance sampled texels of it
  GroupedLight grouped_;  // irradiance_ by light group; may be empty
  FrameError frames_;
  MostRays most_rays_;
  std::vector<float> importance_;                    // by texel: fraction of the frame pixels, neighbourhood average
  std::vector<bool> little_seen_;                    // by texel
  float mean_luminance_ = 0;                         // over visible texels, lux
  std::uint64_t direct_rays_ = 0, gather_rays_ = 0;  // of refinements
  std::uint64_t first_work_ = 0, first_rays_ = 0;    // cost and rays before any refinement
  bool ended_early_ = false, out_of_rays_ = false;
};

}  // namespace

Result<std::unique_ptr<LightEstimator>> make_cached_estimator(const RadiosityTask& task) {
  ORIEL_TRY(Texels texels, list_texels(task, task.quick, {.eyes = task.options.eyes, .seconds = points_seconds(task)}));
  return std::make_unique<CachedEstimator>(task, std::move(texels));
}

}  // namespace oriel
