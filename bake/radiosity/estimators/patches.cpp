#include "bake/radiosity/estimators/patches.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bake/jobs/parallel.h"
#include "bake/jobs/units.h"
#include "bake/radiosity/estimators/patch_list.h"
#include "bake/radiosity/texels/seeds.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kPatchesATask = 64;  // patches whose rays of one number are traced together
constexpr double kRounding = 1e-5;         // of a patch's light: below it there is no growth
constexpr double kDim = 1e-4;              // of the mean: darker patches need not converge
constexpr int kPatience = 24;              // sweeps in which light may spread before growth counts
constexpr int kHasty = 200;                // sweeps without regard to time: they are cheap
constexpr double kEndless = 0.1;           // bound on further bounces from which light does not die away
constexpr double kMuchFlux = 2;            // times the mean direct flux that patches reflect
constexpr std::uint32_t kExtraRays = 8;    // factor of rays for patches with that flux in a gap or a corner

class Solver {
 public:
  Solver(const SweepScene& scene, const SweepOptions& options)
      : texels_(scene.texels), query_(scene.query), direct_(scene.direct), grouped_(scene.grouped), options_(options) {
    const Texels& texels = scene.texels;
    const TexelGraph& graph = scene.graph;
    patch_of_.assign(texels.count(), ~0u);
    const std::vector<std::uint32_t> head = connect_blocks(texels, graph, options.side);
    for (const std::uint32_t i : coherent_order(texels)) {
      if (texels.visible[i] == 0) continue;
      std::uint32_t& number = patch_of_[head[i]];  // invisible texels have no neighbours
      if (number == ~0u) {
        number = static_cast<std::uint32_t>(patches_.size());
        patches_.emplace_back();
        patches_.back().x = texels.x[i] / options_.side, patches_.back().y = texels.y[i] / options_.side;
        patches_.back().stream = head[i];
        if (grouped_) patches_.back().grouped.resize(grouped_->groups);
      }
      patches_[number].texels.push_back(i);
      patches_[number].area_m2 += shown_m2(i);
      patch_of_[i] = number;
    }
    for (std::uint32_t i = 0; i < texels.count(); ++i)
      for (const std::uint32_t j : graph.of(i))
        if (patch_of_[i] != patch_of_[j] && same_chart(texels, i, j))
          patches_[patch_of_[i]].neighbours.push_back(patch_of_[j]);
    for (LightPatch& patch : patches_) {
      std::sort(patch.neighbours.begin(), patch.neighbours.end());
      patch.neighbours.erase(std::unique(patch.neighbours.begin(), patch.neighbours.end()), patch.neighbours.end());
    }
    share_rays();
  }

  Status trace(const Stage& stage, std::uint64_t seed) {
    const bool named = stage.context.units != nullptr;
    const Hash128 direct = named ? hash_of(direct_) : Hash128();
    const Hash128 grouped = named && grouped_ ? hash_of(grouped_->light) : Hash128();
    UnitLoop loop{.stage = "bounces", .count = (patches_.size() + kPatchesATask - 1) / kPatchesATask};
    loop.rays = static_cast<double>(kPatchesATask) * options_.rays_per_patch;
    loop.inputs = [&](std::size_t g, Archive& key) {
      key(direct, options_.side, options_.rays_per_patch, g, query_.lamps(), texels_.eyes);
      if (grouped_) key(grouped);
    };
    loop.compute = [&](std::size_t g) {
      std::uint64_t traced = 0;
      for (std::uint32_t k = 0; k < kExtraRays * options_.rays_per_patch; ++k)
        traced += trace_sample(g * kPatchesATask, group_end(g), k, seed);
      for (std::size_t p = g * kPatchesATask; p < group_end(g); ++p)
        join_links(patches_[p].links), patches_[p].traced = true;
      return traced;
    };
    loop.results = [&](std::size_t g, Archive& archive) {
      for (std::size_t p = g * kPatchesATask; p < group_end(g); ++p) {
        archive(patches_[p].source, patches_[p].unreflected, patches_[p].links, patches_[p].traced);
        if (grouped_) archive(patches_[p].grouped);
      }
    };
    const ElapsedTime clock;
    const auto late = [&] { return clock.spent() > options_.seconds; };
    return done_in_time(stage.context, std::isfinite(options_.seconds) ? late : std::function<bool()>(),
                        [&] { return parallel_units(stage, loop); })
        .map([](bool) {});
  }

