// Images of lamps that shine otherwise than they were baked.
#include "player/images/scene_images.h"

namespace oriel {
void SceneImages::settle_light(std::uint32_t index, PreparedImage& image, std::vector<TextureUpload>& textures) {
  LoadedLightmap& light = lights_[index];
  std::size_t next = 0;
  const auto take = [&](bool there) { return there ? std::move(textures[next++].texture) : gpu::Texture2d(); };
  light.texture = take(true), light.scale = image.scale;
  light.direction = take(image.directional);
  light.cells = take(image.detailed), light.detail = take(image.detailed);
  light.sharp_at = take(image.sharp);
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

// The same maps with other light where that alone came.
void SceneImages::settle_maps(Upload& upload) {
  ReflectorMaps& maps = maps_[items_[upload.item].name.index];
  PreparedImage& image = upload.image;
  maps.mean_radiance = image.mean_radiance;
  const std::size_t each = upload.light_alone ? 1 : 2;
  maps.elements.resize(image.map_scales.size());
  for (std::size_t e = 0; e < maps.elements.size(); ++e) {
    MapArray& element = maps.elements[e];
    element.light = std::move(upload.textures[each * e].array);
    element.scale = std::move(image.map_scales[e]), element.sizes = std::move(image.map_sizes[e]);
    if (!upload.light_alone) element.disparity = std::move(upload.textures[each * e + 1].array);
  }
}

void SceneImages::settle_surround(Upload& upload) {
  SurroundTextures& map = surrounds_[items_[upload.item].name.index];
  gpu::Texture2d distances =
      upload.light_alone ? std::move(map.inverse_distance) : std::move(upload.textures[1].texture);
  map = std::move(upload.image.surround);
  map.light = std::move(upload.textures[0].texture);
  map.inverse_distance = std::move(distances);
}

Status SceneImages::set_lights(std::span<const Vec3> factors, MapFactors of_maps,
                               std::shared_ptr<const PageChanges> added) {
  source_.set_lights(factors, std::move(of_maps), std::move(added));
  for (std::uint32_t i = 0; i < lights_.size(); ++i)
    if (has({ImageKind::kLight, i})) ORIEL_TRY_VOID(show_lights(i));
  // Those that nobody has asked for since are not waited for.
  for (Item& item : items_) item.asked_for = item.asked_for && options_.background;
  return {};
}

}  // namespace oriel
