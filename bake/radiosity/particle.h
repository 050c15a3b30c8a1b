// Transport of one particle, for the energy balance.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/trace/emission.h"
#include "bake/trace/path.h"

namespace oriel {

// The light of a particle by its fate, luminance, lm.
struct Fate {
  double emitted = 0;      // of distant light: the part that hits a surface
  double absorbed = 0;     // at reflecting surfaces: incident less reflected
  double escaped = 0;      // left the scene
  double lost_behind = 0;  // at the back of a one-sided surface
  double lost_guard = 0;   // by PathOptions::max_bounces, or in a stack of glass
  double on_texels = 0;    // incident on fronts of evaluated texels, times absorptance()
};

// Texels whose light the lightmap evaluates as a whole. Of others it has the visible part only, without what is inside
// other bodies, behind a wall on the texel, or in a gap, where a lamp may light a ceiling at a centimetre.
struct EvaluatedTexels {
  const Atlas& atlas;
  std::span<const TexelMapPage> map;
  WantedTexels evaluated;

  bool contains(std::uint32_t triangle, const Vec2& barycentric) const;
};

// Absorptance of a surface under uniform hemispherical illumination, [0,1]: light neither reflected nor transmitted.
Vec3 absorptance(const ShadePoint& point);

// Traces a particle until it is absorbed or lost. Scattering is the adjoint of trace_path's: light from wi that leaves
// towards wo is weighted as a path from wo would be. The two differ at shading normals and under glossy layers (Veach
// 1996, "Non-symmetric Scattering in Light Transport Algorithms"). Adds to `rays`.
Fate follow(const Transport& transport, const EvaluatedTexels& texels, const Particle& particle, Sampler& sampler,
            std::uint64_t& rays);

}  // namespace oriel