  // Predicts the seconds of trace() from one group in kOneIn; the links of these are dropped.
  Result<double> predict_seconds(const Stage& stage) {
    constexpr std::size_t kOneIn = 64;
    const std::size_t groups = (patches_.size() + kPatchesATask - 1) / kPatchesATask;
    const std::size_t tried = std::min(groups, groups / kOneIn + static_cast<std::size_t>(thread_count(stage.context)));
    if (tried == 0) return 0;
    const ElapsedTime clock;
    const Status traced = parallel_for(stage, "", tried, [&](std::size_t i) {
      const std::size_t g = i * groups / tried;
      for (std::uint32_t k = 0; k < kSamplePoints; ++k)
        stage.count(trace_sample(g * kPatchesATask, group_end(g), k, stage.context.seed));
    });
    if (!traced) return tl::unexpected(traced.error());
    return clock.spent() * (double{1.0f * options_.rays_per_patch} / kSamplePoints) * static_cast<double>(groups) /
           static_cast<double>(tried);
  }

  Status solve(Context& context, Sweeps& result);

  std::vector<Vec3> interpolate(Context& context, const std::vector<Vec3>& of_patches) const;
  const std::vector<Vec3>& solution() const { return solution_; }
  // The light of one light group after as many bounces, by patch.
  std::vector<Vec3> solve_group(Context& context, std::size_t group, int sweeps) const;

 private:
  std::size_t group_end(std::size_t g) const { return std::min(patches_.size(), (g + 1) * kPatchesATask); }
  // Distributes rays over texels in proportion to their visible area.
  std::uint32_t texel_for(const LightPatch& patch, std::uint32_t turn) const {
    const double target = (turn + 0.5) / (patch.rays / kSamplePoints) * patch.area_m2;
    double sum = 0;
    for (const std::uint32_t t : patch.texels)
      if ((sum += shown_m2(t)) >= target) return t;
    return patch.texels.back();
  }
  // Patches with much reflected flux get more rays, as the rim of a gap with a lamp in it, which lights a whole room.
  void share_rays() {
    std::vector<double> direct_flux(patches_.size(), 0);
    for (std::size_t p = 0; p < patches_.size(); ++p)
      for (const std::uint32_t t : patches_[p].texels)
        direct_flux[p] += shown_m2(t) * luminance(texels_.albedo[t] * direct_[t]);
    const double mean =
        std::accumulate(direct_flux.begin(), direct_flux.end(), 0.0) / static_cast<double>(patches_.size());
    for (std::size_t p = 0; p < patches_.size(); ++p) {
      LightPatch& patch = patches_[p];
      const bool occlusion_heavy =
          std::ranges::any_of(patch.texels, [&](auto t) { return texels_.occlusion_heavy[t]; });
      patch.follows_near = !options_.most && direct_flux[p] > kMuchFlux * mean;  // such paths do not count bounces
      patch.rays = options_.rays_per_patch * (patch.follows_near && occlusion_heavy ? kExtraRays : 1);
    }
  }
  double shown_m2(std::uint32_t t) const { return double{texels_.area_m2[t]} * texels_.visible[t]; }

