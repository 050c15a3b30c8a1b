#include "player/scene/image_uses.h"

namespace oriel {

void add_uses(const Pack& pack, std::span<const DrawRange> ranges, const std::function<Bounds(const Bounds&)>& placed,
              std::vector<ImageUse>& uses) {
  const auto add = [&](ImageKind kind, std::int32_t index, const DrawRange& range) {
    if (index >= 0) uses.push_back({{kind, static_cast<std::uint32_t>(index)}, placed(range.bounds), range.group});
  };
  for (const DrawRange& range : ranges) {
    const Material& m = pack.materials[range.material];
    add(ImageKind::kColor, m.base_color_texture, range);
    add(ImageKind::kNormal, m.normal_texture, range);
    if (const EmissionTexture* e = of_material(pack.emission_textures, range.material))
      add(ImageKind::kColor, static_cast<std::int32_t>(e->texture), range);
    if (const Metalness* metal = of_material(pack.metalness, range.material))
      add(ImageKind::kColor, metal->texture, range);
    add(ImageKind::kLight, range.lightmap_page, range);
  }
}

}  // namespace oriel
