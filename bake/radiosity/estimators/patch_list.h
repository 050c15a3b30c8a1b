// Patches of the coarse radiosity problem (patches.h), and what they see of each other.
#pragma once

#include <vector>

#include "bake/radiosity/texels/neighbours.h"
#include "formats/core/archive.h"

namespace oriel {

struct PatchLink {
  std::uint32_t patch;
  Vec3 weight;
};
inline void fields(Archive& archive, PatchLink& link) {
  archive(link.patch, link.weight);
}

struct LightPatch {
  std::vector<std::uint32_t> texels;  // those that see light
  std::vector<PatchLink> links;       // weights divided by the number of rays
  DVec3 source{0};                    // irradiance found that no patch holds, lux: direct light after one reflection,
                                      // sky, emitters behind mirrors
  std::vector<DVec3> grouped;         // the same by group of lamps, if asked
  Vec3 unreflected{0};                // of it what comes straight from sky and emitters
  double area_m2 = 0;
  std::uint32_t rays = 0;
  bool follows_near = false;          // GatherRay::near of its rays
  std::uint32_t x = 0, y = 0;         // of its block
  std::uint64_t stream = 0;           // of its random numbers: its block's, which no other block's shape changes
  std::vector<std::uint32_t> beside;  // patches of the same chart that no wall parts from it
};

// Of the light of the patches that it sees.
inline DVec3 handed_on(const LightPatch& patch) {
  DVec3 sum(0);
  for (const PatchLink& link : patch.links) sum += DVec3(link.weight);
  return sum;
}

inline bool same_chart(const Texels& t, std::uint32_t a, std::uint32_t b) {
  return t.page[a] == t.page[b] && t.chart[a] == t.chart[b];
}

// By texel: one texel that stands for all of its patch. Texels of a block, a square of `side` texels, belong together
// where neighbours, which see each other, connect them within it.
std::vector<std::uint32_t> connect_blocks(const Texels& t, const TexelGraph& graph, std::uint32_t side);

// Links to one patch become one: sweeps read half as much.
void join_links(std::vector<PatchLink>& links);

}  // namespace oriel
