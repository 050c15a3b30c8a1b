// A glTF file in the making. Unlike the sample scenes' writer it checks nothing: what it is for is odd, but valid.
#pragma once

#include <optional>
#include <span>

#include "formats/core/bytes.h"
#include "formats/core/json.h"
#include "formats/core/vec.h"

namespace oriel::fuzz {

// Triangles of one primitive. What is empty is left out of the file; the other arrays are as long as positions.
struct Primitive {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> uvs;
  std::vector<Vec4> tangents;
  std::vector<std::uint32_t> indices;
  int material = -1;
  bool skinned = false;  // to joint 0 below, joint 1 above its middle height
};

// What bounds the light of a scene: the sources, and how they are built.
struct Sources {
  double radiance = 0;     // of the brightest emissive surface, cd/m²
  double power_lm = 0;     // of all point and spot lights
  double illuminance = 0;  // of all directional lights, lux
  double lamp_albedo = 0;  // the largest of an emissive surface
  double albedo = 0;       // the largest of any surface
  double index = 1;        // the largest of solid glass
  std::size_t lights = 0;  // punctual ones
  std::size_t triangles = 0;
};

class Glb {
 public:
  // m: a glTF material as JSON; what it says of emission and albedo is noted in sources().
  int add_material(Json m);
  int add_texture(std::span<const std::byte> png);  // returns the texture's index
  int add_mesh(const Primitive& primitive);
  // Appends a node below the root, and returns its index.
  int add_node(Json node);
  int add_child(Json node);   // a node that some other names as a child or a joint
  int add_light(Json light);  // of KHR_lights_punctual, returns its index
  int add_camera(float yfov_rad);
  // Moves node along `to` and back.
  void animate(int node, const Vec3& to);
  int add_skin(const std::vector<int>& joints);
  void use(const char* extension);

  // Mesh areas as nodes use them, m² before the root's scale.
  double area() const { return area_; }
  const Sources& sources() const { return sources_; }

  // The file: all nodes below one root with that scale and place.
  Bytes finish(double scale, const DVec3& offset);

 private:
  template <class T>
  int add_array(const std::vector<T>& values, int component_type, const char* type, bool bounds);
  Json& extension(const char* name);

  Json json_ = Json::object();
  ByteWriter binary_;
  std::vector<int> top_;
  std::vector<double> mesh_area_;
  std::vector<std::size_t> mesh_triangles_;
  double area_ = 0;
  Sources sources_;
};

}  // namespace oriel::fuzz
