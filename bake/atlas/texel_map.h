// Which surface lies under each texel of the lightmap.
#pragma once

#include "bake/atlas/atlas.h"

namespace oriel {

// A triangle's part of a texel.
struct TexelFragment {
  std::uint32_t triangle = 0;
  float area = 0;  // of the triangle's polygon clipped to the texel's square, in texels: (0,1]
};

// The covered texels of one page, in order of (y, x).
struct TexelMapPage {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> texel;  // y * width + x of each covered texel
  std::vector<std::uint32_t> first;  // texel.size() + 1 entries: its fragments are [first[i], first[i+1])
  std::vector<TexelFragment> fragments;
};

// By page and y * width + x: whether a texel is wanted.
using WantedTexels = std::vector<std::vector<bool>>;

// Conservative: a texel is covered when any part of a triangle's image, however small, lies in its square. wanted: the
// others are left out; empty: all are wanted.
Result<std::vector<TexelMapPage>> build_texel_map(const Atlas& atlas, Context& context,
                                                  const WantedTexels& wanted = {});

// The share of texel i that has a surface: (0,1].
float covered_share(const TexelMapPage& page, std::size_t i);

// The area of the surface under texel i of the map, m².
double texel_area_m2(const Scene& scene, const Atlas& atlas, const TexelMapPage& map, std::size_t i);

// A triangle's corners in texels of its page (which it must have).
std::array<DVec2, 3> texel_triangle(const Atlas& atlas, std::uint32_t triangle);

// A point of the surface under texel i of a page, uniform over the clipped polygons. u in [0,1)³.
struct TexelPoint {
  std::uint32_t triangle = 0;
  Vec2 barycentric{0};  // weights of the triangle's second and third vertex
};
TexelPoint sample_texel(const Atlas& atlas, const TexelMapPage& page, std::size_t i, const Vec3& u);

}  // namespace oriel
