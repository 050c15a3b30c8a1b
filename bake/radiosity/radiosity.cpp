#include "bake/radiosity/radiosity.h"

#include <algorithm>
#include <limits>

#include "bake/jobs/units.h"
#include "bake/radiosity/cached/cached.h"
#include "bake/radiosity/certificate.h"
#include "bake/radiosity/dilate.h"
#include "bake/radiosity/seams.h"
#include "bake/radiosity/stitch.h"
#include "bake/radiosity/texels/texel_paths.h"
#include "bake/radiosity/texels/texels.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint32_t kFirstPaths = 16;  // a texel, before the error is looked at
constexpr std::size_t kRaysAPath = 10;     // about
constexpr double kStitchShare = 0.6;       // of the error asked for: what stitching may move texels by
constexpr std::size_t kRun = 64;  // texels a task: long enough to hide scheduling, short enough to stop at once

struct Run {
  std::size_t page, first, last;
};

Vec3 direction_of(const TexelSums& sums) {
  if (!(sums.mean > 0)) return Vec3(0);
  const DVec3 d = sums.vector / sums.mean;
  return Vec3(d / std::max(1.0, glm::length(d)));  // longer than 1 by rounding only
}

void store(const TexelSums& sums, std::uint32_t asked, LightmapPage& page, std::size_t texel) {
  // A handful of points that escaped the probes do not make a texel visible.
  if (sums.count * 16 < asked || sums.count == 0) {
    page.state[texel] = TexelState::kBuried;
    return;
  }
  page.irradiance[texel] = Vec3(sums.irradiance());
  if (!page.direction.empty()) page.direction[texel] = direction_of(sums);
  page.standard_error[texel] = Vec3(glm::sqrt(sums.variance()));
  page.state[texel] = TexelState::kValid;
}

// Power on the visible parts of all lightmapped surfaces, lm.
DVec3 incident_power(const Scene& scene, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                     const Radiosity& radiosity) {
  DVec3 sum(0);
  for (std::size_t p = 0; p < texel_map.size(); ++p)
    for (std::size_t i = 0; i < texel_map[p].texel.size(); ++i) {
      const std::uint32_t texel = texel_map[p].texel[i];
      if (radiosity.pages[p].state[texel] == TexelState::kValid)
        sum += DVec3(radiosity.pages[p].irradiance[texel]) *
               (radiosity.visible[p][i] * texel_area_m2(scene, atlas, texel_map[p], i));
    }
  return sum;
}

// Root mean square, over what is seen of texels and over channels, of standard error over irradiance, with a floor of
// 1 % of the mean. The irradiance is the true one's mean square: of a dark texel that is not known at all the error is
// its light, not more.
double relative_error(std::span<const TexelMapPage> texel_map, const Radiosity& radiosity) {
  DVec3 mean(0);
  double count = 0, seen = 0, squares = 0;
  const auto each_valid = [&](const auto& visit) {
    for (std::size_t p = 0; p < texel_map.size(); ++p)
      for (std::size_t i = 0; i < texel_map[p].texel.size(); ++i) {
        const std::uint32_t t = texel_map[p].texel[i];
        if (radiosity.pages[p].state[t] == TexelState::kValid)
          visit(seen_share(texel_map, radiosity, p, i), radiosity.pages[p].irradiance[t],
                radiosity.pages[p].standard_error[t]);
      }
  };
  each_valid([&](double share, const Vec3& e, const Vec3&) { mean += DVec3(e), ++count, seen += share; });
  each_valid([&](double share, const Vec3& e, const Vec3& error) {
    for (int c = 0; c < 3; ++c) {
      const double floor = 0.01 * mean[c] / count, square = double{error[c]} * error[c];
      const double denominator = double{e[c]} * e[c] + square + floor * floor;
      if (denominator > 0) squares += share * square / denominator;
    }
  });
  return seen > 0 ? std::sqrt(squares / (3 * seen)) : 0;
}

