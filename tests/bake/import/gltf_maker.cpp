#include "tests/bake/import/gltf_maker.h"

#include <unistd.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <set>

namespace oriel::test {
namespace fs = std::filesystem;

TempFolder::TempFolder() {
  static std::atomic<int> count{0};
  path_ = fs::temp_directory_path() / fmt::format("oriel-scene-test-{}-{}", ::getpid(), count++);
  fs::create_directories(path_);
}
TempFolder::~TempFolder() {
  std::error_code ec;
  fs::remove_all(path_, ec);
}
fs::path TempFolder::write(const std::string& name, const std::string& bytes) const {
  const fs::path file = path_ / name;
  fs::create_directories(file.parent_path());
  fs::remove(file);  // rewriting in place makes some file systems flush: slow, a thousand times over
  std::ofstream(file, std::ios::binary) << bytes;
  return file;
}

std::string base64(const std::string& bytes) {
  static const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : letters[group >> (18 - 6 * k) & 63];
  }
  return out;
}

int Gltf::view(const std::string& bytes) {
  buffer.resize((buffer.size() + 3) / 4 * 4);
  doc["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
  buffer += bytes;
  return static_cast<int>(doc["bufferViews"].size()) - 1;
}

int Gltf::accessor(const std::string& bytes, int component_type, const std::string& type, std::size_t count,
                   bool normalized) {
  json a = {{"bufferView", view(bytes)}, {"componentType", component_type}, {"type", type}, {"count", count}};
  if (normalized) a["normalized"] = true;
  doc["accessors"].push_back(std::move(a));
  return static_cast<int>(doc["accessors"].size()) - 1;
}

int Gltf::floats(const std::string& type, const std::vector<float>& values) {
  const std::size_t width = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
  return accessor(std::string(reinterpret_cast<const char*>(values.data()), values.size() * 4), 5126, type,
                  values.size() / width);
}

int Gltf::indices(const std::vector<std::uint16_t>& values) {
  return accessor(std::string(reinterpret_cast<const char*>(values.data()), values.size() * 2), 5123, "SCALAR",
                  values.size());
}

json& Gltf::add(const json& primitive) {
  doc["meshes"].push_back({{"primitives", json::array({primitive})}});
  doc["nodes"].push_back({{"mesh", doc["meshes"].size() - 1}});
  doc["scenes"][0]["nodes"].push_back(doc["nodes"].size() - 1);
  return doc["nodes"].back();
}

json& Gltf::add_triangle() {
  return add({{"attributes", {{"POSITION", floats("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
}

json& Gltf::material() {
  doc["materials"].push_back(json::object());
  return doc["materials"].back();
}

void Gltf::use(const char* extension, bool require) {
  doc["extensionsUsed"].push_back(extension);
  if (require) doc["extensionsRequired"].push_back(extension);
}

std::string Gltf::text() const {
  json out = doc;
  if (!buffer.empty() && !out.contains("buffers"))
    out["buffers"] = {
        {{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}};
  return out.dump();
}

std::string Gltf::glb() const {
  json out = doc;
  out["buffers"] = {{{"byteLength", buffer.size()}}};
  std::string text = out.dump(), binary = buffer;
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto u32 = [](std::size_t v) {
    const auto n = static_cast<std::uint32_t>(v);
    return std::string(reinterpret_cast<const char*>(&n), 4);
  };
  return "glTF" + u32(2) + u32(28 + text.size() + binary.size()) + u32(text.size()) + "JSON" + text +
         u32(binary.size()) + std::string("BIN\0", 4) + binary;
}

Gltf triangle() {
  Gltf g;
  g.add_triangle();
  return g;
}

void animate(Gltf& g, int node, const char* path, const std::vector<float>& times, const std::vector<float>& values,
             const char* interpolation) {
  json& animation = g.doc["animations"][0];
  animation["samplers"].push_back({{"input", g.floats("SCALAR", times)},
                                   {"output", g.floats(std::string(path) == "rotation" ? "VEC4" : "VEC3", values)},
                                   {"interpolation", interpolation}});
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

bool Imported::warned(const std::string& text) const {
  for (const std::string& w : warnings)
    if (w.find(text) != std::string::npos) return true;
  return false;
}

Imported import_file(const fs::path& path, const ImportOptions& options) {
  Imported out;
  Context context;
  context.warn = [&](const Warning& said) { out.warnings.push_back(said.text); };
  out.result = import_gltf(path, options, context);
  return out;
}

Imported import_bytes(const std::string& bytes, const ImportOptions& options) {
  static const TempFolder folder;
  return import_file(folder.write("scene.gltf", bytes), options);
}

Imported import(const Gltf& gltf, const ImportOptions& options) {
  return import_bytes(gltf.text(), options);
}

namespace {

std::string broken_surface(const Scene& scene, std::size_t s) {
  const Surface& surface = scene.surfaces[s];
  if (surface.triangle_count == 0) return fmt::format("surface {} is empty", s);
  if (surface.material >= scene.materials.size()) return fmt::format("surface {} has material {}", s, surface.material);
  for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t) {
    if (scene.triangle_surface[t] != s) return fmt::format("triangle {} is not of surface {}", t, s);
    const Vec3 front = geometric_normal(scene, t);
    if (!(std::abs(glm::length(front) - 1) < 1e-5f)) return fmt::format("triangle {} has no normal", t);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = scene.triangles[t][k];
      if (v < surface.first_vertex || v >= surface.first_vertex + surface.vertex_count)
        return fmt::format("triangle {} leaves its surface", t);
      if (!(glm::dot(scene.normals[v], front) > 0)) return fmt::format("a normal of triangle {} is on its back", t);
    }
  }
  return "";
}

}  // namespace

std::string broken_promise(const Scene& scene) {
  const std::size_t n = scene.positions.size();
  if (scene.normals.size() != n || scene.uv0.size() != n || scene.uv1.size() != n)
    return "vertex arrays differ in length";
  if (!scene.colors.empty() && scene.colors.size() != n) return "colours differ in length";
  if (scene.triangles.empty() || scene.triangle_surface.size() != scene.triangles.size()) return "triangle arrays";
  if (!scene.tangents.empty() && scene.tangents.size() != n) return "tangents differ in length";
  for (std::size_t v = 0; v < scene.tangents.size(); ++v) {
    const Vec4& t = scene.tangents[v];
    if (t.w != 0 && !(std::abs(t.w) == 1 && std::abs(glm::length(Vec3(t)) - 1) < 1e-5f))
      return fmt::format("tangent {} has length {} and side {}", v, glm::length(Vec3(t)), t.w);
  }
  for (std::size_t v = 0; v < n; ++v) {
    if (!is_finite(scene.positions[v]) || !is_finite(Vec3(scene.uv0[v], 0)) || !is_finite(Vec3(scene.uv1[v], 0)))
      return fmt::format("vertex {} is not finite", v);
    if (!(std::abs(glm::length(scene.normals[v]) - 1) < 1e-5f))
      return fmt::format("normal {} has length {}", v, glm::length(scene.normals[v]));
    for (int k = 0; k < 3; ++k)
      if (scene.positions[v][k] < scene.lower[k] || scene.positions[v][k] > scene.upper[k])
        return fmt::format("vertex {} leaves the bounds", v);
  }
  std::uint32_t triangle = 0, vertex = 0;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    if (scene.surfaces[s].first_triangle != triangle || scene.surfaces[s].first_vertex != vertex)
      return fmt::format("surface {} does not follow the one before", s);
    triangle += scene.surfaces[s].triangle_count;
    vertex += scene.surfaces[s].vertex_count;
    if (std::string broken = broken_surface(scene, s); !broken.empty()) return broken;
  }
  if (triangle != scene.triangles.size() || vertex != n) return "surfaces do not cover all";
  for (const Image& image : scene.images)
    if (image.width == 0 || image.height == 0 || image.texels.size() != std::size_t{4} * image.width * image.height)
      return "image of wrong size";
  const auto count = static_cast<std::int32_t>(scene.images.size());
  for (const SceneMaterial& m : scene.materials)
    for (const TextureSlot* slot :
         {&m.base_color_texture, &m.metallic_roughness_texture, &m.emission_texture, &m.transmission_texture,
          &m.specular_texture, &m.specular_color_texture, &m.normal_texture})
      if (slot->image < -1 || slot->image >= count || slot->texcoord > 1)
        return "texture slot out of range in " + m.name;
  return "";
}

}  // namespace oriel::test
