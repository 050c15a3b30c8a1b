// How near the radiosity stage comes to the physical limit: its rays per second beside those of bare queries on the
// same scene, measured back to back.
#include <chrono>
#include <cstdio>

#include "bake/jobs/parallel.h"
#include "bake/radiosity/radiosity.h"
#include "bake/scene/import.h"
#include "bake/trace/warp.h"

namespace oriel {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Cosine-distributed closest-hit rays from texel points, 64 a texel: what a gather must trace, without any shading.
double bare_rate(const Accel& accel, const Atlas& atlas, std::span<const TexelMapPage> map, Context& context) {
  const Scene& scene = accel.scene();
  std::atomic<std::uint64_t> hits{0};
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t rays = 0;
  for (const TexelMapPage& page : map) {
    const auto body = [&](std::size_t i) {
      std::uint64_t found = 0;
      const TexelPoint p = sample_texel(atlas, page, i, Vec3(0.5f));
      const Mat3 frame = frame_from_normal(geometric_normal(scene, p.triangle));
      const Vec3 origin = spawn_origin(scene, p.triangle, p.barycentric, frame[2]);
      for (std::uint32_t k = 0; k < 64; ++k) {
        Sampler sampler(1, i, k);
        found += static_cast<bool>(accel.intersect({origin, frame * square_to_cosine_hemisphere(sampler.next2())}));
      }
      hits += found;
    };
    if (!parallel_for(context, "", page.texel.size(), body)) return 0;
    rays += page.texel.size() * 64;
  }
  return static_cast<double>(rays) / seconds_since(start);
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
  for (int round = 0; round < 3; ++round) {
    const double bare = bare_rate(*accel, *atlas, *map, context);
    const auto start = std::chrono::steady_clock::now();
    const auto baked = bake_radiosity({*accel, lights, {}}, *atlas, *map, {.samples = 16}, context);
    const double rate = static_cast<double>(baked->report.rays) / seconds_since(start);
    std::printf("%s: bare closest-hit %.2f Mray/s, radiosity %.2f Mray/s, ratio %.2f\n", file, bare * 1e-6, rate * 1e-6,
                rate / bare);
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
