#include "bake/radiosity/radiosity.h"

#include <algorithm>

#include "bake/direct/buried.h"
#include "bake/jobs/parallel.h"
#include "bake/radiosity/cached/cached.h"
#include "bake/radiosity/dilate.h"
#include "bake/radiosity/seams.h"
#include "bake/radiosity/stitch.h"
#include "bake/radiosity/texels/texel_part.h"
#include "bake/radiosity/texels/texels.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kRun = 64;  // texels a task: long enough to hide scheduling, short enough to stop at once

struct Run {
  std::size_t page, first, last;
};

// What the paths of one texel found.
struct TexelSums {
  DVec3 sum{0}, squares{0};
  DVec3 vector{0};  // of luminance, as IrradianceSample's
  double mean = 0;
  std::uint32_t count = 0;
};

class Baker {
 public:
  Baker(const Transport& t, const Atlas& atlas, const RadiosityOptions& options, const Context& context)
      : t_(t), atlas_(atlas), options_(options), context_(context) {}

  TexelSums bake(const TexelMapPage& map, std::size_t page, std::size_t i, std::uint64_t& rays) const {
    TexelSums sums;
    const std::uint64_t stream = static_cast<std::uint64_t>(page) << 32 | map.texel[i];
    const bool mixed = any_buried(map, i, stream, rays);
    const TexelPart part(t_, atlas_, map, i, context_.seed, stream, rays);
    for (std::uint32_t k = 0; k < options_.samples; ++k) {
      if (k % 256 == 0 && context_.stopped()) break;  // the result is thrown away
      Sampler sampler(context_.seed, stream, k);
      const Vec2 uv = sampler.next2();
      const SurfacePoint surface = point_of(map, i, Vec3(uv, sampler.next1()));
      if (mixed && is_buried(t_, surface, context_.seed, stream, k, rays)) continue;
      if (!part.holds(surface.triangle, surface.barycentric, rays)) continue;
      const IrradianceSample e = sample_irradiance(t_, surface, sampler, rays, options_.directional);
      const DVec3 value(e.direct + e.indirect);
      sums.sum += value;
      sums.squares += value * value;
      sums.vector += DVec3(e.vector);
      sums.mean += e.mean;
      ++sums.count;
    }
    return sums;
  }

 private:
  SurfacePoint point_of(const TexelMapPage& map, std::size_t i, const Vec3& u) const {
    const TexelPoint point = sample_texel(atlas_, map, i, u);
    return point_on_side(t_.accel.scene(), point.triangle, point.barycentric);
  }

  // Whether some of 16 points spread over the texel are buried: only then every path asks for its own point. Most
  // texels answer with one ray a point.
  bool any_buried(const TexelMapPage& map, std::size_t i, std::uint64_t stream, std::uint64_t& rays) const {
    for (std::uint32_t k = 0; k < 16; ++k) {
      Sampler sampler(~context_.seed, stream, k);
      const Vec2 uv = sampler.next2();
      if (is_buried(t_, point_of(map, i, Vec3(uv, sampler.next1())), context_.seed, stream, ~k, rays)) return true;
    }
    return false;
  }

