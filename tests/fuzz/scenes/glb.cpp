#include "tests/fuzz/scenes/glb.h"

#include <algorithm>

namespace oriel::fuzz {
namespace {

constexpr int kFloat = 5126, kUint8 = 5121, kUint32 = 5125;

int last(const Json& array) {
  return static_cast<int>(array.size()) - 1;
}

}  // namespace

template <class T>
int Glb::add_array(const std::vector<T>& values, int component_type, const char* type, bool bounds) {
  while (binary_.bytes().size() % 4 != 0) binary_.put(std::uint8_t{0});
  json_["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", binary_.bytes().size()}, {"byteLength", values.size() * sizeof(T)}});
  Json accessor = {{"bufferView", last(json_["bufferViews"])},
                   {"componentType", component_type},
                   {"count", values.size()},
                   {"type", type}};
  if constexpr (std::is_same_v<T, Vec3> || std::is_same_v<T, float>) {
    constexpr std::size_t kComponents = sizeof(T) / sizeof(float);
    const auto* f = reinterpret_cast<const float*>(values.data());
    for (std::size_t c = 0; bounds && c < kComponents; ++c) {
      float low = f[c], high = f[c];
      for (std::size_t i = 0; i < values.size(); ++i)
        low = std::min(low, f[i * kComponents + c]), high = std::max(high, f[i * kComponents + c]);
      accessor["min"].push_back(low);
      accessor["max"].push_back(high);
    }
  }
  binary_.put_array(std::span(reinterpret_cast<const std::byte*>(values.data()), values.size() * sizeof(T)));
  json_["accessors"].push_back(std::move(accessor));
  return last(json_["accessors"]);
}

void Glb::use(const char* extension) {
  Json& used = json_["extensionsUsed"];
  if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

Json& Glb::extension(const char* name) {
  use(name);
  return json_["extensions"][name];
}

int Glb::add_material(Json m) {
  const Json& pbr = m["pbrMetallicRoughness"];
  double albedo = 0, emission = 0;
  for (int c = 0; c < 3; ++c) albedo = std::max(albedo, pbr["baseColorFactor"][c].get<double>());
  if (m.contains("emissiveFactor")) {
    double strength = 1;
    if (m.contains("extensions") && m["extensions"].contains("KHR_materials_emissive_strength"))
      strength = m["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"].get<double>();
    for (int c = 0; c < 3; ++c) emission = std::max(emission, strength * m["emissiveFactor"][c].get<double>());
  }
  sources_.albedo = std::max(sources_.albedo, albedo);
  sources_.radiance = std::max(sources_.radiance, emission);
  if (emission > 0) sources_.lamp_albedo = std::max(sources_.lamp_albedo, albedo);
  const Json extensions = m.value("extensions", Json::object());
  for (const auto& [name, value] : extensions.items()) use(name.c_str());
  if (extensions.contains("KHR_materials_volume"))
    sources_.index = std::max(sources_.index, extensions.value("KHR_materials_ior", Json::object()).value("ior", 1.5));
  json_["materials"].push_back(std::move(m));
  return last(json_["materials"]);
}

int Glb::add_texture(std::span<const std::byte> png) {
  while (binary_.bytes().size() % 4 != 0) binary_.put(std::uint8_t{0});
  json_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.bytes().size()}, {"byteLength", png.size()}});
  binary_.put_array(png);
  json_["images"].push_back({{"mimeType", "image/png"}, {"bufferView", last(json_["bufferViews"])}});
  json_["textures"].push_back({{"source", last(json_["images"])}});
  return last(json_["textures"]);
}

