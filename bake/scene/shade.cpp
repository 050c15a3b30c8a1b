#include "bake/scene/shade.h"

#include <algorithm>

#include "formats/assets/normal_map.h"

namespace oriel {
namespace {

template <class V>
V interpolate(const std::vector<V>& values, const UVec3& t, const Vec2& b) {
  return (1 - b.x - b.y) * values[t.x] + b.x * values[t.y] + b.y * values[t.z];
}

Vec4 vertex_color(const Scene& scene, std::uint32_t triangle, const Vec2& b) {
  if (scene.colors.empty()) return Vec4(1);
  const UVec3& t = scene.triangles[triangle];
  const float weights[3] = {1 - b.x - b.y, b.x, b.y};
  Vec4 color(0);
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < 4; ++c)
      color[c] += weights[k] * static_cast<float>(scene.colors[t[k]] >> (8 * c) & 0xFFu) / 255.0f;
  return glm::clamp(color, 0.0f, 1.0f);
}

// Where textures are read.
struct TexturedPoint {
  const Scene& scene;
  std::uint32_t triangle = 0;
  Vec2 barycentric{0};
  Footprint footprint = {};
};

Vec4 texture_at(const TexturedPoint& at, const TextureSlot& slot, bool srgb) {
  if (slot.image < 0) return Vec4(1);
  const std::vector<Vec2>& uvs = slot.texcoord == 0 ? at.scene.uv0 : at.scene.uv1;
  const UVec3& t = at.scene.triangles[at.triangle];
  const auto step = [&](const Vec2& s) { return s.x * (uvs[t.y] - uvs[t.x]) + s.y * (uvs[t.z] - uvs[t.x]); };
  const auto& [shorter, longer] = at.footprint;
  const Footprint over = at.footprint.is_point() ? Footprint{} : Footprint{step(shorter), step(longer)};
  return sample_texture(at.scene, slot, interpolate(uvs, t, at.barycentric), srgb, over);
}

float coverage_of(const SceneMaterial& material, float alpha) {
  switch (material.alpha_mode) {
    case AlphaMode::kOpaque:
      break;
    case AlphaMode::kMask:
      return alpha >= material.alpha_cutoff ? 1.0f : 0.0f;
    case AlphaMode::kBlend:
      return std::clamp(alpha, 0.0f, 1.0f);
  }
  return 1;
}

// Base colour and alpha.
Vec4 base_at(const TexturedPoint& at, const SceneMaterial& material) {
  const Vec4 factor(material.base_color, material.alpha);
  const Vec4 image = texture_at(at, material.base_color_texture, true);
  return glm::clamp(factor * image * vertex_color(at.scene, at.triangle, at.barycentric), 0.0f, 1.0f);
}

// Measured constants in place of base colour and Schlick's curve.
void make_metal(ShadePoint& p, Metal metal) {
  p.f0 = p.base_color = Vec3(metal_f0(metal));
  p.f90 = 1;
  p.curve = {.metal = metal};
  p.diffuse = p.transmission = Vec3(0);
  p.eta = 0;
}

void add_coat(const TexturedPoint& at, const SceneMaterial& m, ShadePoint& p) {
  if (m.coat <= 0) return;
  p.coat = m.coat * texture_at(at, m.coat_texture, false).r;
  const float roughness = m.coat_roughness * texture_at(at, m.coat_roughness_texture, false).g;
  p.coat_alpha = roughness * roughness;
}

void add_anisotropy(const TexturedPoint& at, const SceneMaterial& m, ShadePoint& p) {
  if (m.anisotropy <= 0) return;
  Vec2 direction(1, 0);
  p.anisotropy = m.anisotropy;
  if (m.anisotropy_texture.image >= 0) {
    const Vec4 texel = texture_at(at, m.anisotropy_texture, false);
    const Vec2 d = 2.0f * Vec2(texel) - 1.0f;
    if (glm::dot(d, d) > 1e-6f) direction = glm::normalize(d);
    p.anisotropy *= texel.b;
  }
  const float c = std::cos(m.anisotropy_rotation_rad), s = std::sin(m.anisotropy_rotation_rad);
  p.wide_direction = {c * direction.x - s * direction.y, s * direction.x + c * direction.y};
}

}  // namespace

ShadePoint shade_point(const Scene& scene, std::uint32_t triangle, const Vec2& b, const Footprint& f) {
  const SceneMaterial& m = scene.material_of(triangle);
  const TexturedPoint at{scene, triangle, b, f};
  const Vec4 base = base_at(at, m);
  ShadePoint p;
  p.base_color = Vec3(base);
  if (m.unlit) {
    p.f0 = Vec3(0);
    p.f90 = 0;
    p.coverage = 0;
    return p;
  }
  p.coverage = coverage_of(m, base.a);
  const Vec4 mr = texture_at(at, m.metallic_roughness_texture, false);
  const float metallic = std::clamp(m.metallic * mr.b, 0.0f, 1.0f), gloss = texture_at(at, m.gloss_texture, false).a,
              roughness = std::clamp(1 - (1 - m.roughness * mr.g) * gloss, 0.0f, 1.0f);
  const float transmission =
      m.transmission > 0 ? m.transmission * texture_at(at, m.transmission_texture, false).r : 0.0f;
  const float specular = m.specular * texture_at(at, m.specular_texture, false).a;
  const Vec3 tint = m.specular_color * Vec3(texture_at(at, m.specular_color_texture, true));
  const Vec3 dielectric = glm::min(static_cast<float>(dielectric_f0(m.ior)) * tint, Vec3(1)) * specular;
  p.f0 = glm::mix(dielectric, p.base_color, metallic);
  p.f90 = glm::mix(specular, 1.0f, metallic);
  p.curve = {.ior = m.ior, .schlick = metallic};
  p.alpha = roughness * roughness;
  p.diffuse = (1 - metallic) * (1 - transmission) * p.base_color;
  p.transmission = (1 - metallic) * transmission * p.base_color;
  if (m.solid && max_component(p.transmission) > 0) p.eta = m.ior, p.absorption = m.absorption;
  if (m.metal != Metal::kNone) make_metal(p, m.metal);
  add_coat(at, m, p);
  add_anisotropy(at, m, p);
  p.emission = m.emission;
  if (max_component(m.emission) > 0) p.emission *= Vec3(texture_at(at, m.emission_texture, true));
  return p;
}

