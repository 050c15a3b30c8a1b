// What pixels of radiance and surround maps show, by their rays: so that maps can follow lamps that change.
#pragma once

#include <span>
#include <vector>

#include "formats/assets/fresnel_map.h"
#include "formats/assets/material.h"
#include "formats/assets/radiance_map.h"
#include "formats/assets/surround_map.h"
#include "formats/query/mesh_rays.h"

namespace oriel {

// Eight bytes a pixel.
struct SeenPlace {
  static constexpr std::uint16_t kNone = 0xffff, kSky = 0xfffe;
  std::uint16_t page = kNone;      // of the lightmap; none: nothing that is lit
  std::uint16_t material = kNone;  // kSky: nothing else is seen; none: what is seen is not known
  std::uint16_t u = 0, v = 0;      // of the page, over 65535

  Vec2 uv() const { return Vec2(u, v) / 65535.0f; }
};

// What all pixels of a map show.
struct SeenPixels {
  std::vector<SeenPlace> places;
  // Of pixels that show what shines, what is behind it; by pixel, in their order.
  struct Behind {
    std::uint32_t pixel = 0;
    float distance = 0;  // from where the pixel's ray begins
    SeenPlace place;
  };
  std::vector<Behind> behind;
};

// The ray of a pixel, unit direction, from the reflector's plane or the map's centre; distance: to what it shows,
// infinite for the sky. Pack space.
struct SeenRay {
  Vec3 from{0}, direction{0};
  float distance = 0;
};
SeenRay seen_ray(const RadianceMap& map, const Reflector& reflector, std::size_t pixel);
SeenRay seen_ray(const SurroundMap& map, std::size_t pixel);
// The pixel shows a surface so far away.
void set_distance(SurroundMap& map, std::size_t pixel, float distance);

class SeenPlaces {
 public:
  // The mesh outlives it; of the rest what is wanted is copied. reflectors: that other maps see by way of.
  SeenPlaces(const Mesh& mesh, std::span<const Material> materials, std::span<const Reflector> reflectors,
             std::span<const FresnelMap> fresnel_maps);

  // The surfaces that are met at the distances that the map has. Where a mirror is on the way and distances are those
  // of images, what it shows. reflector: the map's. In all threads.
  SeenPixels of(const RadianceMap& map, const Reflector& reflector) const;
  SeenPixels of(const SurroundMap& map) const;

 private:
  // A ray of a pixel, unit direction, and how far what it shows is, give or take.
  struct Look {
    Vec3 from{0}, direction{0};
    float distance = 0, slack = 0;
  };
  // A plane that reflects more than half at some angle, in pack space.
  struct Mirror {
    Mat4 from_pack{1};
    Vec3 normal{0};
    Vec2 lower{0}, upper{0};
    std::vector<Vec3> reflectance;  // FresnelMap::table
  };
  struct Surface {
    bool two_sided = false, see_through = false, shines = false;
  };
  // slack(pixel's ray): how far off its distance may be.
  template <class Map, class RayOf, class SlackOf>
  SeenPixels find_all(const Map& map, const IVec2& size, const RayOf& ray_of, const SlackOf& slack_of) const;
  SeenPlace find(const Look& look, std::uint32_t& last) const;
  std::optional<SeenPixels::Behind> behind(const Look& look) const;
  SeenPlace place_at(const TriangleHit& hit) const;
  std::optional<TriangleHit> meet(const Look& look, std::uint32_t& last) const;
  bool counts(const TriangleHit& hit) const;
  std::optional<Look> mirrored(const Look& look) const;
  bool is_outside(const Look& look) const;

  MeshRays rays_;
  std::vector<Surface> surfaces_;  // by material
  std::vector<Mirror> mirrors_;
  Vec3 lower_{0}, upper_{0};  // of the mesh
};

}  // namespace oriel
