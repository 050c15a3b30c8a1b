#include "convert/importer/materials.h"

#include <assimp/GltfMaterial.h>

#include <cmath>

namespace oriel {
namespace {

constexpr float kBlack = 0.04f;  // a surface that reflects less diffusely than a dielectric does specularly
constexpr float kMirror = 0.6f;  // specular colour of black metals; black plastics are given 0.5 by default
constexpr float kPlain = 0.8f;   // reflectance of what has no material: white paint, as Blender's

Vec3 rgb(const aiColor3D& c) {
  return Vec3(c.r, c.g, c.b);
}
Json list_of(const Vec3& v) {
  return {v.r, v.g, v.b};
}

class Converter {
 public:
  Converter(const SourceScene& source, const aiMaterial& material, Textures& textures, Glb& glb)
      : source_(source), material_(material), textures_(textures), glb_(glb) {}

  Json run() {
    // What these formats do not say, and their programs show from both sides.
    Json out = {{"name", material_.GetName().C_Str()}, {"doubleSided", true}};
    Json pbr = Json::object();
    add_base(out, pbr);
    pbr["roughnessFactor"] = roughness();
    if (Json map = textures_.reference(material_, aiTextureType_METALNESS); !map.is_null() && is_packed())
      pbr["metallicRoughnessTexture"] = std::move(map), pbr["metallicFactor"] = pbr["roughnessFactor"] = 1;
    out["pbrMetallicRoughness"] = std::move(pbr);
    add_normals(out);
    add_emission(out);
    return out;
  }

 private:
  Vec3 color(const char* key, unsigned type, unsigned index, const Vec3& otherwise) const {
    aiColor3D value(0, 0, 0);
    if (material_.Get(key, type, index, value) != AI_SUCCESS) return otherwise;
    const Vec3 found = rgb(value);
    return std::isfinite(found.r + found.g + found.b) ? glm::max(found, Vec3(0)) : otherwise;
  }
  float number(const char* key, unsigned type, unsigned index, float otherwise) const {
    float value = 0;
    return material_.Get(key, type, index, value) == AI_SUCCESS && std::isfinite(value) ? value : otherwise;
  }
  int integer(const char* key, unsigned type, unsigned index, int otherwise) const {
    int value = 0;
    return material_.Get(key, type, index, value) == AI_SUCCESS ? value : otherwise;
  }
  bool has(aiTextureType type) const { return material_.GetTextureCount(type) > 0; }

  // PLY and STL have no materials: readers make one up.
  bool made_up() const { return source_.extension == "ply" || source_.extension == "stl"; }

  // One image for both, as glTF has it.
  bool is_packed() const {
    aiString metal, rough;
    return material_.GetTexture(aiTextureType_METALNESS, 0, &metal) == AI_SUCCESS &&
           material_.GetTexture(aiTextureType_DIFFUSE_ROUGHNESS, 0, &rough) == AI_SUCCESS && metal == rough;
  }

  float metallic(const Vec3& diffuse, const Vec3& specular) const {
    const float told = number(AI_MATKEY_METALLIC_FACTOR, -1);
    if (told >= 0) return std::min(told, 1.0f);
    // Blender writes its metalness so.
    if (source_.by_blender && source_.extension == "obj") return integer("$mat.illum", 0, 0, 2) == 3 ? 1 : 0;
    if (source_.by_blender) return glm::clamp(number(AI_MATKEY_REFLECTIVITY, 0), 0.0f, 1.0f);
    const bool mirror = max_component(diffuse) < kBlack && max_component(specular) > kMirror &&
                        max_component(color(AI_MATKEY_COLOR_EMISSIVE, Vec3(0))) == 0;
    return mirror && !has(aiTextureType_DIFFUSE) ? 1 : 0;
  }

  float roughness() const {
    const float exponent = number(AI_MATKEY_SHININESS, -1);
    const int shading = integer(AI_MATKEY_SHADING_MODEL, aiShadingMode_Phong);
    const int illum = integer("$mat.illum", 0, 0, -1);  // of an .mtl: 0 and 1 have no highlight
    const bool matt = made_up() || (illum >= 0 ? illum < 2 : shading == aiShadingMode_Gouraud) ||
                      max_component(color(AI_MATKEY_COLOR_SPECULAR, Vec3(1))) == 0;
    if (exponent < 0 || (matt && source_.extension != "fbx"))
      return glm::clamp(number(AI_MATKEY_ROUGHNESS_FACTOR, matt ? 1.0f : 0.5f), 0.0f, 1.0f);
    // The inverse of what Blender's exporters write: 1000 (1 - r)² and 100 (1 - r)².
    if (source_.by_blender)
      return glm::clamp(1 - std::sqrt(exponent / (source_.extension == "obj" ? 1000 : 100)), 0.0f, 1.0f);
    return std::sqrt(std::sqrt(2 / (exponent + 2)));  // alpha² = 2 / (n + 2): Walter and others 2007
  }

