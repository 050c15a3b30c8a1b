#include "convert/importer/scene_writer.h"

#include <algorithm>
#include <cmath>

#include "convert/importer/materials.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

Json matrix_json(const aiMatrix4x4& m) {
  return {m.a1, m.b1, m.c1, 0, m.a2, m.b2, m.c2, 0, m.a3, m.b3, m.c3, 0, m.a4, m.b4, m.c4, 1};
}
bool is_finite(const aiMatrix4x4& m) {
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column)
      if (!std::isfinite(m[row][column])) return false;
  return true;
}
Vec3 vec3(const aiVector3D& v) {
  return Vec3(v.x, v.y, v.z);
}
std::span<const aiVector3D> vertices_of(const aiMesh& mesh, const aiVector3D* values) {
  return {values, mesh.mNumVertices};
}

// What looks along -z with +y up, as glTF's cameras and lights do, at its place.
aiMatrix4x4 looking(const aiVector3D& position, aiVector3D forward, aiVector3D up) {
  if (!(forward.SquareLength() > 0)) forward = aiVector3D(0, 0, -1);
  const aiVector3D back = (-forward).NormalizeSafe();
  if ((up ^ back).SquareLength() < 1e-6f * up.SquareLength() || !(up.SquareLength() > 0))  // parallel, or none
    up = std::abs(back.y) < 0.9f ? aiVector3D(0, 1, 0) : aiVector3D(0, 0, -1);
  const aiVector3D right = (up ^ back).NormalizeSafe(), top = back ^ right;
  return {right.x, top.x, back.x, position.x, right.y, top.y, back.y, position.y,
          right.z, top.z, back.z, position.z, 0,       0,     0,      1};
}

class Writer {
 public:
  Writer(const SourceScene& source, char up)
      : source_(source), scene_(source.scene), textures_(source, glb_), up_(up) {}

  Result<Bytes> run() {
    glb_.json["asset"]["generator"] = "oriel-import";
    for (unsigned i = 0; i < scene_.mNumLights; ++i) lights_[scene_.mLights[i]->mName.C_Str()] = i;
    for (unsigned i = 0; i < scene_.mNumCameras; ++i) cameras_[scene_.mCameras[i]->mName.C_Str()] = i;
    add_nodes();
    if (glb_.json["meshes"].empty())
      return invalid(source_.files.name(), "found no triangle, expected a scene with surfaces");
    return glb_.file();
  }

 private:
  // metres and +Y up of the file's own.
  aiMatrix4x4 root_transform() const {
    const auto number = [&](const char* key, int otherwise) {
      int value = otherwise;
      return scene_.mMetaData && scene_.mMetaData->Get(key, value) ? value : otherwise;
    };
    // assimp turns Collada, 3DS and IFC to +Y; FBX it leaves as it is; of the others only custom tells: printers' and
    // scanners' files have +Z up.
    const bool z_up = source_.extension == "ply" || source_.extension == "stl";
    std::array<aiVector3D, 3> to;  // where the file's axes go
    if (source_.extension == "fbx" && up_ == 0) {
      const std::array<int, 3> axes = {number("CoordAxis", 0), number("UpAxis", 1), number("FrontAxis", 2)};
      const std::array<int, 3> signs = {number("CoordAxisSign", 1), number("UpAxisSign", 1),
                                        number("FrontAxisSign", 1)};
      for (std::size_t i = 0; i < 3; ++i)
        to[static_cast<std::size_t>(std::clamp(axes[i], 0, 2))][static_cast<unsigned>(i)] = signs[i] < 0 ? -1.0f : 1.0f;
    } else if (up_ == 'z' || (up_ == 0 && z_up)) {
      to = {aiVector3D(1, 0, 0), aiVector3D(0, 0, -1), aiVector3D(0, 1, 0)};
    } else {
      to = {aiVector3D(1, 0, 0), aiVector3D(0, 1, 0), aiVector3D(0, 0, 1)};
    }
    double unit = source_.unit_m;
    if (source_.extension == "fbx") {  // of centimetres
      float factor = 1;
      if (scene_.mMetaData) scene_.mMetaData->Get("UnitScaleFactor", factor);
      unit *= (std::isfinite(factor) && factor > 0 ? factor : 1.0) / 100;
    }
    const auto m = static_cast<float>(unit);
    return aiMatrix4x4(to[0].x, to[1].x, to[2].x, 0, to[0].y, to[1].y, to[2].y, 0, to[0].z, to[1].z, to[2].z, 0, 0, 0,
                       0, 1) *
           aiMatrix4x4(m, 0, 0, 0, 0, m, 0, 0, 0, 0, m, 0, 0, 0, 0, 1);
  }

