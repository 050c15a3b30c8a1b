#include "bake/run/inputs.h"

#include "formats/assets/fields.h"

namespace oriel {
namespace {

// The image itself stands for its number.
void add_slot(Archive& archive, const Scene& scene, const TextureSlot& slot) {
  archive(slot.image >= 0);
  if (slot.image < 0) return;
  const Image& image = scene.images[static_cast<std::size_t>(slot.image)];
  archive(image.width, image.height, image.texels, slot.texcoord, slot.image_from_uv, slot.wrap_s, slot.wrap_t,
          slot.nearest);
}

// All but what it emits.
void add_material(Archive& archive, const Scene& scene, const SceneMaterial& m) {
  archive(m.base_color, m.alpha, m.metallic, m.roughness, m.ior, m.specular, m.specular_color, m.transmission,
          m.thickness_m, m.solid, m.absorption, m.normal_scale, m.coat, m.coat_roughness, m.anisotropy,
          m.anisotropy_rotation_rad, m.metal, m.alpha_mode, m.alpha_cutoff, m.double_sided, m.unlit, m.reflections);
  for (const TextureSlot* slot : texture_slots(m))
    if (slot != &m.emission_texture) add_slot(archive, scene, *slot);
}

}  // namespace

void fields(Archive& archive, const SurfacesOf& of) {
  const Scene& s = of.scene;
  archive(s.lower, s.upper, s.positions, s.normals, s.uv0, s.uv1, s.colors, s.tangents, s.triangles, s.triangle_surface,
          s.twin, s.face_normals);
  for (const ChartCut& cut : s.cuts) archive(cut.from, cut.to);
  for (const Surface& surface : s.surfaces)
    archive(surface.material, surface.first_triangle, surface.triangle_count, surface.first_vertex,
            surface.vertex_count);
  for (const SceneMaterial& material : s.materials) add_material(archive, s, material);
}

void fields(Archive& archive, const LightsOf& of) {
  const Scene& s = of.scene;
  for (const SceneMaterial& m : s.materials) {
    archive(m.emission);
    add_slot(archive, s, m.emission_texture);
  }
  for (const Light& light : s.lights)
    archive(light.type, light.position, light.direction, light.right, light.mirrored, light.color, light.intensity,
            light.inner_cone_rad, light.outer_cone_rad, light.angular_radius_rad, light.profile);
  for (const LightProfile& profile : s.profiles) archive(profile.vertical_deg, profile.horizontal_deg, profile.candela);
  // Whose light it is.
  archive(s.light_groups.size());
  if (!s.light_groups.empty()) {
    archive(s.sky_group, s.sky_parts.groups, s.sky_parts.luminance);
    for (const Surface& surface : s.surfaces) archive(surface.light_group);
    for (const Light& light : s.lights) archive(light.light_group);
  }
  archive(s.sky_image.width, s.sky_image.height, s.sky_image.texels, s.sky_image.rotation_rad, s.sky, s.light_mirrors);
}

void fields(Archive& archive, const LayoutOf& of) {
  for (const AtlasPage& page : of.atlas.pages) archive(page.width, page.height);
  archive(of.atlas.page, of.atlas.uv, of.atlas.chart);
}

void fields(Archive& archive, const LitScene& of) {
  const Scene& scene = of.baked.accel.scene();
  archive(SurfacesOf{scene}, LightsOf{scene}, LayoutOf{of.baked.atlas}, of.baked.pages, of.baked.unlit_white);
}

}  // namespace oriel
