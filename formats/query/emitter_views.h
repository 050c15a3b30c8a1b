// From where on planar reflectors a lamp is seen that has moved, and which of them show it in closed form: what the
// baker finds of lamps where they were (bake/radiance/emitters.h).
#pragma once

#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "formats/assets/brdf_kernel.h"
#include "formats/assets/emitter.h"
#include "formats/query/live_lights.h"
#include "formats/query/reflector_nodes.h"

namespace oriel {

// The side of the polygon that shines is where this points; not unit: the area of a parallelogram.
inline Vec3 front_of(const Emitter& polygon) {
  return glm::cross(polygon.corners[1] - polygon.corners[0], polygon.corners[2] - polygon.corners[0]);
}
// Even over a triangle or quadrangle. u: in [0, 1)².
Vec3 point_of(const Emitter& polygon, Vec2 u);

// A closed form times the share of a lamp that a point sees errs where lobes see another share. That share of the
// lamp's light may: of a reflector with maps, and of one whose image is as fine as the screen, which shows what is
// hidden.
inline constexpr double kMostParted = 0.25, kMostPartedOfGeometry = 0.02;
// What it errs by on average, over the lamp's light. seen: the share that a point sees of a lamp of that solid angle,
// in steradians. A lobe that the lamp fills sees all or nothing of it: with the share as its mean that is
// 2 seen (1 - seen). A lobe that holds the lamp averages over it as the share does.
double parted(double seen, double lamp_sr, double alpha);

// The share of the lamp's polygons that a reflector's nodes see; as Reflector::visibility, in this order.
struct EmitterView {
  std::uint32_t reflector = 0;           // into the given ones
  std::uint32_t x = 2, y = 2;            // nodes: as many as its own where it has some
  std::vector<std::uint32_t> polygons;   // which of the lamp's, ascending
  std::vector<std::uint8_t> visibility;  // share * 255
};

// What is asked: all outlive the answer.
struct EmitterQuestion {
  std::span<const Reflector> reflectors;
  std::span<const float> alphas;      // of each reflector's lobe; 0: a mirror, whose image has what has a surface
  std::span<const Emitter> lamp;      // where it is now, pack space
  std::span<const std::int64_t> of;   // by polygon: the only reflector that shows it (points, spots); -1: any may
  std::span<const LiveLight> points;  // by polygon: who such a one stands for, where it is now
};
// Of the reflectors that it lights and shows in closed form; the others have it in their maps or images. By the scene's
// rays, up to 32 from a node to a polygon. stop: null, or ends it early.
std::vector<EmitterView> emitter_views(const EmitterQuestion& question, const LampScene& scene, const MoverPose& pose,
                                       const std::atomic<bool>* stop);

}  // namespace oriel
