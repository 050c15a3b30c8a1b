// Glossy lobes as linearly transformed cosines, whose integrals over polygons of light are closed forms (Heitz, Dupuy,
// Hill and Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines"). All in the surface
// frame of LobeFit.
#pragma once

#include "formats/assets/brdf_kernel.h"

namespace oriel {

// The lobe per steradian in the unit direction w over its amplitude: its integral over the sphere is 1.
double lobe_density(const LobeFit& fit, const DVec3& w);

// The inverse matrix (m11, m13, m22, m31, over m33) in the frame of the mirror direction of an eye at cos_theta: z
// along it, y as in the surface frame. It hardly changes with incidence, so that it can be interpolated; as they stand,
// the matrices of two incidences would turn a lobe between them away from the mirror direction.
Vec4 in_mirror_frame(const LobeFit& fit, float cos_theta);
// Between two such matrices.
Vec4 mix_lobes(const Vec4& a, const Vec4& b, float share);
// Back to the surface frame.
LobeFit in_surface_frame(const Vec4& matrix, float cos_theta, float amplitude);

}  // namespace oriel
