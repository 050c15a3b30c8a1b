// A scene as the baker sees it: plain structs, everything checked (docs/conventions.md).
#pragma once

#include <string>
#include <vector>

#include "formats/assets/camera.h"
#include "formats/assets/material.h"
#include "formats/core/vec.h"

namespace oriel {

// An image as stored: RGBA, 8 bits, rows from the top. Colour slots decode it as sRGB, data slots as linear.
struct Image {
  std::string name;
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> texels;  // 4 * width * height
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
  float transmission = 0;              // KHR_materials_transmission, treated as thin
  TextureSlot transmission_texture;    // R: multiplies transmission
  TextureSlot normal_texture;          // RGB: 2 v - 1 in the tangent frame
  float normal_scale = 1;              // of its x and y
  AlphaMode alpha_mode = AlphaMode::kOpaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  bool unlit = false;
};

// A primitive of a node, placed in the world.
struct Surface {
  std::string name;  // the node's name, or "mesh/primitive" where it has none
  std::string mesh_name;
  std::uint32_t material = 0;
  std::uint32_t first_triangle = 0, triangle_count = 0;  // into Scene::triangles
  std::uint32_t first_vertex = 0, vertex_count = 0;      // into the vertex arrays; not shared with other surfaces
  bool has_uv1 = false;
};

enum class LightType : std::uint8_t { kPoint, kSpot, kDirectional };

// KHR_lights_punctual.
struct Light {
  std::string name;
  LightType type = LightType::kPoint;
  Vec3 position{0};          // scene space
  Vec3 direction{0, 0, -1};  // unit, the way the light travels (spot, directional)
  Vec3 intensity{0};         // colour * intensity: cd (point, spot) or lux on a facing plane (directional)
  float inner_cone_rad = 0, outer_cone_rad = 0.7853982f;  // spot: half angles
};

// All surfaces flattened into world-oriented triangles. Scene space is metres relative to `origin`, so that floats stay
// precise far from the world's origin. Vertex arrays have the same length.
struct Scene {
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
  std::vector<std::uint32_t> triangle_surface;
  std::vector<Surface> surfaces;
  std::vector<SceneMaterial> materials;
  std::vector<Image> images;
  std::vector<Light> lights;
  std::vector<Camera> cameras;    // scene space
  std::vector<CameraPath> paths;  // scene space
  Vec3 sky{0};                    // constant sky radiance, cd/m² (an option of the bake, not of glTF)

  float radius() const { return 0.5f * glm::length(upper - lower); }
};

// Geometric normal (unit, front side) of a triangle, computed in double: right for slivers too.
Vec3 geometric_normal(const Scene& scene, std::uint32_t triangle);
// m².
double triangle_area(const Scene& scene, std::uint32_t triangle);

}  // namespace oriel
