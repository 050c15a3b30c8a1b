#include "scenes/kit/glb_writer.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "formats/core/glb.h"

namespace oriel::sample {
namespace {

Json to_json(const Vec3& v) {
  return Json::array({v.x, v.y, v.z});
}

// Its extensions are named last.
struct SampleGlb : Glb {
  bool uses_emissive_strength = false, uses_specular = false, uses_glass = false;
};

// Floats as an accessor; with bounds where glTF wants them (positions and animation times).
template <class Vector>
std::size_t add_floats(SampleGlb& glb, const std::vector<Vector>& values, const char* type, int target, bool bounds) {
  constexpr int kComponents = sizeof(Vector) / sizeof(float);
  const std::size_t added =
      glb.add_accessor(std::as_bytes(std::span(values)), target, Glb::kFloats, values.size(), type);
  if (!bounds) return added;
  const std::span<const float> floats(reinterpret_cast<const float*>(values.data()), values.size() * kComponents);
  Json& accessor = glb.json["accessors"][added];
  accessor["min"] = Json::array();
  accessor["max"] = Json::array();
  for (std::size_t c = 0; c < kComponents; ++c) {
    float low = floats[c], high = floats[c];
    for (std::size_t i = c; i < floats.size(); i += kComponents) {
      low = std::min(low, floats[i]);
      high = std::max(high, floats[i]);
    }
    accessor["min"].push_back(low);
    accessor["max"].push_back(high);
  }
  return added;
}

std::size_t add_indices(SampleGlb& glb, const std::vector<std::uint32_t>& indices, std::size_t vertices) {
  // 65535 itself is the primitive restart value, which glTF forbids.
  if (vertices > 65535) return glb.add_indices(indices);
  const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
  return glb.add_accessor(std::as_bytes(std::span(narrow)), Glb::kIndices, Glb::kUint16, narrow.size(), "SCALAR");
}

void add_textures(SampleGlb& glb, const SampleScene& scene) {
  for (const PngTexture& texture : scene.textures) {
    const std::size_t image = glb.add_image(texture.name, texture.png);
    glb.add("textures", {{"name", texture.name}, {"sampler", 0}, {"source", image}});
  }
  if (!scene.textures.empty()) {
    glb.json["samplers"].push_back({{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}});
  }
}

void add_glass(const SampleMaterial& material, Json& extensions, SampleGlb& glb) {
  extensions["KHR_materials_transmission"] = {{"transmissionFactor", material.transmission}};
  extensions["KHR_materials_ior"] = {{"ior", material.ior}};
  glb.uses_glass = true;
  if (material.thickness_m <= 0) return;
  extensions["KHR_materials_volume"] = {{"thicknessFactor", material.thickness_m},
                                        {"attenuationDistance", material.attenuation_distance_m},
                                        {"attenuationColor", to_json(material.attenuation_color)}};
}

void add_materials(SampleGlb& glb, const SampleScene& scene) {
  for (const SampleMaterial& material : scene.materials) {
    Json pbr = {
        {"baseColorFactor", Json::array({material.base_color.r, material.base_color.g, material.base_color.b, 1})}};
    if (material.texture >= 0) pbr["baseColorTexture"] = {{"index", material.texture}};
    pbr["metallicFactor"] = material.metallic;
    pbr["roughnessFactor"] = material.roughness;
    Json out = {{"name", material.name}, {"pbrMetallicRoughness", std::move(pbr)}};
    const float strength = max_component(material.emission);
    if (strength > 0) {
      out["emissiveFactor"] = to_json(material.emission / strength);
      out["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
      glb.uses_emissive_strength = true;
    }
    if (material.specular != 1) {
      out["extensions"]["KHR_materials_specular"] = {{"specularFactor", material.specular}};
      glb.uses_specular = true;
    }
    if (material.transmission > 0) add_glass(material, out["extensions"], glb);
    glb.json["materials"].push_back(std::move(out));
  }
}

void add_meshes(SampleGlb& glb, const SampleScene& scene) {
  for (const SampleMesh& mesh : scene.meshes) {
    Json attributes = {{"POSITION", add_floats(glb, mesh.positions, "VEC3", Glb::kVertices, true)},
                       {"NORMAL", add_floats(glb, mesh.normals, "VEC3", Glb::kVertices, false)}};
    if (scene.materials[mesh.material].texture >= 0) {
      attributes["TEXCOORD_0"] = add_floats(glb, mesh.uvs, "VEC2", Glb::kVertices, false);
    }
    Json primitive = {{"attributes", std::move(attributes)},
                      {"indices", add_indices(glb, mesh.indices, mesh.positions.size())},
                      {"material", mesh.material}};
    glb.json["meshes"].push_back({{"name", mesh.name}, {"primitives", Json::array({std::move(primitive)})}});
  }
}

// The rotation of a camera, which looks along its own -z with +y up, as (x, y, z, w).
Vec4 camera_rotation(const Vec3& forward) {
  const DVec3 back = -glm::normalize(DVec3(forward));
  const bool vertical = std::abs(back.y) > 0.9999;
  const DVec3 right = glm::normalize(glm::cross(vertical ? DVec3(0, 0, -1) : DVec3(0, 1, 0), back));
  const DVec3 up = glm::cross(back, right);
  const auto q = glm::quat_cast(glm::dmat3(right, up, back));
  return Vec4(q.x, q.y, q.z, q.w);
}

Json to_json(const Vec4& q) {
  return Json::array({q.x, q.y, q.z, q.w});
}

int add_camera_node(SampleGlb& glb, const std::string& name, float fov_rad, const Vec3& eye, const Vec3& forward) {
  glb.json["cameras"].push_back(
      {{"name", name}, {"type", "perspective"}, {"perspective", {{"yfov", fov_rad}, {"znear", 0.05}}}});
  glb.json["nodes"].push_back({{"name", name},
                               {"translation", to_json(eye)},
                               {"rotation", to_json(camera_rotation(forward))},
                               {"camera", static_cast<int>(glb.json["cameras"].size()) - 1}});
  return static_cast<int>(glb.json["nodes"].size()) - 1;
}

void add_path(SampleGlb& glb, const Path& path) {
  const int node = add_camera_node(glb, path.name, path.vertical_fov_rad, path.eyes[0], path.forwards[0]);
  std::vector<Vec4> rotations;
  for (const Vec3& forward : path.forwards) {
    const Vec4 q = camera_rotation(forward);
    // The shorter way from key to key: q and -q are the same rotation.
    rotations.push_back(!rotations.empty() && glm::dot(rotations.back(), q) < 0 ? -q : q);
  }
  const std::size_t times = add_floats(glb, path.times_s, "SCALAR", Glb::kNoTarget, true);
  const std::size_t translation = add_floats(glb, path.eyes, "VEC3", Glb::kNoTarget, false);
  const std::size_t rotation = add_floats(glb, rotations, "VEC4", Glb::kNoTarget, false);
  Json animation = Json::object();
  animation["name"] = path.name;
  animation["channels"] = Json::array();
  animation["samplers"] = Json::array();
  const auto channel = [&](std::size_t output, const char* property) {
    animation["channels"].push_back({{"sampler", static_cast<int>(animation["samplers"].size())},
                                     {"target", {{"node", node}, {"path", property}}}});
    animation["samplers"].push_back({{"input", times}, {"output", output}, {"interpolation", "LINEAR"}});
  };
  channel(translation, "translation");
  channel(rotation, "rotation");
  glb.json["animations"].push_back(std::move(animation));
}

void add_nodes(SampleGlb& glb, const SampleScene& scene) {
  for (const Node& node : scene.nodes) {
    Json out = {{"name", node.name}, {"mesh", node.mesh}};
    if (node.position != Vec3(0)) out["translation"] = to_json(node.position);
    if (node.yaw_rad != 0) {
      const double half = 0.5 * static_cast<double>(node.yaw_rad);
      out["rotation"] = Json::array({0, static_cast<float>(std::sin(half)), 0, static_cast<float>(std::cos(half))});
    }
    glb.json["nodes"].push_back(std::move(out));
  }
  for (const SampleCamera& camera : scene.cameras) {
    add_camera_node(glb, camera.name, camera.vertical_fov_rad, camera.eye,
                    normalize_or(camera.target - camera.eye, Vec3(0, 0, -1)));
  }
  for (const Path& path : scene.paths) add_path(glb, path);
}

template <class Vector>
bool all_finite(const std::vector<Vector>& values) {
  const std::span<const float> floats(reinterpret_cast<const float*>(values.data()),
                                      values.size() * sizeof(Vector) / sizeof(float));
  return std::all_of(floats.begin(), floats.end(), [](float f) { return std::isfinite(f); });
}

Status check(const SampleScene& scene) {
  for (const SampleMesh& mesh : scene.meshes) {
    const std::size_t n = mesh.positions.size();
    if (n == 0 || mesh.indices.empty()) return invalid(mesh.name, "found an empty mesh, expected triangles");
    if (mesh.material >= scene.materials.size()) {
      return invalid(mesh.name, "found material {}, expected below {}", mesh.material, scene.materials.size());
    }
    if (mesh.normals.size() != n) return invalid(mesh.name, "found {} normals, expected {}", mesh.normals.size(), n);
    if (scene.materials[mesh.material].texture >= 0 && mesh.uvs.size() != n) {
      return invalid(mesh.name, "found {} uvs, expected {} for a textured material", mesh.uvs.size(), n);
    }
    const std::uint32_t largest = *std::max_element(mesh.indices.begin(), mesh.indices.end());
    if (largest >= n) return invalid(mesh.name, "found index {}, expected below {}", largest, n);
    if (mesh.indices.size() % 3 != 0)
      return invalid(mesh.name, "found {} indices, expected triples", mesh.indices.size());
    if (!all_finite(mesh.positions) || !all_finite(mesh.normals) || !all_finite(mesh.uvs)) {
      return invalid(mesh.name, "found a vertex that is not finite");
    }
  }
  for (const SampleMaterial& material : scene.materials) {
    if (material.texture >= static_cast<int>(scene.textures.size())) {
      return invalid(material.name, "found texture {}, expected below {}", material.texture, scene.textures.size());
    }
  }
  for (const Node& node : scene.nodes) {
    if (node.mesh >= scene.meshes.size()) {
      return invalid(node.name, "found mesh {}, expected below {}", node.mesh, scene.meshes.size());
    }
  }
  for (const Path& path : scene.paths) {
    if (path.eyes.empty() || path.eyes.size() != path.times_s.size() || path.forwards.size() != path.times_s.size()) {
      return invalid(path.name, "found {} eyes and {} directions, expected {} of each and at least one",
                     path.eyes.size(), path.forwards.size(), path.times_s.size());
    }
  }
  return {};
}

}  // namespace

Result<Bytes> write_glb(const SampleScene& scene) {
  ORIEL_TRY_VOID(check(scene));
  SampleGlb glb;
  glb.json["asset"]["generator"] = "oriel-scenes";
  glb.json["scene"] = 0;
  add_textures(glb, scene);
  add_materials(glb, scene);
  add_meshes(glb, scene);
  add_nodes(glb, scene);
  Json roots = Json::array();
  for (std::size_t i = 0; i < glb.json["nodes"].size(); ++i) roots.push_back(i);
  glb.json["scenes"].push_back({{"name", scene.name}, {"nodes", std::move(roots)}});
  if (glb.uses_emissive_strength) glb.json["extensionsUsed"].push_back("KHR_materials_emissive_strength");
  if (glb.uses_specular) glb.json["extensionsUsed"].push_back("KHR_materials_specular");
  if (glb.uses_glass)
    for (const char* name : {"KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_volume"})
      glb.json["extensionsUsed"].push_back(name);
  return glb.file();
}

}  // namespace oriel::sample