  std::uint64_t trace_sample(std::size_t first, std::size_t end, std::uint32_t k, std::uint64_t seed) {
    std::vector<Ray> batch;
    std::vector<GatherRay> info;
    std::vector<std::size_t> patch_of_ray;
    for (std::size_t p = first; p < end; ++p) {
      if (k >= patches_[p].rays) continue;
      patch_of_ray.push_back(p);
      const std::uint32_t t = texel_for(patches_[p], k / kSamplePoints);
      GatherRay& ray = info.emplace_back();
      const GatherPoint point(texels_.sample_point(t, static_cast<int>(k % kHalves), k / kHalves));
      batch.push_back(point.ray(Sampler(seed, patches_[p].stream, k).next2()));
      if (query_.weighs()) ray.incidence = point.incidence(batch.back().direction);
      ray.stream = ~patches_[p].stream;
      ray.follows_near = patches_[p].follows_near;
      ray.sample = k;
    }
    if (batch.empty()) return 0;
    QueryResults results;
    query_.evaluate(batch, info, results);
    const auto link_to = [&](std::uint32_t ray, std::uint32_t texel, const Vec3& weight) {
      LightPatch& patch = patches_[patch_of_ray[ray]];
      const float share = 1.0f / static_cast<float>(patch.rays);
      patch.source += DVec3(weight * direct_[texel] * share);
      for (std::size_t g = 0; g < patch.grouped.size(); ++g)
        patch.grouped[g] += DVec3(weight * grouped_->of(texel)[g] * share);
      if (patch_of_[texel] != ~0u) patch.links.push_back({patch_of_[texel], weight * share});
    };
    for (std::uint32_t i = 0; i < batch.size(); ++i) {
      LightPatch& patch = patches_[patch_of_ray[i]];
      const float share = kPi / static_cast<float>(patch.rays);
      patch.source += DVec3(results.light[i] * share);
      for (std::size_t g = 0; g < patch.grouped.size(); ++g)
        patch.grouped[g] += DVec3(results.grouped[i * query_.groups() + g] * share);
      patch.unreflected += results.unreflected[i] * share;
      if (const std::uint32_t texel = results.texel[i]; texel != kNoTexel)
        link_to(i, texel, results.share[i] * texels_.albedo[texel]);
    }
    for (const Link& link : results.links) link_to(link.ray, link.texel, link.weight);
    return batch.size() + results.rays;
  }

  // A bound on the weight sum of a patch, whose expectation is the mean reflectance that its rays meet. The bound is
  // the mean sum of the patch's neighbours and of the patches that it sees, 1 at most. Noise above it evens out over a
  // room, but makes light grow from sweep to sweep among a few such patches.
  DVec3 max_weight_sum(std::size_t p, const std::vector<DVec3>& sums) const {
    DVec3 sum(0);
    double count = 0;
    for (const PatchLink& link : patches_[p].links)
      if (link.patch != p) sum += sums[link.patch], ++count;
    for (const std::uint32_t neighbour : patches_[p].neighbours) sum += sums[neighbour], ++count;
    if (count == 0) return DVec3(1);
    return glm::min(sum / count, DVec3(1));
  }
  std::vector<DVec3> weight_sums() const {
    std::vector<DVec3> sums;
    for (const LightPatch& patch : patches_) sums.push_back(weight_sum(patch));
    return sums;
  }
  // The norm of one sweep's change. `share` is relative to each patch's own light plus `floor`, all patches alike: by
  // area or light, sunlit ground outside, which converges at once, would hide a room that has not.
  struct Change {
    double absolute = 0, share = 0;
  };
  Change sweep_once(Context& context, const std::vector<Vec3>& now, double floor, std::vector<Vec3>& next);
  // Sweeps from unreflected light until converged, or `enough`; detects_growth: or until changes grow.
  enum class End { kDone, kGrows, kStopped };
  End run(Context& context, bool detects_growth, Sweeps& result);
  // Bounds the patches whose light grows from sweep to sweep, and returns their number.
  std::size_t bound_growing(Context& context);
  void warn_of_no_end(Context& context, const Sweeps& result) const;

  const Texels& texels_;
  const CacheQuery& query_;
  std::span<const Vec3> direct_;
  const GroupedLight* grouped_;
  SweepOptions options_;
  std::vector<LightPatch> patches_;
  std::vector<std::uint32_t> patch_of_;  // by texel
  std::vector<Vec3> solution_;           // by patch
};

Solver::Change Solver::sweep_once(Context& context, const std::vector<Vec3>& now, double floor,
                                  std::vector<Vec3>& next) {
  constexpr std::size_t kRun = 256;
  std::vector<Change> change((patches_.size() + kRun - 1) / kRun);
  (void)parallel_for(context, "", change.size(), [&](std::size_t run) {
    for (std::size_t p = run * kRun; p < std::min(patches_.size(), (run + 1) * kRun); ++p) {
      // Sums are in double: a hundred bounces between white walls add up a hundred roundings.
      DVec3 sum(patches_[p].source);
      for (const PatchLink& link : patches_[p].links) sum += DVec3(link.weight * now[link.patch]);
      next[p] = Vec3(sum);
      const Vec3 d = glm::abs(next[p] - now[p]);
      const double moved = double{d.r} + d.g + d.b, light = double{next[p].r} + next[p].g + next[p].b + floor;
      change[run].absolute += patches_[p].area_m2 * moved;
      if (light > 0) change[run].share += moved / light;
    }
  });
  Change total;
  for (const Change& c : change) total.absolute += c.absolute, total.share += c.share;
  return total;
}

