#include "formats/export/scene_glb.h"

#include <map>

#include "formats/core/glb.h"
#include "formats/export/lightmap_texture.h"
#include "formats/export/shown_page.h"
#include "formats/image/display.h"
#include "formats/image/png.h"
#include "formats/query/camera.h"

namespace oriel {
namespace {

Json list(const Vec3& v) {
  return {v.x, v.y, v.z};
}

Json sampler_json(const Texture& texture) {
  constexpr int kLinear = 9729, kNearest = 9728, kMipmapped = 9987;
  const auto wrap = [](Wrap w) { return w == Wrap::kRepeat ? 10497 : w == Wrap::kClamp ? 33071 : 33648; };
  return {{"magFilter", texture.nearest ? kNearest : kLinear},
          {"minFilter", kMipmapped},
          {"wrapS", wrap(texture.wrap_s)},
          {"wrapT", wrap(texture.wrap_t)}};
}

class SceneWriter {
 public:
  SceneWriter(const Pack& pack, const GlbOptions& options) : pack_(pack), options_(options) {}

  Result<GlbScene> run() {
    if (options_.light == LightAs::kEmissive)
      ORIEL_TRY_VOID(add_shown_pages());
    else
      add_lightmap_extras();
    for (const MeshPart& part : pack_.mesh.parts)
      if (part.index_count > 0) ORIEL_TRY_VOID(add_part(part));
    for (const Camera& camera : pack_.cameras) add_camera(camera);
    Json root = {{"name", "oriel"}};
    root["translation"] = {pack_.mesh.origin.x, pack_.mesh.origin.y, pack_.mesh.origin.z};
    if (!children_.empty()) root["children"] = children_;
    glb_.json["scenes"] = {{{"nodes", {glb_.add("nodes", std::move(root))}}}};
    glb_.json["scene"] = 0;
    ORIEL_TRY(out_.file, glb_.file());
    out_.left_out = left_out();
    return std::move(out_);
  }

 private:
  // One exposure for all pages; their own size is enough to find it.
  Status add_shown_pages() {
    FloatImage all{0, 1, 3, {}};
    for (std::size_t page = 0; page < pack_.lightmaps.size(); ++page) {
      const FloatImage light = shown_page(pack_, page, 1);
      all.pixels.insert(all.pixels.end(), light.pixels.begin(), light.pixels.end());
    }
    out_.white_cd_m2 = white_of(all);
    for (std::size_t page = 0; page < pack_.lightmaps.size(); ++page) {
      const FloatImage picture =
          shown(shown_page(pack_, page, fitting_scale(pack_, page, options_.longest_texture)), out_.white_cd_m2);
      ByteImage image{picture.width, picture.height, 3, {}};
      image.pixels.reserve(picture.pixels.size());
      for (const float v : picture.pixels) image.pixels.push_back(static_cast<std::uint8_t>(v * 255 + 0.5f));
      ORIEL_TRY(const Bytes png, encode_png(image));
      const std::string name = fmt::format("light {}", page);
      page_textures_.push_back(
          add_texture(name, png, {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 33071}, {"wrapT", 33071}}));
    }
    glb_.json["asset"]["extras"] = {{"oriel", {{"white_cd_m2", out_.white_cd_m2}}}};
    return {};
  }

  void add_lightmap_extras() {
    Json pages = Json::array();
    for (std::size_t page = 0; page < pack_.lightmaps.size(); ++page)
      pages.push_back({{"page", page},
                       {"file", lightmap_file(options_.lightmap_stem, page, "exr")},
                       {"width", pack_.lightmaps[page].width},
                       {"height", pack_.lightmaps[page].height},
                       {"texcoord", 1},
                       {"quantity", "irradiance"},
                       {"unit", "lux"},
                       {"scale", 1},
                       {"ktx2",
                        {{"file", lightmap_file(options_.lightmap_stem, page, "ktx2")},
                         {"scale", texture_scale(pack_.lightmaps[page])}}}});
    glb_.json["asset"]["extras"] = {{"oriel", {{"lightmaps", std::move(pages)}}}};
  }

