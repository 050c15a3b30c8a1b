#include "bake/radiance/reflector_plan.h"

namespace oriel {

// By places instead of numbers: an edit may number triangles anew.
Hash128 identity_of(const Scene& scene, const FoundReflector& found) {
  Hasher hasher;
  Archive archive(hasher);
  const Reflector& r = found.reflector;
  archive(r.pack_from_reflector, r.lower, r.upper, r.flatness_m, found.reflectance, found.roughness);
  for (const auto* triangles : {&found.triangles, &found.emitters}) {
    archive(triangles->size());
    for (const std::uint32_t t : *triangles)
      for (int corner = 0; corner < 3; ++corner) archive(scene.positions[scene.triangles[t][corner]]);
  }
  return hasher.result();
}

}  // namespace oriel
