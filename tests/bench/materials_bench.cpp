// Seconds that all maps of fifty materials take, of which none can share with another.
#include <chrono>
#include <cstdio>

#include "bake/material/materials.h"
#include "tests/bake/material/fifty_materials.h"

int main() {
  const oriel::Scene scene = oriel::test::fifty_materials();
  for (int run = 0; run < 3; ++run) {
    oriel::Context context;
    const auto start = std::chrono::steady_clock::now();
    const auto maps = oriel::bake_materials(scene, {}, context);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!maps) return 1;
    std::printf("materials: %zu, %zu kernels by incidence, %zu Fresnel maps: %.2f s\n", scene.materials.size(),
                maps->kernels.size(), maps->fresnel_maps.size(), seconds);
  }
}
