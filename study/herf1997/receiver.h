// The planar receiver of a shadow texture: a parallelogram cut into texels, and the space in which light samples see
// it.
#pragma once

#include "formats/core/vec.h"

namespace oriel::study {

// Texel (i, j) has its centre at corner + (i + ½) x + (j + ½) y. World space, metres.
struct ShadowReceiver {
  DVec3 corner{0};
  DVec3 x{1, 0, 0}, y{0, 1, 0};  // one texel along a row, and from a row to the next; neither need be orthogonal
  DVec3 normal{0, 0, 1};         // unit; light and occluders count on its side only
  int width = 0, height = 0;     // texels

  DVec3 center_of(int i, int j) const { return corner + (i + 0.5) * x + (j + 0.5) * y; }
};

// A parallelogram of two edges, with its front on the side of `facing`.
ShadowReceiver make_shadow_receiver(const DVec3& corner, const DVec3& edge_x, const DVec3& edge_y, const IVec2& texels,
                                    const DVec3& facing);

// The same space for all apexes: texels along x and y, and the distance from the plane in metres, positive in front.
// From an apex (a.x, a.y, a.z) a point p is seen at (p.xy a.z − a.xy p.z) / (a.z − p.z), two products
// instead of a matrix's sixteen.
struct ReceiverSpace {
  explicit ReceiverSpace(const ShadowReceiver& receiver);
  DVec3 operator()(const DVec3& world) const { return linear * (world - corner); }

  DVec3 corner;
  DMat3 linear;
};

// Where an apex sees a point that is nearer to the plane than the apex, texels.
inline DVec2 seen_at(const DVec3& apex, const DVec3& p) {
  return (DVec2(p) * apex.z - DVec2(apex) * p.z) / (apex.z - p.z);
}

}  // namespace oriel::study
