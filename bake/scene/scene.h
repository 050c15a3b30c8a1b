// A scene as the baker sees it: plain structs, everything checked (docs/notes/conventions.md).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bake/brdf/metals.h"
#include "formats/assets/camera.h"
#include "formats/assets/day.h"
#include "formats/assets/material.h"
#include "formats/assets/mover.h"
#include "formats/core/vec.h"

namespace oriel {

// An image as stored: RGBA, 8 bits, rows from the top. Colour slots decode it as sRGB, data slots as linear.
struct Image {
  std::string name;
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> texels;  // 4 * width * height
  std::vector<Image> mips = {};      // from half the size on, each half of the one before; none until make_mips()
};

// Where and how a material reads an image.
struct TextureSlot {
  std::int32_t image = -1;     // into Scene::images; -1: no texture
  std::uint32_t texcoord = 0;  // 0 or 1
  Mat3 image_from_uv{1};       // KHR_texture_transform, applied to (u, v, 1)
  Wrap wrap_s = Wrap::kRepeat, wrap_t = Wrap::kRepeat;
  bool nearest = false;
};

struct SceneMaterial {
  std::string name;
  Vec3 base_color{1};  // linear, clamped to [0,1]
  float alpha = 1;
  TextureSlot base_color_texture;
  float metallic = 1, roughness = 1;
  TextureSlot metallic_roughness_texture;  // G: roughness, B: metallic
  Vec3 emission{0};                        // cd/m²: emissiveFactor * emissiveStrength
  TextureSlot emission_texture;
  float ior = 1.5f;
  float specular = 1;  // KHR_materials_specular
  Vec3 specular_color{1};
  TextureSlot specular_texture;        // A: multiplies specular
  TextureSlot specular_color_texture;  // multiplies specular_color
  TextureSlot gloss_texture;           // A: multiplies 1 - roughness
  float transmission = 0;              // KHR_materials_transmission; thin unless solid
  bool solid = false;                  // KHR_materials_volume: closed surfaces around glass of index ior
  Vec3 absorption{0};                  // in it, 1/m: what is left after d is exp(-absorption d)
  float thickness_m = 0;               // for who cannot follow light through the mesh
  TextureSlot transmission_texture;    // R: multiplies transmission
  TextureSlot normal_texture;          // RGB: 2 v - 1 in the tangent frame
  float normal_scale = 1;              // of its x and y
  float coat = 0, coat_roughness = 0;  // KHR_materials_clearcoat
  TextureSlot coat_texture;            // R: multiplies coat
  TextureSlot coat_roughness_texture;  // G: multiplies coat_roughness
  float anisotropy = 0;                // KHR_materials_anisotropy: strength, [0,1]
  float anisotropy_rotation_rad = 0;   // of the wide direction from the tangent, counter-clockwise
  TextureSlot anisotropy_texture;      // RG: 2 v - 1 the wide direction in the tangent frame, B: multiplies anisotropy
  Metal metal =
      Metal::kNone;  // the key metal (object_keys.h): all metal, with measured constants instead of base_color
  AlphaMode alpha_mode = AlphaMode::kOpaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  bool unlit = false;
  bool reflections = true;  // false: it is asked to show no image of its surroundings
};

// All texture slots of a material (const or not).
template <class M>
auto texture_slots(M& m) {
  return std::array{
      &m.base_color_texture,     &m.metallic_roughness_texture, &m.emission_texture, &m.transmission_texture,
      &m.specular_texture,       &m.specular_color_texture,     &m.normal_texture,   &m.coat_texture,
      &m.coat_roughness_texture, &m.anisotropy_texture,         &m.gloss_texture};
}

// A primitive of a node, placed in the world.
struct Surface {
  std::string name;  // the node's name, or "mesh/primitive" where it has none
  std::string mesh_name;
  std::string node_path;  // of names from a root of the file down, "house/ground floor/wall"; nodes[3] for one without
  std::uint32_t material = 0;
  std::uint32_t first_triangle = 0, triangle_count = 0;  // into Scene::triangles
  std::uint32_t first_vertex = 0, vertex_count = 0;      // into the vertex arrays; not shared with other surfaces
  bool has_uv1 = false;
  float texel_m = 0;              // asked for; 0: what eyes want
  std::int32_t mover = -1;        // into Scene::movers; -1: it stands still
  std::int32_t motion = -1;       // into Scene::lamp_motions: a lamp that stands still in the bake alone
  std::string group_mark{};       // extras.oriel.light_group of its node, or of the nearest above it that has one
  std::uint32_t light_group = 0;  // into Scene::light_groups, where it shines and there are any
};

// What moves as one rigid object. Object space: the node's origin, the world's directions turned as the node is; its
// scale is in the vertices.
struct SceneMover {
  std::string name;
  MoverPose rest;              // scene_from_object, as its surfaces lie in the scene
  std::vector<MoverKey> keys;  // of its animation; empty: none moves it
};

enum class LightType : std::uint8_t { kPoint, kSpot, kDirectional };

// A luminaire's far-field luminous intensity, measured (IES LM-63, photometry of type C). Angles as there, degrees:
// vertical 0 is the light's direction (node -Z), 180 its opposite; horizontal 0 is node +X, 90 node +Y, so it grows
// counter-clockwise seen from the luminaire's top. Symmetries are unfolded at lookup.
struct LightProfile {
  std::string name;
  std::vector<float> vertical_deg;    // ascending, at least 2; no light beyond the first and the last
  std::vector<float> horizontal_deg;  // ascending: one (rotational symmetry), or 0 to 90, 180 or 360, or 90 to 270
  std::vector<float> candela;         // >= 0; horizontal angle h, vertical v at h * vertical_deg.size() + v
};

// KHR_lights_punctual.
struct Light {
  std::string name;
  LightType type = LightType::kPoint;
  Vec3 position{0};          // scene space
  Vec3 direction{0, 0, -1};  // unit, the way the light travels (spot, directional)
  Vec3 right{1, 0, 0};       // unit, normal to direction: node +X, horizontal 0 of a profile
  bool mirrored = false;     // by its node: horizontal 90 of a profile is direction x right, not right x direction
  Vec3 color{1};             // linear
  Vec3 intensity{0};         // colour * intensity: cd (point, spot) or lux on a facing plane (directional)
  float inner_cone_rad = 0, outer_cone_rad = 0.7853982f;  // spot: half angles
  float angular_radius_rad = 0;                           // directional: half its angular diameter, at most π/2
  std::int32_t hour = -1;                                 // into Scene::day's hours: the sun of that hour
  std::int32_t profile = -1;      // into Scene::profiles: then colour * candela, no cone, no intensity (point, spot)
  std::string node_path{};        // as Surface's
  std::string group_mark{};       // likewise
  std::int32_t motion = -1;       // likewise
  std::uint32_t light_group = 0;  // into Scene::light_groups, where there are any
};

// Lamps that are switched together: their light is kept apart from all other.
struct SceneLightGroup {
  std::string name;
  std::vector<std::string> lamps;  // names of nodes, of a sky "sky"
  std::int32_t motion = -1;        // of all of them; into Scene::lamp_motions
};

// Radiance from all around on a latitude-longitude grid: row 0 ends at +Y, the last row at -Y; the centre is +X and +Z
// lies to its right, as in Blender and three.js; `rotation_rad` then turns it counter-clockwise seen from above.
struct SkyImage {
  std::uint32_t width = 0, height = 0;
  std::vector<Vec3> texels;  // cd/m², >= 0; width * height; empty: there is no image
  float rotation_rad = 0;
};

// Whose light a sky image is, where it is of several groups of lamps: grey skies that sum to it.
struct SkyParts {
  std::vector<std::uint32_t> groups;  // into Scene::light_groups
  std::vector<float> luminance;       // cd/m², >= 0; of texel t and part k at t * groups.size() + k

