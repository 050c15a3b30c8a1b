// A glTF document as plain structs: every reference resolved, every offset inside of what it points into. Only the
// bytes of buffers are not looked at here. Names follow glTF 2.0.
#pragma once

#include <map>
#include <optional>

#include "bake/import/json.h"
#include "bake/import/object_keys.h"
#include "bake/jobs/context.h"
#include "bake/scene/scene.h"

namespace oriel::gltf {

struct BufferDesc {
  std::optional<std::string> uri;  // none: the BIN chunk of a GLB
  std::uint64_t byte_length = 0;
  bool fallback = false;  // EXT_meshopt_compression: holds nothing, only compressed views point into it
};

// EXT_meshopt_compression: where a view's bytes come from instead of its buffer.
struct MeshoptDesc {
  enum class Mode { kAttributes, kTriangles, kIndices };
  enum class Filter { kNone, kOctahedral, kQuaternion, kExponential };
  int buffer = -1;
  std::uint64_t offset = 0, length = 0, stride = 0, count = 0;
  Mode mode = Mode::kAttributes;
  Filter filter = Filter::kNone;
};

struct ViewDesc {
  int buffer = -1;
  std::uint64_t offset = 0, length = 0, stride = 0;  // stride 0: tightly packed
  std::optional<MeshoptDesc> meshopt;
};

enum class ComponentType {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126
};
std::uint64_t component_size(ComponentType type);

struct SparseDesc {
  std::uint64_t count = 0;
  int indices_view = -1, values_view = -1;
  std::uint64_t indices_offset = 0, values_offset = 0;
  ComponentType indices_type = ComponentType::kUnsignedInt;
};

struct AccessorDesc {
  int view = -1;  // -1: zeros, or Draco's
  std::uint64_t offset = 0, count = 0;
  ComponentType type = ComponentType::kFloat;
  bool normalized = false;
  bool matrix = false;
  std::uint32_t components = 1;    // 1 to 16
  std::uint64_t element_size = 4;  // bytes, with the padding of matrix columns
  std::optional<SparseDesc> sparse;
};

struct ImageDesc {
  std::string name;
  std::optional<std::string> uri;
  int view = -1;
};

struct DracoDesc {
  int view = -1;
  std::map<std::string, std::uint32_t> attributes;  // semantic → unique id in the Draco mesh
};

// A morph target: what it adds to vertices.
struct TargetDesc {
  std::map<std::string, int> attributes;  // semantic → accessor
  bool used = false;                      // some node gives it a weight
};

struct PrimitiveDesc {
  std::string path;  // "meshes[0].primitives[1]"
  int mode = 4;
  int indices = -1, material = -1;
  std::map<std::string, int> attributes;  // semantic → accessor
  std::vector<TargetDesc> targets;
  bool skinned = false;  // by some node
  std::optional<DracoDesc> draco;
};

struct MeshDesc {
  std::string name;
  std::vector<double> weights;  // of morph targets, where a node has none of its own
  std::vector<PrimitiveDesc> primitives;
};

struct NodeDesc {
  std::string name;
  int mesh = -1, camera = -1, light = -1, skin = -1, parent = -1;
  std::vector<double> weights;    // of its mesh's morph targets; empty: the mesh's
  ObjectKeys keys;                // extras.oriel
  bool hidden = false;            // KHR_node_visibility: and all below it
  float angular_radius_rad = -1;  // for its directional light; < 0: the light's own
  std::vector<std::uint32_t> children;
  bool has_matrix = false;
  DMat4 matrix{1};                                 // parent_from_node
  DVec3 translation{0}, scale{1};                  // unless has_matrix
  DVec4 rotation{0, 0, 0, 1};                      // unit quaternion x, y, z, w
  bool instanced = false;                          // EXT_mesh_gpu_instancing
  std::map<std::string, int> instance_attributes;  // TRANSLATION, ROTATION, SCALE → accessor
};
// parent_from_node of a translation, a unit quaternion and a scale.
DMat4 matrix_from_trs(const DVec3& translation, const DVec4& rotation, const DVec3& scale);

struct SkinDesc {
  std::vector<std::uint32_t> joints;  // nodes
  int inverse_bind = -1;              // accessor of a matrix a joint; -1: identities
};

struct CameraDesc {
  std::string name;
  bool perspective = true;
  double vertical_fov_rad = 1, half_height = 1;
  bool usable = true;  // else no node shows it
};

struct AnimationDesc {
  struct Sampler {
    int input = -1, output = -1;
    enum class Interpolation { kLinear, kStep, kCubicSpline } interpolation = Interpolation::kLinear;
  };
  struct Channel {
    std::string file_path;  // "animations[0].channels[2]"
    int sampler = -1, node = -1;
    std::string target;  // "translation", …
  };
  std::string name;
  std::vector<Sampler> samplers;
  std::vector<Channel> channels;
};

struct SceneDesc {
  std::string name;
  std::vector<std::uint32_t> nodes;
};

struct Document {
  std::string file;
  std::vector<BufferDesc> buffers;
  std::vector<ViewDesc> views;
  std::vector<AccessorDesc> accessors;
  std::vector<ImageDesc> images;
  std::vector<SceneMaterial> materials;  // texture slots hold indices into images
  std::vector<MeshDesc> meshes;
  std::vector<NodeDesc> nodes;
  std::vector<SkinDesc> skins;
  std::vector<SceneDesc> scenes;
  std::vector<CameraDesc> cameras;
  std::vector<Light> lights;  // not placed
  std::vector<AnimationDesc> animations;
  int default_scene = -1;
  bool quantized = false;         // KHR_mesh_quantization is in use
  std::vector<Warning> warnings;  // what the user should know and what is left out, one line each
};

// Error kInvalid for whatever breaks glTF 2.0, and for a required extension that Oriel does not know.
Result<Document> parse_document(JsonDocument& json);

// extras.oriel.KEY, oriel_KEY and oriel.KEY of a material or a node. What is no key of ours, or no
// value of it, is said and ignored.
ObjectKeys parse_object_keys(const JsonAt& value);

// Its parts, in the order in which they need each other.
void parse_materials(const JsonAt& root, Document& document);
void parse_meshes(const JsonAt& root, std::size_t materials, Document& document);
void parse_nodes(const JsonAt& root, Document& document);

}  // namespace oriel::gltf