void summarize(const Scene& scene, const Atlas& atlas, std::span<const TexelMapPage> texel_map, Radiosity& radiosity) {
  const auto& pages = radiosity.pages;
  RadiosityReport& report = radiosity.report;
  report.texels = report.buried = 0;
  report.max = Vec3(0);
  DVec3 sum(0);
  for (std::size_t p = 0; p < pages.size(); ++p)
    for (std::size_t i = 0; i < texel_map[p].texel.size(); ++i) {
      const std::uint32_t texel = texel_map[p].texel[i];
      if (pages[p].state[texel] != TexelState::kValid) {
        ++report.buried;
        continue;
      }
      ++report.texels;
      const Vec3& e = pages[p].irradiance[texel];
      sum += DVec3(e);
      report.max = glm::max(report.max, e);
    }
  report.incident_lm = incident_power(scene, atlas, texel_map, radiosity);
  if (report.texels == 0) return;
  report.mean = Vec3(sum / static_cast<double>(report.texels));
  report.relative_error = relative_error(texel_map, radiosity);
}

Status stitch_lightmap(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                       double error, Context& context, std::atomic<std::uint64_t>& rays, Radiosity& radiosity) {
  ORIEL_TRY(const Seams seams, find_seams(transport, atlas, radiosity.pages, context, rays));
  if (seams.points.empty()) return {};
  const auto power = [&] {
    return luminance(Vec3(incident_power(transport.accel.scene(), atlas, texel_map, radiosity)));
  };
  const double before = power();
  const double at_most = error > 0 ? kStitchShare * error : std::numeric_limits<double>::infinity();
  radiosity.report.seams = stitch(seams, texel_map, at_most, radiosity.pages);
  if (before > 0) radiosity.report.seams.energy_change = power() / before - 1;
  return {};
}

void darken_hidden(const TexelMapPage& map, const std::vector<float>& visible, LightmapPage& page) {
  for (std::size_t i = 0; i < map.texel.size(); ++i) {
    page.irradiance[map.texel[i]] *= visible[i];
    page.standard_error[map.texel[i]] *= visible[i];
  }
}

// Rounds that double the paths, until the error asked for holds or all are taken. Each texel's sums go on from round to
// round: the result is that of one round.
Status bake_reference(const TexelPaths& paths, std::span<const TexelMapPage> texel_map, const RadiosityOptions& options,
                      Context& context, std::atomic<std::uint64_t>& rays, Radiosity& result) {
  std::vector<Run> runs;
  std::vector<std::vector<TexelSums>> sums;
  for (std::size_t p = 0; p < texel_map.size(); ++p) {
    sums.emplace_back(texel_map[p].texel.size());
    for (std::size_t first = 0; first < texel_map[p].texel.size(); first += kRun)
      runs.push_back({p, first, std::min(first + kRun, texel_map[p].texel.size())});
  }
  std::uint32_t done = 0,
                next = options.error > 0 || options.enough ? std::min(options.samples, kFirstPaths) : options.samples;
  for (;; done = next, next = std::min(options.samples, 2 * done)) {
    const auto sums_of = [&](std::size_t r, Archive& archive) {
      for (std::size_t i = runs[r].first; i < runs[r].last; ++i) archive(sums[runs[r].page][i]);
    };
    UnitLoop loop{
        .stage = "paths", .count = runs.size(), .rays = static_cast<double>(kRun * kRaysAPath) * (next - done)};
    loop.inputs = [&](std::size_t r, Archive& key) {
      key(options.directional, runs[r].page, runs[r].first, runs[r].last, done, next);
      sums_of(r, key);  // paths are added to them
    };
    loop.compute = [&](std::size_t r) {
      std::uint64_t traced = 0;
      for (std::size_t i = runs[r].first; i < runs[r].last && !context.stopped(); ++i)
        paths.add(texel_map[runs[r].page], runs[r].page, i, done, next, sums[runs[r].page][i], traced);
      return traced;
    };
    loop.results = sums_of;
    ORIEL_TRY_VOID(parallel_units(context, loop, &rays));
    for (std::size_t p = 0; p < texel_map.size(); ++p)
      for (std::size_t i = 0; i < texel_map[p].texel.size(); ++i) {
        result.visible[p][i] = static_cast<float>(sums[p][i].count) / static_cast<float>(next);
        store(sums[p][i], next, result.pages[p], texel_map[p].texel[i]);
      }
    if (next == options.samples || context.stopped()) return {};
    if (options.error > 0 && relative_error(texel_map, result) <= options.error) return {};
    if (options.enough) context.finishable = true;
    if ((result.report.ended_early = options.enough && options.enough())) return {};
  }
}

