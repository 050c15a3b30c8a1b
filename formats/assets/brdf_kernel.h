// K: how a glossy material spreads the reflected image (Bastos et al. 1999, section 8.2.1).
#pragma once

#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// The lobe seen at one incidence. Its directions are in stereographic coordinates of the mirror direction,
// u = 2 tan(γ/2) for the angle γ from it: x across the plane of incidence, y in it, growing towards the surface normal.
// They reach every direction, and are tangents where γ is small.
struct KernelSlice {
  float cos_theta = 1;
  float albedo = 1;            // of the whole lobe without Fresnel, [0, 1]
  float energy_kept = 1;       // share of the lobe inside the texture, [0, 1]
  float tilt_rad = 0;          // elevation of the lobe's mean direction over the mirror direction
  float shift = 0;             // median of the lobe's y; that of x is 0
  Vec2 width{0};               // half of the lobe lies within shift ± width, for x and for y; > 0
  Vec2 lower{0}, upper{0};     // of the texture, in s: u = (0, shift) + width sinh(s), fine where the lobe is high
  float radial_extent = 0;     // stereographic radius around the mirror direction that holds the energy kept
  std::vector<float> radial;   // entry i of n: share of the lobe within the radius (i / (n-1))² radial_extent; rising
  std::vector<float> weights;  // slice_size², sum 1, the same left and right; even in s
};

// Mirror coordinates of a point of the texture, [0, 1]².
inline DVec2 slice_point(const KernelSlice& slice, const DVec2& at) {
  const DVec2 s = DVec2(slice.lower) + at * DVec2(slice.upper - slice.lower);
  return DVec2(0, slice.shift) + DVec2(slice.width) * DVec2(std::sinh(s.x), std::sinh(s.y));
}

// The lobe at one incidence as a linearly transformed cosine (Heitz, Dupuy, Hill, Neubelt 2016), by which polygons of
// light reflect in closed form. Surface frame: z the normal, x the projection of the direction towards the eye on the
// surface, y = z × x. The inverse matrix, by rows: (m11, 0, m13), (0, m22, 0), (m31, 0, 1).
struct LobeFit {
  float m11 = 1, m13 = 0, m22 = 1, m31 = 0;
  float amplitude = 1;  // integral of the lobe times cosine without Fresnel, [0, 1]
};

// K of a material: the lobe D G2 / (4 cosθo) of GGX facets, G2 height-correlated Smith, which is the BRDF times cosθi
// without Fresnel's factor. `weights` is a square kernel over the tangent plane of the mirror direction, centred on it,
// sampled at one incidence, for programs without use for slices; pixel (x, y) is the direction (tx, ty, 1) with t =
// ((i + ½) / size * 2 - 1) * half_extent, that is t = tan of the angle from the mirror direction. Sum of weights 1.
// size 1 is the mirror. `slices` is the lobe as it turns from there and stretches with incidence.
struct BrdfKernel {
  float alpha = 0;                  // microfacet width, roughness²
  float cos_theta = 1;              // incidence it was sampled at
  float half_extent = 0;            // tangent of the half angle it covers
  float energy_kept = 1;            // share of the whole lobe inside it before normalising
  std::uint32_t size = 1;           // odd
  std::vector<float> weights;       // size * size
  std::uint32_t slice_size = 0;     // odd where there are slices
  std::vector<KernelSlice> slices;  // by rising cosθ; empty for a mirror
  std::vector<LobeFit> fits;        // one a slice, or none
};

}  // namespace oriel
