// How a material's surfaces are drawn: what all passes that shade them set.
#pragma once

#include "formats/assets/opacity.h"
#include "player/gpu/program.h"
#include "player/gpu/raster_state.h"
#include "player/scene/frame_options.h"
#include "player/scene/gpu_scene.h"

namespace oriel {

// Texture units of shaders/passes/surface.glsl and its users.
enum TextureUnit {
  kBaseUnit = 0,
  kLightmapUnit = 1,
  kReflectanceUnit = 2,
  kDirectionUnit = 3,
  kNormalUnit = 4,
  kChangeUnit = 5,       // light that movers take or get, by pixel
  kWeightUnit = 6,       // a mover's transfer
  kTableUnit = 7,        // and its light
  kCellUnit = 9,         // of a lightmap
  kDetailUnit = 10,      // its finer light
  kPlaceUnit = 8,        // and where
  kGlowUnit = 11,        // the picture that a surface shines with
  kSharpAtUnit = 12,     // of a lightmap with sharp light
  kSharpWordsUnit = 13,  // and of the scene
  kSharpTrianglesUnit = 14,
  kSharpLampsUnit = 15,
  kSurfaceUnit = 0,  // of bright lights: what is seen
  kTakenUnit = 1,    // what movers take of them
  kShadowUnit = 6,   // shadow maps of movers
  kStaticUnit = 7,   // and of what stands still
};

inline gpu::Cull cull_of(const Material& material) {
  return material.double_sided ? gpu::Cull::kNone : gpu::Cull::kBack;
}

// Blended, and it may be whole in places: there it is drawn and hides as opaque surfaces do, the rest of it is seen
// through.
inline bool is_partly_opaque(const Material& material) {
  return material.alpha_mode == AlphaMode::kBlend && material.alpha >= kOpaqueAlpha && material.transmission <= 0;
}

inline float cutoff_of(const Material& material) {
  if (is_partly_opaque(material)) return kOpaqueAlpha;
  return material.alpha_mode == AlphaMode::kMask ? std::max(material.alpha_cutoff, 0.0f) : -1.0f;
}

// From the index buffer that is bound.
inline void draw_indices(std::uint32_t first, std::uint32_t count, FrameStats& stats) {
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(std::uintptr_t{first} * sizeof(std::uint32_t)));
  ++stats.draws;
  stats.triangles += count / 3;
}

inline void draw_batch(const DrawBatch& batch, FrameStats& stats) {
  // OpenGL ES has no call for several ranges.
  if (batch.counts.size() == 1 || !epoxy_is_desktop_gl()) {
    for (std::size_t i = 0; i < batch.counts.size(); ++i)
      glDrawElements(GL_TRIANGLES, batch.counts[i], GL_UNSIGNED_INT, batch.offsets[i]);
  } else {
    glMultiDrawElements(GL_TRIANGLES, batch.counts.data(), GL_UNSIGNED_INT, batch.offsets.data(),
                        static_cast<GLsizei>(batch.counts.size()));
  }
  ++stats.draws;
  for (const std::int32_t count : batch.counts) stats.triangles += static_cast<std::uint64_t>(count) / 3;
}

// 1 / distance is never stored smaller than this where something is seen, the sky too:
// half floats hold it.
inline constexpr float kClosest = 0x1p-14f;

// That alpha tells 1 / distance, as in images of what reflectors show (shaders/passes/opaque.glsl). Uses the program.
inline void set_distance_alpha(const gpu::Program& program, const View& view) {
  program.use();
  program.set("u_alpha_kind", view.orthographic ? 2 : 1);
  program.set("u_depth_row", -glm::transpose(view.view_from_pack)[2]);
  program.set("u_closest", kClosest);
}

// What is cut out of a material's surfaces.
inline void set_cutout(const gpu::Program& program, const GpuScene& scene, const Material& m) {
  program.set("u_base_texture", kBaseUnit);
  program.set("u_alpha", m.alpha);
  program.set("u_alpha_cutoff", cutoff_of(m));
  scene.albedo(m.base_color_texture).bind(kBaseUnit);
}

// What shaders/lib/metalness.glsl asks for, and its texture to that unit. Returns whether F0 differs from place to
// place.
inline bool set_metalness(const gpu::Program& program, const GpuScene& scene, std::uint32_t material, int unit) {
  const Material& m = scene.pack().materials[material];
  const Metalness* metal = scene.metalness(material);
  program.set("u_metal_varies", metal != nullptr ? 1 : 0);
  if (metal == nullptr) return false;
  program.set("u_metal", metal->texture >= 0 ? 1.0f : m.metallic);
  program.set("u_dielectric", metal->dielectric);
  program.set("u_f0", m.f0);
  scene.albedo(metal->texture).bind(unit);
  return true;
}

// What shaders/passes/place_reflectance.glsl asks for: two textures, to that unit and the next.
inline void set_place_reflectance(const gpu::Program& program, const GpuScene& scene, std::uint32_t material,
                                  int unit) {
  const Material& m = scene.pack().materials[material];
  program.set("u_base_texture", unit);
  program.set("u_metal_texture", unit + 1);
  if (!set_metalness(program, scene, material, unit + 1)) return;
  program.set("u_base_color", Vec4(glm::clamp(m.base_color, Vec3(0), Vec3(1)), m.alpha));
  scene.albedo(m.base_color_texture).bind(unit);
}

// Albedo, reflectance, emission and its picture, and normal map. normal_mapped: the mesh has coordinates for normal
// maps.
inline void set_surface(const gpu::Program& program, const GpuScene& scene, std::uint32_t material,
                        bool normal_mapped) {
  const Material& m = scene.pack().materials[material];
  const Vec3 base = glm::clamp(m.base_color, Vec3(0), Vec3(1));
  program.set("u_base_color", Vec4(base, m.alpha));
  program.set("u_alpha_cutoff", cutoff_of(m));
  program.set("u_covers", m.alpha_mode == AlphaMode::kBlend ? 1 : 0);
  program.set("u_transmission", m.transmission);
  const EmissionTexture* picture = scene.emission_texture(material);
  program.set("u_emission", scene.brightest_emission(material));
  program.set("u_emission_texture", kGlowUnit);
  scene.albedo(picture != nullptr ? static_cast<std::int32_t>(picture->texture) : -1).bind(kGlowUnit);
  const bool varies = set_metalness(program, scene, material, kGlowUnit);  // a texture has both
  program.set("u_diffuse_share", (varies ? 1 : 1 - m.metallic) * (1 - m.transmission));
  program.set("u_unlit", m.unlit ? 1 : 0);
  program.set("u_reflectance_row", m.fresnel_map);
  if (m.fresnel_map >= 0) {
    const auto& table = scene.pack().fresnel_maps[static_cast<std::size_t>(m.fresnel_map)].table;
    program.set("u_reflectance_count", static_cast<int>(table.size()));
  }
  scene.albedo(m.base_color_texture).bind(kBaseUnit);
  program.set("u_normal_mapped", m.normal_texture >= 0 && normal_mapped ? 1 : 0);
  program.set("u_normal_scale", m.normal_scale);
  scene.normal_map(m.normal_texture).bind(kNormalUnit);
}

}  // namespace oriel
