// Patches of the coarse radiosity problem (patches.h), with their links.
#pragma once

#include <vector>

#include "bake/radiosity/texels/neighbours.h"
#include "formats/core/archive.h"

namespace oriel {

// A patch seen from another one. Irradiance gained: weight * irradiance of the patch seen.
struct PatchLink {
  std::uint32_t patch;
  Vec3 weight;
};
inline void fields(Archive& archive, PatchLink& link) {
  archive(link.patch, link.weight);
}

struct LightPatch {
  std::vector<std::uint32_t> texels;  // visible ones
  std::vector<PatchLink> links;       // weights, divided by the number of rays
  DVec3 source{0};  // irradiance from outside the patches, lux: direct light after one reflection, sky, emitters
  std::vector<DVec3> grouped;  // `source` by light group; may be empty
  Vec3 unreflected{0};         // the part of `source` directly from sky and emitters
  double area_m2 = 0;
  std::uint32_t rays = 0;
  bool traced = false;                    // its rays are: it has links and sources
  bool follows_near = false;              // GatherRay::follows_near of its rays
  std::uint32_t x = 0, y = 0;             // of its block
  std::uint64_t stream = 0;               // of its random numbers: by block, so that other blocks do not change it
  std::vector<std::uint32_t> neighbours;  // connected patches of the same chart
};

// The sum of a patch's link weights: the mean reflectance of the patches that it sees, by channel.
inline DVec3 weight_sum(const LightPatch& patch) {
  DVec3 sum(0);
  for (const PatchLink& link : patch.links) sum += DVec3(link.weight);
  return sum;
}

inline bool same_chart(const Texels& t, std::uint32_t a, std::uint32_t b) {
  return t.page[a] == t.page[b] && t.chart[a] == t.chart[b];
}

// The patches of blocks of side x side texels, as one representative texel by texel. Texels of a block share a patch if
// neighbours connect them within the block.
std::vector<std::uint32_t> connect_blocks(const Texels& t, const TexelGraph& graph, std::uint32_t side);

// Scales weights to sum to `most` at most; true if they had to be.
bool bound(LightPatch& patch, const DVec3& most);

// Gives patches for whose rays there was no time the mean light of the others.
void fill_untraced(std::span<const LightPatch> patches, std::vector<Vec3>& light);

// Merges the links to each patch into one, which halves the memory that sweeps read.
void join_links(std::vector<PatchLink>& links);

}  // namespace oriel
