#include "preview/frame/scene_parts.h"

#include "bake/scene/shade.h"
#include "bake/trace/planar_mirrors.h"
#include "formats/core/archive.h"

namespace oriel {

SceneParts parts_of(const Scene& scene) {
  SceneParts parts;
  std::vector<std::uint32_t> surfaces;  // in their order
  for (const Surface& s : scene.surfaces) {
    const SceneMaterial& m = scene.materials[s.material];
    for (const std::uint32_t value : {s.first_triangle, s.triangle_count, may_transmit(m) ? 1u : 0u, m.solid ? 1u : 0u})
      surfaces.push_back(value);
  }
  std::vector<char> frosted;
  if (!scene.lights.empty()) frosted = PlanarMirrors::frosted_panes(scene).triangles_of(scene);
  parts.shape = hash_of(scene.lower, scene.upper, scene.positions, scene.triangles, scene.twin, surfaces, frosted);
  parts.vertices = hash_of(parts.shape, scene.normals, scene.uv0, scene.uv1, scene.colors, scene.tangents);
  Hasher images, sky;
  Archive to_images(images), to_sky(sky);
  for (const Image& image : scene.images) to_images(image.width, image.height, image.texels);
  to_sky(scene.sky_image.width, scene.sky_image.height, scene.sky_image.texels);
  parts.images = images.result();
  parts.sky = sky.result();
  return parts;
}

}  // namespace oriel
