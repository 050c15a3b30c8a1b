// Materials, textures and samplers.
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "bake/import/document.h"
#include "bake/import/extensions.h"

namespace oriel::gltf {
namespace {

constexpr double kMaxScale = 1e6;   // of normal maps: beyond it every texel that is not flat lies in the surface
constexpr double kDarkest = 1e-20;  // of attenuation colours, for a finite absorption

struct SamplerDesc {
  Wrap wrap_s = Wrap::kRepeat, wrap_t = Wrap::kRepeat;
  bool nearest = false;
};

struct TextureDesc {
  int image = -1, sampler = -1;
};

Wrap parse_wrap(const JsonAt& value) {
  switch (value.integer(10497)) {
    case 10497:
      return Wrap::kRepeat;
    case 33071:
      return Wrap::kClamp;
    case 33648:
      return Wrap::kMirror;
    default:
      value.expected("10497, 33071 or 33648");
      return Wrap::kRepeat;
  }
}

SamplerDesc parse_sampler(const JsonAt& value) {
  SamplerDesc sampler{parse_wrap(value["wrapS"]), parse_wrap(value["wrapT"]), false};
  const JsonAt filter = value["magFilter"];
  const std::uint64_t code = filter.integer(9729);
  if (code != 9728 && code != 9729) filter.expected("9728 or 9729");
  sampler.nearest = code == 9728;
  return sampler;
}

// Reads the materials of one document.
class MaterialParser {
 public:
  MaterialParser(const JsonAt& root, Document& document) : document_(document) {
    const JsonAt samplers = root["samplers"], textures = root["textures"];
    for (std::size_t i = 0; i < samplers.size(); ++i) samplers_.push_back(parse_sampler(samplers.at(i)));
    for (std::size_t i = 0; i < textures.size(); ++i) textures_.push_back(parse_texture(textures.at(i)));
  }

  SceneMaterial parse(const JsonAt& value, std::size_t i) {
    SceneMaterial m;
    m.name = value["name"].name();
    if (m.name.empty()) m.name = fmt::format("material {}", i);
    const JsonAt pbr = value["pbrMetallicRoughness"];
    std::array<double, 4> base{1, 1, 1, 1};
    pbr["baseColorFactor"].numbers(base);
    m.base_color = Vec3(unit(pbr["baseColorFactor"], base[0]), unit(pbr["baseColorFactor"], base[1]),
                        unit(pbr["baseColorFactor"], base[2]));
    m.alpha = unit(pbr["baseColorFactor"], base[3]);
    m.base_color_texture = slot(pbr["baseColorTexture"]);
    m.metallic = unit(pbr["metallicFactor"], pbr["metallicFactor"].number(1));
    m.roughness = unit(pbr["roughnessFactor"], pbr["roughnessFactor"].number(1));
    m.metallic_roughness_texture = slot(pbr["metallicRoughnessTexture"]);
    parse_emission(value, m);
    parse_alpha(value, m);
    parse_dielectric(value, m);
    parse_glossiness(value, m);
    parse_coat(value, m);
    parse_anisotropy(value, m);
    const ObjectKeys keys = parse_object_keys(value);
    if (keys.mover || keys.exclude || keys.texel_m || keys.light_group)
      value["extras"].repaired("mover, exclude, texel, density and light_group are a node's; they are ignored",
                               "object-key");
    m.metal = keys.metal;
    m.reflections = keys.reflections.value_or(true);
    m.double_sided = keys.two_sided.value_or(value["doubleSided"].boolean(false));
    m.unlit = value.extension("KHR_materials_unlit").present();
    const JsonAt normal = value["normalTexture"];
    m.normal_texture = slot(normal);
    m.normal_scale = static_cast<float>(std::fmin(std::fmax(normal["scale"].number(1), -kMaxScale), kMaxScale));
    for (const std::string& name : value["extensions"].keys())
      if (extension_named(name).support == Support::kByMaterial) left_out_[name].push_back(m.name);
    // Read for its mistakes only.
    if (slot(value["occlusionTexture"]).image >= 0) ++occlusion_maps_;
    return m;
  }

