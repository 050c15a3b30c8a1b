#include "bake/run/assemble.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "bake/scene/sky.h"

namespace oriel {
namespace {

// By which metalness differs, or what of a coloured surface is metal, for its texture to be shown: stones of 14 of the
// Sponza atrium's materials differ by 0.005 to 0.027, by compression, its metals by 0.1 to 0.27. Less changes F0 as
// little.
constexpr double kLeastMetalness = 0.03;

bool same_coordinates(const TextureSlot& a, const TextureSlot& b) {
  return a.texcoord == b.texcoord && a.image_from_uv == b.image_from_uv;
}

// Whose coordinates a material's surfaces have: its base colour's, or without one those of the picture it shines with,
// or of its metalness.
const TextureSlot& shown_slot(const SceneMaterial& m) {
  if (m.base_color_texture.image >= 0) return m.base_color_texture;
  const bool shines = m.emission_texture.image >= 0 && max_component(m.emission) > 0;
  return shines ? m.emission_texture : m.metallic_roughness_texture;
}

// Copies vertices on demand, one for each (scene vertex, lightmap uv) pair.
class VertexSplitter {
 public:
  VertexSplitter(const Scene& scene, AssembledMesh& out)
      : scene_(scene), mesh_(out.mesh), scene_vertex_(out.scene_vertex), first_(scene.positions.size(), kNone) {
    for (const SceneMaterial& material : scene.materials) mapped_ |= material.normal_texture.image >= 0;
  }

  std::uint32_t vertex(std::uint32_t v, const Vec2& lightmap_uv, const SceneMaterial& material) {
    for (std::uint32_t at = first_[v]; at != kNone; at = next_[at])
      if (mesh_.lightmap_uvs[at] == lightmap_uv) return at;
    const auto added = static_cast<std::uint32_t>(mesh_.positions.size());
    mesh_.positions.push_back(scene_.positions[v]);
    scene_vertex_.push_back(v);
    mesh_.normals.push_back(scene_.normals[v]);
    mesh_.uvs.push_back(texture_uv(shown_slot(material), v));
    mesh_.lightmap_uvs.push_back(lightmap_uv);
    if (mapped_) {
      const bool own = material.normal_texture.image >= 0 && !scene_.tangents.empty();
      mesh_.normal_uvs.push_back(texture_uv(material.normal_texture, v));
      mesh_.tangents.push_back(own ? scene_.tangents[v] : Vec4(0));
    }
    if (!scene_.colors.empty()) mesh_.colors.push_back(scene_.colors[v]);
    next_.push_back(first_[v]);
    first_[v] = added;
    return added;
  }

 private:
  static constexpr std::uint32_t kNone = ~0u;

  Vec2 texture_uv(const TextureSlot& slot, std::uint32_t v) const {
    const Vec2 uv = slot.texcoord == 0 ? scene_.uv0[v] : scene_.uv1[v];
    return slot.image < 0 ? Vec2(0) : Vec2(slot.image_from_uv * Vec3(uv, 1));
  }

  const Scene& scene_;
  Mesh& mesh_;
  std::vector<std::uint32_t>& scene_vertex_;
  std::vector<std::uint32_t> first_, next_;  // a list of copies by scene vertex
  bool mapped_ = false;                      // some material has a normal map
};

// A pack's textures of one kind, one for each image and way of reading it.
class TextureList {
 public:
  TextureList(const Scene& scene, std::vector<Texture>& textures) : scene_(scene), textures_(textures) {}

  // -1 where the slot is empty.
  std::int32_t index(const TextureSlot& slot) {
    if (slot.image < 0) return -1;
    const auto [at, added] = known_.try_emplace({slot.image, slot.wrap_s, slot.wrap_t, slot.nearest},
                                                static_cast<std::int32_t>(textures_.size()));
    if (added) {
      const Image& image = scene_.images[static_cast<std::size_t>(slot.image)];
      textures_.push_back(
          {image.name, image.width, image.height, slot.wrap_s, slot.wrap_t, slot.nearest, image.texels});
    }
    return at->second;
  }
  // A texture whose alpha is a material's metalness and whose colours are the picture that it shines with, else white.
  std::int32_t metalness(const SceneMaterial& m, const TextureSlot& picture) {
    const TextureSlot& slot = picture.image >= 0 ? picture : m.metallic_roughness_texture;
    const std::int32_t metal = m.metallic_roughness_texture.image;
    const auto [at, added] =
        metals_.try_emplace({metal, m.metallic, picture.image, slot.wrap_s, slot.wrap_t, slot.nearest},
                            static_cast<std::int32_t>(textures_.size()));
    if (added)
      textures_.push_back(with_alpha(slot, scene_.images[static_cast<std::size_t>(metal)], m.metallic, picture));
    return at->second;
  }

