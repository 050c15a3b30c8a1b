// What a planar reflector sees: images with depth taken from viewpoints behind it, through its elements
// (Bastos et al. 1999, section 8.1.3).
#pragma once

#include <string>
#include <vector>

#include "formats/core/vec.h"

namespace oriel {

// A planar reflector. Reflector space: origin on the plane, x and y in it, z along the normal towards the reflected
// side, metres. Its material's kernel and Fresnel map say how it reflects.
struct Reflector {
  std::string name;             // of the part it was found in
  std::uint32_t material = 0;   // into Pack::materials
  Mat4 pack_from_reflector{1};  // rigid; pack space: metres, relative to Mesh::origin
  Vec2 lower{0}, upper{0};      // bounds of the reflector in its x, y
  float area_m2 = 0;
  float flatness_m = 0;                          // largest distance of a vertex from the plane
  std::vector<std::uint32_t> indices;            // its triangles, into Mesh's vertices
  std::uint32_t elements_x = 0, elements_y = 0;  // the grid of reflector elements over the bounds
  std::uint32_t first_map = 0,
                map_count = 0;  // into Pack::radiance_maps, ordered by element (row by row), then viewpoint
  // Emitters that its maps leave out, into Pack::emitters, and the share of each that is seen from the nodes of a grid
  // over the bounds: node (i, j) lies at lower + (i / (visibility_x - 1), j / (visibility_y - 1)) * (upper - lower),
  // borders included. Emitter k's node is at (k * visibility_y + j) * visibility_x + i: share * 255.
  std::vector<std::uint32_t> emitters;
  std::uint32_t visibility_x = 0, visibility_y = 0;  // at least 2 each where there are emitters
  std::vector<std::uint8_t> visibility;
};

inline constexpr std::size_t kMaxReflectorEmitters = 64;

// Maps of an element that the player can blend at once: no more are planned.
inline constexpr std::size_t kMostMapsPerElement = 16;

// A radiance map: an off-axis perspective image from `eye` (behind the plane, z < 0) through the element's rectangle on
// the plane. Pixel (x, y), row 0 at the element's lower y, is the ray from eye through the rectangle's point
// lower + ((x+½)/width, (y+½)/height) * (upper - lower). It starts on the plane: what lies behind it is not seen.
struct RadianceMap {
  std::uint32_t reflector = 0;  // into Pack::reflectors
  std::uint32_t element = 0;    // of its grid, row by row: j * elements_x + i
  Vec3 eye{0, 0, -1};           // reflector space
  Vec2 lower{0}, upper{0};      // the element's rectangle, reflector x, y: one for all of its maps
  std::uint32_t width = 0, height = 0;
  std::vector<Vec3>
      radiance;  // cd/m², linear Rec. 709: all that the pixel sees, emission included, but for has_emission
  // Where not, the emitters that the reflector lists are seen without their own light, but for their images in other
  // mirrors: those a closed form of the emitters alone does not show.
  bool has_emission = false;
  // Disparity: the eye's distance to the plane over the distance to the hit, both measured along the reflector's z:
  // 1 on the plane, 0 at infinity (a miss). Linear along a projected ray, so it interpolates.
  std::vector<float> disparity;
  // Whether the pixel saw a surface (1), nothing but sky (2) or the back of a surface or the reflector itself (0).
  std::vector<std::uint8_t> valid;
};

}  // namespace oriel
