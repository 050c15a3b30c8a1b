// A sample scene in memory: what the generators fill and the GLB writer writes. Metres, +Y up, right-handed, as glTF.
#pragma once

#include <string>
#include <vector>

#include "formats/core/bytes.h"
#include "formats/core/vec.h"

namespace oriel::sample {

struct PngTexture {
  std::string name;
  Bytes png;
};

// glTF's metallic-roughness. The defaults are a purely diffuse surface: a dielectric without its specular lobe.
struct SampleMaterial {
  std::string name;
  Vec3 base_color{0.8f};  // linear
  float metallic = 0;
  float roughness = 1;
  float specular = 0;  // KHR_materials_specular
  float transmission = 0, ior = 1.5f;
  float thickness_m = 0;      // KHR_materials_volume; 0: thin
  Vec3 attenuation_color{1};  // what is left of white light after attenuation_distance_m of it
  float attenuation_distance_m = 1;
  Vec3 emission{0};  // cd/m²
  int texture = -1;  // base colour, into SampleScene::textures; its meshes must have uvs
};

// One primitive. positions and normals have one length, uvs that length or none.
struct SampleMesh {
  std::string name;
  std::uint32_t material = 0;
  std::vector<Vec3> positions = {};
  std::vector<Vec3> normals = {};  // unit
  std::vector<Vec2> uvs = {};
  std::vector<std::uint32_t> indices = {};  // triangles, counter-clockwise from the front

  std::size_t triangle_count() const { return indices.size() / 3; }
};

// A mesh put into the world: turned about +Y, then moved.
struct Node {
  std::string name;
  std::uint32_t mesh = 0;
  Vec3 position{0};
  float yaw_rad = 0;  // turns +z towards +x
};

struct SampleCamera {
  std::string name;
  Vec3 eye{0}, target{0, 0, -1};
  float vertical_fov_rad = 1;
};

// An animated camera.
struct Path {
  std::string name;
  float vertical_fov_rad = 1;
  std::vector<float> times_s;  // ascending
  std::vector<Vec3> eyes;
  std::vector<Vec3> forwards;  // unit
};

struct SampleScene {
  std::string name;
  std::vector<PngTexture> textures;
  std::vector<SampleMaterial> materials;
  std::vector<SampleMesh> meshes;
  std::vector<Node> nodes;
  std::vector<SampleCamera> cameras;
  std::vector<Path> paths;
};

std::uint32_t add_material(SampleScene& scene, SampleMaterial material);
std::uint32_t add_mesh(SampleScene& scene, SampleMesh mesh);
// A mesh used once: a mesh and its node, both with the mesh's name.
void place(SampleScene& scene, SampleMesh mesh, const Vec3& position = Vec3(0), float yaw_rad = 0);
// One more use of a mesh.
void place(SampleScene& scene, std::uint32_t mesh, std::string name, const Vec3& position, float yaw_rad = 0);

// A purely diffuse material, which may emit (cd/m²); its index.
std::uint32_t add_diffuse(SampleScene& scene, std::string name, const Vec3& color, const Vec3& emission = Vec3(0));

// Everything `factor` times as large about the origin, cameras and walks too. Radiance stays: light falls as before.
void scale_scene(SampleScene& scene, double factor);

// Triangles drawn: those of each node's mesh.
std::uint64_t triangle_count(const SampleScene& scene);

}  // namespace oriel::sample