  const Transport& t_;
  const Atlas& atlas_;
  const RadiosityOptions& options_;
  const Context& context_;
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
  const double n = sums.count;
  const DVec3 mean = sums.sum / n;
  // One path says nothing of its spread: its error is taken to be as large as itself.
  const DVec3 variance = sums.count < 2 ? mean * mean : glm::max(DVec3(0), sums.squares / n - mean * mean);
  page.irradiance[texel] = Vec3(mean);
  if (!page.direction.empty()) page.direction[texel] = direction_of(sums);
  page.standard_error[texel] = Vec3(glm::sqrt(variance / std::max(1.0, n - 1)));
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

void summarize(const Scene& scene, const Atlas& atlas, std::span<const TexelMapPage> texel_map, Radiosity& radiosity) {
  const auto& pages = radiosity.pages;
  RadiosityReport& report = radiosity.report;
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
  double squares = 0;
  for (std::size_t p = 0; p < pages.size(); ++p)
    for (const std::uint32_t texel : texel_map[p].texel) {
      if (pages[p].state[texel] != TexelState::kValid) continue;
      for (int c = 0; c < 3; ++c) {
        const double denominator = pages[p].irradiance[texel][c] + 0.01 * report.mean[c];
        if (denominator > 0) squares += std::pow(pages[p].standard_error[texel][c] / denominator, 2);
      }
    }
  report.relative_error = std::sqrt(squares / (3.0 * static_cast<double>(report.texels)));
}

Status stitch_lightmap(const Transport& transport, const Atlas& atlas, std::span<const TexelMapPage> texel_map,
                       Context& context, std::atomic<std::uint64_t>& rays, Radiosity& radiosity) {
  ORIEL_TRY(const Seams seams, find_seams(transport, atlas, radiosity.pages, context, rays));
  if (seams.points.empty()) return {};
  const auto power = [&] {
    return luminance(Vec3(incident_power(transport.accel.scene(), atlas, texel_map, radiosity)));
  };
  const double before = power();
  radiosity.report.seams = stitch(seams, texel_map, radiosity.pages);
  if (before > 0) radiosity.report.seams.energy_change = power() / before - 1;
  return {};
}

void darken_hidden(const TexelMapPage& map, const std::vector<float>& visible, LightmapPage& page) {
  for (std::size_t i = 0; i < map.texel.size(); ++i) {
    page.irradiance[map.texel[i]] *= visible[i];
    page.standard_error[map.texel[i]] *= visible[i];
  }
}

Status bake_reference(const Baker& baker, std::span<const TexelMapPage> texel_map, const RadiosityOptions& options,
                      Context& context, std::atomic<std::uint64_t>& rays, Radiosity& result) {
  std::vector<Run> runs;
  for (std::size_t p = 0; p < texel_map.size(); ++p)
    for (std::size_t first = 0; first < texel_map[p].texel.size(); first += kRun)
      runs.push_back({p, first, std::min(first + kRun, texel_map[p].texel.size())});
  const auto body = [&](std::size_t r) {
    const Run& run = runs[r];
    std::uint64_t traced = 0;
    for (std::size_t i = run.first; i < run.last && !context.stopped(); ++i) {
      const TexelSums sums = baker.bake(texel_map[run.page], run.page, i, traced);
      result.visible[run.page][i] = static_cast<float>(sums.count) / static_cast<float>(options.samples);
      store(sums, options.samples, result.pages[run.page], texel_map[run.page].texel[i]);
    }
    rays += traced;
  };
  return parallel_for(context, "radiosity", runs.size(), body, &rays);
}

}  // namespace

Result<Radiosity> bake_radiosity(const Transport& transport, const Atlas& atlas,
                                 std::span<const TexelMapPage> texel_map, const RadiosityOptions& options,
                                 Context& context) {
  Radiosity result;
  for (std::size_t p = 0; p < texel_map.size(); ++p) {
    const TexelMapPage& map = texel_map[p];
    const std::size_t size = static_cast<std::size_t>(map.width) * map.height;
    LightmapPage page{map.width, map.height, std::vector<Vec3>(size), std::vector<Vec3>(size),
                      std::vector<TexelState>(size)};
    if (options.directional) page.direction.resize(size);
    result.pages.push_back(std::move(page));
    result.visible.emplace_back(map.texel.size());
  }
  std::atomic<std::uint64_t> rays{0};
  if (options.estimator == Estimator::kCached) {
    ORIEL_TRY_VOID(bake_cached(transport, atlas, texel_map, options, context, rays, result));
  } else {
    ORIEL_TRY_VOID(
        bake_reference(Baker(transport, atlas, options, context), texel_map, options, context, rays, result));
  }
  if (context.stopped()) return fail(ErrorCode::kStopped, "radiosity", "stopped");
  const bool black = options.hidden == Hidden::kBlack;
  if (!black) {
    for (std::size_t p = 0; p < texel_map.size(); ++p) {
      fill_buried(atlas, texel_map[p], result.pages[p]);
      dilate(options.dilation, result.pages[p]);
    }
    if (options.stitch) {
      ORIEL_TRY_VOID(stitch_lightmap(transport, atlas, texel_map, context, rays, result));
    }
  }
  summarize(transport.accel.scene(), atlas, texel_map, result);
  result.report.rays = rays;
  for (std::size_t p = 0; black && p < texel_map.size(); ++p) {
    darken_hidden(texel_map[p], result.visible[p], result.pages[p]);
    dilate(options.dilation, result.pages[p]);
  }
  return result;
}

}  // namespace oriel
