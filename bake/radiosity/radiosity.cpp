#include "bake/radiosity/radiosity.h"

#include <algorithm>
#include <limits>

#include "bake/jobs/units.h"
#include "bake/radiosity/cached/cached.h"
#include "bake/radiosity/certificate.h"
#include "bake/radiosity/dilate.h"
#include "bake/radiosity/frames/frame_error.h"
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
constexpr std::size_t kPixels = 1 << 16;   // that the error is told from, and as many others held out
constexpr std::uint32_t kOpenEyes = 1024;  // where none is given
constexpr std::size_t kRun = 64;  // texels a task: long enough to hide scheduling, short enough to stop at once

constexpr std::uint64_t kPixelSeed = 0xf4a3e, kHeldOutSeed = 0x4e1d;

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

// By texel, in the order of the texel map.
std::vector<bool> has_light(std::span<const TexelMapPage> texel_map, const Radiosity& radiosity) {
  std::vector<bool> has;
  for (std::size_t p = 0; p < texel_map.size(); ++p)
    for (const std::uint32_t t : texel_map[p].texel) has.push_back(radiosity.pages[p].state[t] == TexelState::kValid);
  return has;
}

// RadiosityReport::relative_error.
double relative_error(std::span<const TexelMapPage> texel_map, std::span<const FramePixel> pixels,
                      const Radiosity& radiosity) {
  std::vector<Vec3> light, variance;
  for (std::size_t p = 0; p < texel_map.size(); ++p)
    for (const std::uint32_t t : texel_map[p].texel) {
      const Vec3& error = radiosity.pages[p].standard_error[t];
      light.push_back(radiosity.pages[p].irradiance[t]);
      variance.push_back(error * error);
    }
  double sum = 0;
  for (const float square : FrameError(pixels, texel_map, has_light(texel_map, radiosity)).squares(light, variance))
    sum += square;
  return std::sqrt(sum);
}

