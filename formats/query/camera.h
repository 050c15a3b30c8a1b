// Headings of cameras, and rays through their pixels. A Camera is all that the player knows of where it looks from; its
// matrices are player/navigation/view.h. Pack space: metres, relative to Mesh::origin.
#pragma once

#include "formats/assets/camera.h"
#include "formats/core/vec.h"

namespace oriel {

// A camera from eye to target, upright; along ±y it has -z (or +z) at the top. The two points differ.
Camera look_at(const Vec3& eye, const Vec3& target, float vertical_fov_rad);

// From outside, a little above (or below), with all of the bounds in a picture 60° high: one-sided walls are not seen
// from behind, so that rooms open. turn_rad: how far the eye is turned around them, counter-clockwise from above; at 0
// it stands towards +z and, less, +x.
Camera overview(const Vec3& lower, const Vec3& upper, float turn_rad, bool from_above = true);

// Heading: 0 looks along -z, π/2 along -x (counter-clockwise from above). Of a vertical camera, the heading of its up
// vector's side. Pitch: [-π/2, π/2], positive upwards.
float yaw_of(const Camera& camera);
float pitch_of(const Camera& camera);
Vec3 forward_from(float yaw_rad, float pitch_rad);

// Orthonormal: columns right, up, back, for any camera whose forward has a direction.
Mat3 pack_from_eye_axes(const Camera& camera);

struct PixelRay {
  Vec3 origin{0};
  Vec3 direction{0, 0, -1};  // unit
};
// Through the point (x, y) of an image of width × height pixels; x to the right, y downwards from the top; (0.5, 0.5)
// is the centre of the first pixel.
PixelRay pixel_ray(const Camera& camera, float x, float y, float width, float height);

}  // namespace oriel
