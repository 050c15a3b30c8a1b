#include "bake/lux/illuminance.h"

#include <bit>

#include "bake/jobs/parallel.h"
#include "bake/trace/buried.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::uint32_t kReplicates = 32;    // Student's t is within 4 % of the normal's 1.96 then
constexpr std::uint32_t kFirstSamples = 32;  // a replicate: 1024 paths before a point is believed
constexpr double kFloor = 0.01;              // of the mean over points, in the error's denominator

// Sums over one scrambled set.
struct Replicate {
  DVec3 direct{0}, indirect{0};
};

// Scaled by its largest component first: the square of a tiny or huge one leaves what a double can hold.
Vec3 unit(const DVec3& v) {
  return Vec3(glm::normalize(v / std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)})));
}

class Meter {
 public:
  Meter(const Transport& t, std::span<const MeasurePoint> points, const Context& context)
      : t_(t), context_(context), replicates_(points.size() * kReplicates), results_(points.size()) {
    const Scene& scene = t.accel.scene();
    const float size = max_component(glm::max(glm::abs(scene.lower), glm::abs(scene.upper)));
    for (const MeasurePoint& point : points) {
      SurfacePoint s;
      s.position = Vec3(point.position - scene.origin);
      s.magnitude = std::max(size, max_component(glm::abs(s.position)));
      s.normal = s.geometric_normal = unit(point.normal);
      surfaces_.push_back(s);
    }
  }

  void find_buried(std::size_t p, std::uint64_t& rays) {
    results_[p].buried = is_buried(t_, surfaces_[p], context_.seed, p, 0, rays);
  }

  // Carries one replicate of a point from sample `first` to `last`.
  void grow(std::size_t p, std::uint32_t r, std::uint32_t first, std::uint32_t last, std::uint64_t& rays) {
    Replicate& sums = replicates_[p * kReplicates + r];
    for (std::uint32_t k = first; k < last; ++k) {
      if (k % 1024 == 0 && context_.stopped()) return;  // the result is thrown away
      Sampler sampler(context_.seed, p * kReplicates + r, k);
      const IrradianceSample e = sample_irradiance(t_, surfaces_[p], sampler, rays);
      sums.direct += DVec3(e.direct);
      sums.indirect += DVec3(e.indirect);
    }
  }

  // Means and errors of a point from its replicates of `samples` each.
  void summarize(std::size_t p, std::uint32_t samples) {
    PointIlluminance& result = results_[p];
    result.direct = result.indirect = DVec3(0);
    DVec3 squares(0);
    double luminance_squares = 0;
    const auto own = std::span(replicates_).subspan(p * kReplicates, kReplicates);
    for (const Replicate& r : own) {
      result.direct += r.direct / (1.0 * samples * kReplicates);
      result.indirect += r.indirect / (1.0 * samples * kReplicates);
    }
    const DVec3 mean = result.direct + result.indirect;
    for (const Replicate& r : own) {
      const DVec3 deviation = (r.direct + r.indirect) / (1.0 * samples) - mean;
      squares += deviation * deviation;
      luminance_squares += luminance(deviation) * luminance(deviation);
    }
    constexpr double kCount = kReplicates * (kReplicates - 1.0);
    result.standard_error = glm::sqrt(squares / kCount);
    result.luminance_error = std::sqrt(luminance_squares / kCount);
    result.samples = samples * kReplicates;
  }

  // Which of these points still miss the target.
  std::vector<std::size_t> unfinished(const std::vector<std::size_t>& points, double target) {
    double mean = 0;
    for (const PointIlluminance& r : results_) mean += luminance(r.direct + r.indirect) / double(results_.size());
    std::vector<std::size_t> left;
    for (const std::size_t p : points) {
      PointIlluminance& r = results_[p];
      r.converged = r.luminance_error <= target * (luminance(r.direct + r.indirect) + kFloor * mean);
      if (!r.converged || target <= 0) left.push_back(p);
    }
    return left;
  }

  std::vector<PointIlluminance>& results() { return results_; }

 private:
  const Transport& t_;
  const Context& context_;
  std::vector<SurfacePoint> surfaces_;
  std::vector<Replicate> replicates_;  // kReplicates a point
  std::vector<PointIlluminance> results_;
};

}  // namespace

Result<std::vector<PointIlluminance>> illuminance_at(const Transport& transport, std::span<const MeasurePoint> points,
                                                     const LuxOptions& options, Context& context) {
  Meter meter(transport, points, context);
  std::vector<std::size_t> active(points.size());
  for (std::size_t p = 0; p < active.size(); ++p) active[p] = p;
  const std::uint32_t most = std::bit_ceil(std::max(1u, std::min(options.max_samples, 1u << 31) / kReplicates));
  std::uint32_t first = 0;
  for (std::uint32_t last = kFirstSamples; !active.empty() && (first == 0 || last <= most); last *= 2) {
    const std::string stage = fmt::format("{} points, {} paths each", active.size(), last * kReplicates);
    std::atomic<std::uint64_t> total_rays{0};
    const auto body = [&](std::size_t task) {
      const std::size_t p = active[task / kReplicates];
      const auto r = static_cast<std::uint32_t>(task % kReplicates);
      std::uint64_t rays = 0;
      if (first == 0 && r == 0) meter.find_buried(p, rays);
      meter.grow(p, r, first, last, rays);
      total_rays += rays;
    };
    ORIEL_TRY_VOID(parallel_for(context, stage, active.size() * kReplicates, body, &total_rays));
    if (context.stopped()) return fail(ErrorCode::kStopped, stage, "stopped");
    for (const std::size_t p : active) meter.summarize(p, last);
    active = meter.unfinished(active, options.relative_error);
    first = last;
  }
  return std::move(meter.results());
}

}  // namespace oriel