void summarize(const Scene& scene, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
               std::span<const FramePixel> pixels, Radiosity& radiosity) {
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
  report.relative_error = relative_error(texel_map, pixels, radiosity);
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
Status bake_reference(const TexelPaths& paths, std::span<const TexelMapPage> texel_map,
                      std::span<const FramePixel> pixels, const RadiosityOptions& options, Context& context,
                      std::atomic<std::uint64_t>& rays, Radiosity& result) {
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
    if (options.error > 0 && relative_error(texel_map, pixels, result) <= options.error) return {};
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

// Pixels that eyes see; where they see nothing, or none is given, those of eyes in the open.
Result<std::vector<FramePixel>> pixels_of(const Transport& transport, const Atlas& atlas, std::vector<Vec3> eyes,
                                          std::uint64_t seed, Context& context) {
  for (;; eyes.clear()) {
    const bool given = !eyes.empty();
    if (!given) eyes = eyes_in_the_open(transport, kOpenEyes, seed);
    if (eyes.empty()) return std::vector<FramePixel>();
    const auto per_eye = static_cast<std::uint32_t>(std::max<std::size_t>(1, kPixels / eyes.size()));
    ORIEL_TRY(std::vector<FramePixel> pixels, find_frame_pixels(transport, atlas, eyes, per_eye, mix64(seed), context));
    if (!given || !pixels.empty()) return pixels;
  }
}

// All that follows an estimate: what is buried and beyond charts is filled, seams are stitched, and held-out texels
// tell the error.
class Finisher {
 public:
  Finisher(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
           std::span<const FramePixel> pixels, const RadiosityOptions& options, Context& context,
           std::atomic<std::uint64_t>& rays)
      : transport_(transport),
        atlas_(atlas),
        map_(texel_map),
        pixels_(pixels),
        options_(options),
        context_(context),
        rays_(rays) {}

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
    summarize(transport_.accel.scene(), atlas_, map_, pixels_, result);
    return {};
  }

  // How to refine, where held-out pixels tell of a larger error than was asked for.
  Result<Refinement> finish_and_verify(Radiosity& result) {
    ORIEL_TRY_VOID(finish(result));
    RadiosityReport& report = result.report;
    if (options_.verify <= 0) return {};
    const auto late = [&] { return options_.left && options_.left() <= 0; };
    std::vector<FramePixel> held_out;
    {
      const Interruptible until(context_, late);
      const auto measured = [&]() -> Result<Certificate> {
        ORIEL_TRY(held_out, pixels_of(transport_, atlas_, options_.held_out.empty() ? options_.eyes : options_.held_out,
                                      mix64(context_.seed + kHeldOutSeed), context_));
        return ask(Ask::kPoints, held_out, result);
      }();
      if (!measured && (context_.stop || !late())) return tl::unexpected(measured.error());
      report.certificate = measured ? *measured : Certificate();
    }
    const double asked = options_.error;
    Certificate& c = report.certificate;
    const bool missed = asked > 0 && c.relative_error > kTolerated * asked && c.error_low > asked;
    if (!missed || report.ended_early || report.refinements == kRefinements) return {};
    if (options_.enough && options_.enough()) return {};
    // What the noise that is stated does not explain stays, however many rays are traced. Of it, what texels are off by
    // as a whole comes from what rays look up, but for what stitching moves: less of it where less is looked up, and
    // none of that can be with limited bounces. The rest is their size.
    const double asked2 = asked * asked, square = c.relative_error * c.relative_error;
    double stays = std::max(square - std::pow(report.relative_error, 2), 0.0);
    Refinement how;
    if (report.refinements == 0 && options_.bounces == 0 && stays > kUnexplained * asked2) {
      ORIEL_TRY(const Certificate texels, ask(Ask::kTexels, held_out, result));
      c.texel_error = texels.relative_error, c.rays += texels.rays;
      const double of_texels = c.texel_error * c.texel_error;
      const double looked_up = of_texels - std::pow(report.relative_error, 2) - std::pow(report.seams.moved, 2);
      how.nearer = looked_up > kUnexplained * asked2 && square - of_texels < asked2;
      if (how.nearer) stays -= (1 - kNearerLeaves) * looked_up;
    }
    const double goal2 = asked2 - stays;
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

  Result<Certificate> ask(Ask what, std::span<const FramePixel> held_out, const Radiosity& result) {
    const auto at_most = static_cast<std::uint64_t>(options_.verify * static_cast<double>(rays_));
    const double goal = options_.error > 0 ? options_.error : result.report.relative_error;
    auto c = certify(transport_, atlas_, map_, result.pages, held_out, what, goal, at_most, context_);
    if (c) rays_ += c->rays;
    return c;
  }

  const Transport& transport_;
  const Atlas& atlas_;
  std::span<const TexelMapPage> map_;
  std::span<const FramePixel> pixels_;
  const RadiosityOptions& options_;
  Context& context_;
  std::atomic<std::uint64_t>& rays_;
  double target_ = std::numeric_limits<double>::infinity();  // of the last refinement
};

}  // namespace

Result<Radiosity> bake_radiosity(const Transport& transport, const Atlas& atlas,
                                 std::span<const TexelMapPage> texel_map, const RadiosityOptions& options,
                                 Context& context) {
  Radiosity result;
  result.pages = empty_pages(texel_map, options.directional);
  for (const TexelMapPage& map : texel_map) result.visible.emplace_back(map.texel.size());
  std::atomic<std::uint64_t> rays{0};
  ORIEL_TRY(const std::vector<FramePixel> pixels,
            pixels_of(transport, atlas, options.eyes, mix64(context.seed + kPixelSeed), context));
  Finisher finisher(transport, atlas, texel_map, pixels, options, context, rays);
  if (is_dark(transport)) {
    ORIEL_TRY_VOID(bake_dark(transport, atlas, texel_map, context, rays, result));
    ORIEL_TRY_VOID(finisher.finish(result));
  } else if (options.estimator == Estimator::kCached) {
    const NextRefinement next = [&] { return finisher.finish_and_verify(result); };
    ORIEL_TRY_VOID(bake_cached(transport, atlas, texel_map, pixels, options, context, rays, result, next));
  } else {
    ORIEL_TRY_VOID(bake_reference(TexelPaths(transport, atlas, options.directional, context), texel_map, pixels,
                                  options, context, rays, result));
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
