// Every rule of validate() is broken once, on a pack that is right otherwise: each check can fail, under its own
// number.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "formats/pack/validate.h"
#include "tests/support/tiny_pack.h"

namespace oriel {
namespace {

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();

struct Break {
  int number;
  const char* section;
  std::function<void(Pack&)> change;
};

// A record of so many lamps with so many triangles each.
void add_sharp_record(Pack& pack, std::uint32_t lamps, std::uint32_t triangles) {
  pack.sharp_light.words.push_back(lamps);
  for (; lamps > 0; --lamps) {
    pack.sharp_light.words.push_back(SharpShine{0, false, triangles}.code());
    pack.sharp_light.words.insert(pack.sharp_light.words.end(), triangles, 0);
  }
}

const Break kBreaks[] = {
    {101, "MESH", [](Pack& p) { p.mesh.uvs.pop_back(); }},
    {101, "MESH", [](Pack& p) { p.mesh.colors.pop_back(); }},
    {103, "MESH", [](Pack& p) { p.mesh.origin.y = kNan; }},
    {103, "MESH", [](Pack& p) { p.mesh.positions[3].z = kInf; }},
    {104, "MESH", [](Pack& p) { p.mesh.normals[0] *= 1.01f; }},
    {104, "MESH", [](Pack& p) { p.mesh.normals[0].x = kNan; }},
    {105, "MESH", [](Pack& p) { p.mesh.uvs[0].x = kNan; }},
    {105, "MESH", [](Pack& p) { p.mesh.lightmap_uvs[0].x = 1.01f; }},
    {106, "MESH", [](Pack& p) { p.mesh.indices[2] = 8; }},
    {107, "MESH", [](Pack& p) { p.mesh.parts[0].index_count = 5; }},
    {108, "MESH", [](Pack& p) { p.mesh.parts[1].index_count = 0xfffffffcu; }},
    {109, "MESH", [](Pack& p) { p.mesh.parts[1].material = 2; }},
    {110, "MESH", [](Pack& p) { p.mesh.parts[1].lightmap_page = 2; }},
    {110, "MESH", [](Pack& p) { p.mesh.parts[1].lightmap_page = -2; }},
    {101, "MESH", [](Pack& p) { p.mesh.tangents.pop_back(); }},
    {105, "MESH", [](Pack& p) { p.mesh.normal_uvs[0].y = kInf; }},
    {112, "MESH", [](Pack& p) { p.mesh.tangents[5].x = 0; }},
    {112, "MESH", [](Pack& p) { p.mesh.tangents[5].w = 0.5f; }},
    {201, "MATL", [](Pack& p) { p.materials[0].base_color.g = -0.1f; }},
    {201, "MATL", [](Pack& p) { p.materials[0].roughness = kNan; }},
    {202, "MATL", [](Pack& p) { p.materials[0].emission.b = kInf; }},
    {203, "MATL", [](Pack& p) { p.materials[1].base_color_texture = 1; }},
    {204, "MATL", [](Pack& p) { p.materials[0].kernel = 2; }},
    {205, "MATL", [](Pack& p) { p.materials[0].fresnel_map = -7; }},
    {206, "MATL", [](Pack& p) { p.materials[1].normal_texture = 1; }},
    {206, "MATL", [](Pack& p) { p.materials[1].normal_scale = kNan; }},
    {207, "MATL", [](Pack& p) { p.mesh.normal_uvs = {}, p.mesh.tangents = {}; }},
    {211, "NTEX 0", [](Pack& p) { p.normal_textures[0].texels.pop_back(); }},
    {211, "TEXR 0", [](Pack& p) { p.textures[0].texels.pop_back(); }},
    {301, "LMAP 0", [](Pack& p) { p.lightmaps[0].state.pop_back(); }},
    {301, "LMAP 0", [](Pack& p) { p.lightmaps[0].width = 0; }},
    {302, "LMAP 0", [](Pack& p) { p.lightmaps[0].irradiance[4].r = -1; }},
    {302, "LMAP 0", [](Pack& p) { p.lightmaps[0].irradiance[4].b = kInf; }},
    {303, "LMAP 0", [](Pack& p) { p.lightmaps[0].standard_error[4].b = kNan; }},
    {304, "LMAP 0",
     [](Pack& p) {
       p.lightmaps[0].direction[4] = {1, 0.2f, 0};
     }},
    {304, "LMAP 0", [](Pack& p) { p.lightmaps[0].direction[4].z = kNan; }},
    {304, "LMAP 0", [](Pack& p) { p.lightmaps[0].direction.pop_back(); }},
    {305, "LMAP 0", [](Pack& p) { p.lightmaps[0].detail.pop_back(); }},
    {305, "LMAP 0", [](Pack& p) { p.lightmaps[0].cell.clear(); }},
    {305, "LMAP 0", [](Pack& p) { p.lightmaps[0].detail[7].g = -1; }},
    {306, "LMAP 0",
     [](Pack& p) {
       p.lightmaps[0].cell[9] = DetailBlock{1, 0, 2}.code();
     }},
    {306, "LMAP 0",
     [](Pack& p) {
       p.lightmaps[0].cell[9] = DetailBlock{0, 0, 4}.code();
     }},
    {306, "LMAP 0",
     [](Pack& p) {
       p.lightmaps[0].cell[15] = DetailBlock{0, 0, 1}.code();
     }},
    {309, "LMAP 1", [](Pack& p) { p.lightmaps[1].sharp.pop_back(); }},
    {309, "LMAP 1", [](Pack& p) { p.lightmaps[1].sharp_at.clear(); }},
    {309, "LMAP 1", [](Pack& p) { p.lightmaps[1].sharp[3].g = -1; }},
    {309, "LMAP 1", [](Pack& p) { p.lightmaps[1].sharp[3].b = kNan; }},
    {309, "LMAP 1", [](Pack& p) { p.lightmaps[1].sharp[3].b = 100; }},
    {310, "LMAP 1", [](Pack& p) { p.lightmaps[1].sharp_at[0] = 2; }},
    {310, "LMAP 1", [](Pack& p) { p.lightmaps[1].sharp_at[7] = 20; }},
    {310, "LMAP 1", [](Pack& p) { p.sharp_light = {}; }},
    {310, "LMAP 1", [](Pack& p) { p.sharp_light.words[7] = 2; }},
    {311, "SHRP", [](Pack& p) { p.sharp_light.lamps.resize(1025, p.sharp_light.lamps[0]); }},
    {311, "SHRP", [](Pack& p) { p.sharp_light.lamps.clear(); }},
    {311, "SHRP", [](Pack& p) { p.sharp_light.words.clear(); }},
    {312, "SHRP", [](Pack& p) { p.sharp_light.lamps[0].position.x = kNan; }},
    {312, "SHRP", [](Pack& p) { p.sharp_light.lamps[0].direction *= 2; }},
    {312, "SHRP", [](Pack& p) { p.sharp_light.lamps[0].intensity.r = -1; }},
    {312, "SHRP", [](Pack& p) { p.sharp_light.lamps[0].cos_outer = kNan; }},
    {312, "SHRP", [](Pack& p) { p.sharp_light.lamps[0].inverse_falloff = 0; }},
    {312, "SHRP", [](Pack& p) { p.sharp_light.lamps[0].inverse_falloff = kInf; }},
    {312, "SHRP", [](Pack& p) { p.sharp_light.lamps[1].angular_radius_rad = kPi / 2; }},
    {312, "SHRP", [](Pack& p) { p.sharp_light.lamps[1].light_group = 2; }},
    {313, "SHRP", [](Pack& p) { p.sharp_light.triangles[1][2].y = kInf; }},
    {314, "SHRP", [](Pack& p) { p.sharp_light.words[0] = 1; }},
    {314, "SHRP", [](Pack& p) { p.sharp_light.words[2] = SharpShine{2, true, 2}.code(); }},
    {314, "SHRP", [](Pack& p) { p.sharp_light.words[2] = SharpShine{0, true, 0x1fffff}.code(); }},
    {314, "SHRP", [](Pack& p) { p.sharp_light.words[5] = 2; }},
    {314, "SHRP", [](Pack& p) { add_sharp_record(p, 17, 0); }},
    {314, "SHRP", [](Pack& p) { add_sharp_record(p, 1, 65); }},
    {314, "SHRP", [](Pack& p) { p.sharp_light.words[6] = 3; }},    // lamps
    {314, "SHRP", [](Pack& p) { p.sharp_light.words[11] = 10; }},  // itself
    {314, "SHRP", [](Pack& p) { p.sharp_light.words[11] = 15; }},  // behind it
    {314, "SHRP", [](Pack& p) { p.sharp_light.words[11] = 2; }},   // inside a record
    {314, "SHRP", [](Pack& p) { p.sharp_light.words.pop_back(); }},
    {314, "SHRP", [](Pack& p) { p.sharp_light.words.push_back(1); }},
    {314, "SHRP",
     [](Pack& p) {
       for (std::uint32_t below = 15; below < 35; below += 5)  // two splits and four
         p.sharp_light.words.insert(p.sharp_light.words.end(), {kSharpSplit, below, 0, 0, 0});
     }},
    {401, "RFLT", [](Pack& p) { p.reflectors[0].material = 9; }},
    {402, "RFLT", [](Pack& p) { p.reflectors[0].pack_from_reflector[0] *= 1.1f; }},
    {402, "RFLT", [](Pack& p) { p.reflectors[0].pack_from_reflector[1] *= -1.0f; }},
    {402, "RFLT", [](Pack& p) { p.reflectors[0].pack_from_reflector[3].x = kNan; }},
    {403, "RFLT", [](Pack& p) { p.reflectors[0].upper.x = -3; }},
    {404, "RFLT", [](Pack& p) { p.reflectors[0].area_m2 = -1; }},
    {405, "RFLT", [](Pack& p) { p.reflectors[0].indices[0] = 8; }},
    {406, "RFLT", [](Pack& p) { p.reflectors[0].map_count = 4; }},
    {407, "RFLT", [](Pack& p) { p.reflectors[0].elements_x = 0; }},
    {411, "RMAP 1", [](Pack& p) { p.radiance_maps[1].disparity.pop_back(); }},
    {412, "RMAP 1", [](Pack& p) { p.radiance_maps[1].reflector = 1; }},
    {412, "RMAP 1", [](Pack& p) { p.reflectors[0].map_count = 1; }},
    {413, "RMAP 0", [](Pack& p) { p.radiance_maps[0].eye.z = 0; }},
    {414, "RMAP 0", [](Pack& p) { p.radiance_maps[0].upper.x = 2.1f; }},
    {414, "RMAP 0", [](Pack& p) { p.radiance_maps[0].upper.y = p.radiance_maps[0].lower.y; }},
    {415, "RMAP 0", [](Pack& p) { p.radiance_maps[0].radiance[1].r = kNan; }},
    {416, "RMAP 0", [](Pack& p) { p.radiance_maps[0].disparity[1] = 1.1f; }},
    {417, "RMAP 0", [](Pack& p) { p.radiance_maps[0].valid[1] = 3; }},
    {419, "RMAP 2", [](Pack& p) { p.radiance_maps[1].element = 1; }},
    {425, "RMAP 1", [](Pack& p) { p.radiance_maps[1].upper.x -= 0.125f; }},
    {426, "RMAP 0", [](Pack& p) { p.radiance_maps[0].element = 99; }},
    {427, "MMSH", [](Pack& p) { p.map_meshes.pop_back(); }},
    {428, "MMSH 0", [](Pack& p) { p.map_meshes[0].vertices[1].z = 1.5f; }},
    {429, "MMSH 1", [](Pack& p) { p.map_meshes[1].indices[1] = 3; }},
    {429, "MMSH 0", [](Pack& p) { p.map_meshes[0].indices.pop_back(); }},
    {420, "RMAP 16", [](Pack& p) { p.map_meshes.clear(), p.radiance_maps.resize(17, p.radiance_maps[0]); }},
    {421, "EMIT", [](Pack& p) { p.emitters[0].corners.pop_back(), p.emitters[0].corners.pop_back(); }},
    {421, "EMIT", [](Pack& p) { p.emitters[0].corners[1].y = 2; }},
    {421, "EMIT",
     [](Pack& p) {
       p.emitters[0].corners[2] = {-0.5f, 3, 0.25f};
     }},
    {421, "EMIT", [](Pack& p) { p.emitters[1].corners[0].x = kNan; }},
    {422, "EMIT", [](Pack& p) { p.emitters[1].radiance.g = -1; }},
    {423, "RFLT", [](Pack& p) { p.reflectors[0].emitters[1] = 2; }},
    {424, "RFLT", [](Pack& p) { p.reflectors[0].visibility.pop_back(); }},
    {424, "RFLT", [](Pack& p) { p.reflectors[0].visibility_x = 1; }},
    {401, "PANE", [](Pack& p) { p.frosted_panes[0].material = 2; }},
    {405, "PANE", [](Pack& p) { p.frosted_panes[0].indices[0] = 8; }},
    {423, "PANE", [](Pack& p) { p.frosted_panes[0].emitters[1] = 2; }},
    {424, "PANE", [](Pack& p) { p.frosted_panes[0].visibility.pop_back(); }},
    {430, "PANE", [](Pack& p) { p.frosted_panes[0].map_count = 1; }},
    {431, "CRFL", [](Pack& p) { p.curved_reflectors[0].material = 2; }},
    {431, "CRFL", [](Pack& p) { p.curved_reflectors[0].map = 1; }},
    {432, "CRFL", [](Pack& p) { p.curved_reflectors[0].indices[1] = 8; }},
    {441, "SMAP 0", [](Pack& p) { p.surround_maps[0].centre.y = kInf; }},
    {442, "SMAP 0", [](Pack& p) { p.surround_maps[0].valid.pop_back(); }},
    {443, "SMAP 0", [](Pack& p) { p.surround_maps[0].radiance[2].g = -1; }},
    {444, "SMAP 0", [](Pack& p) { p.surround_maps[0].inverse_distance[1] = kNan; }},
    {445, "SMAP 0", [](Pack& p) { p.surround_maps[0].valid[3] = 3; }},
    {501, "KERN", [](Pack& p) { p.kernels[1].alpha = kNan; }},
    {502, "KERN", [](Pack& p) { p.kernels[1].size = 4; }},
    {503, "KERN", [](Pack& p) { p.kernels[1].weights[0] = -0.01f; }},
    {504, "KERN", [](Pack& p) { p.kernels[1].weights[0] += 2e-4f; }},
    {502, "KERN", [](Pack& p) { p.kernels[1].slices[1].weights.pop_back(); }},
    {503, "KERN", [](Pack& p) { p.kernels[1].slices[1].weights[3] = kNan; }},
    {504, "KERN", [](Pack& p) { p.kernels[1].slices[0].weights[4] += 2e-4f; }},
    {511, "KERN", [](Pack& p) { p.kernels[1].slices[1].cos_theta = 0.25f; }},
    {511, "KERN", [](Pack& p) { p.kernels[1].slices[0].cos_theta = kNan; }},
    {512, "KERN", [](Pack& p) { p.kernels[1].slices[0].albedo = 1.1f; }},
    {512, "KERN", [](Pack& p) { p.kernels[1].slices[0].tilt_rad = kInf; }},
    {512, "KERN", [](Pack& p) { p.kernels[1].slices[0].radial_extent = -1; }},
    {513, "KERN", [](Pack& p) { p.kernels[1].slices[0].width.y = 0; }},
    {513, "KERN", [](Pack& p) { p.kernels[1].slices[0].upper.x = 2; }},
    {513, "KERN", [](Pack& p) { p.kernels[1].slices[0].upper.y = 1e6f; }},
    {513, "KERN", [](Pack& p) { p.kernels[1].slices[0].shift = kNan; }},
    {514, "KERN", [](Pack& p) { p.kernels[1].slices[0].radial.resize(1); }},
    {514, "KERN", [](Pack& p) { p.kernels[1].slices[0].radial[1] = 0.995f; }},
    {514, "KERN", [](Pack& p) { p.kernels[1].slices[0].radial[1] = kNan; }},
    {516, "KERN", [](Pack& p) { std::swap(p.kernels[1].slices[0].weights[0], p.kernels[1].slices[0].weights[1]); }},
    {515, "KERN", [](Pack& p) { p.kernels[1].slices.resize(257, p.kernels[1].slices[0]); }},
    {521, "KERN", [](Pack& p) { p.kernels[1].fits.pop_back(); }},
    {522, "KERN", [](Pack& p) { p.kernels[1].fits[0].m22 = 0; }},
    {522, "KERN", [](Pack& p) { p.kernels[1].fits[0].m13 = -4; }},
    {522, "KERN", [](Pack& p) { p.kernels[1].fits[1].amplitude = kNan; }},
    {601, "FRES", [](Pack& p) { p.fresnel_maps[0].alpha = 2; }},
    {602, "FRES", [](Pack& p) { p.fresnel_maps[0].table.resize(1); }},
    {603, "FRES", [](Pack& p) { p.fresnel_maps[0].table[1].r = 1.01f; }},
    {603, "FRES", [](Pack& p) { p.fresnel_maps[0].table[1].r = kNan; }},
    {604, "FRES", [](Pack& p) { p.fresnel_maps[0].factor.resize(1); }},
    {605, "FRES", [](Pack& p) { p.fresnel_maps[0].factor[1].g = -0.1f; }},
    {701, "CAMS", [](Pack& p) { p.cameras[0].eye.x = kNan; }},
    {702, "CAMS", [](Pack& p) { p.cameras[0].up = p.cameras[0].forward; }},
    {703, "CAMS", [](Pack& p) { p.cameras[0].vertical_fov_rad = 3.2f; }},
    {703, "CAMS", [](Pack& p) { p.cameras[1].half_height = 0; }},
    {711, "PATH", [](Pack& p) { p.paths[0].vertical_fov_rad = 0; }},
    {712, "PATH", [](Pack& p) { p.paths[0].keys[0].forward = Vec3(0); }},
    {713, "PATH", [](Pack& p) { p.paths[0].keys[0].time_s = 3; }},
    {721, "WALK", [](Pack& p) { p.walk_grids[0].floor_y.pop_back(); }},
    {722, "WALK", [](Pack& p) { p.walk_grids[0].cell_m = 0; }},
    {722, "WALK", [](Pack& p) { p.walk_grids[1].lower.y = kInf; }},
    {723, "WALK", [](Pack& p) { p.walk_grids[1].floor_y[0] = kInf; }},
    {751, "PVIS", [](Pack& p) { p.visible_sets.runs[1].group = 2; }},
    {751, "PVIS", [](Pack& p) { p.visible_sets.runs[1].index_count = 2; }},
    {751, "PVIS", [](Pack& p) { p.visible_sets.runs.push_back({0, 0}); }},
    {752, "PVIS", [](Pack& p) { p.visible_sets.runs.pop_back(); }},
    {752, "PVIS", [](Pack& p) { p.visible_sets.runs = {{3, 0}, {9, 1}}; }},
    {753, "PVIS", [](Pack& p) { p.visible_sets.side = 0; }},
    {753, "PVIS", [](Pack& p) { p.visible_sets.below_m = kNan; }},
    {753, "PVIS", [](Pack& p) { p.visible_sets.groups = (1u << 16) + 1; }},
    {754, "PVIS", [](Pack& p) { p.visible_sets.seen.pop_back(); }},
    {754, "PVIS", [](Pack& p) { p.visible_sets.side = 1; }},
    {755, "PVIS", [](Pack& p) { p.mesh.positions[0].x += 1; }},
    {755, "PVIS", [](Pack& p) { p.walk_grids[0].floor_y[2] = 0; }},
    {756, "RVIS", [](Pack& p) { p.reflected_sets.seen.push_back(0); }},
    {757, "RVIS", [](Pack& p) { p.reflectors[0].flatness_m += 1; }},
    {731, "MOVR 0", [](Pack& p) { p.movers[0].rest.rotation.y = 0; }},
    {731, "MOVR 0", [](Pack& p) { p.movers[0].keys[1].pose.position.x = kInf; }},
    {732, "MOVR 0", [](Pack& p) { p.movers[0].keys[0].time_s = 2; }},
    {733, "MOVR 0", [](Pack& p) { p.movers[0].transfer.cluster.pop_back(); }},
    {733, "MOVR 0", [](Pack& p) { p.movers[0].transfer.channels = 2; }},
    {734, "MOVR 0", [](Pack& p) { p.movers[0].transfer.cluster[2] = 2; }},
    {734, "MOVR 0", [](Pack& p) { p.movers[0].transfer.basis[5] = kNan; }},
    {735, "MOVR 0", [](Pack& p) { p.light_field.bands = 0; }},
    {736, "MOVR 0", [](Pack& p) { p.movers[0].mesh.parts[0].material = 1; }},
    {106, "MOVR 0", [](Pack& p) { p.movers[0].mesh.indices[1] = 4; }},
    {741, "PROB", [](Pack& p) { p.light_field.size[1] = 10; }},
    {741, "PROB", [](Pack& p) { p.light_field.cell_m.z = 0; }},
    {742, "PROB", [](Pack& p) { p.light_field.cells[3].probes[7] = 8; }},
    {742, "PROB", [](Pack& p) { p.light_field.cells[0].children = 2; }},
    {742, "PROB", [](Pack& p) { p.light_field.cells[2].children = 1; }},
    {743, "PROB", [](Pack& p) { p.light_field.probes[1].sh[3] = kNan; }},
    {743, "PROB", [](Pack& p) { p.light_field.probes[1].depth.pop_back(); }},
    {743, "PROB", [](Pack& p) { p.light_field.probes[1].kept = 4; }},
    {743, "PROB", [](Pack& p) { p.light_field.probes[0].kept = 1; }},
    {744, "PROB", [](Pack& p) { p.light_field.lights[0].corners.pop_back(); }},
    {744, "PROB", [](Pack& p) { p.light_field.lights[1].intensity.g = -1; }},
    {208, "GLAS", [](Pack& p) { p.solids = {{99, Vec3(1), Vec3(0)}}; }},
    {208, "GLAS", [](Pack& p) { p.solids = {{0, Vec3(1), Vec3(0)}, {0, Vec3(1), Vec3(0)}}; }},
    {209, "GLAS", [](Pack& p) { p.solids = {{0, Vec3(1.5f), Vec3(0)}}; }},
    {209, "GLAS", [](Pack& p) { p.solids = {{0, Vec3(1), Vec3(0, kNan, 0)}}; }},
    {212, "ETEX", [](Pack& p) { p.emission_textures = {{99, 0, Vec3(1)}}; }},
    {212, "ETEX", [](Pack& p) { p.emission_textures = {{0, 99, Vec3(1)}}; }},
    {212, "ETEX", [](Pack& p) { p.emission_textures = {{0, 0, Vec3(1)}, {0, 0, Vec3(1)}}; }},
    {213, "ETEX", [](Pack& p) { p.emission_textures = {{0, 0, Vec3(0.5f, kNan, 0)}}; }},
    {214, "METL", [](Pack& p) { p.metalness = {{99, 0, Vec3(0)}}; }},
    {214, "METL", [](Pack& p) { p.metalness = {{0, 99, Vec3(0)}}; }},
    {214, "METL", [](Pack& p) { p.metalness = {{0, -2, Vec3(0)}}; }},
    {214, "METL", [](Pack& p) { p.metalness = {{0, 0, Vec3(0)}, {0, 0, Vec3(0)}}; }},
    {215, "METL", [](Pack& p) { p.metalness = {{0, 0, Vec3(0, 0, 1.5f)}}; }},
    {761, "LGRP", [](Pack& p) { p.light_groups[1].name = p.light_groups[0].name; }},
    {761, "LGRP", [](Pack& p) { p.light_groups[1].value = -1; }},
    {761, "LGRP", [](Pack& p) { p.light_groups[1].color.b = kNan; }},
    {761, "LGRP", [](Pack& p) { p.light_groups[0].own_color.r = kInf; }},
    {731, "LGRP", [](Pack& p) { p.light_groups[0].keys = {{0, {{kInf, 0, 0}, {0, 0, 0, 1}}}}; }},
    {732, "LGRP", [](Pack& p) { p.light_groups[0].keys = {{1, {}}, {0, {}}}; }},
    {762, "LGRP", [](Pack& p) { p.light_groups[0].materials = {2}; }},
    {762, "LGRP", [](Pack& p) { p.light_groups[0].emitters = {2}; }},
    {762, "LGRP", [](Pack& p) { p.light_groups[0].bright_lights = {2}; }},
    {763, "LGRP", [](Pack& p) { p.light_groups[0].materials = {1}; }},
    {764, "LGRP", [](Pack& p) { p.light_groups[1].probes.pop_back(); }},
    {764, "LGRP", [](Pack& p) { p.light_groups[1].reflectors[0].g = 1.5f; }},
    {764, "LGRP", [](Pack& p) { p.light_groups[1].surrounds.clear(); }},
    {765, "GLMP 0", [](Pack& p) { p.page_groups[0].page = 2; }},
    {765, "GLMP 0", [](Pack& p) { p.page_groups[0].others[0].group = 2; }},
    {765, "GLMP 1", [](Pack& p) { p.page_groups.push_back(p.page_groups[0]); }},
    {766, "GLMP 0", [](Pack& p) { p.page_groups[0].width = 4; }},
    {766, "GLMP 0", [](Pack& p) { p.page_groups[0].rest.pop_back(); }},
    {766, "GLMP 0", [](Pack& p) { p.page_groups[0].others[1].light.pop_back(); }},
    {767, "GLMP 0", [](Pack& p) { p.page_groups[0].rest[3] = 2; }},
    {768, "LGRP",
     [](Pack& p) {
       for (int i = 0; i < 63; ++i) {
         p.light_groups.push_back(p.light_groups[1]);
         LightGroup& added = p.light_groups.back();
         added.name += std::to_string(i), added.materials = {}, added.emitters = {}, added.bright_lights = {};
       }
     }},
    {769, "DAYH", [](Pack& p) { p.day.latitude_deg = 91; }},
    {769, "DAYH", [](Pack& p) { p.day.shown_hour = 9; }},
    {770, "DAYH", [](Pack& p) { p.day.hours[1].hour = 4.5f; }},
    {770, "DAYH", [](Pack& p) { p.day.hours[1].group = 2; }},
    {770, "DAYH", [](Pack& p) { p.day.hours[0].group = 1; }},
    {770, "DAYH", [](Pack& p) { p.day.hours[1].group = kNight; }},
    {770, "DAYH", [](Pack& p) { p.day.hours[1].sky_lux = -1; }},
    {770, "DAYH", [](Pack& p) { p.day.hours[1].sky.g = kNan; }},
    {801, "PROV", [](Pack& p) { p.provenance = "{\"a\":"; }},
    {802, "PROV", [](Pack& p) { p.provenance.clear(); }},
    {803, "PLAN", [](Pack& p) { p.plan = "[1]"; }},
    {804, "SCNE", [](Pack& p) { p.sky.r = kNan; }},
    {805, "SKYM", [](Pack& p) { p.sky_map.texels.pop_back(); }},
    {806, "SKYM", [](Pack& p) { p.sky_map.texels[1].y = kNan; }},
    {901, "MESH", [](Pack& p) { p.unknown[0].kind = 'M' | 'E' << 8 | 'S' << 16 | 'H' << 24; }},
    {902, "XTRA", [](Pack& p) { p.unknown[0].raw_bytes = ~0ull; }},
};

TEST(Validate, EveryRuleCanFail) {
  for (const auto& rule : kBreaks) {
    Pack pack = testing::tiny_mapped_pack();
    rule.change(pack);
    bool found = false;
    std::string all;
    for (const auto& issue : validate(pack)) {
      all += std::to_string(issue.number) + " " + issue.section + ": " + issue.message + "\n";
      found = found || (issue.number == rule.number &&
                        issue.section.find(std::string("section ") + rule.section) == 0 && !issue.message.empty());
    }
    EXPECT_TRUE(found) << rule.number << " in " << rule.section << ", found:\n" << all;
  }
}

TEST(Validate, CountsAndNamesTheFirst) {
  Pack pack = testing::tiny_pack();
  pack.mesh.positions[2].x = kNan;
  pack.mesh.positions[5].y = kInf;
  const auto issues = validate(pack);
  ASSERT_EQ(issues.size(), 1u);
  EXPECT_EQ(issues[0].message, "2 of 8 positions: the first is number 2, found (nan, 0, -2), expected finite numbers");
}

TEST(Validate, EmptyPackHasWarningsOnly) {
  for (const auto& issue : validate(Pack{})) EXPECT_EQ(issue.severity, Severity::kWarning) << issue.message;
}

TEST(Validate, DeepJsonIsNoStackOverflow) {
  Pack pack = testing::tiny_pack();
  pack.provenance = "{\"a\":" + std::string(1000000, '[');
  EXPECT_FALSE(validate(pack).empty());
}

}  // namespace
}  // namespace oriel
