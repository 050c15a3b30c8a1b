// How much of what maps see is traced along lobes.
#pragma once

#include "bake/run/reflections.h"

namespace oriel {

// By triangle: the surfaces whose lobes are traced where maps see them. No ray is mirrored by curved things, and those
// of surround maps by nothing: there planar ones are among them.
std::vector<bool> curved_triangles(const Scene& scene, const FoundReflections& all);
std::vector<bool> shiny_triangles(const Scene& scene, const FoundReflections& all);

// Shares of the pixels that trace a lobe (traces_lobe), each for as often as it does.
struct LobeShares {
  double planar = 0;    // of the maps of planar reflectors
  double surround = 0;  // of those of curved ones
};

// By every 8th pixel along each axis. Error kStopped.
Result<LobeShares> lobe_shares(const BakedScene& baked, const ReflectedSurroundings& surroundings,
                               std::span<const RadianceMap> maps, const FoundReflections& all, Context& context);

}  // namespace oriel
