// Shiny surfaces that are not planar: spheres, lamps, handles. They get a surround map each instead of radiance maps.
#pragma once

#include "bake/radiance/reflectors.h"
#include "formats/assets/surround_map.h"

namespace oriel {

struct CurvedOptions {
  std::uint32_t max_reflectors = 32;  // the largest by reflectance * area * (1 - roughness) are kept
  float min_extent_m = 0.05f;         // diagonal of the bounds: smaller ones are not seen
  float max_extent_m = 2;             // longest side of the bounds: larger ones see too much from their middle, so
  std::uint32_t max_pieces = 8;       // they are cut into at most so many pieces
  std::uint64_t memory_bytes = std::uint64_t{32} << 20;  // of all maps in the pack, kMapBytesPerPixel each
};

struct FoundCurvedReflector {
  CurvedReflector reflector;             // indices are left empty; map is its own place in the list
  std::vector<std::uint32_t> triangles;  // into Scene::triangles, ascending
  std::uint32_t object = 0;              // into FoundCurvedReflectors::objects
  double area_m2 = 0;
};

// A connected shiny surface.
struct CurvedObject {
  std::vector<std::uint32_t> triangles;  // ascending
  Vec3 lower{0}, upper{0};               // bounds, scene space
};

struct FoundCurvedReflectors {
  std::vector<FoundCurvedReflector> reflectors;  // most important first
  std::vector<SurroundMap> maps;                 // one each: centre and size, no texels
  std::vector<CurvedObject> objects;
  std::vector<std::string> omitted;  // what was left out and why; one line each
};

// Texels of a map's side for a lobe of that roughness: a mirror 512, wider lobes fewer.
std::uint32_t surround_resolution(float roughness);

// `triangles` (FoundReflectors::unplanar) that share positions and a material make an object; one that is too large is
// cut across its longest side. Each piece sees its surroundings from the middle of its bounds. Where the maps need more
// than memory_bytes, those of the least important reflectors are halved first. The order depends on the scene only.
FoundCurvedReflectors find_curved_reflectors(const Scene& scene, std::span<const std::uint32_t> triangles,
                                             std::span<const ReflectorMaterial> materials,
                                             const CurvedOptions& options = {});

}  // namespace oriel
