#include "preview/frame/landings.h"

#include <algorithm>
#include <optional>

#include "bake/jobs/parallel.h"
#include "bake/trace/emission.h"
#include "bake/trace/shading.h"

namespace oriel {
namespace {

constexpr std::uint64_t kStream = 0x656c656d;
constexpr int kMostBounces = 64;
constexpr int kRouletteFrom = 2;
constexpr std::uint32_t kTogether = 256;  // particles of a task

class Walk {
 public:
  Walk(const Transport& t, const Particle& particle, float share, Sampler& sampler, std::vector<Landing>& landed)
      : t_(t), ray_(particle.ray), power_(particle.power), share_(share), sampler_(sampler), landed_(landed) {}

  void run() {
    if (!(full_ > 0)) return;
    int bounces = 0;
    for (int passes = 0; bounces < kMostBounces && passes < kMaxPasses;) {
      const Hit hit = t_.accel.intersect(ray_);
      if (!hit) return;
      const SurfacePoint s = surface_at(t_.accel.scene(), hit, ray_.direction);
      if (s.shade.coverage < 1 && sampler_.next1() >= s.shade.coverage) {
        ray_.origin = spawn_origin(s, ray_.direction), ++passes;
        continue;
      }
      if (!s.reflects) return;
      land(s);
      const auto straight = scatter(s);
      if (!straight || !is_usable(power_)) return;
      if (*straight)
        ++passes;
      else if (++bounces >= kRouletteFrom && !survive())
        return;
    }
  }

 private:
  void land(const SurfacePoint& s) {
    const float left = 1 - max_component(reflectance(s.shade, -glm::dot(s.normal, ray_.direction)));
    const Vec3 power = power_ * left * s.shade.diffuse * (share_ / kPi);
    if (max_component(power) > 0 && is_usable(power))
      landed_.push_back({s.position, s.geometric_normal, power, s.magnitude});
  }

  // Nothing where the light ends, else whether it went straight on.
  std::optional<bool> scatter(const SurfacePoint& s) {
    const Shading shading(s, -ray_.direction);
    const float u = sampler_.next1();
    const auto sample = shading.sample(u, sampler_.next2());
    if (!sample || !(max_component(sample->weight) > 0)) return std::nullopt;
    power_ *= sample->weight / sample->squeeze;
    const bool straight = sample->lobe == Lobe::kTransmission;
    if (!straight) ray_.direction = shading.world(*sample);
    ray_.origin = spawn_origin(s, ray_.direction);
    return straight;
  }

  bool survive() {
    const float q = std::min(0.95f, max_component(power_) / full_);
    if (sampler_.next1() >= q) return false;
    power_ /= q;
    return true;
  }

  const Transport& t_;
  Ray ray_;
  Vec3 power_;
  const float share_, full_ = max_component(power_);
  Sampler& sampler_;
  std::vector<Landing>& landed_;
};

}  // namespace

Result<std::vector<Landing>> land_particles(const Transport& t, std::uint32_t count, Context& context) {
  const Sources sources(t.accel.scene(), t.lights);
  const std::size_t tasks = (count + kTogether - 1) / kTogether;  // of each kind
  std::vector<std::vector<Landing>> landed(tasks * sources.kinds().size());
  ORIEL_TRY_VOID(parallel_for(context, "", landed.size(), [&](std::size_t task) {
    const std::size_t kind = task / tasks;
    const auto first = static_cast<std::uint32_t>(task % tasks) * kTogether;
    for (std::uint32_t i = first; i < std::min(count, first + kTogether); ++i) {
      Sampler sampler(context.seed, kStream + kind, i);
      const Particle particle = sources.emit(sources.kinds()[kind], sampler);
      Walk(t, particle, 1 / static_cast<float>(count), sampler, landed[task]).run();
    }
  }));
  std::vector<Landing> all;
  for (const std::vector<Landing>& some : landed) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace oriel
