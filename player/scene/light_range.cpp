// Whether half floats hold a scene's light.
#include <algorithm>

#include "player/scene/gpu_scene.h"

namespace oriel {
namespace {

constexpr float kMostInHalves = 0.75f * 65504;  // cd/m²; the rest is for what a surface mirrors beside its own light
constexpr float kOfScale = 0x1p15f;             // that an image's light is below (image_data.h)

}  // namespace

bool GpuScene::fits_halves() const {
  constexpr float kLeastRadius = 0.1f;  // m: a near plane of a smaller scene is nearer than 1 / distance can say
  if (!(0.5f * glm::length(bounds_.upper - bounds_.lower) >= kLeastRadius)) return false;
  float most = max_component(pack_.sky);
  for (std::uint32_t m = 0; m < pack_.materials.size(); ++m)
    most = std::max(most, max_component(brightest_emission(m)));
  for (std::uint32_t i = 0; i < pack_.lightmaps.size(); ++i)
    most = std::max(most, images_->light(i).scale * kOfScale / kPi);
  for (std::size_t e = 0; e < pack_.emitters.size(); ++e)  // glints: suns, points and spots
    if (emitters_[e].empty()) most = std::max(most, max_component(pack_.emitters[e].radiance));
  return most <= kMostInHalves;
}

bool GpuScene::fit_halves(const GpuReflector& reflector) const {
  float most = 0;
  for (const MapArray& array : images_->maps(reflector.index).elements)
    for (const float scale : array.scale) most = std::max(most, scale * kOfScale);
  return most <= kMostInHalves;
}

}  // namespace oriel
