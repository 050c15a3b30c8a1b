#include "preview/frame/scene_edits.h"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "bake/import/container.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

Json numbers(const Vec3& v) {
  return {v.x, v.y, v.z};
}

void use_extension(Json& file, const char* name) {
  Json& used = file["extensionsUsed"];
  if (!used.is_array()) used = Json::array();
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

void write_material(Json& file, std::uint32_t index, const MaterialEdit& edit) {
  Json& material = file["materials"][index];
  Json& surface = material["pbrMetallicRoughness"];
  const Json* color = surface.find("baseColorFactor");
  const double alpha = color && color->size() == 4 ? (*color)[3].get<double>() : 1.0;
  surface["baseColorFactor"] = {edit.base_color.x, edit.base_color.y, edit.base_color.z, alpha};
  surface["roughnessFactor"] = edit.roughness;
  // A factor of at most 1, and its strength.
  const float strength = std::max(max_component(edit.emission), 1.0f);
  material["emissiveFactor"] = numbers(edit.emission / strength);
  if (strength > 1) {
    material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    use_extension(file, "KHR_materials_emissive_strength");
  } else if (material.contains("extensions")) {
    material["extensions"].erase("KHR_materials_emissive_strength");
  }
}

DMat3 linear_of(const Json& node) {
  DMat3 out(1);
  if (const Json* matrix = node.find("matrix")) {
    for (int k = 0; k < 9; ++k)
      out[k / 3][k % 3] = matrix->at(static_cast<std::size_t>(4 * (k / 3) + k % 3)).get<double>();
    return out;
  }
  const auto q = node.value("rotation", std::vector<double>{0, 0, 0, 1});
  const auto s = node.value("scale", std::vector<double>{1, 1, 1});
  out = glm::mat3_cast(glm::dquat(q.at(3), q.at(0), q.at(1), q.at(2)));
  for (int axis = 0; axis < 3; ++axis) out[axis] *= s.at(static_cast<std::size_t>(axis));
  return out;
}

// What turns and scales all below a node's parent; world from there.
DMat3 world_from_parent(const Json& nodes, std::size_t of) {
  DMat3 out(1);
  for (std::size_t steps = 0; steps < nodes.size(); ++steps) {
    const auto parent = std::find_if(nodes.begin(), nodes.end(), [&](const Json& node) {
      const Json children = node.value("children", Json::array());
      return std::find(children.begin(), children.end(), of) != children.end();
    });
    if (parent == nodes.end()) break;
    out = linear_of(*parent) * out;
    of = static_cast<std::size_t>(parent - nodes.begin());
  }
  return out;
}

// False: its parents have no size.
bool move_node(Json& nodes, std::size_t index, const Vec3& moved) {
  const DMat3 linear = world_from_parent(nodes, index);
  if (!(std::abs(glm::determinant(linear)) > 0)) return false;
  const DVec3 by = glm::inverse(linear) * DVec3(moved);
  Json& node = nodes[index];
  const bool has_matrix = node.contains("matrix");
  Json& place = has_matrix ? node["matrix"] : node["translation"];
  if (!place.is_array()) place = {0.0, 0.0, 0.0};
  for (int axis = 0; axis < 3; ++axis) {
    Json& value = place.at(static_cast<std::size_t>(axis + (has_matrix ? 12 : 0)));
    value = value.get<double>() + by[axis];
  }
  return true;
}

bool write_light(Json& file, const std::string& name, const LightEdit& edit) {
  bool found = false;
  Json& nodes = file["nodes"];
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const Json& node = nodes[n];
    const Json* place = node["extensions"]["KHR_lights_punctual"].find("light");
    if (!place) continue;
    const auto index = place->get<std::size_t>();
    Json& light = file["extensions"]["KHR_lights_punctual"]["lights"][index];
    std::string own = node.value("name", "");
    if (own.empty()) own = light.value("name", fmt::format("light {}", index));
    if (own != name) continue;
    light["color"] = numbers(edit.color);
    light["intensity"] = edit.intensity;
    found = edit.moved == Vec3(0) || move_node(nodes, n, edit.moved);
  }
  return found;
}

