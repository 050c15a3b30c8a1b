// How near the final gather comes to the physical limit: its rays per second beside those of bare queries with the same
// rays in the same order, and beside the same rays in an order without coherence, measured back to back.
#include <chrono>
#include <cstdio>

#include "bake/import/import.h"
#include "bake/jobs/parallel.h"
#include "bake/radiosity/gather/gather.h"

namespace oriel {
namespace {

constexpr std::uint32_t kPerHalf = 32;
constexpr std::size_t kGroup = 64;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The rays of gather() for some groups of texels, made ready.
std::vector<Ray> rays_of(const Texels& texels, std::span<const std::uint32_t> order) {
  const ShiftedNet net(1, 2 * kPerHalf);
  std::vector<Ray> rays;
  for (std::size_t g = 0; g < order.size(); g += kGroup)
    for (std::uint32_t k = 0; k < 2 * kPerHalf; ++k)
      for (const std::uint32_t t : order.subspan(g, std::min(kGroup, order.size() - g)))
        rays.push_back(GatherPoint(texels.sample_point(t, 0, k)).ray(net.point(k, net.shift(t))));
  return rays;
}

// Queries and nothing else. one_by_one: each ray by itself, a texel's after each other, as a path tracer has them.
double bare_seconds(const Accel& accel, const Texels& texels, std::span<const std::uint32_t> order, bool one_by_one,
                    Context& context) {
  constexpr std::size_t kChunk = 512 * kGroup;  // texels: as many rays as fit in memory
  std::atomic<std::uint64_t> hits{0};
  double seconds = 0;
  for (std::size_t first = 0; first < order.size(); first += kChunk) {
    const auto chunk = order.subspan(first, std::min(kChunk, order.size() - first));
    const std::vector<Ray> rays = rays_of(texels, chunk);
    const std::size_t per_task = kGroup * 2 * kPerHalf;
    const auto start = std::chrono::steady_clock::now();
    (void)parallel_for(context, "", (rays.size() + per_task - 1) / per_task, [&](std::size_t task) {
      const auto own = std::span(rays).subspan(task * per_task, std::min(per_task, rays.size() - task * per_task));
      std::vector<Hit> found(kGroup);
      std::uint64_t count = 0;
      if (one_by_one) {
        const std::size_t members = own.size() / (2 * kPerHalf);
        for (std::size_t t = 0; t < members; ++t)
          for (std::size_t k = 0; k < 2 * kPerHalf; ++k)
            count += static_cast<bool>(accel.intersect(own[k * members + t]));
      } else {
        for (std::size_t i = 0; i < own.size(); i += kGroup) {
          const auto batch = own.subspan(i, std::min(kGroup, own.size() - i));
          accel.intersect(batch, std::span(found).first(batch.size()));
          for (std::size_t k = 0; k < batch.size(); ++k) count += static_cast<bool>(found[k]);
        }
      }
      hits += count;
    });
    seconds += seconds_since(start);
  }
  return seconds;
}

int bench(const char* file) {
  Context context;
  const auto imported = import_gltf(file, {}, context);
  if (!imported) {
    std::fprintf(stderr, "%s\n", imported.error().text().c_str());
    return static_cast<int>(imported.error().code);
  }
  const Scene& scene = imported->scene;
  const auto atlas = build_atlas(scene, {}, context);
  const auto map = build_texel_map(*atlas, context);
  const auto accel = Accel::build(scene);
  const LightSet lights(scene);
  const Transport transport{*accel, lights, {}};
  std::atomic<std::uint64_t> rays{0};
  const auto texels = list_texels({transport, *atlas, *map}, {context, &rays});
  const auto graph = find_neighbours(transport, *texels, {context, &rays});
  std::vector<std::uint32_t> order;
  for (const std::uint32_t t : coherent_order(*texels))
    if (texels->visible[t] > 0) order.push_back(t);
  const CacheQuery query(transport, *texels, true, 1);
  const ExtraSamplePoints sample_points({transport, *atlas, *map}, *texels, context.seed);
  const std::vector<Vec3> irradiance(texels->count(), Vec3(1));
  const CachedLight cached = cache_light(*texels, *graph, irradiance, context);
  for (int round = 0; round < 3; ++round) {
    const double single = bare_seconds(*accel, *texels, order, true, context);
    const double bare = bare_seconds(*accel, *texels, order, false, context);
    HalfSums sums(texels->count(), false);
    rays = 0;
    const auto start = std::chrono::steady_clock::now();
    if (!FinalGather{sample_points, query, cached}.run(order, kPerHalf, {context, &rays}, sums)) return 4;
    const double seconds = seconds_since(start), count = static_cast<double>(order.size()) * 2 * kPerHalf * 1e-6;
    std::printf(
        "%s: %.1f Mray, one by one %.2f Mray/s, in the gather's order %.2f Mray/s (%.1f times), the gather %.2f Mray/s "
        "(%.0f %% of that order, with %.2f rays each)\n",
        file, count, count / single, count / bare, single / bare, count / seconds, 100 * bare / seconds,
        static_cast<double>(rays) * 1e-6 / count);
  }
  return 0;
}

}  // namespace
}  // namespace oriel

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: rays_bench SCENE.glb\n");
    return 1;
  }
  return oriel::bench(argv[1]);
}