  void warn_of_omissions() {
    if (occlusion_maps_ > 0)
      document_.warnings.push_back(
          {fmt::format("occlusion maps of {} materials are left out: the bake finds occlusion itself", occlusion_maps_),
           "unsupported"});
    for (const auto& [name, materials] : left_out_)
      document_.warnings.push_back(
          {fmt::format("{} of {} is not supported and is left out: {}", name,
                       materials.size() == 1
                           ? fmt::format("material \"{}\"", materials.front())
                           : fmt::format("{} materials, \"{}\" among them,", materials.size(), materials.front()),
                       extension_named(name).advice),
           "unsupported"});
    for (const auto& [name, count] : replaced_)
      document_.warnings.push_back(
          {fmt::format("{} of {} textures is not supported: the PNG or JPEG beside it is shown", name, count),
           "unsupported"});
    for (const auto& [name, count] : unread_)
      document_.warnings.push_back(
          {fmt::format("{} of {} textures is not supported, they have no other image and are left out: {}", name, count,
                       extension_named(name).advice),
           "missing-texture"});
  }

 private:
  TextureDesc parse_texture(const JsonAt& value) {
    TextureDesc texture;
    const JsonAt webp = value.extension("EXT_texture_webp")["source"];
    const JsonAt source = webp.present() ? webp : value["source"];
    texture.image = source.index(document_.images.size());
    texture.sampler = value["sampler"].index(samplers_.size());
    bool told = source.present();
    for (const std::string& name : value["extensions"].keys()) {
      if (extension_named(name).support != Support::kOtherImages || webp.present()) continue;
      ++(source.present() ? replaced_ : unread_)[name];
      told = true;
    }
    if (!told) warn(value, "has no image that can be read and is left out", "missing-texture");
    return texture;
  }

  void warn(const JsonAt& value, const std::string& message, WarningCode code = "material-value") {
    document_.warnings.emplace_back(fmt::format("{}: {}", value.path(), message), code);
  }

  float unit(const JsonAt& value, double x) {
    if (x < 0 || x > 1) warn(value, fmt::format("found {}, expected 0 to 1: clamped", x));
    return static_cast<float>(std::fmin(std::fmax(x, 0.0), 1.0));
  }

  TextureSlot slot(const JsonAt& value) {
    TextureSlot slot;
    if (!value.present()) return slot;
    const int texture = value.need("index").index(textures_.size());
    std::uint64_t texcoord = value["texCoord"].integer(0);
    const JsonAt transform = value.extension("KHR_texture_transform");
    if (transform.present()) {
      texcoord = transform["texCoord"].integer(texcoord);
      slot.image_from_uv = parse_transform(transform);
    }
    if (texture < 0) return slot;
    if (texcoord > 1) {
      warn(value,
           fmt::format("texture coordinates {} are not supported, expected 0 or 1: the texture is left out", texcoord),
           "missing-texture");
      return {};
    }
    const TextureDesc& desc = textures_[static_cast<std::size_t>(texture)];
    const SamplerDesc sampler = desc.sampler < 0 ? SamplerDesc{} : samplers_[static_cast<std::size_t>(desc.sampler)];
    slot.image = desc.image;
    slot.texcoord = static_cast<std::uint32_t>(texcoord);
    slot.wrap_s = sampler.wrap_s;
    slot.wrap_t = sampler.wrap_t;
    slot.nearest = sampler.nearest;
    return slot;
  }

