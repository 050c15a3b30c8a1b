// Sample points of a texel beyond those that Texels stores.
#pragma once

#include "bake/radiosity/texels/texels.h"

namespace oriel {

// The k-th sample point of one half of a texel.
struct TexelSampleId {
  std::size_t texel = 0;
  int half = 0;
  std::uint32_t k = 0;
};
// A candidate for that sample point, anywhere on the texel's surface: it may be buried. The candidates of one k and
// half are stratified over the surface.
SurfacePoint texel_candidate(const LightmapScene& scene, const Texels& texels, const TexelSampleId& point,
                             std::uint64_t seed);

SamplePoint sample_point_of(const SurfacePoint& surface);

// Draws any number of sample points. The stored points of a partly occluded texel sample the light too coarsely,
// however many they are: further ones are drawn from the visible part of the texel (TexelPart).
class ExtraSamplePoints {
 public:
  ExtraSamplePoints(const LightmapScene& scene, const Texels& texels, std::uint64_t seed)
      : scene_(scene), texels_(texels), seed_(seed) {}

  const Texels& texels() const { return texels_; }
  // The k-th sample point of a half, for any k. The texel must be visible. Adds the rays traced to `rays`.
  SamplePoint at(std::uint32_t i, int half, std::uint32_t k, std::uint64_t& rays) const;
  // The number of points of a half, from k = 0, that are stored: at() traces no ray for them.
  std::uint32_t cached_count(std::uint32_t i, int half) const;
  // A point anywhere on the texel's surface; it may be buried.
  SurfacePoint candidate(std::uint32_t i, int half, std::uint32_t k) const;
  // The area of the surface under the texel, measured on the page, in texels. Candidates are uniform over it.
  float area_texels2(std::uint32_t i) const;
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
