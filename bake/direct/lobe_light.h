// Polygons of light in glossy lobes, in closed form: linearly transformed cosines (Heitz, Dupuy, Hill and Neubelt 2016,
// "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines"). All in the surface frame of LobeFit.
#pragma once

#include <span>

#include "formats/assets/brdf_kernel.h"

namespace oriel {

// The lobe per steradian in the unit direction w over its amplitude: its integral over the sphere is 1.
double lobe_density(const LobeFit& fit, const DVec3& w);

// The integral of the lobe over the part of a polygon above the surface: what it reflects of a radiance of 1, without
// Fresnel, [0, fit.amplitude] up to rounding. corners: 3 or 4, convex, relative to the point; counter-clockwise as seen
// from it: positive, else negative.
float reflected_polygon(const LobeFit& fit, std::span<const Vec3> corners);

}  // namespace oriel