 private:
  // As large as the larger of both.
  Texture with_alpha(const TextureSlot& slot, const Image& metal, float factor, const TextureSlot& picture) const {
    const Image& shown = picture.image >= 0 ? scene_.images[static_cast<std::size_t>(picture.image)] : metal;
    Texture out{shown.name,
                std::max(shown.width, metal.width),
                std::max(shown.height, metal.height),
                slot.wrap_s,
                slot.wrap_t,
                slot.nearest,
                {}};
    for (std::uint32_t y = 0; y < out.height; ++y)
      for (std::uint32_t x = 0; x < out.width; ++x) {
        const auto texel = [&](const Image& image) {
          return &image.texels[4 * (std::size_t{y} * image.height / out.height * image.width +
                                    std::size_t{x} * image.width / out.width)];
        };
        const std::uint8_t* const color = texel(shown);
        for (int c = 0; c < 3; ++c) out.texels.push_back(picture.image >= 0 ? color[c] : 255);
        out.texels.push_back(static_cast<std::uint8_t>(std::lround(factor * static_cast<float>(texel(metal)[2]))));
      }
    return out;
  }

  const Scene& scene_;
  std::vector<Texture>& textures_;
  std::map<std::tuple<std::int32_t, Wrap, Wrap, bool>, std::int32_t> known_;
  std::map<std::tuple<std::int32_t, float, std::int32_t, Wrap, Wrap, bool>, std::int32_t> metals_;
};

// Whether its colour tells what of it is metal. What light passes shows its mean.
bool may_be_metal(const SceneMaterial& m) {
  return !m.unlit && m.metal == Metal::kNone && m.alpha_mode != AlphaMode::kBlend && m.transmission == 0;
}

// Whether a material is a metal in some places of its texture alone.
bool is_metal_in_places(const Scene& scene, const SceneMaterial& m) {
  const TextureSlot& slot = m.metallic_roughness_texture;
  if (slot.image < 0 || m.metallic <= 0 || !may_be_metal(m) || !same_coordinates(shown_slot(m), slot)) return false;
  const std::vector<std::uint8_t>& texels = scene.images[static_cast<std::size_t>(slot.image)].texels;
  double sum = 0, squares = 0;
  for (std::size_t i = 2; i < texels.size(); i += 4) sum += texels[i], squares += double{1} * texels[i] * texels[i];
  const double count = static_cast<double>(texels.size() / 4), mean = sum / count;
  return double{m.metallic} * std::sqrt(std::max(squares / count - mean * mean, 0.0)) > 255 * kLeastMetalness;
}

MeshPart& part_for(Mesh& mesh, const Surface& surface, std::int32_t page, bool new_surface) {
  if (new_surface || mesh.parts.back().lightmap_page != page) {
    MeshPart part;
    part.name = surface.name;
    part.first_index = static_cast<std::uint32_t>(mesh.indices.size());
    part.material = surface.material;
    part.lightmap_page = page;
    mesh.parts.push_back(std::move(part));
  }
  return mesh.parts.back();
}

// What differs from place to place of material i: the picture that it shines with, and where it is metal.
void add_pictures(const Scene& scene, const MaterialSummary& mean, std::size_t i, TextureList& colors, Pack& pack) {
  const SceneMaterial& in = scene.materials[i];
  const auto material = static_cast<std::uint32_t>(i);
  const bool shines = in.emission_texture.image >= 0 && max_component(mean.emission) > 0 &&
                      same_coordinates(shown_slot(in), in.emission_texture);
  const bool in_places = is_metal_in_places(scene, in);
  const std::int32_t texture = in_places ? colors.metalness(in, shines ? in.emission_texture : TextureSlot())
                               : shines ? colors.index(in.emission_texture)
                                         : -1;
  if (shines) {
    Vec3 texel(0);
    for (int c = 0; c < 3; ++c)
      if (in.emission[c] > 0) texel[c] = std::min(mean.emission[c] / in.emission[c], 1.0f);
    pack.emission_textures.push_back({material, static_cast<std::uint32_t>(texture), texel});
  }
  const bool coloured = mean.metallic > kLeastMetalness && in.base_color_texture.image >= 0 && may_be_metal(in);
  if (in_places || coloured) pack.metalness.push_back({material, in_places ? texture : -1, dielectric_f0(in)});
}

}  // namespace

AssembledMesh assemble_mesh(const Scene& scene, const Atlas& atlas) {
  AssembledMesh out;
  Mesh& mesh = out.mesh;
  mesh.origin = scene.origin;
  out.first_index.resize(scene.triangles.size());
  VertexSplitter splitter(scene, out);
  for (const Surface& surface : scene.surfaces) {
    // One part a page: a surface's charts may lie on several.
    std::map<std::int32_t, std::vector<std::uint32_t>> by_page;
    for (std::uint32_t t = surface.first_triangle; t < surface.first_triangle + surface.triangle_count; ++t)
      by_page[atlas.page[t]].push_back(t);
    const SceneMaterial& material = scene.materials[surface.material];
    bool new_surface = true;
    for (const auto& [page, triangles] : by_page) {
      MeshPart& part = part_for(mesh, surface, page, new_surface);
      new_surface = false;
      for (const std::uint32_t t : triangles) {
        out.first_index[t] = static_cast<std::uint32_t>(mesh.indices.size());
        for (int corner = 0; corner < 3; ++corner)
          mesh.indices.push_back(
              splitter.vertex(scene.triangles[t][corner], page < 0 ? Vec2(0) : atlas.uv[t][corner], material));
      }
      part.index_count = static_cast<std::uint32_t>(mesh.indices.size()) - part.first_index;
    }
  }
  return out;
}

void assemble_materials(const Scene& scene, const MaterialMaps& maps, Pack& pack) {
  TextureList colors(scene, pack.textures), normals(scene, pack.normal_textures);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const SceneMaterial& in = scene.materials[i];
    const MaterialSummary& mean = maps.summaries[i];
    Material m;
    m.name = in.name;
    m.base_color = in.base_color;
    // Who does not know of solids draws their front faces only, straight: they have the tint of the back ones and of
    // the glass too.
    if (in.solid) {
      pack.solids.push_back({static_cast<std::uint32_t>(i), in.base_color, in.absorption});
      m.base_color *= glm::mix(Vec3(1), in.base_color * glm::exp(-in.absorption * in.thickness_m), mean.transmission);
    }
    m.alpha = in.alpha;
    m.alpha_mode = in.alpha_mode;
    m.alpha_cutoff = in.alpha_cutoff;
    m.double_sided = in.double_sided;
    m.unlit = in.unlit;
    m.metallic = mean.metallic;
    m.roughness = mean.roughness;
    m.ior = in.ior;
    m.f0 = mean.f0;
    m.transmission = mean.transmission;
    m.emission = mean.emission;
    m.kernel = maps.kernel[i];
    m.fresnel_map = maps.fresnel_map[i];
    m.base_color_texture = colors.index(in.base_color_texture);
    add_pictures(scene, mean, i, colors, pack);
    m.normal_texture = normals.index(in.normal_texture);
    m.normal_scale = in.normal_scale;
    pack.materials.push_back(std::move(m));
  }
}

void assemble_scene(const Scene& scene, MaterialMaps maps, AssembledMesh mesh, Pack& pack) {
  assemble_materials(scene, maps, pack);
  pack.mesh = std::move(mesh.mesh);
  pack.kernels = std::move(maps.kernels);
  pack.fresnel_maps = std::move(maps.fresnel_maps);
  pack.cameras = scene.cameras;
  pack.paths = scene.paths;
  pack.sky = scene.sky;
  pack.sky_map = make_sky_map(scene);
}

std::vector<std::uint32_t> mesh_indices(const AssembledMesh& mesh, std::span<const std::uint32_t> triangles) {
  std::vector<std::uint32_t> indices;
  for (const std::uint32_t t : triangles)
    for (std::uint32_t i = 0; i < 3; ++i) indices.push_back(mesh.mesh.indices[mesh.first_index[t] + i]);
  return indices;
}

}  // namespace oriel
