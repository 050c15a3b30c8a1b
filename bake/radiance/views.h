// Where radiance maps are taken from: elements of a reflector and viewpoints on a hemisphere behind each
// (Bastos et al. 1999, section 8.1.3, "Sampling of the plenoptic function").
#pragma once

#include <string>
#include <vector>

#include "bake/radiance/elements.h"

namespace oriel {

struct ViewOptions {
  float element_m = 3.0f;           // largest side of a reflector element, metres
  std::uint32_t max_elements = 16;  // per reflector: larger ones get larger elements
  std::uint32_t views_per_element = 16;
  std::uint32_t map_resolution = 0;  // longer side of a map, pixels; 0: by the lobe (resolution_for)
  std::uint64_t memory_bytes = std::uint64_t{128} << 20;  // of all maps, kMapBytesPerPixel each
};

// How far from the pole the rings of a hemisphere go: to 75°, since views closer to the plane see it edge-on; or, as
// published, over all of it: arcs end half a step above the rim, where a frustum is flat.
enum class Rings { kTo75, kToRim };

// Unit vectors with z < 0: the pole (0, 0, -1), then rings at evenly spaced arcs from it, each with points at about the
// same spacing. Exactly `count` of them, at least 1.
std::vector<Vec3> hemisphere_directions(std::uint32_t count, Rings rings);

// Pixels of a map's longer side for a lobe of that roughness: a mirror 256, wider lobes fewer.
std::uint32_t resolution_for(float roughness);

struct ViewPlan {
  std::vector<RadianceMap> maps;        // everything but the pixels; by reflector, element (row by row), viewpoint
  std::vector<std::string> omitted;     // what was reduced or left out and why, one line each
  std::uint32_t views_per_element = 0;  // as used
  std::uint32_t kept = 0;               // reflectors whose views are those of an earlier bake
};

// Whether the point is in the scene's bounds, or no further out than the margin along any axis.
bool is_inside(const Scene& scene, const Vec3& p, float margin);

// How an omission of maps that do not fit begins: "radiance maps would take … MiB of … MiB allowed: ".
std::string memory_line(std::uint64_t wanted, std::uint64_t allowed);

// Plans the maps of all reflectors that have maps, from hemispheres to the rim, and sets each one's elements_x,
// elements_y, first_map and map_count. Left out are elements that the reflector's polygons do not cover and viewpoints
// whose mirror image is outside the scene's bounds by more than the hemisphere's radius. Where memory_bytes does not
// suffice, views per element are reduced for all, then resolution (down to 16), then the least important reflectors get
// no maps.
ViewPlan plan_views(const Scene& scene, std::vector<FoundReflector>& reflectors, const ViewOptions& options);

}  // namespace oriel
