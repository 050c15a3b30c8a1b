// What the surface is at a point: textures, vertex colours and factors resolved into the parameters of light transport.
#pragma once

#include "bake/brdf/fresnel.h"
#include "bake/scene/scene.h"
#include "bake/scene/texture.h"

namespace oriel {

// Reflection parameters at a point. Unlit materials take no part in light transport: only base_color is set and
// coverage is 0. Diffuse albedo kd and specular lobe are those of glTF 2.0 appendix B (metallic-roughness), see
// docs/notes/conventions.md.
struct ShadePoint {
  Vec3 base_color{1};              // linear
  Vec3 diffuse{0};                 // (1 - metallic) * (1 - transmission) * base colour
  Vec3 f0{0.04f};                  // specular reflectance at normal incidence
  float f90 = 1;                   // at grazing incidence
  FresnelCurve curve = {};         // how the reflectance goes from f0 to f90
  float alpha = 1;                 // GGX width: roughness²; 0 is a mirror
  float anisotropy = 0;            // strength, [0,1]: the lobe is mix(alpha, 1, strength²) wide along wide_direction
  Vec2 wide_direction{1, 0};       // unit, in the tangent frame (tangent_at)
  float coat = 0, coat_alpha = 0;  // a clear coat over all the above: its share of the surface, its GGX width
  Vec3 transmission{0};            // colour of transmission; times what the specular lobe leaves
  float eta = 0;                   // of solid glass: index beyond the surface over that before it; 0: thin and straight
  bool inside = false;             // it is met from within the glass
  Vec3 absorption{0};              // in the glass, 1/m
  Vec3 emission{0};                // cd/m², front side only unless double-sided
  float coverage = 1;              // alpha test or blend: 0 lets light pass as if nothing were there
};

// barycentric: weights of the triangle's second and third vertex. Textures are their means over the footprint.
ShadePoint shade_point(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric,
                       const Footprint& footprint = {});

// The same point of solid glass as it is met from within: only what reflects and refracts is left.
void turn_inside(ShadePoint& point);

// The unit normal on the front side that the material's normal map makes of `normal` (unit, front side); the same where
// it has none. docs/notes/conventions.md, "Normal maps".
Vec3 mapped_normal(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric, const Vec3& normal,
                   const Footprint& footprint = {});

// The tangent of a slot's texture coordinates at a point with that normal: the mesh's TANGENT, or out of the
// coordinates. xyz of any length, 0 where the coordinates do not span a plane; w = ±1, the side of the bitangent w ·
// cross(normal, xyz).
Vec4 tangent_at(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric, const Vec3& normal,
                const TextureSlot& slot);

// The share of light along a straight ray that passes the surface there: coverage and thin transmission, [0,1].
Vec3 transmittance_at(const Scene& scene, std::uint32_t triangle, const Vec2& barycentric);

// False where every point has transmittance 0: rays need not look.
bool may_transmit(const SceneMaterial& material);

// Whether the material may have a lobe so narrow that it throws a bright image of a small lamp: by its roughness, or a
// texture that may make it smooth.
bool is_polished(const SceneMaterial& material);

// The mean emission of a triangle over its emission texture, cd/m².
Vec3 mean_emission(const Scene& scene, std::uint32_t triangle);

}  // namespace oriel