void Solver::warn_of_no_end(Context& context, const Sweeps& result) const {
  DVec3 incident(0), absorbed(0);
  for (std::size_t p = 0; p < patches_.size(); ++p)
    for (const std::uint32_t t : patches_[p].texels) {
      const DVec3 flux = DVec3(direct_[t] + solution_[p]) * static_cast<double>(texels_.area_m2[t]);
      incident += flux;
      absorbed += flux * (DVec3(1) - DVec3(texels_.albedo[t]));
    }
  context.warning(
      "light-lingers",
      fmt::format("the light hardly dies away: after {} bounces {:.4g} lm fall on the surfaces and {:.4g} lm of them "
                  "are absorbed; what these bounces bring is baked. Lower albedos of 1, or let some light out",
                  result.count, incident.g, absorbed.g));
}

Solver::End Solver::run(Context& context, bool detects_growth, Sweeps& result) {
  const int most = options_.most.value_or(PathOptions().max_bounces);
  std::vector<Vec3> next(patches_.size());
  solution_.resize(patches_.size());
  std::ranges::transform(patches_, solution_.begin(), &LightPatch::unreflected);
  if (most == 0) return End::kDone;
  double area = 0, scale = 0;
  for (const LightPatch& patch : patches_) area += patch.area_m2;
  const auto patches = static_cast<double>(patches_.size());
  Change before;
  // The geometric tail by the ratio q of the last two changes; after the first sweep its own size is the bound.
  const auto tail = [](double change, double q, double of) { return q < 1 ? change / of * q / (1 - q) : change / of; };
  const auto ratio = [](double change, double last) { return last > 0 ? change / last : 1; };
  for (result.count = 1;; ++result.count) {
    const Change change = sweep_once(context, solution_, area > 0 ? kDim * scale / area : 0, next);
    if (context.stopped()) return End::kStopped;
    solution_.swap(next);
    scale = 0;
    for (std::size_t p = 0; p < patches_.size(); ++p)
      scale += patches_[p].area_m2 * (solution_[p].r + solution_[p].g + solution_[p].b);
    if (detects_growth && !std::isfinite(change.absolute)) return End::kGrows;
    if (!(change.absolute > 0) || !(scale > 0)) return End::kDone;
    const double q = ratio(change.absolute, before.absolute), q_share = ratio(change.share, before.share);
    result.growth = q;
    result.tail = std::max(tail(change.absolute, q, scale), tail(change.share, q_share, patches));
    before = change;
    if (q < 1 && q_share < 1 && result.tail < options_.tolerance) return End::kDone;
    if (detects_growth && q > 1 && result.count >= kPatience) return End::kGrows;
    if (result.count >= most) return End::kDone;
    if (result.count >= kHasty && options_.enough && options_.enough()) return End::kDone;
  }
}

std::size_t Solver::bound_growing(Context& context) {
  std::vector<Vec3> now(patches_.size()), next(patches_.size());
  (void)sweep_once(context, solution_, 0, now);
  (void)sweep_once(context, now, 0, next);
  const std::vector<DVec3> sums = weight_sums();
  std::size_t bounded = 0;
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const Vec3 was = glm::abs(now[p] - solution_[p]), is = glm::abs(next[p] - now[p]);
    const double grown = double{is.r} + is.g + is.b - was.r - was.g - was.b,
                 light = double{now[p].r} + now[p].g + now[p].b;
    if (!(grown <= kRounding * light))  // also for NaN
      bounded += bound(patches_[p], max_weight_sum(p, sums));
  }
  return bounded;
}

Status Solver::solve(Context& context, Sweeps& result) {
  constexpr int kRounds = 8;
  End end = run(context, true, result);
  for (int round = 1; end == End::kGrows; ++round) {
    const std::size_t bounded = round < kRounds ? bound_growing(context) : 0;
    if (bounded == 0)
      for (LightPatch& patch : patches_) result.bounded += bound(patch, DVec3(1));
    result.bounded += bounded;
    end = run(context, bounded > 0, result);
  }
  if (end == End::kStopped) return fail(ErrorCode::kStopped, "radiosity", "stopped");
  if (!options_.most && result.count >= PathOptions().max_bounces && (result.growth >= 1 || result.tail > kEndless))
    warn_of_no_end(context, result);
  fill_untraced(patches_, solution_);
  return {};
}