  // Scale, then rotation, then offset. With v pointing down, "counter-clockwise" is as seen in the image; the sign was
  // checked against the markers of Khronos' TextureTransformTest.
  static Mat3 parse_transform(const JsonAt& value) {
    std::array<double, 2> offset{0, 0}, scale{1, 1};
    value["offset"].numbers(offset);
    value["scale"].numbers(scale);
    const double angle_rad = value["rotation"].number(0);
    const double c = std::cos(angle_rad), s = std::sin(angle_rad);
    const DMat3 matrix(DVec3(c * scale[0], -s * scale[0], 0), DVec3(s * scale[1], c * scale[1], 0),
                       DVec3(offset[0], offset[1], 1));
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        if (!(std::abs(matrix[i][k]) <= 1e9)) {
          value.error("found offset or scale beyond 1e9, expected them within");
          return Mat3(1);
        }
    return Mat3(matrix);
  }

  void parse_emission(const JsonAt& value, SceneMaterial& m) {
    std::array<double, 3> factor{0, 0, 0};
    const JsonAt emissive = value["emissiveFactor"];
    emissive.numbers(factor);
    const JsonAt strength = value.extension("KHR_materials_emissive_strength")["emissiveStrength"];
    const double scale = strength.number(1, 0);
    for (int i = 0; i < 3; ++i) {
      const double radiance = factor[static_cast<std::size_t>(i)] * scale;
      if (factor[static_cast<std::size_t>(i)] < 0)
        emissive.expected("numbers of at least 0");
      else if (radiance > 1e30)
        value.error(fmt::format("emits {} cd/m², expected at most 1e30", radiance));
      else
        m.emission[i] = static_cast<float>(radiance);
    }
    m.emission_texture = slot(value["emissiveTexture"]);
  }

  void parse_alpha(const JsonAt& value, SceneMaterial& m) {
    const std::string mode = value["alphaMode"].text("OPAQUE");
    if (mode == "MASK")
      m.alpha_mode = AlphaMode::kMask;
    else if (mode == "BLEND")
      m.alpha_mode = AlphaMode::kBlend;
    else if (mode != "OPAQUE")
      value["alphaMode"].expected("OPAQUE, MASK or BLEND");
    m.alpha_cutoff = static_cast<float>(value["alphaCutoff"].number(0.5, 0, 1e30));
  }

  void parse_dielectric(const JsonAt& value, SceneMaterial& m) {
    const JsonAt ior = value.extension("KHR_materials_ior")["ior"];
    m.ior = static_cast<float>(ior.number(1.5, 0, 1e6));
    if (m.ior != 0 && m.ior < 1) {
      warn(ior, fmt::format("found {}, expected 0 or at least 1: taken as 1", m.ior));
      m.ior = 1;
    }
    const JsonAt specular = value.extension("KHR_materials_specular");
    m.specular = unit(specular["specularFactor"], specular["specularFactor"].number(1));
    std::array<double, 3> color{1, 1, 1};
    specular["specularColorFactor"].numbers(color);
    for (int i = 0; i < 3; ++i) {
      const double channel = color[static_cast<std::size_t>(i)];
      if (channel < 0 || channel > 1e30)
        specular["specularColorFactor"].expected("numbers from 0 to 1e30");
      else
        m.specular_color[i] = static_cast<float>(channel);
    }
    m.specular_texture = slot(specular["specularTexture"]);
    m.specular_color_texture = slot(specular["specularColorTexture"]);
    const JsonAt transmission = value.extension("KHR_materials_transmission");
    m.transmission = unit(transmission["transmissionFactor"], transmission["transmissionFactor"].number(0));
    m.transmission_texture = slot(transmission["transmissionTexture"]);
    parse_volume(value, m);
  }

  // What older exporters write instead of metalness: the colour of reflections as such, with Schlick's curve, which is
  // that of an index of 0.
  void parse_glossiness(const JsonAt& value, SceneMaterial& m) {
    const JsonAt old = value.extension("KHR_materials_pbrSpecularGlossiness");
    if (!old.present()) return;
    std::array<double, 4> diffuse{1, 1, 1, 1};
    std::array<double, 3> specular{1, 1, 1};
    old["diffuseFactor"].numbers(diffuse);
    old["specularFactor"].numbers(specular);
    for (int i = 0; i < 3; ++i) {
      m.base_color[i] = unit(old["diffuseFactor"], diffuse[static_cast<std::size_t>(i)]);
      m.specular_color[i] = unit(old["specularFactor"], specular[static_cast<std::size_t>(i)]);
    }
    m.alpha = unit(old["diffuseFactor"], diffuse[3]);
    m.base_color_texture = slot(old["diffuseTexture"]);
    m.specular_color_texture = m.gloss_texture = slot(old["specularGlossinessTexture"]);
    m.roughness = 1 - unit(old["glossinessFactor"], old["glossinessFactor"].number(1));
    m.metallic = m.ior = 0;
    m.specular = 1;
    m.metallic_roughness_texture = m.specular_texture = {};
  }

