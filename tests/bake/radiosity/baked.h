// A scene taken through sides, atlas, texel map and radiosity, as a bake runs.
#pragma once

#include "bake/radiosity/lit_sides.h"
#include "bake/radiosity/radiosity.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel::test {

struct Baked {
  Scene scene;
  Atlas atlas;
  std::vector<TexelMapPage> texel_map;
  SidesReport sides;
  Radiosity radiosity;

  // Calls visit(page, texel, triangle) for every valid texel.
  template <class Visit>
  void each_texel(const Visit& visit) const {
    for (std::size_t p = 0; p < texel_map.size(); ++p)
      for (std::size_t i = 0; i < texel_map[p].texel.size(); ++i) {
        const std::uint32_t t = texel_map[p].texel[i];
        if (radiosity.pages[p].state[t] == TexelState::kValid)
          visit(radiosity.pages[p], t, texel_map[p].fragments[texel_map[p].first[i]].triangle);
      }
  }
};

// The estimator as bakes have it by default, to that error and no more: nothing verifies it.
inline RadiosityOptions cached_options(double error) {
  RadiosityOptions options;
  options.estimator = Estimator::kCached;
  options.samples = 4096;
  options.error = error;
  options.fit_texels = true;
  options.detail = kMostCellSide;
  options.verify = 0;
  return options;
}

inline Baked bake(Scene scene, float texel_m, const RadiosityOptions& options, int threads = 0,
                  std::uint64_t seed = 1) {
  Baked b;
  b.scene = std::move(scene);
  Context context;
  context.threads = threads;
  context.seed = seed;
  {
    const Accel accel = *Accel::build(b.scene);
    const LightSet lights(b.scene);
    const FoundSides found = *find_lit_sides({accel, lights, {}}, {}, context);
    b.sides = found.report;
    if (found.change_scene()) b.scene = split_sides(std::move(b.scene), found.sides);
  }
  AtlasOptions atlas;
  atlas.texel_m = texel_m;
  b.atlas = *build_atlas(b.scene, atlas, context);
  b.texel_map = *build_texel_map(b.atlas, context);
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  PathOptions paths;
  if (options.bounces > 0) paths.max_bounces = options.bounces;
  b.radiosity = *bake_radiosity({{accel, lights, paths}, b.atlas, b.texel_map}, options, context);
  return b;
}

}  // namespace oriel::test
