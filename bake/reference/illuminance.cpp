#include "bake/reference/illuminance.h"

#include "bake/jobs/parallel.h"
#include "bake/reference/meter.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr double kFloor = 0.01;  // of the mean over points, in the error's denominator

double illuminance_of(const PointIlluminance& r) {
  return luminance(r.direct + r.indirect);
}

// Which of these points still miss the target and may go on.
std::vector<std::size_t> unfinished(const std::vector<std::size_t>& points, const LuxOptions& options,
                                    std::vector<PointIlluminance>& results) {
  double mean = 0;
  for (const PointIlluminance& r : results) mean += illuminance_of(r) / static_cast<double>(results.size());
  std::vector<std::size_t> left;
  for (const std::size_t p : points) {
    PointIlluminance& r = results[p];
    r.converged =
        options.relative_error > 0 && r.luminance_error <= options.relative_error * (illuminance_of(r) + kFloor * mean);
    if (!r.converged && r.samples <= options.max_samples / 2) left.push_back(p);
  }
  return left;
}

}  // namespace

Result<std::vector<PointIlluminance>> illuminance_at(const Transport& transport, std::span<const MeasurePoint> points,
                                                     const LuxOptions& options, Context& context) {
  Meter meter(transport, points, context);
  std::vector<PointIlluminance> results(points.size());
  std::vector<char> buried(points.size());
  std::vector<std::size_t> active(points.size());
  for (std::size_t p = 0; p < active.size(); ++p) active[p] = p;
  for (int round = 0; !active.empty(); ++round) {
    const std::string stage = fmt::format("round {}, {} points", round + 1, active.size());
    std::atomic<std::uint64_t> total_rays{0};
    const auto body = [&](std::size_t task) {
      const std::size_t p = active[task / kReplicates];
      const auto r = static_cast<std::uint32_t>(task % kReplicates);
      std::uint64_t rays = 0;
      if (round == 0 && r == 0) buried[p] = meter.buried(p, rays);
      meter.grow(p, r, rays);
      total_rays += rays;
    };
    ORIEL_TRY_VOID(parallel_for({context, &total_rays}, stage, active.size() * kReplicates, body));
    if (context.stopped()) return fail(ErrorCode::kStopped, stage, "stopped");
    for (const std::size_t p : active) {
      results[p] = meter.summarize(p);
      results[p].buried = buried[p] != 0;
    }
    active = unfinished(active, options, results);
  }
  return results;
}

}  // namespace oriel
