#include "formats/analysis/asset_diff.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "formats/core/hash.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

template <class V>
Json numbers_of(const V& v) {
  return std::array{v.x, v.y, v.z};
}

// Assets by name, each with its members.
class AssetList {
 public:
  void add(const char* kind, const std::string& name, Json members) {
    const std::string key = fmt::format("{} '{}'", kind, name);
    const int same = ++count_[key];
    all[same == 1 ? key : fmt::format("{} ({})", key, same)] = std::move(members);
  }
  std::map<std::string, Json> all;

 private:
  std::map<std::string, int> count_;
};

Json texels_of(const std::vector<Texture>& textures, std::int32_t index) {
  if (index < 0) return {};
  const Texture& t = textures[static_cast<std::size_t>(index)];
  return fmt::format("{} x {}: {}", t.width, t.height, hash128_hex(std::as_bytes(std::span(t.texels))));
}

void add_materials(const Pack& pack, AssetList& list) {
  for (const Material& m : pack.materials)
    list.add("material", m.name,
             {{"base colour", numbers_of(m.base_color)},
              {"texture", texels_of(pack.textures, m.base_color_texture)},
              {"normal map", texels_of(pack.normal_textures, m.normal_texture)},
              {"alpha", {m.alpha, m.alpha_cutoff, static_cast<int>(m.alpha_mode)}},
              {"normal scale", m.normal_scale},
              {"double-sided", m.double_sided},
              {"unlit", m.unlit},
              {"metallic", m.metallic},
              {"roughness", m.roughness},
              {"index of refraction", m.ior},
              {"reflectance", numbers_of(m.f0)},
              {"transmission", m.transmission},
              {"emission", m.unlit ? Json() : numbers_of(m.emission)}});  // an unlit one's follows from its light
  for (const SolidGlass& s : pack.solids)
    list.add("glass", pack.materials[s.material].name,
             {{"tint", numbers_of(s.tint)}, {"absorption", numbers_of(s.absorption)}});
  for (const EmissionTexture& e : pack.emission_textures)
    list.add("picture", pack.materials[e.material].name,
             {{"texture", texels_of(pack.textures, static_cast<int>(e.texture))}});
  for (const Metalness& m : pack.metalness)
    list.add("metalness", pack.materials[m.material].name,
             {{"texture", texels_of(pack.textures, m.texture)}, {"dielectric", numbers_of(m.dielectric)}});
}

void add_lamps(const Pack& pack, AssetList& list) {
  DVec3 towards(0);  // another map with this mean differs
  for (std::size_t i = 0; const Vec3& texel : pack.sky_map.texels) towards += static_cast<double>(++i) * DVec3(texel);
  list.add("light", "sky", {{"radiance", numbers_of(pack.sky)}, {"map", numbers_of(towards)}});
  for (std::size_t i = 0; const SharpLamp& l : pack.sharp_light.lamps)
    list.add("lamp", std::to_string(i++),
             {{"position", numbers_of(DVec3(l.position) + pack.mesh.origin)},
              {"direction", numbers_of(l.direction)},
              {"intensity", numbers_of(l.intensity)},
              {"cone", {l.cos_outer, l.inverse_falloff, l.angular_radius_rad}}});
  for (const LightGroup& g : pack.light_groups)
    list.add("light group", g.name, {{"lamps", g.lamps}, {"value", g.value}, {"colour", numbers_of(g.color)}});
}