bool is_dark(const Transport& transport) {
  return transport.lights.empty() && luminance(transport.accel.scene().sky) <= 0;
}

std::vector<LightmapPage> empty_pages(std::span<const TexelMapPage> texel_map, bool directional) {
  std::vector<LightmapPage> pages;
  for (const TexelMapPage& map : texel_map) {
    const std::size_t size = static_cast<std::size_t>(map.width) * map.height;
    LightmapPage page{map.width, map.height, std::vector<Vec3>(size), std::vector<Vec3>(size),
                      std::vector<TexelState>(size)};
    if (directional) page.direction.resize(size);
    pages.push_back(std::move(page));
  }
  return pages;
}

// Without any light black is exact: only what lies inside other geometry is to be found.
Status bake_dark(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                 Context& context, std::atomic<std::uint64_t>& rays, Radiosity& result) {
  ORIEL_TRY(const Texels texels, list_texels(transport, atlas, texel_map, context, rays));
  for (std::size_t i = 0; i < texels.count(); ++i) {
    LightmapPage& page = result.pages[texels.page[i]];
    page.state[std::size_t{texels.y[i]} * page.width + texels.x[i]] =
        texels.visible[i] > 0 ? TexelState::kValid : TexelState::kBuried;
    result.visible[texels.page[i]][texels.index[i]] = texels.visible[i];
  }
  return {};
}

// All that follows an estimate: what is buried and beyond charts is filled, seams are stitched, and held-out texels
// tell the error.
class Finisher {
 public:
  Finisher(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
           const RadiosityOptions& options, Context& context, std::atomic<std::uint64_t>& rays)
      : transport_(transport), atlas_(atlas), map_(texel_map), options_(options), context_(context), rays_(rays) {}

  Status finish(Radiosity& result) {
    if (context_.stopped()) return fail(ErrorCode::kStopped, "radiosity", "stopped");
    if (options_.hidden != Hidden::kBlack) {
      for (std::size_t p = 0; p < map_.size(); ++p) {
        fill_buried(atlas_, map_[p], result.pages[p]);
        dilate(options_.dilation, result.pages[p]);
      }
      const bool late = options_.left && options_.left() <= 0;
      if (late && options_.stitch) context_.warning("the seams of the lightmap are not stitched: --time was over");
      if (options_.stitch && !late && !is_dark(transport_))
        ORIEL_TRY_VOID(stitch_lightmap(transport_, atlas_, map_, options_.error, context_, rays_, result));
    }
    summarize(transport_.accel.scene(), atlas_, map_, result);
    return {};
  }

