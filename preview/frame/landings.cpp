#include "preview/frame/landings.h"

#include <algorithm>

#include "bake/jobs/parallel.h"
#include "preview/frame/particle_walk.h"
#include "preview/frame/streams.h"

namespace oriel {
namespace {

constexpr int kMostBounces = 64;
constexpr std::uint32_t kParticles = 2048, kParticlesATask = 64;  // of a kind of source, and of a task

}  // namespace

Result<std::vector<Landing>> land_particles(const Transport& t, const GuidedSources& sources, std::uint32_t pass,
                                            Context& context) {
  struct Task {
    SourceKind kind;
    std::uint32_t first, last, count;  // of as many particles of that kind
    std::vector<Landing> landed;
  };
  std::vector<Task> tasks;
  for (const SourceKind kind : sources.kinds()) {
    const bool aimed = kind == SourceKind::kNear || !sources.guides(kind).empty();
    const std::uint32_t count = std::max(1u, aimed ? kParticles : kParticles / 8);
    for (std::uint32_t first = 0; first < count; first += kParticlesATask)
      tasks.push_back({kind, first, std::min(count, first + kParticlesATask), count, {}});
  }
  ORIEL_TRY_VOID(parallel_for(context, "", tasks.size(), [&](std::size_t i) {
    Task& task = tasks[i];
    const float share = 1 / (kPi * static_cast<float>(task.count));
    const auto land = [&](const SurfacePoint& s, const Ray& ray, const Vec3& power) {
      const Vec3 lobes = reflectance(s.shade, -glm::dot(s.normal, ray.direction));
      const Vec3 shines = share * power * ((1 - max_component(lobes)) * s.shade.diffuse + lobes);
      if (max_component(shines) > 0 && is_usable(shines))
        task.landed.push_back({s.position, s.geometric_normal, shines, s.magnitude});
    };
    for (std::uint32_t k = task.first; k < task.last; ++k) {
      Sampler sampler(context.seed, kLandingStream + static_cast<std::uint64_t>(task.kind), pass * task.count + k);
      const Particle particle = sources.emit(task.kind, sampler);
      ParticleWalk(t, particle.ray, particle.power, sampler).run(kMostBounces, land, [](const Ray&) {});
    }
  }));
  std::vector<Landing> all;
  for (const Task& task : tasks) all.insert(all.end(), task.landed.begin(), task.landed.end());
  return all;
}

}  // namespace oriel