void turn_inside(ShadePoint& point) {
  if (point.inside || !(point.eta > 0)) return;
  point.eta = 1 / point.eta;
  point.inside = true;
  point.diffuse = point.emission = Vec3(0);
}

Vec4 tangent_at(const Scene& scene, std::uint32_t triangle, const Vec2& b, const Vec3& normal,
                const TextureSlot& slot) {
  const UVec3& t = scene.triangles[triangle];
  Vec4 tangent = scene.tangents.empty() ? Vec4(0) : interpolate(scene.tangents, t, b);
  if (std::abs(tangent.w) < 0.5f) {
    const std::vector<Vec2>& uvs = slot.texcoord == 0 ? scene.uv0 : scene.uv1;
    const auto uv_step = [&](std::uint32_t corner) {
      return Vec2(DMat3(slot.image_from_uv) * DVec3(uvs[corner] - uvs[t.x], 0));
    };
    const Vec3& at = scene.positions[t.x];
    tangent =
        tangent_of_steps(normal, scene.positions[t.y] - at, scene.positions[t.z] - at, uv_step(t.y), uv_step(t.z));
  } else {
    tangent.w = std::copysign(1.0f, tangent.w);
  }
  return tangent;
}

Vec3 mapped_normal(const Scene& scene, std::uint32_t triangle, const Vec2& b, const Vec3& normal,
                   const Footprint& footprint) {
  const SceneMaterial& m = scene.material_of(triangle);
  const TextureSlot& slot = m.normal_texture;
  if (slot.image < 0 || m.unlit) return normal;
  const Vec4 tangent = tangent_at(scene, triangle, b, normal, slot);
  return tilted_normal(normal, tangent, Vec3(texture_at({scene, triangle, b, footprint}, slot, false)), m.normal_scale);
}

Vec3 transmittance_at(const Scene& scene, std::uint32_t triangle, const Vec2& b) {
  if (!may_transmit(scene.material_of(triangle))) return Vec3(0);
  const ShadePoint p = shade_point(scene, triangle, b);
  return glm::clamp(Vec3(1 - p.coverage) + p.coverage * (1 - max_component(p.f0)) * p.transmission, 0.0f, 1.0f);
}

bool may_transmit(const SceneMaterial& material) {
  return material.unlit || material.alpha_mode != AlphaMode::kOpaque ||
         (material.transmission > 0 && material.metallic < 1) ||
         (material.transmission > 0 && material.metallic_roughness_texture.image >= 0);
}

bool is_polished(const SceneMaterial& m) {
  constexpr float kMostRoughness = 0.5f;
  const auto narrow = [](float roughness, const TextureSlot& texture) {
    return roughness <= kMostRoughness || texture.image >= 0;
  };
  if (m.unlit) return false;
  const bool reflects = m.metallic > 0 || m.specular > 0 || m.metal != Metal::kNone;
  return (reflects && narrow(m.roughness, m.metallic_roughness_texture)) ||
         (m.coat > 0 && narrow(m.coat_roughness, m.coat_roughness_texture));
}

Vec3 mean_emission(const Scene& scene, std::uint32_t triangle) {
  const SceneMaterial& m = scene.material_of(triangle);
  if (m.unlit || max_component(m.emission) <= 0) return Vec3(0);
  if (m.emission_texture.image < 0) return m.emission;
  // Midpoints of n² equal parts, about one a texel under the longest edge.
  const Image& image = scene.images[static_cast<std::size_t>(m.emission_texture.image)];
  const std::vector<Vec2>& uvs = m.emission_texture.texcoord == 0 ? scene.uv0 : scene.uv1;
  const UVec3& t = scene.triangles[triangle];
  double texels = 0;
  for (int k = 0; k < 3; ++k) {
    const DVec3 edge = DMat3(m.emission_texture.image_from_uv) * DVec3(uvs[t[(k + 1) % 3]] - uvs[t[k]], 0);
    texels = std::max(texels, std::hypot(edge.x * image.width, edge.y * image.height));
  }
  const int n = static_cast<int>(std::clamp(std::ceil(texels), 1.0, 32.0));
  DVec3 sum(0);
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < 2 * (n - i) - 1; ++k) {
      // Row i holds upright and, between them, upside-down parts.
      const float third = k % 2 == 0 ? 1.0f / 3 : 2.0f / 3;
      const Vec2 b = Vec2(static_cast<float>(k / 2) + third, static_cast<float>(i) + third) / static_cast<float>(n);
      sum += DVec3(texture_at({scene, triangle, b}, m.emission_texture, true));
    }
  return m.emission * Vec3(sum / static_cast<double>(n * n));
}

}  // namespace oriel
