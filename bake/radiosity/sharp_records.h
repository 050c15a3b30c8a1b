// What reaches texels of sharp light, and how SharpLight::words hold it.
#pragma once

#include <map>
#include <memory>
#include <unordered_map>

#include "bake/radiosity/screen_fit.h"
#include "bake/radiosity/shadow_casters.h"
#include "formats/assets/sharp_light.h"

namespace oriel {

// What reaches a square, before it is encoded: a leaf's words, without numbers of triangles in SharpLight, or quarters.
struct LampShine {
  std::uint32_t lamp = 0;
  Vec3 tint{1};
  std::vector<std::uint32_t> casters;  // of the scene, with the bits of their edges beside
  std::vector<std::uint8_t> edges;
  std::vector<Screen> screens;  // stand for all that is in the way
};
struct SharpRecord {
  std::vector<LampShine> shines;
  std::array<std::unique_ptr<SharpRecord>, 4> quarters;
  bool is_split() const { return quarters[0] != nullptr; }
  std::size_t words() const;  // without its quarters'
};

// Those lights of the scene, and their profiles.
void add_lamps(const Scene& scene, std::span<const std::uint32_t> lights, SharpLight& out);

// Numbers triangles as they come, and keeps records that are equal once.
class SharpWriter {
 public:
  SharpWriter(const ShadowCasters& casters, SharpLight& light);

  std::uint32_t place_of(const SharpRecord& record);

 private:
  void add(const LampShine& shine, std::vector<std::uint32_t>& words);
  std::uint32_t number_of(std::uint32_t caster);

  const ShadowCasters& casters_;
  SharpLight& light_;
  std::map<std::vector<std::uint32_t>, std::uint32_t> places_;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
};

}  // namespace oriel
