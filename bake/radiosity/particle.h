// Where the light of one particle goes.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/trace/emission.h"
#include "bake/trace/path.h"

namespace oriel {

// lm, luminance.
struct Fate {
  double emitted = 0;      // of light from afar: what meets a surface
  double absorbed = 0;     // by surfaces that reflect: what came less what left
  double escaped = 0;      // left the scene
  double lost_behind = 0;  // met the back of a one-sided surface
  double lost_guard = 0;   // was still on its way after PathOptions::max_bounces, or passed a stack of glass
  double on_texels = 0;    // what came to fronts with told texels, times share_kept() there
};

// Texels whose light the lightmap tells as a whole. Of others it knows the part that somebody sees: not what is inside
// other bodies, behind a wall that stands on them, or in a gap, where a lamp may shine on a ceiling at a centimetre.
struct ToldTexels {
  const Atlas& atlas;
  std::span<const TexelMapPage> map;
  WantedTexels told;

  bool hold(std::uint32_t triangle, const Vec2& barycentric) const;
};

// What a surface keeps of light that comes evenly from all sides, [0,1]: neither reflected nor let through.
Vec3 share_kept(const ShadePoint& point);

// Follows a particle until it is absorbed, or lost. Reflection is that of the paths that look for light
// (trace_path), the other way round: what came from wi and left towards wo is weighted as an eye at wo sees it, which
// matters where that is not symmetric, at shading normals and under glossy layers (Veach 1996, "Non-symmetric
// Scattering in Light Transport Algorithms"). Adds to `rays`.
Fate follow(const Transport& transport, const ToldTexels& texels, const Particle& particle, Sampler& sampler,
            std::uint64_t& rays);

}  // namespace oriel
