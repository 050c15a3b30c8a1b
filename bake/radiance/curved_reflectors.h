// Shiny surfaces that are not planar: spheres, lamps, handles. They get a surround map each instead of radiance maps.
#pragma once

#include "bake/radiance/reflectors.h"
#include "formats/assets/surround_map.h"

namespace oriel {

struct CurvedOptions {
  std::uint32_t max_reflectors = 128;  // the largest by reflectance * (1 - roughness) * what eyes see are kept
  float min_extent_m = 0.05f;          // diagonal of the bounds: smaller ones are not seen; times small_scene()
  float max_extent_m = 2;              // longest side of the bounds: larger ones see too much from their middle, so
  std::uint32_t max_pieces = 8;        // they are cut into at most so many pieces
  std::uint64_t memory_bytes = std::uint64_t{32} << 20;  // of all maps in the pack, kMapBytesPerPixel each
};

// What eyes see of a triangle.
struct SeenOfTriangle {
  float pixels = 0;          // their unit cancels out
  float inverse_square = 0;  // Σ 1/d² of these, d the distance from the eye in metres
};

// What a surround map shows of what is near its centre.
enum class SurroundView : std::uint8_t {
  kOutside,       // nothing of its own object, nor of what lies before the object's backs
  kHollow,        // fronts of its own object too: it is taken from the hollow, a tub's
  kBeyondBounds,  // nothing within the object's bounds: not the bulb in the mouth of a shade
};

struct FoundCurvedReflector {
  CurvedReflector reflector;             // indices are left empty; map is its own place in the list
  std::vector<std::uint32_t> triangles;  // into Scene::triangles, ascending
  std::uint32_t object = 0;              // into FoundCurvedReflectors::objects
  double area_m2 = 0;
  float reflectance = 1;  // at 60°
  float alpha = 0;        // of its lobe
  SeenOfTriangle seen;    // of all of them
  SurroundView view = SurroundView::kOutside;
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
  std::vector<Warning> omitted;  // what was left out and why; one line each
};

// Texels of a map's side for a lobe of that roughness: a mirror 512, wider lobes fewer.
std::uint32_t surround_resolution(float roughness);

// Texels of a map's side, a power of two of 32 or more, for a piece of that area seen from that far, m, on a frame of
// 720 pixels and 60°. A mirroring sphere N pixels across turns the reflected direction by 4/N rad a pixel in its
// middle, and a map of S² texels has √(4π)/S rad a texel: S = 0.9 N. Twice that, for pieces half as bent as a sphere.
// Any piece has the pixels of a sphere of its area (Cauchy): the rim of a pane has few, however long it is.
std::uint32_t surround_resolution_for_eyes(double area_m2, double distance_m);

// Divides their sides, for trials. Returns the texels that they have then.
double make_coarser(std::uint32_t divisor, std::vector<SurroundMap>& maps);

// `triangles` (FoundReflectors::unplanar) that share positions and a material make an object, the two sides of a sheet
// (Scene::twin) two; one that is too large is cut across its longest side. Each piece sees its surroundings from the
// middle of its bounds. `seen`: by triangle of the scene; empty: nothing is known of eyes, area stands for what they
// see and maps are as fine as lobes show. Where the maps need more than memory_bytes, those of the least important
// reflectors are halved first. The order depends on the arguments only.
FoundCurvedReflectors find_curved_reflectors(const Scene& scene, std::span<const std::uint32_t> triangles,
                                             std::span<const ReflectorMaterial> materials,
                                             std::span<const SeenOfTriangle> seen, const CurvedOptions& options = {});

}  // namespace oriel
