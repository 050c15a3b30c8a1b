// The pack's images on the GPU.
#pragma once

#include <span>

#include "formats/pack/pack.h"
#include "player/gpu/texture.h"
#include "player/scene/kernel_taps.h"

namespace oriel {

// With mipmaps.
gpu::Texture upload_normal_texture(const Texture& texture);
// The same. Where all materials that use it cut parts of it away or blend it, these parts take no share in the colours
// of coarser levels (cutout_mips).
gpu::Texture upload_color_texture(const Texture& texture, std::span<const Material> used_by);

// Half floats of irradiance / scale; scale is a power of two that puts the brightest texel in [16384, 32768), so that
// the relative error stays 2^-11 down to a billionth of it. 0: the page is black.
struct LightmapTexture {
  gpu::Texture texture;
  float scale = 0;
  gpu::Texture direction;  // of a directional lightmap, else empty
};
LightmapTexture upload_lightmap(const LightmapPage& page);

// Float RGBA: radiance, and disparity, which is -1 where the pixel saw nothing usable.
gpu::Texture upload_radiance_map(const RadianceMap& map);

// One row a map, as wide as the longest table; not filtered.
gpu::Texture upload_reflectance_tables(const std::vector<FresnelMap>& maps);
// A row an incidence, a texel a tap: mirror coordinates, width, weight. Not filtered.
gpu::Texture upload_kernel_taps(const KernelTaps& taps);
// Row 0: the kernel's fits in the frame of the mirror direction (formats/lobes); texel i of n is at cosθ = (i /
// (n-1))². Row 1: F where the half vector is at that cosine, and its mean over the lobe at that incidence, given by
// rows as KernelTaps'.
gpu::Texture upload_lobe_fits(const BrdfKernel& kernel, const FresnelMap& fresnel, std::span<const float> mean_factors);
gpu::Texture upload_sphere_map(const FresnelMap& map);

}  // namespace oriel
