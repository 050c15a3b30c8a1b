// Occluders as one receiver and one light have them between each other, in receiver space.
#pragma once

#include "study/herf1997/occluders.h"
#include "study/herf1997/receiver.h"
#include "study/herf1997/shadow_light.h"

namespace oriel::study {

inline constexpr std::uint32_t kNoFace = ~0u;

struct ViewEdge {
  std::uint32_t a = 0, b = 0;  // points, a < b
  std::array<std::uint32_t, 2> faces{kNoFace, kNoFace};
};

struct ViewFace {
  std::array<std::uint32_t, 3> points{}, edges{};
  std::uint32_t part = 0;
  bool one_side = false;  // of a body that light enters as often as it leaves: one side of it casts all its shadow
};

// What of the occluders can cast a shadow. Faces that reach behind the receiver are cut at its plane. Of more than two
// faces on one edge each further pair has an edge of its own at the same place.
struct OccluderView {
  std::vector<DVec3> apexes;           // the light samples in front of the receiver,
  std::vector<std::uint32_t> apex_of;  // as numbered in the light
  std::vector<DVec3> points;
  std::vector<ViewEdge> edges;
  std::vector<ViewFace> faces;                     // nearer to the receiver than every sample
  std::vector<std::array<DVec3, 3>> beside_light;  // reach as far from the receiver as some sample: cut for each sample
  std::size_t tested = 0;                          // boxes and faces that were looked at
};

// touching: what is not further from the plane, or the lamp's, than this lies in it and casts nothing, metres.
OccluderView view_occluders(const Occluders& occluders, const ShadowReceiver& receiver, const ShadowLight& light,
                            double touching);

// The part of a triangle that is nearer to the receiver than the apex, as a fan of triangles that the apex sees at
// finite places: up to two, in seen_at's texels.
std::vector<std::array<DVec2, 3>> cut_at_light(const DVec3& apex, const std::array<DVec3, 3>& triangle);

}  // namespace oriel::study
