// A scene taken as far as its texels, for tests of what is done with them.
#pragma once

#include "bake/radiosity/texels/extra_sample_points.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel::test {

struct Listed {
  Scene scene;
  Context context;
  Atlas atlas;
  std::vector<TexelMapPage> map;
  std::optional<Accel> accel;
  std::optional<LightSet> lights;
  Texels texels;
  std::vector<std::uint32_t> floor;  // texels of the scene's first surface

  Listed(Scene built, float texel_m, std::uint64_t seed = 1, const AtlasOptions& charts = {})
      : scene(std::move(built)) {
    context.seed = seed;
    AtlasOptions options = charts;
    options.texel_m = texel_m;
    atlas = *build_atlas(scene, options, context);
    map = *build_texel_map(atlas, context);
    accel.emplace(*Accel::build(scene));
    lights.emplace(scene);
    texels = *list_texels({transport(), atlas, map}, context);
    for (std::uint32_t i = 0; i < texels.count(); ++i) {
      const TexelMapPage& page = map[texels.page[i]];
      if (scene.triangle_surface[page.fragments[page.first[texels.index[i]]].triangle] == 0) floor.push_back(i);
    }
  }
  Transport transport() const { return {*accel, *lights, {}}; }
  ExtraSamplePoints sample_points(const Transport& t) const { return {{t, atlas, map}, texels, context.seed}; }
};

}  // namespace oriel::test
