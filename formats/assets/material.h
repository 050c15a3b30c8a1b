// Materials and their base colour textures, as the player needs them.
#pragma once

#include <string>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

enum class AlphaMode : std::uint8_t { kOpaque = 0, kMask = 1, kBlend = 2 };
enum class Wrap : std::uint8_t { kRepeat = 0, kClamp = 1, kMirror = 2 };

// RGBA, 8 bits a channel, rows from the top. Colours are sRGB-encoded with a linear alpha; normal maps are linear.
struct Texture {
  std::string name;
  std::uint32_t width = 0, height = 0;
  Wrap wrap_s = Wrap::kRepeat, wrap_t = Wrap::kRepeat;
  bool nearest = false;              // magnification filter: nearest instead of linear
  std::vector<std::uint8_t> texels;  // 4 * width * height
};

struct Material {
  std::string name;
  Vec3 base_color{1};                    // linear, [0,1]; multiplies the texture and the vertex colour
  float alpha = 1;                       // [0,1], multiplies the texture's and the vertex colour's alpha
  std::int32_t base_color_texture = -1;  // into Pack::textures
  AlphaMode alpha_mode = AlphaMode::kOpaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  bool unlit = false;                 // shown as base colour, takes no part in light transport
  float metallic = 0, roughness = 1;  // [0,1]; averages over the material's texture where it has one
  float ior = 1.5f;                   // of the dielectric part
  Vec3 f0{0.04f};          // reflectance at normal incidence: metals' colour, dielectrics' from ior and specular
  float transmission = 0;  // [0,1], thin
  Vec3 emission{0};  // cd/m², the average over its texture where it has one; of an unlit one its white in mirrors
  std::int32_t kernel = -1;          // into Pack::kernels: K, for reflective materials
  std::int32_t fresnel_map = -1;     // into Pack::fresnel_maps: R
  std::int32_t normal_texture = -1;  // into Pack::normal_textures
  float normal_scale = 1;            // of the map's x and y, within ±1e6
};

// What a material's surfaces enclose: glass that light refracts at and is absorbed in (KHR_materials_volume). They are
// closed and face outwards. Without it transmission is thin and straight.
struct SolidGlass {
  std::uint32_t material = 0;  // into Pack::materials, whose index of refraction it has
  Vec3 tint{1};                // [0,1]: what one surface leaves of light; multiplies the base colour's texture
  Vec3 absorption{0};          // 1/m, >= 0: Beer and Lambert's law
};

// cd/m² that a white texel of an unlit material shows.
inline Vec3 unlit_white(const Material& m) {
  return m.emission == Vec3(0) ? Vec3(1) : m.emission;
}

// The picture that a material shines with: a screen, a light box. Its radiance is emission · texel / mean, texels
// linear.
struct EmissionTexture {
  std::uint32_t material = 0;  // into Pack::materials
  std::uint32_t texture = 0;   // into Pack::textures, by the same coordinates as the base colour's
  Vec3 mean{1};                // of its texels over the material's surfaces, >= 0; 0 where it does not shine
};

// A material whose reflectance at normal incidence differs from place to place: that of a metal, which is the base
// colour, or `dielectric`.
struct Metalness {
  std::uint32_t material = 0;  // into Pack::materials, whose metallic and f0 are the averages
  std::int32_t texture = -1;   // into Pack::textures, by the base colour's coordinates: alpha is how much is metal.
                               // -1: all as much as Material::metallic
  Vec3 dielectric{0.04f};      // [0,1]
};

}  // namespace oriel
