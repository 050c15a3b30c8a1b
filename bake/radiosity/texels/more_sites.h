// Points of a texel beyond the few that Texels keeps.
#pragma once

#include "bake/radiosity/texels/texels.h"

namespace oriel {

// The k-th point of a texel's half.
struct HalfPoint {
  std::size_t texel = 0;
  int half = 0;
  std::uint32_t k = 0;
};
// A candidate for it: on the texel's surface, whatever is there. Those of one k and half are spread evenly.
SurfacePoint texel_candidate(const LightmapScene& scene, const Texels& texels, const HalfPoint& point,
                             std::uint64_t seed);

TexelSite site_of(const SurfacePoint& surface);

// However many points of a texel are kept, those of a texel that is partly hidden see some of the light only: beyond
// them new ones are drawn, from the part that the texel's light is taken from.
class MoreSites {
 public:
  MoreSites(const LightmapScene& scene, const Texels& texels, std::uint64_t seed)
      : scene_(scene), texels_(texels), seed_(seed) {}

  const Texels& texels() const { return texels_; }
  // The k-th site of a half, of as many as are asked for. The texel must be visible. Adds to rays.
  TexelSite at(std::uint32_t i, int half, std::uint32_t k, std::uint64_t& rays) const;
  // So many of a half take no rays to find.
  std::uint32_t known(std::uint32_t i, int half) const;
  // A point anywhere on the texel's surface, whatever lies on it.
  SurfacePoint candidate(std::uint32_t i, int half, std::uint32_t k) const;
  // All surface under the texel, as it is on the page, in texels: what candidates are even over.
  float texels2(std::uint32_t i) const;
  // One of the triangles under the texel.
  std::uint32_t triangle(std::uint32_t i) const {
    const TexelMapPage& map = scene_.map[texels_.page[i]];
    return map.fragments[map.first[texels_.index[i]]].triangle;
  }

 private:
  LightmapScene scene_;
  const Texels& texels_;
  std::uint64_t seed_;
};

}  // namespace oriel