  void add_base(Json& out, Json& pbr) {
    const Vec3 specular = color(AI_MATKEY_COLOR_SPECULAR, Vec3(0));
    Vec3 base = made_up() ? Vec3(kPlain) : color(AI_MATKEY_COLOR_DIFFUSE, Vec3(kPlain));
    base = color(AI_MATKEY_BASE_COLOR, base);
    const float metal = metallic(base, specular);
    if (metal == 1 && max_component(base) < kBlack) base = specular;
    pbr["metallicFactor"] = metal;
    const auto kind = has(aiTextureType_BASE_COLOR) ? aiTextureType_BASE_COLOR : aiTextureType_DIFFUSE;
    bool cut_out = false;
    const bool covered = has(aiTextureType_OPACITY);
    Json map = covered ? textures_.with_alpha(material_, kind, aiTextureType_OPACITY, cut_out)
                       : textures_.reference(material_, kind);
    const bool textured = has(kind) && !map.is_null();
    if (textured) base = Vec3(1);  // as their programs show it: the texture in place of the colour
    if (!map.is_null()) pbr["baseColorTexture"] = std::move(map);
    if (covered && pbr.contains("baseColorTexture"))
      out["alphaMode"] = cut_out ? "MASK" : "BLEND";
    else
      base = add_glass(out, base, textured);
    base = glm::min(base, Vec3(1));
    pbr["baseColorFactor"] = {base.r, base.g, base.b, 1};
  }

  // Opacity o over what is behind: o · diffuse + (1 - o) · behind. A thin pane of base colour b and transmission T
  // shows (1 - T) b · white + T b · behind, which is the same with b = 1 - o + o · diffuse and T = (1 - o) / b.
  Vec3 add_glass(Json& out, const Vec3& diffuse, bool textured) {
    const float opacity = glm::clamp(number(AI_MATKEY_OPACITY, 1), 0.0f, 1.0f);
    if (opacity == 1) return diffuse;
    const Vec3 base = textured ? diffuse : 1 - opacity + opacity * glm::min(diffuse, Vec3(1));
    const float transmission = std::min((1 - opacity) / std::max(max_component(base), 1 - opacity), 1.0f);
    out["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", transmission}};
    glb_.uses("KHR_materials_transmission");
    return base;
  }

  // What an .mtl calls bump, and 3ds Max too, may be either.
  void add_normals(Json& out) {
    for (const auto type : {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, aiTextureType_HEIGHT}) {
      if (!has(type)) continue;
      if (textures_.is_normal_map(material_, type)) {
        out["normalTexture"] = textures_.reference(material_, type);
        return;
      }
      source_.warn(
          fmt::format("material \"{}\": its bump map is left out: expected a normal map", material_.GetName().C_Str()));
    }
  }

  void add_emission(Json& out) {
    Vec3 emission = color(AI_MATKEY_COLOR_EMISSIVE, Vec3(0)) * number(AI_MATKEY_EMISSIVE_INTENSITY, 1);
    if (Json map = textures_.reference(material_, aiTextureType_EMISSIVE); !map.is_null()) {
      out["emissiveTexture"] = std::move(map);
      if (max_component(emission) <= 0) emission = Vec3(1);
    }
    const float strength = max_component(emission);
    if (!(strength > 0)) return;
    out["emissiveFactor"] = list_of(emission / strength);
    out["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength * kLumensPerWatt}};
    glb_.uses("KHR_materials_emissive_strength");
  }

  const SourceScene& source_;
  const aiMaterial& material_;
  Textures& textures_;
  Glb& glb_;
};

}  // namespace

Json gltf_material(const SourceScene& source, const aiMaterial& material, Textures& textures, Glb& glb) {
  return Converter(source, material, textures, glb).run();
}

}  // namespace oriel