int Glb::add_mesh(const Primitive& p) {
  Json attributes = {{"POSITION", add_array(p.positions, kFloat, "VEC3", true)}};
  if (!p.normals.empty()) attributes["NORMAL"] = add_array(p.normals, kFloat, "VEC3", false);
  if (!p.uvs.empty()) attributes["TEXCOORD_0"] = add_array(p.uvs, kFloat, "VEC2", false);
  if (!p.tangents.empty()) attributes["TANGENT"] = add_array(p.tangents, kFloat, "VEC4", false);
  if (p.skinned) {
    float middle = 0;
    for (const Vec3& v : p.positions) middle += v.y / static_cast<float>(p.positions.size());
    std::vector<glm::u8vec4> joints;
    for (const Vec3& v : p.positions) joints.push_back({v.y > middle ? 1 : 0, 0, 0, 0});
    attributes["JOINTS_0"] = add_array(joints, kUint8, "VEC4", false);
    attributes["WEIGHTS_0"] = add_array(std::vector<Vec4>(p.positions.size(), Vec4(1, 0, 0, 0)), kFloat, "VEC4", false);
  }
  Json primitive = {{"attributes", std::move(attributes)}, {"indices", add_array(p.indices, kUint32, "SCALAR", false)}};
  if (p.material >= 0) primitive["material"] = p.material;
  json_["meshes"].push_back({{"primitives", Json::array({std::move(primitive)})}});
  double area = 0;
  for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
    const DVec3 a(p.positions[p.indices[i]]), b(p.positions[p.indices[i + 1]]), c(p.positions[p.indices[i + 2]]);
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  mesh_area_.push_back(area);
  mesh_triangles_.push_back(p.indices.size() / 3);
  return last(json_["meshes"]);
}

int Glb::add_child(Json node) {
  if (node.contains("mesh")) {
    const auto mesh = node["mesh"].get<std::size_t>();
    area_ += mesh_area_[mesh];
    sources_.triangles += mesh_triangles_[mesh];
  }
  json_["nodes"].push_back(std::move(node));
  return last(json_["nodes"]);
}

int Glb::add_node(Json node) {
  top_.push_back(add_child(std::move(node)));
  return top_.back();
}

int Glb::add_light(Json light) {
  const double intensity = light.value("intensity", 1.0);
  ++sources_.lights;
  if (light["type"] == "directional")
    sources_.illuminance += intensity;
  else
    sources_.power_lm += 4 * kPiD * intensity;
  Json& lights = extension("KHR_lights_punctual")["lights"];
  lights.push_back(std::move(light));
  return last(lights);
}

int Glb::add_camera(float yfov_rad) {
  json_["cameras"].push_back({{"type", "perspective"}, {"perspective", {{"yfov", yfov_rad}, {"znear", 0.05}}}});
  return last(json_["cameras"]);
}

void Glb::animate(int node, const Vec3& to) {
  const int times = add_array(std::vector<float>{0, 1, 2}, kFloat, "SCALAR", true);
  const int places = add_array(std::vector<Vec3>{Vec3(0), to, Vec3(0)}, kFloat, "VEC3", false);
  json_["animations"].push_back(
      {{"channels", Json::array({{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}}})},
       {"samplers", Json::array({{{"input", times}, {"output", places}, {"interpolation", "LINEAR"}}})}});
}

int Glb::add_skin(const std::vector<int>& joints) {
  json_["skins"].push_back({{"joints", joints}});
  return last(json_["skins"]);
}

Bytes Glb::finish(double scale, const DVec3& offset) {
  json_["asset"] = {{"version", "2.0"}};
  Json root = {{"name", "root"}, {"scale", {scale, scale, scale}}, {"translation", {offset.x, offset.y, offset.z}}};
  if (!top_.empty()) root["children"] = top_;
  json_["nodes"].push_back(std::move(root));
  json_["scene"] = 0;
  json_["scenes"].push_back({{"nodes", Json::array({last(json_["nodes"])})}});
  while (binary_.bytes().size() % 4 != 0) binary_.put(std::uint8_t{0});
  const Bytes binary = binary_.take();
  if (!binary.empty()) json_["buffers"].push_back({{"byteLength", binary.size()}});
  std::string text = json_.dump();
  while (text.size() % 4 != 0) text += ' ';
  ByteWriter out;
  const auto put32 = [&](std::size_t value) { out.put(static_cast<std::uint32_t>(value)); };
  put32(0x46546C67);  // "glTF"
  put32(2);
  put32(12 + 8 + text.size() + (binary.empty() ? 0 : 8 + binary.size()));
  put32(text.size());
  put32(0x4E4F534A);  // "JSON"
  out.put_array(std::span<const char>(text));
  if (!binary.empty()) {
    put32(binary.size());
    put32(0x004E4942);  // "BIN"
    out.put_array(std::span<const std::byte>(binary));
  }
  return out.take();
}

}  // namespace oriel::fuzz
