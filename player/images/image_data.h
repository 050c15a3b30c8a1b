// The pack's images as textures. Each can leave out its finest levels: `coarser` 1 has half the texels a side, 2 a
// quarter, and so on, down to 1 x 1.
#pragma once

#include <optional>
#include <span>

#include "formats/assets/light_group.h"
#include "formats/assets/lightmap.h"
#include "formats/assets/material.h"
#include "formats/pack/half_page.h"
#include "player/images/texture_data.h"

namespace oriel {

// With mipmaps.
TextureData normal_texture_data(const Texture& texture, int coarser = 0);
// The same. Where all materials that use it cut parts of it away or blend it, these parts take no share in the colours
// of coarser levels (cutout_mips).
TextureData color_texture_data(const Texture& texture, std::span<const Material> used_by, int coarser = 0);

// Half floats of irradiance without sharp light, over scale; scale puts the brightest texel in [16384, 32768), so that
// the relative error stays 2^-11 down to a billionth of it. 0: the page is black.
HalfPage half_page(const LightmapPage& page);
// Without mipmaps. A coarser page is means over texels, those without light apart: charts that lie beside each other
// bleed.
struct LightData {
  TextureData light;
  std::optional<TextureData> direction;  // of a directional lightmap
  // Of a page with finer cells, not of a coarser one: LightmapPage::cell as it is, and detail as the light is.
  std::optional<TextureData> cells, detail;
  // LightmapPage::sharp_at, however coarse the page: shaders find its texels by its own size.
  std::optional<TextureData> sharp_at;
  float scale = 0;
  float mean_lux = 0;  // luminance over what has light; 0: nothing has
};
LightData light_data(HalfPage page, int coarser = 0);

// The page where groups of lamps shine so many times as they were baked (formats/query/group_light.h).
HalfPage relit(const HalfPage& baked, const PageGroups& groups, std::span<const Vec3> factors);

// Light that is added to a page, lux; may be negative. Empty: none.
struct PageChange {
  std::vector<Vec3> light, detail;  // by texel, by point of its details
  bool empty() const { return light.empty(); }
};
using PageChanges = std::vector<PageChange>;  // by page; empty: none anywhere

// The page with it. Where it adds nothing the light stays to the bit; nowhere it is negative.
HalfPage changed(HalfPage page, const PageChange& change);
// All of the page's light as numbers.
PageChange light_of(const HalfPage& page);

// On the device, without the data: of a texture with mipmaps, of a page of light.
std::size_t mipmapped_bytes(const IVec2& size, int coarser);
// detail: points of its finer cells' image; sharp: it has LightmapPage::sharp_at.
std::size_t light_page_bytes(const IVec2& size, const IVec2& detail, bool directional, bool sharp, int coarser);

}  // namespace oriel
