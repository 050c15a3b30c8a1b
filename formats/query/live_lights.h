// Lights that stand for a lamp: points on it give its direct light. LiveBounces brings what bounces.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/assets/fresnel_map.h"
#include "formats/assets/light_field.h"
#include "formats/assets/material.h"
#include "formats/query/live_options.h"
#include "formats/query/mesh_rays.h"
#include "formats/query/mover_pose.h"

namespace oriel {

// Shines with intensity · cosine from the front of a surface; without a normal to all sides alike.
struct LiveLight {
  Vec3 position{0}, normal{0};  // normal: unit, or 0
  Vec3 intensity{0};            // cd, along the normal
  float disk = 0;               // m²/π of the surface that it stands for
  bool two_sided = false;
  float cos_inner = -1, cos_outer = -1;  // of a spot about `axis`
  Vec3 axis{0};
};

// Irradiance at a point of that unit normal as if nothing were between, lux. The surface that a light stands for counts
// as a disk that faces the point (Wallace, Elmquist and Haines 1989, "A Ray Tracing Algorithm for Progressive
// Radiosity"): so it is finite wherever the point is.
Vec3 unshadowed(const LiveLight& light, const Vec3& point, const Vec3& normal);

// Unit, about that unit normal, in proportion to the cosine. u: in [0, 1)².
inline Vec3 cosine_direction(const Vec2& u, const Vec3& normal) {
  const float r = std::sqrt(u.x), phi = 2 * kPi * u.y;
  return frame_from_normal(normal) * Vec3(r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0f, 1 - u.x)));
}

// A lamp as the mesh has it, in pack space.
struct LiveLamp {
  std::vector<std::uint32_t> parts;  // of the mesh: those that shine; ascending
  std::vector<Vec3> radiance;        // of each of them, cd/m²
  std::vector<BrightLight> points;   // its point and spot lights
};

// A pack's surfaces, as far as light is concerned. All outlive who is given it.
struct LiveSurfaces {
  const Mesh& mesh;
  std::span<const Material> materials;
  std::span<const Texture> textures;
  std::span<const FresnelMap> fresnel_maps;
};

// A lamp, and what stands still around it. A pose moves the lamp from where the mesh has it: pack space to pack space.
// See-through and unlit surfaces are no obstacle; cut-outs are obstacles as a whole.
class LampScene {
 public:
  // Copies positions: the mesh's may change.
  LampScene(const LiveSurfaces& surfaces, LiveLamp lamp);

  // By the same random numbers for every pose: what differs between two poses is the poses'. So many of them, but at
  // least one for each point light and one for all surfaces together; none where 0 are wanted.
  std::vector<LiveLight> lights(std::size_t count, const MoverPose& pose) const;
  // What stands still and is lit, from its front, is met there: a page of the lightmap and its coordinates on it.
  struct LitPlace {
    std::uint32_t page = 0;
    Vec2 uv{0};
    Vec3 position{0}, normal{0};  // normal: unit, towards where the ray came from
  };
  // Nothing: no such surface. The lamp is no obstacle.
  std::optional<LitPlace> lit_place(const Vec3& from, const Vec3& direction) const;
  // The share of light that is reflected at a place of a part's triangle, by the shares of its second and third corner.
  // What is mirrored counts as if it were scattered. Reads textures.
  Vec3 reflectance(std::uint32_t part, std::size_t first_index, const Vec2& shares) const;
  const Mesh& mesh() const { return surfaces_.mesh; }
  bool is_two_sided(std::uint32_t material) const { return two_sided_[material] != 0; }
  // What stands still along a direction (any length), lit or not. Does not look at what the constructor was given.
  struct Surface {
    Vec3 position{0}, normal{0};  // normal: unit, towards where the ray came from; 0: its back, which reflects nothing
    float distance = 0;           // over the direction's length
    std::uint32_t material = 0;
  };
  std::optional<Surface> first_surface(const Vec3& from, const Vec3& direction) const {
    const auto hit = still_.first(from, direction);
    if (!hit) return std::nullopt;
    return Surface{from + hit->distance * direction, facing_normal(*hit, direction), hit->distance,
                   part_of(*hit).material};
  }
  // What was last in the way of a light; of the scene and of the lamp. It saves time alone.
  struct Blockers {
    std::uint32_t still = ~0u, lamp = ~0u;
  };
  // Whether light comes from one place to the other, both off their surfaces.
  bool sees(const Vec3& from, const Vec3& to, const Mat4& lamp_from_pack, Blockers& last) const;
  // The part that the lamp's surface passes through, but does not where the mesh has it; empty: none.
  std::string passes_through(const MoverPose& pose) const;
  float luminous_flux() const { return chosen_.empty() ? 0.0f : chosen_.back(); }  // of the lamp, lm
  // That rays keep from surfaces.
  float offset_m() const { return offset_m_; }

 private:
  // A triangle of the lamp.
  struct Piece {
    Vec3 a{0}, ab{0}, ac{0}, normal{0};
    Vec3 radiance{0};
    float area = 0;
    bool two_sided = false;
  };
  // A point of the piece that stands for that area of it.
  static LiveLight point_on(const Piece& piece, const Vec2& at, float area, const Mat4& pack_from_lamp);
  const MeshPart& part_of(const TriangleHit& hit) const;
  Vec3 albedo(std::uint32_t material, const std::uint32_t* corners, const Vec2& shares) const;
  // Towards whoever comes along there; 0: its back, which reflects nothing.
  Vec3 facing_normal(const TriangleHit& hit, const Vec3& direction) const;

  LiveSurfaces surfaces_;
  LiveLamp lamp_;
  std::vector<Vec3> reflectance_;        // by material: mean over the hemisphere
  std::vector<std::uint8_t> two_sided_;  // by material
  Mesh still_mesh_, lamp_mesh_;          // positions, indices and parts
  MeshRays still_, lamp_rays_;
  std::vector<Piece> pieces_;
  std::vector<float> chosen_;  // sums of luminous flux of pieces, then of points: who is chosen
  float offset_m_ = 0;
};

}  // namespace oriel