// Interpolates bilinearly between a texel's patch and its neighbours.
std::vector<Vec3> Solver::interpolate(Context& context, const std::vector<Vec3>& of_patches) const {
  constexpr std::size_t kRun = 1024;
  std::vector<Vec3> gathered(texels_.count(), Vec3(0));
  (void)parallel_for(context, "", (texels_.count() + kRun - 1) / kRun, [&](std::size_t run) {
    for (std::size_t i = run * kRun; i < std::min(texels_.count(), (run + 1) * kRun); ++i) {
      if (patch_of_[i] == ~0u) continue;
      const Vec2 at = (Vec2(texels_.x[i], texels_.y[i]) + 0.5f) / static_cast<float>(options_.side) - 0.5f;
      Vec3 sum(0);
      float weights = 0;
      const auto add = [&](std::uint32_t p) {
        const Vec2 off = 1.0f - glm::abs(at - Vec2(patches_[p].x, patches_[p].y));
        if (off.x <= 0 || off.y <= 0) return;
        sum += off.x * off.y * of_patches[p];
        weights += off.x * off.y;
      };
      add(patch_of_[i]);
      for (const std::uint32_t p : patches_[patch_of_[i]].neighbours) add(p);
      gathered[i] = sum / weights;  // its own patch has a weight of a quarter at least
    }
  });
  return gathered;
}

std::vector<Vec3> Solver::solve_group(Context& context, std::size_t group, int sweeps) const {
  constexpr std::size_t kRun = 256;
  std::vector<Vec3> now(patches_.size()), next(patches_.size());
  // One sweep more than solve(), which starts from unreflected light.
  for (int sweep = 0; sweep <= sweeps && !context.stopped(); ++sweep, now.swap(next))
    (void)parallel_for(context, "", (patches_.size() + kRun - 1) / kRun, [&](std::size_t run) {
      for (std::size_t p = run * kRun; p < std::min(patches_.size(), (run + 1) * kRun); ++p) {
        DVec3 sum(patches_[p].grouped[group]);
        for (const PatchLink& link : patches_[p].links) sum += DVec3(link.weight * now[link.patch]);
        next[p] = Vec3(sum);
      }
    });
  fill_untraced(patches_, now);
  return now;
}

// Options that keep within the time for rays, by timing a few groups: fewer rays, then larger patches.
Result<SweepOptions> affordable(const SweepScene& scene, SweepOptions options, const Stage& stage) {
  constexpr std::uint32_t kFewest = 2 * kSamplePoints, kLargest = 8;
  if (!std::isfinite(options.seconds)) return options;
  Solver calibration(scene, options);
  ORIEL_TRY(double needed, calibration.predict_seconds(stage));
  while (needed > options.seconds && options.rays_per_patch > kFewest) options.rays_per_patch /= 2, needed /= 2;
  while (needed > options.seconds && options.side < kLargest) options.side *= 2, needed /= 4;
  return options;
}

}  // namespace

Result<Sweeps> sweep(const SweepScene& scene, const SweepOptions& options, const Stage& stage) {
  Sweeps result;
  ORIEL_TRY(const SweepOptions how, affordable(scene, options, stage));
  Solver solver(scene, how);
  ORIEL_TRY_VOID(solver.trace(stage, stage.context.seed + seeds::kBounces));
  ORIEL_TRY_VOID(solver.solve(stage.context, result));
  result.gathered = solver.interpolate(stage.context, solver.solution());
  if (!scene.grouped) return result;
  result.grouped = GroupedLight(scene.texels.count(), scene.grouped->groups);
  for (std::size_t g = 0; g < scene.grouped->groups; ++g)
    result.grouped.set_group(g, solver.interpolate(stage.context, solver.solve_group(stage.context, g, result.count)));
  for (std::size_t i = 0; i < scene.texels.count(); ++i) rescale_groups(result.grouped.of(i), result.gathered[i]);
  return result;
}

}  // namespace oriel
