#include "bake/radiosity/estimators/first_direct.h"

#include "bake/radiosity/texels/nearest.h"

namespace oriel {
namespace {

constexpr double kPointsTime = 0.35;       // of the time left
constexpr double kLeast_s = 0.3;           // for each: some light even where nothing is left
constexpr std::size_t kLeastTexels = 512;  // with direct light, whatever the time: all else shows theirs

}  // namespace

double points_seconds(const RadiosityTask& task) {
  if (!task.options.left) return std::numeric_limits<double>::infinity();
  return std::max(kPointsTime * task.options.left(), kLeast_s);
}

Result<bool> FirstDirect::everywhere(const std::vector<std::uint32_t>& texels) {
  const ElapsedTime clock;
  if (task_.options.left) {
    std::vector<std::uint32_t> some;
    for (std::size_t i = 0; i < texels.size(); i += 1 + texels.size() / kLeastTexels) some.push_back(texels[i]);
    ORIEL_TRY_VOID(estimate(some, samples(), {}));
  }
  ORIEL_TRY(const bool all, estimate(texels, samples(), time_is_over()));
  seconds_ = clock.spent();
  if (all) return true;
  std::vector<std::uint32_t> unfinished;
  for (const std::uint32_t i : texels)
    if (texels_.visible[i] > 0 && sums_.per_half[i] == 0) unfinished.push_back(i);
  leave_out(unfinished, texels_);
  return false;
}

// Directions come from samples, not closed forms; and few randomly chosen light samples hit anything.
std::uint32_t FirstDirect::samples() const {
  return task_.options.directional || light_.samples_lights() ? 4 * kSamples : kSamples;
}

Result<bool> FirstDirect::estimate(const std::vector<std::uint32_t>& list, std::uint32_t per_half,
                                   const std::function<bool()>& enough) const {
  return done_in_time(task_.context, enough, [&] { return light_.estimate(list, per_half, task_.quick, sums_); });
}

std::function<bool()> FirstDirect::time_is_over() const {
  if (!task_.options.left) return {};
  const double left = task_.options.left();
  return [this, least = left - std::max(kTime * left, kLeast_s)] { return task_.options.left() < least; };
}

}  // namespace oriel
