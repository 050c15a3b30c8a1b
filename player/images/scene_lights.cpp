// Images of lamps that shine otherwise than they were baked.
#include "player/images/scene_images.h"

namespace oriel {
void SceneImages::settle_light(std::uint32_t index, PreparedImage& image, std::vector<TextureUpload>& textures) {
  LoadedLightmap& light = lights_[index];
  light = {std::move(textures[0].texture), image.scale, {}, {}, {}};
  if (image.directional) light.direction = std::move(textures[1].texture);
  if (textures.size() > 2) {
    light.cells = std::move(textures[textures.size() - 2].texture);
    light.detail = std::move(textures[textures.size() - 1].texture);
  }
  if (image.mean_lux > 0) {
    lux_sum_ += static_cast<double>(image.mean_lux);
    some_light_.scale = static_cast<float>(lux_sum_ / static_cast<double>(++lux_count_));
  }
  // Lamps were switched while it came.
  if (image.lights != source_.lights()) (void)show_lights(index);
}

// A page that is there, as lamps shine now.
Status SceneImages::show_lights(std::uint32_t index) {
  const ImageName name{ImageKind::kLight, index};
  ORIEL_TRY(PreparedImage image, source_.prepare(name, at(name).level));
  std::vector<TextureUpload> textures;
  for (TextureData& data : image.textures) {
    textures.emplace_back(std::move(data));
    while (!textures.back().step(~std::size_t{0})) {
    }
  }
  image.mean_lux = 0;
  settle_light(index, image, textures);
  return {};
}

Status SceneImages::set_lights(std::span<const Vec3> factors, MapFactors of_maps,
                               std::shared_ptr<const PageChanges> added) {
  source_.set_lights(factors, std::move(added));
  map_factors_ = std::move(of_maps);
  for (std::uint32_t i = 0; i < lights_.size(); ++i)
    if (has({ImageKind::kLight, i})) ORIEL_TRY_VOID(show_lights(i));
  for (std::uint32_t i = 0; i < maps_.size(); ++i) tint_maps(i);
  for (std::uint32_t i = 0; i < surrounds_.size(); ++i) tint_surround(i);
  return {};
}

void SceneImages::tint_maps(std::uint32_t reflector) {
  if (reflector >= map_factors_.reflectors.size()) return;
  ReflectorMaps& maps = maps_[reflector];
  const Vec3 factor = map_factors_.reflectors[reflector];
  maps.means.radiance = factor * maps.baked_radiance;
  for (MapArray& element : maps.elements) element.tint = factor;
}

void SceneImages::tint_surround(std::uint32_t index) {
  if (index < map_factors_.surrounds.size()) surrounds_[index].tint = map_factors_.surrounds[index];
}

}  // namespace oriel
