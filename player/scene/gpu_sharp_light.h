// Sharp light as shaders/lib/sharp_light.glsl reads it.
#pragma once

#include <span>

#include "formats/assets/sharp_light.h"
#include "player/gpu/texture.h"

namespace oriel {

inline constexpr std::size_t kSharpColumns = 4096;  // of words, and of triangles by four texels each

struct GpuSharpLight {
  gpu::Texture2d words, triangles, lamps;  // none where there is no such light
  std::vector<std::size_t> profile_rows;   // of `triangles`, where they begin
  bool suns = false;                       // some lamps are

  static GpuSharpLight upload(const SharpLight& light);
  // factors: by light group, how many times its lamps shine as they were baked.
  void shine(const SharpLight& light, std::span<const Vec3> factors);
  explicit operator bool() const { return static_cast<bool>(words); }
};

}  // namespace oriel
