#include "bake/run/unlit.h"

#include <algorithm>

#include "bake/radiosity/texels/frame_pixels.h"
#include "formats/image/display.h"

namespace oriel {

Result<float> unlit_white(const BakeTask& bake, const PathOptions& paths, std::span<const Vec3> eyes) {
  constexpr std::uint32_t kDirections = 64;
  constexpr std::uint64_t kSalt = 0x0171e5;
  const Scene& scene = bake.scene();
  const auto is_unlit = [&](const Surface& surface) { return scene.materials[surface.material].unlit; };
  if (std::none_of(scene.surfaces.begin(), scene.surfaces.end(), is_unlit)) return 1.0f;
  const Transport transport{bake.accel(), bake.lights, paths};
  ORIEL_TRY(const std::vector<FramePixel> pixels, find_frame_pixels(transport, bake.prepared.atlas, {eyes, kDirections},
                                                                    bake.context.seed ^ kSalt, bake.context));
  FloatImage seen{static_cast<std::uint32_t>(pixels.size()), 1, 3, {}};
  for (const FramePixel& p : pixels) {
    const Vec3 normal = geometric_normal(scene, p.triangle);
    const Vec3 e = baked_irradiance(bake.prepared.atlas, bake.lightmaps, {p.triangle, p.barycentric}, normal, normal);
    const Vec3 light = p.transfer * e + p.emitted;
    seen.pixels.insert(seen.pixels.end(), {light.r, light.g, light.b});
  }
  return white_of(seen);
}

}  // namespace oriel
