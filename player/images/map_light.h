// Radiance and surround maps under lamps that shine otherwise than they were baked, pixel by pixel: each shows a place
// of the lightmap, and changes as the light there does.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "formats/assets/lightmap.h"
#include "formats/pack/pack.h"
#include "formats/query/seen_places.h"
#include "player/images/moved_lamp.h"

namespace oriel {

// How many times what was baked the light is that maps show without the lightmap's telling: by material that shines,
// its emission; the sky; and on average all that each reflector and each surround map shows; sharp light, which pages
// do not show either. Empty: as baked.
struct MapFactors {
  std::vector<std::optional<Vec3>> materials;
  Vec3 sky{1};
  std::vector<Vec3> reflectors, surrounds;
  std::vector<Vec3> sharp;  // by light group, of SharpLight::lamps; 0: what they give is in pages' changes
  std::vector<std::shared_ptr<const MovedLamp>> moved;
  std::uint64_t geometry = 0;  // another one where lamps are elsewhere; 0: where they were baked
};

// Of all pages; no more than their light and finer cells. Those that cannot be read have no texels.
struct MapLights {
  std::shared_ptr<const std::vector<LightmapPage>> baked;
  std::vector<LightmapPage> now;
  MapFactors factors;
  std::vector<Vec3> reflectance;  // by material, without textures
};

// The radiance now of a pixel that shows that place, cd/m²; mean: the map's factor. What a surface sends out over the
// light on it stays, up to what white does, or the colour of a material that shines: so the light of diffuse surfaces
// is exact, with textures as the map has them. What is beyond that was emitted, or mirrored by a lobe: it changes as
// the material's lamps, or as the mean. Where hardly any light was, the material's colour says what is reflected.
Vec3 light_now(const Vec3& baked, const SeenPlace& place, const MapLights& lights, const Vec3& mean);

class MapLight {
 public:
  // Refers to the pack's mesh and reflectors; of its materials, as they were baked, what is wanted is copied.
  explicit MapLight(const Pack& pack);

  // Give the map, Pack::radiance_maps[index] and so on, the light of lamps as they shine now; surround maps show one
  // that has moved where it is, and where it was what is behind. What pixels show is found the first time and kept.
  // From any thread.
  void shine(const MapLights& lights, std::uint32_t index, RadianceMap& map);
  void shine(const MapLights& lights, std::uint32_t index, SurroundMap& map);
  // What the map's pixels show is not wanted any more.
  void forget_map(std::uint32_t index);
  void forget_surround(std::uint32_t index);
  const std::vector<Vec3>& reflectance() const { return reflectance_; }  // as MapLights has it

 private:
  using Pixels = std::shared_ptr<const SeenPixels>;
  template <class Find>
  Pixels pixels(std::map<std::uint32_t, Pixels>& of, std::uint32_t index, const Find& find);
  const SeenPlaces& finder();

  const Pack& pack_;
  std::vector<Material> materials_;
  std::vector<Vec3> reflectance_;
  std::mutex mutex_;
  std::once_flag made_;
  std::unique_ptr<const SeenPlaces> finder_;
  std::map<std::uint32_t, Pixels> maps_, surrounds_;
};

}  // namespace oriel