// 12 bytes of header, the JSON chunk padded by spaces, whatever followed it.
Bytes with_json(std::span<const std::byte> glb, std::span<const std::byte> old_json, std::string json) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto after = static_cast<std::size_t>(old_json.data() + old_json.size() - glb.data());
  const std::span<const std::byte> rest = glb.subspan(after);
  ByteWriter out;
  out.put_array(glb.first(8));
  out.put(static_cast<std::uint32_t>(20 + json.size() + rest.size()));
  out.put(static_cast<std::uint32_t>(json.size()));
  out.put_array(glb.subspan(16, 4));
  out.put_array(std::span<const char>(json));
  out.put_array(rest);
  return out.take();
}

}  // namespace

bool is_alone(const Scene& scene, const std::string& light) {
  return std::ranges::count(scene.lights, light, &Light::name) == 1;
}

MaterialEdit edit_of(const SceneMaterial& m) {
  return {m.base_color, m.roughness, m.emission};
}

LightEdit edit_of(const Light& light) {
  const float most = std::max(max_component(light.color), 1e-30f);
  return {light.color / most, max_component(light.intensity), light.position};
}

SceneEdits edits_of(const Scene& scene) {
  SceneEdits all;
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m) all.materials[m] = edit_of(scene.materials[m]);
  for (const Light& light : scene.lights) all.lights[light.name] = edit_of(light);
  return all;
}

void edit_scene(PreviewScene& scene, const SceneEdits& edits) {
  std::vector<SceneMaterial>& materials = scene.imported.scene.materials;
  for (const auto& [index, edit] : edits.materials) {
    if (index >= materials.size()) continue;
    const std::string name = materials[index].name;
    for (std::size_t m = 0; m < materials.size(); ++m) {
      // Copies that the import made bear the name, as movers have them.
      if (m != index && (name.empty() || m < index || materials[m].name != name)) continue;
      materials[m].base_color = edit.base_color;
      materials[m].roughness = edit.roughness;
      materials[m].emission = edit.emission;
    }
  }
  for (Light& light : scene.imported.scene.lights)
    if (const auto edit = edits.lights.find(light.name); edit != edits.lights.end()) {
      light.color = edit->second.color;
      light.intensity = edit->second.intensity * edit->second.color;
      if (is_alone(scene.scene(), light.name)) light.position = edit->second.place;
    }
  find_lamps(scene);
}

void follow_places(const SceneEdits& originals, const Vec3& shift, SceneEdits& edits) {
  for (auto& [name, edit] : edits.lights) {
    const auto original = originals.lights.find(name);
    if (original == originals.lights.end()) continue;
    const Vec3& there = original->second.place;
    edit.place = edit.moved == Vec3(0) ? there : edit.place + shift;
    edit.moved = edit.place - there;
  }
}

Result<Bytes> edited_file(std::span<const std::byte> file, const std::string& name, const SceneEdits& edits) {
  ORIEL_TRY(const gltf::Container parts, gltf::split_container(file, name));
  Json json = Json::parse(parts.json).value_or(Json());
  if (!json.is_object()) return invalid(name, "found no JSON object, expected a glTF file");
  try {
    for (const auto& [index, edit] : edits.materials) {
      if (index >= json.value("materials", Json::array()).size())
        return invalid(name, "found no material {}, expected the one that was changed", index);
      write_material(json, index, edit);
    }
    for (const auto& [light, edit] : edits.lights)
      if (!write_light(json, light, edit))
        return invalid(name, "found no node or light \"{}\", expected the one that was changed", light);
  } catch (const std::exception& error) {
    return invalid(name, "found JSON that is no glTF: {}", error.what());
  }
  if (!parts.binary && file.data() == parts.json.data()) return bytes_of_text(json.dump(2) + "\n");
  return with_json(file, parts.json, json.dump());
}

}  // namespace oriel