  // Without recursion: files nest as deep as they like.
  void add_nodes() {
    struct Open {
      const aiNode* node;
      std::size_t parent;
    };
    Json root = {{"name", scene_.mRootNode->mName.C_Str()}};
    const aiMatrix4x4 turned = root_transform() * scene_.mRootNode->mTransformation;
    std::vector<Open> open = {{scene_.mRootNode, 0}};
    std::vector<std::vector<std::size_t>> children;
    while (!open.empty()) {
      const auto [node, parent] = open.back();
      open.pop_back();
      const std::size_t number = add_node(*node, node == scene_.mRootNode ? turned : node->mTransformation);
      children.resize(glb_.json["nodes"].size());
      if (node != scene_.mRootNode) children[parent].push_back(number);
      for (unsigned i = node->mNumChildren; i-- > 0;) open.push_back({node->mChildren[i], number});
    }
    for (std::size_t i = 0; i < children.size(); ++i)
      for (const std::size_t child : children[i]) glb_.json["nodes"][i]["children"].push_back(child);
    glb_.json["scenes"] = {{{"nodes", {0}}}};
    glb_.json["scene"] = 0;
  }

  std::size_t add_node(const aiNode& node, const aiMatrix4x4& matrix) {
    const std::string name = node.mName.C_Str();
    Json out = {{"name", name}};
    if (!is_finite(matrix))
      source_.warn(fmt::format("node \"{}\": its matrix is not finite and is left out", name));
    else if (!matrix.IsIdentity())
      out["matrix"] = matrix_json(matrix);
    if (node.mNumMeshes > 0)
      if (const auto mesh = mesh_of(node)) out["mesh"] = *mesh;
    const std::size_t number = glb_.add("nodes", std::move(out));
    if (const auto at = cameras_.find(name); at != cameras_.end()) add_camera(*scene_.mCameras[at->second], number);
    if (const auto at = lights_.find(name); at != lights_.end()) add_light(*scene_.mLights[at->second], number);
    return number;
  }

  // Into the node itself, or a child of its name that is turned as glTF has it.
  void add_turned(std::size_t node, const aiMatrix4x4& matrix, const char* what, Json value) {
    const Json& name = glb_.json["nodes"][node]["name"];
    const std::size_t to = matrix.Equal(aiMatrix4x4(), 1e-5f)
                               ? node
                               : glb_.add("nodes", {{"name", name}, {"matrix", matrix_json(matrix)}});
    if (to != node) glb_.json["nodes"][node]["children"].push_back(to);
    if (std::string_view(what) == "camera") {
      glb_.json["nodes"][to]["camera"] = std::move(value);
    } else {
      glb_.json["nodes"][to]["extensions"]["KHR_lights_punctual"] = {{"light", std::move(value)}};
    }
  }

  void add_camera(const aiCamera& camera, std::size_t node) {
    const float aspect = camera.mAspect > 0 ? camera.mAspect : 16.0f / 9;  // as most programs' films
    constexpr float near = 0.05f;                                          // m: closer than eyes come
    Json out = {{"name", camera.mName.C_Str()}};
    if (camera.mOrthographicWidth > 0) {
      out["type"] = "orthographic";
      out["orthographic"] = {{"xmag", camera.mOrthographicWidth},
                             {"ymag", camera.mOrthographicWidth / aspect},
                             {"znear", near},
                             {"zfar", 1000}};
    } else {
      const float across = std::clamp(camera.mHorizontalFOV, 0.01f, 3.1f);  // rad: what a camera can have
      out["type"] = "perspective";
      out["perspective"] = {
          {"yfov", 2 * std::atan(std::tan(across / 2) / aspect)}, {"aspectRatio", aspect}, {"znear", near}};
    }
    add_turned(node, looking(camera.mPosition, camera.mLookAt, camera.mUp), "camera",
               glb_.add("cameras", std::move(out)));
  }

