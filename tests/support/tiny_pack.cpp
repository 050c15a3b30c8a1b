#include "tests/support/tiny_pack.h"

#include <algorithm>
#include <limits>

#include "formats/core/half.h"
#include "formats/query/group_light.h"

namespace oriel::testing {
namespace {

void add_quad(Mesh& mesh, const Vec3& corner, const Vec3& right, const Vec3& up, const Vec2& lightmap_corner,
              std::uint32_t material, const char* name) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3 normal = normalize_or(glm::cross(right, up), {0, 1, 0});
  for (int i = 0; i < 4; ++i) {
    const auto x = static_cast<float>(i == 1 || i == 2), y = static_cast<float>(i >= 2);
    mesh.positions.push_back(corner + right * x + up * y);
    mesh.normals.push_back(normal);
    mesh.uvs.push_back({x * 3, y * 3});
    mesh.lightmap_uvs.push_back(lightmap_corner + Vec2(x * 0.5f, y));
    mesh.colors.push_back(0xff8040ffu);
  }
  MeshPart part{name, static_cast<std::uint32_t>(mesh.indices.size()), 6, material, 0};
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
  mesh.parts.push_back(part);
}

Mesh tiny_mesh() {
  Mesh mesh;
  mesh.origin = {1e6, 0.125, -2.5e5};
  add_quad(mesh, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, {0, 0}, 0, "floor");
  add_quad(mesh, {-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, {0.5f, 0}, 1, "wall");
  return mesh;
}

std::vector<Material> tiny_materials() {
  Material mirror;
  mirror.name = "polished";
  mirror.base_color = {0.9f, 0.8f, 0.7f};
  mirror.metallic = 1;
  mirror.roughness = 0.25f;
  mirror.f0 = mirror.base_color;
  mirror.kernel = 1;
  mirror.fresnel_map = 0;
  Material wall;
  wall.name = "wall paper \xc3\xa9";
  wall.base_color = {0.5f, 0.6f, 0.7f};
  wall.base_color_texture = 0;
  wall.alpha_mode = AlphaMode::kMask;
  wall.double_sided = true;
  wall.emission = {0.5f, 0.25f, 0};
  return {mirror, wall};
}

Texture tiny_texture() {
  Texture texture;
  texture.name = "checks";
  texture.width = 4;
  texture.height = 2;
  texture.wrap_t = Wrap::kClamp;
  texture.nearest = true;
  for (std::uint32_t i = 0; i < 8; ++i)
    for (std::uint32_t c = 0; c < 4; ++c)
      texture.texels.push_back(static_cast<std::uint8_t>(c == 3 ? 255 : (i % 3) * 90 + c));
  return texture;
}

LightmapPage tiny_lightmap() {
  LightmapPage page;
  page.width = 8;
  page.height = 4;
  const TexelState states[] = {TexelState::kEmpty, TexelState::kDilated, TexelState::kBuried, TexelState::kValid};
  for (std::uint32_t i = 0; i < 32; ++i) {
    const auto v = static_cast<float>(i);
    page.irradiance.push_back({100 + v * 7.3f, 90 + v, 0.001f * v});
    page.standard_error.push_back(Vec3(0.01f * v));
    page.state.push_back(states[i % 4]);
  }
  page.cell.resize(32);
  page.detail_width = 5, page.detail_height = 8;
  page.cell[9] = DetailBlock{0, 0, 2}.code(), page.cell[10] = DetailBlock{2, 5, 1}.code();
  for (std::uint32_t i = 0; i < 40; ++i) page.detail.push_back({100 + static_cast<float>(i) * 5.1f, 90, 0.5f});
  return page;
}

RadianceMap tiny_radiance_map(float eye_x) {
  RadianceMap map;
  map.eye = {eye_x, 0.25f, -1.5f};
  map.lower = {-2, -2};
  map.upper = {2, 2};
  map.width = 6;
  map.height = 4;
  map.has_emission = eye_x > 0;
  for (std::uint32_t i = 0; i < 24; ++i) {
    const auto v = static_cast<float>(i);
    map.radiance.push_back({v * 3.7f, 40 + v, 12});
    map.disparity.push_back(i == 0 ? 0.0f : 1 / (1 + 0.1f * v));
    map.valid.push_back(static_cast<std::uint8_t>(i == 0 ? 2 : i % 2));
  }
  return map;
}

BrdfKernel tiny_kernel(std::uint32_t size) {
  BrdfKernel kernel;
  kernel.size = size;
  kernel.alpha = size > 1 ? 0.0625f : 0;
  kernel.half_extent = size > 1 ? 0.3f : 0;
  kernel.cos_theta = 0.7f;
  kernel.energy_kept = 0.98f;
  kernel.weights.assign(std::size_t{size} * size, 1.0f / static_cast<float>(size * size));
  return kernel;
}

KernelSlice tiny_slice(float cos_theta) {
  KernelSlice slice;
  slice.cos_theta = cos_theta;
  slice.albedo = 0.9f;
  slice.energy_kept = 0.99f;
  slice.tilt_rad = 0.1f;
  slice.shift = 0.05f;
  slice.width = {0.1f, 0.2f};
  slice.upper = {1.5f, 2};
  slice.lower = {-1.5f, -1};
  slice.radial_extent = 0.7f;
  slice.radial = {0, 0.5f, 0.99f};
  slice.weights = {0.0625f, 0.125f, 0.0625f, 0.125f, 0.25f, 0.125f, 0.0625f, 0.125f, 0.0625f};
  return slice;
}

FresnelMap tiny_fresnel_map() {
  FresnelMap map;
  map.alpha = 0.0625f;
  for (int i = 0; i < 5; ++i) map.table.push_back(Vec3(0.9f, 0.8f, 0.7f) + Vec3(0.02f * static_cast<float>(4 - i)));
  return map;
}

Reflector tiny_reflector() {
  Reflector reflector;
  reflector.name = "floor";
  // x stays, y becomes -z, z becomes up: the floor's plane seen from above.
  reflector.pack_from_reflector = Mat4(1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1);
  reflector.lower = {-2, -2};
  reflector.upper = {2, 2};
  reflector.area_m2 = 16;
  reflector.indices = {0, 1, 2, 0, 2, 3};
  reflector.elements_x = reflector.elements_y = 1;
  reflector.map_count = 2;
  return reflector;
}

Mover tiny_mover() {
  Mover mover;
  mover.name = "door";
  mover.rest = {{1, 0.5f, -1}, {0, 0.6f, 0, 0.8f}};
  mover.keys = {{0, mover.rest}, {1.5f, {{1, 0.5f, 2}, {0, 0, 0, 1}}}};
  add_quad(mover.mesh, {0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0}, 0, "leaf");
  mover.mesh.parts[0].lightmap_page = -1;
  CompressedTransfer& t = mover.transfer;
  t.bands = 2;
  t.channels = 1;
  t.clusters = 2;
  t.components = 1;
  t.error = 0.0125f;
  for (int i = 0; i < 16; ++i) t.basis.push_back(0.25f * static_cast<float>(i - 7));
  t.weight_scale = {0.5f, 0.125f};
  t.cluster = {0, 1, 1, 0};
  t.weight = {-32767, 100, 32767, 0};
  return mover;
}

// One cell cut into eight, which share its corners.
LightField tiny_field() {
  LightField field;
  field.bands = 2;
  field.depth_side = 2;
  field.depth_cap_m = 3;
  field.error = 0.01f;
  field.lower = {-1, 0, -1};
  field.cell_m = {2, 3, 2};
  field.size = {1, 1, 1};
  for (std::uint32_t i = 0; i < 8; ++i) {
    LightProbe probe;
    probe.position = field.lower + field.cell_m * Vec3(i & 1, i >> 1 & 1, i >> 2);
    probe.valid = i != 3;
    probe.bright = i == 0 ? 1 : 0;
    probe.kept = i == 0 ? 2 : 3;
    for (int k = 0; k < 12; ++k)
      probe.sh.push_back(static_cast<float>(k % 4 == 0 ? 40 : k - 7) + 0.1f * static_cast<float>(i));
    for (int k = 0; k < 4; ++k) probe.depth.push_back(Vec2(0.5f, 0.26f) + 0.01f * static_cast<float>(k));
    field.probes.push_back(std::move(probe));
  }
  FieldCell cell{{0, 1, 2, 3, 4, 5, 6, 7}, 1};
  field.cells.push_back(cell);
  cell.children = 0;
  for (std::uint32_t i = 0; i < 8; ++i) {
    std::rotate(cell.probes.begin(), cell.probes.begin() + 1, cell.probes.end());
    field.cells.push_back(cell);
  }
  BrightLight lamp;
  lamp.name = "lamp";
  lamp.kind = BrightLightKind::kPolygon;
  lamp.intensity = {900, 800, 700};
  lamp.corners = {{0, 3, 0}, {1, 3, 0}, {0, 3, 1}};
  lamp.two_sided = true;
  lamp.direction = {0, -1, 0};
  BrightLight spot;
  spot.name = "spot";
  spot.kind = BrightLightKind::kSpot;
  spot.intensity = {10, 20, 30};
  spot.position = {0.5f, 2, 0.5f};
  spot.outer_cone_rad = 0.5f;
  field.lights = {lamp, spot};
  return field;
}

}  // namespace

Pack tiny_pack() {
  Pack pack;
  pack.provenance = R"({"tool":"oriel-bake","version":"0.1.0","seed":7,"options":{"texel":0.1}})";
  pack.plan = R"({"omitted":["movers: the scene has none"]})";
  pack.sky = {0.5f, 0.6f, 1.0f};
  pack.mesh = tiny_mesh();
  pack.materials = tiny_materials();
  pack.textures = {tiny_texture()};
  pack.lightmaps = {tiny_lightmap()};
  pack.reflectors = {tiny_reflector()};
  pack.radiance_maps = {tiny_radiance_map(-0.5f), tiny_radiance_map(0.5f)};
  pack.kernels = {tiny_kernel(1), tiny_kernel(5)};
  pack.fresnel_maps = {tiny_fresnel_map()};
  pack.cameras = {{"door", {0, 1.6f, 1.5f}, {0, 0, -1}, {0, 1, 0}, 1.0f, 0},
                  {"plan", {0, 5, 0}, {0, -1, 0}, {0, 0, -1}, 0, 3}};
  pack.paths = {{"walk", 1.0f, {{0, {0, 1.6f, 1.5f}, {0, 0, -1}}, {2, {0, 1.6f, 0}, {1, 0, 0}}}}};
  UnknownSection unknown;
  unknown.kind = 'X' | 'T' << 8 | 'R' << 16 | 'A' << 24;
  unknown.codec = 77;
  unknown.raw_bytes = 1000;
  unknown.count = 3;
  for (int i = 0; i < 21; ++i) unknown.stored.push_back(static_cast<std::byte>(i * 11));
  pack.unknown = {unknown};
  return pack;
}

namespace {

// Two, of which each has a part of each texel's light, the first more of every third's.
void add_tiny_groups(Pack& pack) {
  pack.light_groups.resize(2);
  for (std::uint32_t g = 0; g < 2; ++g) {
    LightGroup& group = pack.light_groups[g];
    group.name = g == 0 ? "desk" : "hall";
    group.lamps = g == 0 ? std::vector<std::string>{"desk/lamp", "bulb"} : std::vector<std::string>{"sky"};
    group.materials = group.emitters = {g};
    group.bright_lights = {1 - g};
    group.sky = g == 1;
    group.reflectors.assign(pack.reflectors.size(), Vec3(g == 0 ? 0.25f : 0.75f));
    group.surrounds.assign(pack.surround_maps.size(), Vec3(0.5f, 1.0f - static_cast<float>(g), 0.5f));
    group.probes.assign(pack.light_field.probes.size(), Vec3(0.5f));
  }
  pack.light_groups[0].value = 0.5f, pack.light_groups[0].color = Vec3(1, 0.75f, 0.5f);
  pack.light_groups[0].own_color = Vec3(1.5f, 0.875f, 0.5f);
  const LightmapPage& page = pack.lightmaps[0];
  std::vector<std::vector<LightmapPage>> light(2, {page});
  for (std::size_t g = 0; g < 2; ++g)
    for (std::vector<Vec3>* values : {&light[g][0].irradiance, &light[g][0].detail})
      for (std::size_t i = 0; i < values->size(); ++i) (*values)[i] *= (i % 3 == 0) == (g == 0) ? 0.75f : 0.25f;
  pack.page_groups = {groups_of_page(page, 0, light)};
  DayHour night, morning;
  night.hour = 4.5f;
  morning.hour = 8, morning.group = 1, morning.to_sun = {0.6f, 0.8f, 0};
  morning.sun_lux = 70000, morning.sky_lux = 12000, morning.sky = Vec3(3000, 3500, 4000);
  pack.day = {"2026-06-21", 52.5f, 13.5f, -30, false, 2, 12, 8, {night, morning}};
}

// A second page, two lamps that reach it, and records of each kind.
void add_tiny_sharp_light(Pack& pack) {
  LightmapPage page;
  page.width = 4, page.height = 2;
  page.sharp_at = {0, 1, 6, 10, 15, 15, 0, 1};
  page.standard_error.assign(8, Vec3(0.5f));
  page.state.assign(8, TexelState::kValid);
  for (std::uint32_t i = 0; i < 8; ++i) {
    page.sharp.push_back(page.sharp_at[i] == 0 ? Vec3(0) : Vec3(400, 30, 2) * static_cast<float>(i));
    page.irradiance.push_back(page.sharp[i] + Vec3(0.03f, 7, 90));
  }
  pack.lightmaps.push_back(page);
  SharpLight& light = pack.sharp_light;
  SharpLamp spot, sun;
  spot.position = {0.5f, 2, 0.5f};
  spot.direction = {0, -1, 0};
  spot.intensity = {10, 20, 30};
  spot.cos_outer = 0.75f, spot.inverse_falloff = 8;
  sun.sun = true;
  sun.direction = {0.6f, -0.8f, 0};
  sun.intensity = {90000, 80000, 70000};
  sun.angular_radius_rad = 0.0047f;
  light.lamps = {spot, sun};
  light.triangles = {{Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(1, 1, 1)}, {Vec3(0, 1, 0), Vec3(1, 1, 1), Vec3(0, 1, 1)}};
  const std::uint32_t first = 3u << kSharpEdgeShift, second = 6u << kSharpEdgeShift | 1;
  const auto spot_code = [](bool tinted, std::uint32_t count) { return SharpShine{0, tinted, count}.code(); };
  for (const auto& record : std::initializer_list<std::vector<std::uint32_t>>{
           {0},
           {1, spot_code(true, 2), rgb9e5_from_rgb({1, 0.5f, 0.25f}), first, second},
           {2, SharpShine{1, false, 0}.code(), spot_code(false, 1), second},
           {kSharpSplit, 1, 0, 6, 1},
           {kSharpSplit, 10, 6, 0, 1}})
    light.words.insert(light.words.end(), record.begin(), record.end());
}

}  // namespace

Pack tiny_mapped_pack() {
  Pack pack = tiny_pack();
  pack.emission_textures = {{1, 0, Vec3(0.5f, 0.25f, 1)}};
  pack.metalness = {{0, -1, Vec3(0.04f)}, {1, 0, Vec3(0.02f, 0.03f, 0.04f)}};
  pack.solids = {{1, Vec3(0.9f, 0.95f, 1), Vec3(0.5f, 0, 12)}};
  LightmapPage& page = pack.lightmaps[0];
  for (std::size_t i = 0; i < page.irradiance.size(); ++i) {
    const auto v = static_cast<float>(i);
    page.direction.push_back(Vec3(0.1f * v - 1.5f, 1, 0.03f * v) / 4.0f);
  }
  page.direction[0] = {0, -1, 0};
  Texture bumps;
  bumps.name = "bumps";
  bumps.width = bumps.height = 2;
  bumps.wrap_s = Wrap::kMirror;
  bumps.texels = {128, 128, 255, 255, 200, 128, 220, 255, 128, 60, 220, 255, 90, 170, 230, 255};
  pack.normal_textures = {bumps};
  pack.materials[1].normal_texture = 0;
  pack.materials[1].normal_scale = 0.75f;
  for (std::size_t i = 0; i < pack.mesh.positions.size(); ++i) {
    pack.mesh.normal_uvs.push_back(2.0f * pack.mesh.uvs[i]);
    // The floor's tangents follow from the coordinates.
    pack.mesh.tangents.push_back(i < 4 ? Vec4(0) : Vec4(0.6f, 0.8f, 0, i % 2 == 0 ? 1 : -1));
  }
  pack.kernels[1].slice_size = 3;
  pack.kernels[1].slices = {tiny_slice(0.25f), tiny_slice(1)};
  pack.fresnel_maps[0].factor = {Vec3(1), Vec3(0.25f, 0.5f, 0.75f), Vec3(0.04f)};
  pack.kernels[1].fits = {{0.5f, 0.25f, 2, -0.5f, 0.75f}, {}};
  pack.radiance_maps.push_back(tiny_radiance_map(0.5f));
  // The second map's mesh uses its vertices in another order than they have; the third's has no triangle.
  pack.map_meshes = {{{{0, 0, 0.5f}, {1, 0, 0.5f}, {1, 1, 0.25f}, {0, 1, 0.25f}}, {0, 1, 2, 0, 2, 3}},
                     {{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}}, {0, 2, 1}},
                     {}};
  pack.emitters = {{{{-1, 3, 0}, {1, 3, 0}, {1, 3, 1}, {-1, 3, 1}}, {4000, 3000, 2000}, false},
                   {{{0, 1, -2}, {1, 1, -2}, {0, 2, -2}}, {100, 100, 100}, true}};
  Reflector& reflector = pack.reflectors[0];
  reflector.map_count = 3;
  reflector.emitters = {1, 0};
  reflector.visibility_x = 3;
  reflector.visibility_y = 2;
  reflector.visibility = {0, 51, 102, 153, 204, 255, 255, 204, 153, 102, 51, 0};
  const float none = std::numeric_limits<float>::quiet_NaN();
  pack.walk_grids = {{{-2, -2}, 0.5f, 3, 2, {0, 0.25f, none, none, -1, 0}, 1.6f}, {{0, 0}, 1, 1, 1, {3}, 1.5f}};
  Reflector lit = pack.reflectors[0];
  lit.name = "screen";
  lit.elements_x = lit.elements_y = lit.first_map = lit.map_count = 0;
  pack.frosted_panes = {lit};
  pack.curved_reflectors = {{"wall", 1, 0, {4, 5, 6}}};
  pack.surround_maps = {
      {{0, 1, -1}, 2, {{1, 0.5f, 0}, {8, 4, 2}, {0, 0, 0}, {0.25f, 3, 1}}, {2, 0, 1, 0.5f}, {1, 2, 0, 1}}};
  // The first grid has two eye cells, the second one.
  VisibleSets& sets = pack.visible_sets;
  sets.groups = 2;
  sets.runs = {{6, 1}, {3, 0}, {3, 1}};
  sets.side = 2;
  sets.below_m = 0.5f;
  sets.above_m = 0.25f;
  sets.seen = {3, 1, 2};
  sets.made_for = visibility_hash(pack.mesh, pack.materials, pack.walk_grids);
  for (const Reflector& r : pack.reflectors)
    pack.reflected_sets.seen.push_back(static_cast<std::uint8_t>(r.map_count > 0 ? 3 : 1));
  pack.reflected_sets.made_for = reflected_hash(sets, pack.reflectors);
  pack.sky_map = {3, 2, {{1, 2, 3}, {0.5f, 0, 0.25f}, {4, 1, 1}, {0, 0, 0}, {1, 1, 1}, {2, 0.5f, 1}}};
  pack.movers = {tiny_mover()};
  pack.light_field = tiny_field();
  add_tiny_groups(pack);
  add_tiny_sharp_light(pack);
  return pack;
}

}  // namespace oriel::testing