  std::size_t add_texture(const std::string& name, const Bytes& png, Json sampler) {
    const std::size_t image = glb_.add_image(name, png), s = glb_.add("samplers", std::move(sampler));
    return glb_.add("textures", {{"name", name}, {"source", image}, {"sampler", s}});
  }

  Result<std::size_t> texture(std::int32_t number) {
    if (const auto at = textures_.find(number); at != textures_.end()) return at->second;
    const Texture& t = pack_.textures[static_cast<std::size_t>(number)];
    ORIEL_TRY(const Bytes png, encode_png({t.width, t.height, 4, t.texels}));
    return textures_[number] = add_texture(t.name, png, sampler_json(t));
  }

  // Of a material on a page.
  Result<std::size_t> material(std::uint32_t number, std::int32_t page) {
    const bool shown = options_.light == LightAs::kEmissive && page >= 0;
    const auto key = std::pair(number, shown ? page : -1);
    if (const auto at = materials_.find(key); at != materials_.end()) return at->second;
    const Material& m = pack_.materials[number];
    const bool seen_through = m.alpha_mode != AlphaMode::kOpaque;
    Json pbr = Json::object();
    if (m.base_color_texture >= 0 && (!shown || seen_through)) {
      ORIEL_TRY(const std::size_t base, texture(m.base_color_texture));
      pbr["baseColorTexture"] = {{"index", base}};
    }
    Json out = {{"name", m.name}, {"doubleSided", m.double_sided}};
    if (m.alpha_mode == AlphaMode::kMask) out["alphaMode"] = "MASK", out["alphaCutoff"] = m.alpha_cutoff;
    if (m.alpha_mode == AlphaMode::kBlend) out["alphaMode"] = "BLEND";
    if (shown)
      add_shown(m, page, pbr, out);
    else
      add_surface(m, pbr, out);
    out["pbrMetallicRoughness"] = std::move(pbr);
    return materials_[key] = glb_.add("materials", std::move(out));
  }

  // Black and without highlights: all that is seen is emitted.
  void add_shown(const Material& m, std::int32_t page, Json& pbr, Json& out) {
    float alpha = m.alpha;
    if (m.transmission > 0) {
      alpha *= 1 - m.transmission;
      if (m.alpha_mode == AlphaMode::kOpaque) out["alphaMode"] = "BLEND";
    }
    pbr["baseColorFactor"] = {0, 0, 0, alpha};
    pbr["metallicFactor"] = 0;
    pbr["roughnessFactor"] = 1;
    out["emissiveFactor"] = {1, 1, 1};
    out["emissiveTexture"] = {{"index", page_textures_[static_cast<std::size_t>(page)]}, {"texCoord", 1}};
    out["extensions"]["KHR_materials_specular"] = {{"specularFactor", 0}};
    glb_.uses("KHR_materials_specular");
  }

  void add_surface(const Material& m, Json& pbr, Json& out) {
    const Vec3 base = glm::clamp(m.base_color, Vec3(0), Vec3(1));
    pbr["baseColorFactor"] = {base.r, base.g, base.b, m.alpha};
    pbr["metallicFactor"] = m.metallic;
    pbr["roughnessFactor"] = m.roughness;
    const auto extension = [&](const char* name, Json value) {
      out["extensions"][name] = std::move(value);
      glb_.uses(name);
    };
    if (m.unlit) return extension("KHR_materials_unlit", Json::object());
    if (m.transmission > 0) extension("KHR_materials_transmission", {{"transmissionFactor", m.transmission}});
    if (m.ior >= 1 && m.ior != 1.5f) extension("KHR_materials_ior", {{"ior", m.ior}});
    if (const float strength = max_component(m.emission); strength > 0) {
      out["emissiveFactor"] = list(m.emission / strength);
      extension("KHR_materials_emissive_strength", {{"emissiveStrength", strength}});
    }
  }

