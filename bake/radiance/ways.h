// Which planar reflectors are drawn as mirrored geometry, and which have radiance maps: what a frame shows right by the
// cheapest way.
#pragma once

#include <span>
#include <vector>

#include "bake/radiance/reflectors.h"

namespace oriel {

// What chooses: the cost of frames, or the user.
enum class WaysWanted { kAuto, kGeometry, kMaps };

// What frames are drawn on.
enum class DrawnOn { kCpu, kGpu };

// The image of one reflector, milliseconds: measured on the target (docs/notes/reflections.md, "Geometry or maps").
struct WayCosts {
  double geometry_ms = 0, triangle_us = 0, geometry_pixel_us = 0;  // by image, triangle drawn and pixel
  double maps_ms = 0, maps_pixel_us = 0;
};
WayCosts way_costs(DrawnOn target);

// Of a screen of 720 x 486 pixels, 60 degrees high: pixels that a solid angle covers near its middle.
inline constexpr double kPixelsPerSteradian = 177'000;

// Of the triangles that a reflector shows to any eye, those in the frustum of a frame that shows it.
inline constexpr double kInFrustum = 0.5;

// Sets way and why of each reflector. triangles: by reflector those that its image may show; pixels: those of
// FoundReflector::shown_sr.
void choose_ways(WaysWanted wanted, DrawnOn target, std::span<const std::uint64_t> triangles,
                 std::span<FoundReflector> reflectors);

}  // namespace oriel
