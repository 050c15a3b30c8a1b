#include "bake/radiance/curved_reflectors.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <tuple>

#include "bake/radiance/views.h"
#include "formats/core/disjoint_sets.h"

namespace oriel {
namespace {

constexpr std::uint32_t kMinSide = 32;               // of maps that are made smaller
constexpr double kPixelsPerRad = 720 / (kPi / 3.0);  // of a frame

std::uint32_t material_of(const Scene& scene, std::uint32_t triangle) {
  return scene.surfaces[scene.triangle_surface[triangle]].material;
}

CurvedObject object_of(const Scene& scene, std::vector<std::uint32_t> triangles) {
  CurvedObject object;
  object.lower = object.upper = scene.positions[scene.triangles[triangles.front()][0]];
  for (const std::uint32_t t : triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3& p = scene.positions[scene.triangles[t][corner]];
      object.lower = glm::min(object.lower, p);
      object.upper = glm::max(object.upper, p);
    }
  object.triangles = std::move(triangles);
  return object;
}

// Of a sheet that was split into two sides, the second one: its surroundings are others.
bool is_back(const Scene& scene, std::uint32_t triangle) {
  return !scene.twin.empty() && scene.twin[triangle] < triangle;
}

// Vertices are not shared between surfaces, nor where normals part: positions tell what is connected.
std::vector<CurvedObject> connected_objects(const Scene& scene, std::span<const std::uint32_t> triangles) {
  struct Corner {
    std::uint32_t material;
    bool back;
    Vec3 p;
    std::size_t triangle;  // into `triangles`
    auto key() const { return std::tuple(material, back, p.x, p.y, p.z); }
  };
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (int c = 0; c < 3; ++c)
      corners.push_back({material_of(scene, triangles[i]), is_back(scene, triangles[i]),
                         scene.positions[scene.triangles[triangles[i]][c]], i});
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.key() < b.key(); });
  DisjointSets sets(triangles.size());
  for (std::size_t i = 1; i < corners.size(); ++i)
    if (corners[i].key() == corners[i - 1].key()) sets.join(corners[i - 1].triangle, corners[i].triangle);
  std::map<std::size_t, std::vector<std::uint32_t>> members;
  for (std::size_t i = 0; i < triangles.size(); ++i) members[sets.root(i)].push_back(triangles[i]);
  std::vector<CurvedObject> objects;
  for (auto& [root, list] : members) objects.push_back(object_of(scene, std::move(list)));
  return objects;
}

// Cut in the middle of the longest side; empty where all triangles lie in one half.
std::vector<CurvedObject> halves(const Scene& scene, const CurvedObject& object) {
  const Vec3 size = object.upper - object.lower, middle = 0.5f * (object.lower + object.upper);
  const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
  std::vector<std::uint32_t> low, high;
  for (const std::uint32_t t : object.triangles) {
    const UVec3& v = scene.triangles[t];
    const float at = (scene.positions[v.x][axis] + scene.positions[v.y][axis] + scene.positions[v.z][axis]) / 3;
    (at < middle[axis] ? low : high).push_back(t);
  }
  if (low.empty() || high.empty()) return {};
  return {object_of(scene, std::move(low)), object_of(scene, std::move(high))};
}

std::vector<CurvedObject> pieces_of(const Scene& scene, const CurvedObject& object, const CurvedOptions& options) {
  std::vector<CurvedObject> pieces{object};
  while (pieces.size() < options.max_pieces) {
    const auto longest_side = [](const CurvedObject& o) { return max_component(o.upper - o.lower); };
    const auto largest = std::max_element(
        pieces.begin(), pieces.end(),
        [&](const CurvedObject& a, const CurvedObject& b) { return longest_side(a) < longest_side(b); });
    if (longest_side(*largest) <= options.max_extent_m) break;
    std::vector<CurvedObject> cut = halves(scene, *largest);
    if (cut.empty()) break;
    *largest = std::move(cut[0]);
    pieces.push_back(std::move(cut[1]));
  }
  return pieces;
}

double area_of(const Scene& scene, const std::vector<std::uint32_t>& triangles) {
  double area = 0;
  for (const std::uint32_t t : triangles) area += triangle_area(scene, t);
  return area;
}

SeenOfTriangle seen_of(std::span<const SeenOfTriangle> seen, const std::vector<std::uint32_t>& triangles) {
  SeenOfTriangle sum;
  for (const std::uint32_t t : triangles) sum.pixels += seen[t].pixels, sum.inverse_square += seen[t].inverse_square;
  return sum;
}

void keep_most_important(std::span<const ReflectorMaterial> materials, bool eyes_known, std::uint32_t limit,
                         FoundCurvedReflectors& found) {
  const auto importance = [&](const FoundCurvedReflector& f) {
    const ReflectorMaterial& m = materials[f.reflector.material];
    return f.reflectance * (eyes_known ? double{f.seen.pixels} : f.area_m2) * (1 - m.roughness);
  };
  auto& list = found.reflectors;
  std::stable_sort(list.begin(), list.end(), [&](const FoundCurvedReflector& a, const FoundCurvedReflector& b) {
    return importance(a) > importance(b);
  });
  keep_first(limit, "curved pieces", list, found.omitted);
}

