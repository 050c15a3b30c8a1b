#include "tests/fuzz/scenes/random_scene.h"

#include "tests/fuzz/scenes/parts.h"

namespace oriel::fuzz {
RandomScene random_scene(std::uint64_t seed, const std::set<std::string>& without, bool plain_space) {
  Random random(seed);
  RandomScene scene;
  if (random.chance(0.3f)) scene.scale = random.decades(1e-4, 1e4);
  DVec3 offset(0);
  if (random.chance(0.3f)) {
    const double far = random.decades(1, 1e6);
    offset = far * DVec3(random.in_box(Vec3(-1), Vec3(1)));
  }
  if (plain_space) scene.scale = 1, offset = DVec3(0);
  Glb glb;
  for (std::size_t i = 0; i < all_parts().size(); ++i) {
    const Part& part = all_parts()[i];
    Random own(seed, i + 1);
    if (!own.chance(part.chance) || without.contains(part.name)) continue;
    part.add(glb, own);
    scene.parts.emplace_back(part.name);
  }
  scene.sources = glb.sources();
  scene.area_m2 = scene.scale * scene.scale * glb.area();
  scene.glb = glb.finish(scene.scale, offset);
  return scene;
}

}  // namespace oriel::fuzz
