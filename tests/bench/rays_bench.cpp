// How near the final gather comes to the physical limit: its rays per second beside those of bare queries with the same
// rays in the same order, and beside the same rays in an order without coherence, measured back to back.
#include <chrono>
#include <cstdio>

#include "bake/jobs/parallel.h"
#include "bake/radiosity/cached/gather.h"
#include "bake/scene/import.h"

namespace oriel {
namespace {

constexpr std::uint32_t kPerHalf = 32;
constexpr std::size_t kGroup = 64;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The rays of gather(), group by group, traced and forgotten. one_by_one: a texel's rays after each other, each by
// itself, as a path tracer has them.
double bare_seconds(const Accel& accel, const Texels& texels, std::span<const std::uint32_t> order,
                    const DirectionSets& sets, bool one_by_one, Context& context) {
  std::atomic<std::uint64_t> hits{0};
  const auto start = std::chrono::steady_clock::now();
  const auto body = [&](std::size_t g) {
    const auto group = order.subspan(g * kGroup, std::min(kGroup, order.size() - g * kGroup));
    std::vector<Ray> rays;
    std::vector<Hit> found(group.size());
    std::uint64_t count = 0;
    // Made ready before: what is left is a direction turned to the site, and the query.
    std::vector<GatherSite> sites;
    std::vector<const Vec3*> rows;
    for (const std::uint32_t t : group) {
      sites.emplace_back(texels.site_for(t, 0, 0));
      rows.push_back(sets.row(DirectionSets::set_of(texels.page[t], texels.x[t], texels.y[t]), 0));
    }
    if (one_by_one) {
      for (std::size_t t = 0; t < group.size(); ++t)
        for (std::uint32_t k = 0; k < 2 * kPerHalf; ++k)
          count += static_cast<bool>(accel.intersect(sites[t].ray(rows[t][k])));
    } else {
      for (std::uint32_t k = 0; k < 2 * kPerHalf; ++k) {
        rays.clear();
        for (std::size_t t = 0; t < group.size(); ++t) rays.push_back(sites[t].ray(rows[t][k]));
        accel.intersect(rays, found);
        for (const Hit& hit : found) count += static_cast<bool>(hit);
      }
    }
    hits += count;
  };
  (void)parallel_for(context, "", (order.size() + kGroup - 1) / kGroup, body);
  return seconds_since(start);
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
  const auto texels = list_texels(transport, *atlas, *map, context, rays);
  std::vector<std::uint32_t> order;
  for (const std::uint32_t t : coherent_order(*texels))
    if (texels->visible[t] > 0) order.push_back(t);
  const Surroundings around(transport, *texels, true, 1);
  const DirectionSets sets(1, 2 * kPerHalf);
  const std::vector<Vec3> irradiance(texels->count(), Vec3(1));
  for (int round = 0; round < 3; ++round) {
    const double single = bare_seconds(*accel, *texels, order, sets, true, context);
    const double bare = bare_seconds(*accel, *texels, order, sets, false, context);
    HalfSums sums(texels->count(), false);
    rays = 0;
    const auto start = std::chrono::steady_clock::now();
    if (!gather(*texels, around, sets, order, kPerHalf, irradiance, context, sums, rays)) return 4;
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