// Of what no light tells: surfaces without, and movers.
void add_shapes(const Pack& pack, AssetList& list) {
  const auto add = [&](const char* kind, const std::string& name, const Mesh& mesh, const MeshPart& part) {
    Vec3 lower(std::numeric_limits<float>::max()), upper(-lower);
    for (std::uint32_t i = 0; i < part.index_count; ++i) {
      const Vec3& corner = mesh.positions[mesh.indices[part.first_index + i]];
      lower = glm::min(lower, corner), upper = glm::max(upper, corner);
    }
    list.add(kind, name,
             {{"triangles", part.index_count / 3},
              {"lower", numbers_of(DVec3(lower) + pack.mesh.origin)},
              {"upper", numbers_of(DVec3(upper) + pack.mesh.origin)}});
  };
  for (const MeshPart& part : pack.mesh.parts)
    if (part.lightmap_page < 0) add("unlit surface", part.name, pack.mesh, part);
  for (const Mover& mover : pack.movers)
    for (const MeshPart& part : mover.mesh.parts) add("mover", mover.name, mover.mesh, part);
}

void add_cameras(const Pack& pack, AssetList& list) {
  for (const Camera& c : pack.cameras)
    list.add("camera", c.name,
             {{"eye", numbers_of(DVec3(c.eye) + pack.mesh.origin)},
              {"forward", numbers_of(c.forward)},
              {"up", numbers_of(c.up)},
              {"field of view", {c.vertical_fov_rad, c.half_height}}});
  for (const CameraPath& p : pack.paths) {
    Json keys = Json::array();
    for (const CameraKey& k : p.keys)
      keys.push_back({k.time_s, numbers_of(DVec3(k.eye) + pack.mesh.origin), numbers_of(k.forward)});
    list.add("path", p.name, {{"field of view", p.vertical_fov_rad}, {"keys", keys}});
  }
}

std::map<std::string, Json> assets_of(const Pack& pack) {
  AssetList list;
  add_materials(pack, list);
  add_lamps(pack, list);
  add_shapes(pack, list);
  add_cameras(pack, list);
  return std::move(list.all);
}

void append_numbers(const Json& json, std::vector<double>& numbers) {
  if (json.is_number()) numbers.push_back(json.get<double>());
  for (const Json& one : json) append_numbers(one, numbers);
}

// scale: what the largest difference is a share of; 0: the largest number.
double change_between(const Json& before, const Json& after, double scale) {
  std::vector<double> a, b;
  append_numbers(before, a), append_numbers(after, b);
  if (a.size() != b.size() || a.empty()) return 1;
  double off = 0, largest = scale;
  for (std::size_t i = 0; i < a.size(); ++i) {
    off = std::max(off, std::fabs(a[i] - b[i]));
    if (scale == 0) largest = std::max({largest, std::fabs(a[i]), std::fabs(b[i])});
  }
  return off / largest;
}

// A place's change is a share of the building's size, wherever the building stands.
bool is_place(const std::string& member) {
  return member == "position" || member == "eye" || member == "lower" || member == "upper";
}
double size_of(const Mesh& mesh) {
  Vec3 lower(std::numeric_limits<float>::max()), upper(-lower);
  for (const Vec3& p : mesh.positions) lower = glm::min(lower, p), upper = glm::max(upper, p);
  return mesh.positions.empty() ? 0 : glm::length(DVec3(upper) - DVec3(lower));
}

}  // namespace

std::vector<AssetChange> diff_assets(const Pack& before, const Pack& after) {
  const std::map<std::string, Json> a = assets_of(before), b = assets_of(after);
  const double size = size_of(before.mesh);
  std::vector<AssetChange> changes;
  for (const auto& [name, members] : a) {
    const auto other = b.find(name);
    if (other == b.end()) {
      changes.push_back({name, "gone", members.dump(), ""});
      continue;
    }
    for (const auto& [member, value] : members.items())
      if (const Json& now = other->second[member]; now != value)
        changes.push_back(
            {name, member, value.dump(), now.dump(), change_between(value, now, is_place(member) ? size : 0)});
  }
  for (const auto& [name, members] : b)
    if (!a.contains(name)) changes.push_back({name, "added", "", members.dump()});
  std::ranges::stable_sort(changes, std::ranges::greater(), &AssetChange::change);
  return changes;
}

}  // namespace oriel