  // With vertices of its own, so that viewers know its bounds.
  Status add_part(const MeshPart& part) {
    const Mesh& mesh = pack_.mesh;
    std::map<std::uint32_t, std::uint32_t> renumbered;
    std::vector<std::uint32_t> indices, colors;
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs, lightmap_uvs;
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; ++i) {
      const std::uint32_t v = mesh.indices[i];
      const auto [at, added] = renumbered.try_emplace(v, static_cast<std::uint32_t>(positions.size()));
      indices.push_back(at->second);
      if (!added) continue;
      positions.push_back(mesh.positions[v]);
      normals.push_back(mesh.normals[v]);
      uvs.push_back(mesh.uvs[v]);
      lightmap_uvs.push_back(mesh.lightmap_uvs[v]);
      if (!mesh.colors.empty()) colors.push_back(mesh.colors[v]);
    }
    Json attributes = {{"POSITION", glb_.add_positions(positions)},
                       {"NORMAL", glb_.add_vectors(normals)},
                       {"TEXCOORD_0", glb_.add_vectors(uvs)},
                       {"TEXCOORD_1", glb_.add_vectors(lightmap_uvs)}};
    if (!colors.empty()) attributes["COLOR_0"] = glb_.add_colors(colors);
    ORIEL_TRY(const std::size_t material_number, material(part.material, part.lightmap_page));
    Json primitive = {
        {"attributes", std::move(attributes)}, {"indices", glb_.add_indices(indices)}, {"material", material_number}};
    if (options_.light == LightAs::kLightmap && part.lightmap_page >= 0)
      primitive["extras"] = {{"oriel", {{"lightmap_page", part.lightmap_page}}}};
    const std::size_t number =
        glb_.add("meshes", {{"name", part.name}, {"primitives", Json::array({std::move(primitive)})}});
    children_.push_back(glb_.add("nodes", {{"name", part.name}, {"mesh", number}}));
    return {};
  }

  void add_camera(const Camera& camera) {
    constexpr double kNear = 0.01, kFar = 10000;
    Json lens = {{"name", camera.name}};
    if (camera.vertical_fov_rad > 0) {
      lens["type"] = "perspective";
      lens["perspective"] = {{"yfov", camera.vertical_fov_rad}, {"znear", kNear}};
    } else {
      lens["type"] = "orthographic";
      lens["orthographic"] = {
          {"xmag", camera.half_height}, {"ymag", camera.half_height}, {"znear", kNear}, {"zfar", kFar}};
    }
    const std::size_t number = glb_.add("cameras", std::move(lens));
    const Mat3 axes = pack_from_eye_axes(camera);
    Json matrix = Json::array();
    for (int column = 0; column < 4; ++column) {
      const Vec3 v = column < 3 ? axes[column] : camera.eye;
      for (const float value : {v.x, v.y, v.z, column < 3 ? 0.0f : 1.0f}) matrix.push_back(value);
    }
    children_.push_back(glb_.add("nodes", {{"name", camera.name}, {"camera", number}, {"matrix", std::move(matrix)}}));
  }

  std::vector<std::string> left_out() const {
    std::vector<std::string> out;
    const auto add = [&](std::size_t count, const char* what) {
      if (count > 0) out.push_back(fmt::format("{} {}", count, what));
    };
    add(pack_.movers.size(), "movers");
    add(pack_.reflectors.size() + pack_.curved_reflectors.size(), "reflectors' images");
    add(pack_.normal_textures.size(), "normal maps");
    add(pack_.paths.size(), "camera paths");
    return out;
  }

  const Pack& pack_;
  const GlbOptions& options_;
  Glb glb_;
  GlbScene out_;
  Json children_ = Json::array();
  std::vector<std::size_t> page_textures_;
  std::map<std::int32_t, std::size_t> textures_;
  std::map<std::pair<std::uint32_t, std::int32_t>, std::size_t> materials_;
};

}  // namespace

std::string lightmap_file(const std::string& stem, std::size_t page, const char* extension) {
  return fmt::format("{}_{:03}.{}", stem, page, extension);
}

Result<GlbScene> scene_glb(const Pack& pack, const GlbOptions& options) {
  return SceneWriter(pack, options).run();
}

}  // namespace oriel
