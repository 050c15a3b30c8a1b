// Precomputed radiance transfer: how the light around an object that moves becomes the light that leaves its vertices
// (Sloan et al. 2002, "Precomputed Radiance Transfer"; Barczak 2006, section 4.4).
#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "bake/jobs/context.h"
#include "bake/trace/accel.h"
#include "formats/core/archive.h"

namespace oriel {

struct TransferOptions {
  int bands = 5;                 // of spherical harmonics, 2 to 6: bands² coefficients
  int bounces = 2;               // of light between its own parts
  std::uint32_t samples = 1024;  // rays a vertex, and a quarter for each bounce; rounded down to a power of two, >= 16
  std::function<bool()> enough = {};  // once it is true, other vertices stay unshadowed, with a warning; may be empty
};
inline void fields(Archive& archive, TransferOptions& o) {
  archive(o.bands, o.bounces, o.samples);
}

// T with B = albedo · Σ T_i L_i: radiance that a diffuse vertex sends out under distant radiance Σ L_i Y_i. Unoccluded,
// T = 1/π ∫ max(n·ω, 0) Y_i(ω) dω. Axes: the object's scene space.
struct VertexTransfer {
  int bands = 0;
  int channels = 1;                 // 3 where light that the object reflects onto itself has a colour
  std::vector<float> coefficients;  // by vertex, channel, coefficient
  float standard_error = 0;         // of the coefficients, root mean square over vertices, relative to theirs

  std::size_t stride() const { return static_cast<std::size_t>(channels * bands * bands); }
  std::size_t vertices() const { return stride() > 0 ? coefficients.size() / stride() : 0; }
};

// One row a vertex of object.scene(), which holds nothing but the object. A ray that leaves through a triangle at its
// own vertex, or meets a one-sided surface from behind, is free: the mesh stands for a smooth surface there, so that
// convex objects have exactly the unshadowed transfer. Surfaces that light passes shade by their transmittance. Errors:
// kStopped; kUsage for options out of range.
Result<VertexTransfer> bake_transfer(const Accel& object, const TransferOptions& options, const Stage& stage);

// Vertices too far apart for what shades them: the share of the object's edges over which the transfer changes by more
// than `step` of its mean length, area-weighted. Light between such vertices is interpolated across a shadow's edge.
float coarse_share(const Scene& object, const VertexTransfer& transfer, float step = 0.35f);

}  // namespace oriel