  // Whether its surfaces are closed is found once they are placed (solids.h). The thickness itself is for those who
  // cannot follow light through the mesh.
  void parse_volume(const JsonAt& value, SceneMaterial& m) {
    const JsonAt volume = value.extension("KHR_materials_volume");
    const double thickness = volume["thicknessFactor"].number(0, 0);
    slot(volume["thicknessTexture"]);
    const JsonAt distance = volume["attenuationDistance"];
    double metres = distance.number(std::numeric_limits<double>::infinity());
    if (distance.present() && !(metres > 0)) {
      warn(distance, fmt::format("found {}, expected a distance above 0: the glass absorbs nothing", metres));
      metres = std::numeric_limits<double>::infinity();
    }
    std::array<double, 3> color{1, 1, 1};
    volume["attenuationColor"].numbers(color);
    for (std::size_t c = 0; c < 3; ++c) {
      const double left = std::max<double>(unit(volume["attenuationColor"], color[c]), kDarkest);
      m.absorption[static_cast<int>(c)] = static_cast<float>(std::min(-std::log(left) / metres, 1e30));
    }
    m.thickness_m = static_cast<float>(std::min(thickness, 1e30));
    m.solid = m.thickness_m > 0 && m.transmission > 0;
    if (m.solid && m.ior == 0) {
      warn(value.extension("KHR_materials_ior"), "found 0, which reflects all light: the solid lets none through");
      m.solid = false;
    }
  }

  void parse_coat(const JsonAt& value, SceneMaterial& m) {
    const JsonAt coat = value.extension("KHR_materials_clearcoat");
    m.coat = unit(coat["clearcoatFactor"], coat["clearcoatFactor"].number(0));
    m.coat_roughness = unit(coat["clearcoatRoughnessFactor"], coat["clearcoatRoughnessFactor"].number(0));
    m.coat_texture = slot(coat["clearcoatTexture"]);
    m.coat_roughness_texture = slot(coat["clearcoatRoughnessTexture"]);
    if (slot(coat["clearcoatNormalTexture"]).image >= 0)
      warn(coat, "clearcoatNormalTexture is left out: the coat follows the normals of what it covers", "unsupported");
  }

  void parse_anisotropy(const JsonAt& value, SceneMaterial& m) {
    const JsonAt anisotropy = value.extension("KHR_materials_anisotropy");
    m.anisotropy = unit(anisotropy["anisotropyStrength"], anisotropy["anisotropyStrength"].number(0));
    m.anisotropy_rotation_rad = static_cast<float>(anisotropy["anisotropyRotation"].number(0, -1e6, 1e6));
    m.anisotropy_texture = slot(anisotropy["anisotropyTexture"]);
  }

  Document& document_;
  std::vector<SamplerDesc> samplers_;
  std::vector<TextureDesc> textures_;
  std::map<std::string, std::vector<std::string>> left_out_;  // extension → materials
  std::map<std::string, int> replaced_, unread_;              // extension → textures
  int occlusion_maps_ = 0;
};

}  // namespace

void parse_materials(const JsonAt& root, Document& document) {
  MaterialParser parser(root, document);
  const JsonAt materials = root["materials"];
  for (std::size_t i = 0; i < materials.size(); ++i) document.materials.push_back(parser.parse(materials.at(i), i));
  parser.warn_of_omissions();
}

}  // namespace oriel::gltf