  bool empty() const { return groups.empty(); }
};

// All surfaces flattened into world-oriented triangles. Scene space is metres relative to `origin`, so that floats stay
// precise far from the world's origin. Vertex arrays have the same length.
// A straight line in a flat surface, on edges of its triangles, at which charts end: under a wall that parts two rooms.
struct ChartCut {
  Vec3 from{0}, to{0};  // scene space

  // From it to the ends of edges on it, at most: a millimetre, or eight steps of a float far from zero, where those
  // ends and its own are rounded.
  double tolerance_m() const {
    const Vec3 most = glm::max(glm::abs(from), glm::abs(to));
    return std::max(1e-3, 0x1p-20 * std::max({most.x, most.y, most.z}));
  }
};

struct Scene {
  // In scene.cpp, so that not every file compiles them.
  Scene();
  ~Scene();
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;

  DVec3 origin{0};          // world position, metres, of scene space's zero: the centre of the bounds
  Vec3 lower{0}, upper{0};  // bounds, scene space
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  // unit shading normals, on the front side (counter-clockwise winding) of their triangles
  std::vector<Vec2> uv0, uv1;
  std::vector<std::uint32_t> colors;  // RGBA8 linear; empty when the whole scene has none
  // Unit tangents of normal maps, w = ±1 the side of the bitangent w · cross(normal, tangent); w = 0 where none is
  // given and it follows from the texture coordinates. Empty when the whole scene gives none.
  std::vector<Vec4> tangents;
  std::vector<UVec3> triangles;  // counter-clockwise seen from the front; never degenerate
  // geometric_normal() of the first triangles, kept; it computes those of the others. Who moves vertices clears it.
  std::vector<Vec3> face_normals;
  std::vector<std::uint32_t> triangle_surface;
  // By triangle: the same one seen from behind, where a double-sided surface was split into two one-sided ones; ~0u:
  // none; empty: no triangle has one. Symmetric. A pair stands in a ray's way once: Accel answers with the one whose
  // front the ray meets.
  std::vector<std::uint32_t> twin;
  std::vector<Surface> surfaces;
  std::vector<ChartCut> cuts;  // of walls (wall_cuts.h)
  std::vector<SceneMover> movers;
  std::vector<SceneMover> lamp_motions;  // of lamps that the file animates: their light is baked where they rest
  std::vector<SceneMaterial> materials;
  std::vector<Image> images;
  std::vector<Light> lights;
  std::vector<Camera> cameras;    // scene space
  std::vector<CameraPath> paths;  // scene space
  std::vector<LightProfile> profiles;
  SkyImage sky_image;  // read it by sky_radiance() in sky.h
  Vec3 sky{0};  // radiance of the sky, cd/m² (an option of the bake, not of glTF): constant, or the image's mean
  SkyParts sky_parts;  // none: all of it is of sky_group
  Day day;             // whose suns are among the lights, whose skies are sky_parts
  // Every lamp has one of them; empty: nobody asks whose light it is.
  std::vector<SceneLightGroup> light_groups;
  std::uint32_t sky_group = 0;  // into light_groups
  int light_mirrors = 8;        // that point, spot and directional lights are followed by, at most

  std::uint32_t light_group(std::uint32_t triangle) const { return surfaces[triangle_surface[triangle]].light_group; }
  const SceneMaterial& material_of(std::uint32_t triangle) const {
    return materials[surfaces[triangle_surface[triangle]].material];
  }
  float radius() const { return 0.5f * glm::length(upper - lower); }
};

// Geometric normal (unit, front side) of a triangle, computed in double: right for slivers too.
Vec3 geometric_normal(const Scene& scene, std::uint32_t triangle);
// Finds face_normals of all triangles anew.
void keep_face_normals(Scene& scene);
// m².
double triangle_area(const Scene& scene, std::uint32_t triangle);

}  // namespace oriel