  void add_light(const aiLight& light, std::size_t node) {
    const bool sun = light.mType == aiLightSource_DIRECTIONAL, spot = light.mType == aiLightSource_SPOT,
               area = light.mType == aiLightSource_AREA;
    if (!sun && !spot && !area && light.mType != aiLightSource_POINT) {
      source_.warn(
          fmt::format("light \"{}\" shines from everywhere and is left out: the bake finds ambient light itself",
                      light.mName.C_Str()));
      return;
    }
    Vec3 color = glm::max(Vec3(light.mColorDiffuse.r, light.mColorDiffuse.g, light.mColorDiffuse.b), Vec3(0));
    // assimp takes white, which Blender's FBX does not write, for the 0.8 of cameras' template.
    if (source_.by_blender && source_.extension == "fbx" && color.r == color.g && color.g == color.b) color /= 0.8f;
    float strength = max_component(color);
    if (!(strength > 0) || !std::isfinite(strength)) return;
    color /= strength;
    // Blender's watts are over all directions (of areas, over one side), its suns' W/m². Elsewhere 1 lights what is
    // white to the radiance of white: π of it, at a metre from points.
    const float per_unit = !source_.by_blender ? kPi : sun ? 1 : area ? 1 / kPi : 1 / (4 * kPi);
    strength *= kLumensPerWatt * per_unit;
    Json out = {{"name", light.mName.C_Str()},
                {"type", sun            ? "directional"
                         : spot || area ? "spot"
                                        : "point"},
                {"color", {color.r, color.g, color.b}},
                {"intensity", strength}};
    if (spot || area) {
      // Full angles; Collada's falloff_angle is the inner one alone, and it ends there.
      const float widest = area || source_.extension == "dae" ? light.mAngleInnerCone : light.mAngleOuterCone;
      const float outer = area ? kPi / 2 : std::clamp(widest / 2, 0.01f, kPi / 2);
      const float inner = area ? 0 : std::clamp(light.mAngleInnerCone / 2, 0.0f, 0.99f * outer);
      out["spot"] = {{"innerConeAngle", inner}, {"outerConeAngle", outer}};
    }
    glb_.uses("KHR_lights_punctual");
    Json& all = glb_.json["extensions"]["KHR_lights_punctual"]["lights"];
    all.push_back(std::move(out));
    add_turned(node, looking(light.mPosition, light.mDirection, light.mUp), "light", all.size() - 1);
  }

  // The glTF mesh of all meshes of a node; those that nodes share once.
  std::optional<std::size_t> mesh_of(const aiNode& node) {
    std::vector<unsigned> parts(node.mMeshes, node.mMeshes + node.mNumMeshes);
    const auto [at, added] = meshes_.try_emplace(parts);
    if (!added) return at->second;
    Json primitives = Json::array();
    for (const unsigned part : parts)
      if (part < scene_.mNumMeshes) add_primitive(*scene_.mMeshes[part], primitives);
    if (primitives.empty()) return std::nullopt;
    return at->second = glb_.add("meshes", {{"name", node.mName.C_Str()}, {"primitives", std::move(primitives)}});
  }

  void add_primitive(const aiMesh& mesh, Json& primitives) {
    std::vector<std::uint32_t> indices;
    indices.reserve(std::size_t{3} * mesh.mNumFaces);
    for (unsigned i = 0; i < mesh.mNumFaces; ++i)
      if (mesh.mFaces[i].mNumIndices == 3)
        indices.insert(indices.end(), mesh.mFaces[i].mIndices, mesh.mFaces[i].mIndices + 3);
    if (indices.empty() || !mesh.HasPositions()) return;
    std::vector<Vec3> values;
    const auto take = [&](const aiVector3D* from) -> std::span<const Vec3> {
      values.clear();
      for (const aiVector3D& v : vertices_of(mesh, from)) values.push_back(vec3(v));
      return values;
    };
    Json attributes = {{"POSITION", glb_.add_positions(take(mesh.mVertices))}};
    if (mesh.HasNormals()) attributes["NORMAL"] = glb_.add_vectors(take(mesh.mNormals));
    for (unsigned channel = 0; channel < 2 && mesh.HasTextureCoords(channel); ++channel) {
      std::vector<Vec2> uvs;
      for (const aiVector3D& v : vertices_of(mesh, mesh.mTextureCoords[channel])) uvs.emplace_back(v.x, 1 - v.y);
      attributes["TEXCOORD_" + std::to_string(channel)] = glb_.add_vectors(uvs);
    }
    // Elsewhere they are often masks for somebody's shader.
    if (mesh.HasVertexColors(0) &&
        (source_.extension == "ply" || source_.extension == "stl" || source_.extension == "obj")) {
      values.clear();
      for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiColor4D& c = mesh.mColors[0][i];
        values.push_back(Vec3(linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)));
      }
      attributes["COLOR_0"] = glb_.add_vectors(std::span<const Vec3>(values));
    }
    Json out = {{"attributes", std::move(attributes)}, {"indices", glb_.add_indices(indices)}};
    if (mesh.mMaterialIndex < scene_.mNumMaterials) out["material"] = material(mesh.mMaterialIndex);
    primitives.push_back(std::move(out));
  }

  std::size_t material(unsigned index) {
    const auto [at, added] = materials_.try_emplace(index, 0);
    if (added) at->second = glb_.add("materials", gltf_material(source_, *scene_.mMaterials[index], textures_, glb_));
    return at->second;
  }

  const SourceScene& source_;
  const aiScene& scene_;
  Glb glb_;
  Textures textures_;
  char up_;
  std::map<std::string, unsigned> lights_, cameras_;
  std::map<std::vector<unsigned>, std::optional<std::size_t>> meshes_;
  std::map<unsigned, std::size_t> materials_;
};

}  // namespace

Result<Bytes> write_scene(const SourceScene& source, char up) {
  return Writer(source, up).run();
}

}  // namespace oriel