// Their centres were set; halves the maps of the least important until all fit.
void choose_sizes(std::span<const ReflectorMaterial> materials, bool eyes_known, std::uint64_t memory_bytes,
                  FoundCurvedReflectors& found) {
  std::uint64_t texels = 0;
  std::size_t halved = 0;
  for (std::size_t i = 0; i < found.maps.size(); ++i) {
    const FoundCurvedReflector& f = found.reflectors[i];
    std::uint32_t size = surround_resolution(materials[f.reflector.material].roughness);
    if (eyes_known) {
      const double distance = f.seen.inverse_square > 0 ? std::sqrt(f.seen.pixels / f.seen.inverse_square) : HUGE_VAL;
      size = std::min(size, surround_resolution_for_eyes(f.area_m2, distance));
    }
    found.maps[i].size = size;
    texels += std::uint64_t{size} * size;
  }
  while (texels * kMapBytesPerPixel > memory_bytes) {
    const auto largest = std::max_element(found.maps.rbegin(), found.maps.rend(),
                                          [](const SurroundMap& a, const SurroundMap& b) { return a.size < b.size; });
    if (largest->size <= kMinSide) break;
    largest->size /= 2;
    texels -= std::uint64_t{3} * largest->size * largest->size;
    ++halved;
  }
  if (halved > 0)
    found.omitted.push_back(
        fmt::format("surround maps of {} curved reflectors: their sides were halved {} times to fit in {:.1f} MiB",
                    found.maps.size(), halved, static_cast<double>(memory_bytes) / (1 << 20)));
}

}  // namespace

std::uint32_t surround_resolution(float roughness) {
  if (roughness < 0.05f) return 512;
  return roughness <= 0.2f ? 256 : 128;
}

std::uint32_t surround_resolution_for_eyes(double area_m2, double distance_m) {
  const double across_m = std::sqrt(area_m2 / kPi);
  const double texels = 1.8 * kPixelsPerRad * across_m / std::max(distance_m, across_m / 2);
  return std::bit_ceil(std::max(kMinSide, static_cast<std::uint32_t>(texels)));
}

double make_coarser(std::uint32_t divisor, std::vector<SurroundMap>& maps) {
  double texels = 0;
  for (SurroundMap& map : maps) {
    map.size = std::max(1u, map.size / divisor);
    texels += double{1.0f * map.size} * map.size;
  }
  return texels;
}

FoundCurvedReflectors find_curved_reflectors(const Scene& scene, std::span<const std::uint32_t> triangles,
                                             std::span<const ReflectorMaterial> materials,
                                             std::span<const SeenOfTriangle> seen, const CurvedOptions& options) {
  FoundCurvedReflectors out;
  const float min_extent = options.min_extent_m * small_scene(scene.radius());
  std::size_t small = 0;
  std::string smallest;
  for (CurvedObject& object : connected_objects(scene, triangles)) {
    const Surface& surface = scene.surfaces[scene.triangle_surface[object.triangles.front()]];
    if (glm::length(object.upper - object.lower) < min_extent) {
      if (small++ == 0) smallest = surface.name;
      continue;
    }
    for (CurvedObject& piece : pieces_of(scene, object, options)) {
      FoundCurvedReflector found;
      found.reflector.name = surface.name;
      found.reflector.material = surface.material;
      found.reflector.map = static_cast<std::uint32_t>(out.maps.size());
      found.area_m2 = area_of(scene, piece.triangles);
      const ReflectorMaterial& material = materials[surface.material];
      found.reflectance = reflectance_at_60_deg(material);
      found.alpha = material.roughness * material.roughness;
      if (!seen.empty()) found.seen = seen_of(seen, piece.triangles);
      found.triangles = std::move(piece.triangles);
      found.object = static_cast<std::uint32_t>(out.objects.size());
      out.maps.emplace_back().centre = 0.5f * (piece.lower + piece.upper);
      out.reflectors.push_back(std::move(found));
    }
    out.objects.push_back(std::move(object));
  }
  if (small > 0)
    out.omitted.push_back(fmt::format("{} curved pieces ('{}'{}): smaller than {:.3g} m", small, smallest,
                                      small > 1 ? " and others" : "", min_extent));
  keep_most_important(materials, !seen.empty(), options.max_reflectors, out);
  std::vector<SurroundMap> maps;
  for (FoundCurvedReflector& found : out.reflectors) {
    maps.push_back(std::move(out.maps[found.reflector.map]));
    found.reflector.map = static_cast<std::uint32_t>(maps.size() - 1);
  }
  out.maps = std::move(maps);
  choose_sizes(materials, !seen.empty(), options.memory_bytes, out);
  return out;
}

}  // namespace oriel