  // How to refine, where held-out texels tell of a larger error than was asked for.
  Result<Refinement> finish_and_verify(Radiosity& result) {
    ORIEL_TRY_VOID(finish(result));
    RadiosityReport& report = result.report;
    if (options_.verify <= 0) return {};
    const auto at_most = static_cast<std::uint64_t>(options_.verify * static_cast<double>(rays_));
    const auto late = [&] { return options_.left && options_.left() <= 0; };
    {
      const Interruptible until(context_, late);
      auto certificate = certify(transport_, atlas_, map_, result, options_.error, at_most, context_);
      if (!certificate && (context_.stop || !late())) return tl::unexpected(certificate.error());
      report.certificate = certificate ? *certificate : Certificate();
    }
    rays_ += report.certificate.rays;
    const double asked = options_.error;
    const Certificate& c = report.certificate;
    const bool missed = asked > 0 && c.relative_error > kTolerated * asked && c.error_low > asked;
    if (!missed || report.ended_early || report.refinements == kRefinements) return {};
    if (options_.enough && options_.enough()) return {};
    // What the noise that is stated does not explain stays, however many rays are traced, unless less is looked up: but
    // for what stitching moves, which neither mends, and looked-up bounces, of which `bounces` says how many there are.
    const double stays = std::max(std::pow(c.relative_error, 2) - std::pow(report.relative_error, 2), 0.0);
    const double looked_up = stays - std::pow(report.seams.moved, 2);
    Refinement how;
    how.nearer = report.refinements == 0 && options_.bounces == 0 && looked_up > kUnexplained * asked * asked;
    const double goal2 = asked * asked - (how.nearer ? kNearerLeaves : 1) * stays;
    if (!how.nearer && goal2 <= 0) return {};
    how.error = std::max(std::sqrt(std::max(goal2, 0.0)), kSharpest * asked);
    if (!how.nearer && how.error >= target_) return {};
    target_ = how.error;
    ++report.refinements;
    result.pages = empty_pages(map_, options_.directional);
    return how;
  }

 private:
  static constexpr double kTolerated = 1.1;
  static constexpr double kUnexplained = 0.3;  // of the squared error asked for: more is a matter of what is looked up,
  static constexpr double kNearerLeaves = 0.5;  // of which so much is left where less is
  static constexpr double kSharpest = 0.5;      // of the error asked for: less noise would cost more than it brings

  const Transport& transport_;
  const Atlas& atlas_;
  std::span<const TexelMapPage> map_;
  const RadiosityOptions& options_;
  Context& context_;
  std::atomic<std::uint64_t>& rays_;
  double target_ = std::numeric_limits<double>::infinity();  // of the last refinement
};

}  // namespace

double seen_share(std::span<const TexelMapPage> texel_map, const Radiosity& radiosity, std::size_t page,
                  std::size_t i) {
  return double{covered_share(texel_map[page], i)} * radiosity.visible[page][i];
}

Result<Radiosity> bake_radiosity(const Transport& transport, const Atlas& atlas,
                                 std::span<const TexelMapPage> texel_map, const RadiosityOptions& options,
                                 Context& context) {
  Radiosity result;
  result.pages = empty_pages(texel_map, options.directional);
  for (const TexelMapPage& map : texel_map) result.visible.emplace_back(map.texel.size());
  std::atomic<std::uint64_t> rays{0};
  Finisher finisher(transport, atlas, texel_map, options, context, rays);
  if (is_dark(transport)) {
    ORIEL_TRY_VOID(bake_dark(transport, atlas, texel_map, context, rays, result));
    ORIEL_TRY_VOID(finisher.finish(result));
  } else if (options.estimator == Estimator::kCached) {
    const NextRefinement next = [&] { return finisher.finish_and_verify(result); };
    ORIEL_TRY_VOID(bake_cached(transport, atlas, texel_map, options, context, rays, result, next));
  } else {
    ORIEL_TRY_VOID(bake_reference(TexelPaths(transport, atlas, options.directional, context), texel_map, options,
                                  context, rays, result));
    ORIEL_TRY_VOID(finisher.finish(result));
  }
  result.report.rays = rays;
  for (std::size_t p = 0; options.hidden == Hidden::kBlack && p < texel_map.size(); ++p) {
    darken_hidden(texel_map[p], result.visible[p], result.pages[p]);
    std::fill(result.visible[p].begin(), result.visible[p].end(), 1.0f);
    dilate(options.dilation, result.pages[p]);
  }
  return result;
}

}  // namespace oriel
