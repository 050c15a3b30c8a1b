#include "formats/query/live_lights.h"

#include <functional>

#include "formats/core/color.h"
#include "formats/query/base_color.h"

namespace oriel {
namespace {

constexpr float kOffset = 1e-4f, kMostOffset_m = 2e-3f;  // of the scene's size
constexpr float kLeastDistance2 = 1e-8f;                 // m², to a light without extent

std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return x ^ x >> 16;
}

// The van der Corput sequence with digits that are permuted at random: the first so many of its points are even too.
float van_der_corput(std::uint32_t index) {
  double value = 0, digit_size = 0.5;
  for (std::uint32_t level = 0; digit_size > 1e-8; ++level, index /= 2, digit_size /= 2)
    value += (index + (mixed(level + 1) >> 16)) % 2 * digit_size;
  return std::min(static_cast<float>(value), 0x1.fffffep-1f);
}

// Shares of two sides (Heitz 2019, "A Low-Distortion Map Between Triangle and Square").
Vec2 in_triangle(const Vec2& u) {
  return u.y > u.x ? Vec2(0.5f * u.x, u.y - 0.5f * u.x) : Vec2(u.x - 0.5f * u.y, 0.5f * u.y);
}

// glTF's KHR_lights_punctual.
float spot_factor(float cosine, float cos_inner, float cos_outer) {
  if (cosine >= cos_inner) return 1;
  if (cosine <= cos_outer) return 0;
  const float share = (cosine - cos_outer) / std::max(cos_inner - cos_outer, kSharpestCone);
  return share * share;
}

bool is_obstacle(const Material& material) {
  return material.alpha_mode != AlphaMode::kBlend && material.transmission <= 0 && !material.unlit;
}

Vec3 mean_reflectance(std::span<const Vec3> table) {
  constexpr int kSteps = 32;
  Vec3 sum(0);
  for (int i = 0; i < kSteps; ++i)  // even in cos²θ
    sum += lookup_by_cosine(table, std::sqrt((static_cast<float>(i) + 0.5f) / kSteps));
  return sum / static_cast<float>(kSteps);
}

float area_of(const Mesh& mesh, std::size_t first_index) {
  const Vec3 a = mesh.positions[mesh.indices[first_index]];
  return 0.5f * glm::length(glm::cross(mesh.positions[mesh.indices[first_index + 1]] - a,
                                       mesh.positions[mesh.indices[first_index + 2]] - a));
}

void add_part(const Mesh& mesh, const MeshPart& part, Mesh& out) {
  MeshPart added = part;
  added.first_index = static_cast<std::uint32_t>(out.indices.size());
  const auto from = mesh.indices.begin() + part.first_index;
  out.indices.insert(out.indices.end(), from, from + part.index_count);
  out.parts.push_back(std::move(added));
}

Mesh parts_where(const Mesh& mesh, const std::function<bool(std::uint32_t)>& wanted) {
  Mesh out;
  out.positions = mesh.positions;
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p)
    if (wanted(p)) add_part(mesh, mesh.parts[p], out);
  return out;
}

}  // namespace

Vec3 unshadowed(const LiveLight& light, const Vec3& point, const Vec3& normal) {
  const Vec3 to = light.position - point;
  const float d2 = length2(to), inverse = d2 > 0 ? 1 / std::sqrt(d2) : 0.0f;
  const float at_point = glm::dot(normal, to) * inverse;
  float at_light = 1;
  if (light.normal != Vec3(0)) {
    at_light = -glm::dot(light.normal, to) * inverse;
    if (light.two_sided) at_light = std::abs(at_light);
  } else if (light.axis != Vec3(0)) {
    at_light = spot_factor(-glm::dot(light.axis, to) * inverse, light.cos_inner, light.cos_outer);
  }
  if (!(at_point > 0 && at_light > 0)) return Vec3(0);
  const Vec3 facing = light.intensity * (at_point * at_light);
  return facing / std::max(d2 + light.disk, kLeastDistance2);
}

LampScene::LampScene(const LiveSurfaces& surfaces, LiveLamp lamp)
    : surfaces_(surfaces),
      lamp_(std::move(lamp)),
      still_mesh_(parts_where(surfaces.mesh,
                              [&](std::uint32_t p) {
                                return std::ranges::find(lamp_.parts, p) == lamp_.parts.end() &&
                                       is_obstacle(surfaces.materials[surfaces.mesh.parts[p].material]);
                              })),
      lamp_mesh_(parts_where(surfaces.mesh,
                             [&](std::uint32_t p) { return std::ranges::find(lamp_.parts, p) != lamp_.parts.end(); })),
      still_(still_mesh_),
      lamp_rays_(lamp_mesh_) {
  for (const Material& material : surfaces.materials) two_sided_.push_back(material.double_sided ? 1 : 0);
  for (const Material& material : surfaces.materials)
    reflectance_.push_back(
        material.fresnel_map < 0
            ? Vec3(0)
            : mean_reflectance(surfaces.fresnel_maps[static_cast<std::size_t>(material.fresnel_map)].table));
  Vec3 lower(std::numeric_limits<float>::infinity()), upper(-lower);
  for (std::size_t i = 0; i + 2 < still_mesh_.indices.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& p = still_mesh_.positions[still_mesh_.indices[i + c]];
      lower = glm::min(lower, p), upper = glm::max(upper, p);
    }
  }
  if (!still_mesh_.indices.empty()) offset_m_ = std::min(kOffset * glm::length(upper - lower), kMostOffset_m);
  float sum = 0;
  const auto take = [&](const Vec3& flux) { chosen_.push_back(sum += luminance(flux)); };
  for (std::size_t i = 0; i + 2 < lamp_mesh_.indices.size(); i += 3) {
    const std::uint32_t part = lamp_rays_.part(i).value_or(0);  // of lamp_mesh_, whose parts are in the mesh's order
    const Material& material = surfaces.materials[lamp_mesh_.parts[part].material];
    const auto corner = [&](std::size_t c) { return lamp_mesh_.positions[lamp_mesh_.indices[i + c]]; };
    const Piece& piece = pieces_.emplace_back(Piece{corner(0), corner(1) - corner(0), corner(2) - corner(0),
                                                    triangle_normal(lamp_mesh_, i), lamp_.radiance[part],
                                                    area_of(lamp_mesh_, i), material.double_sided});
    take(kPi * piece.area * (piece.two_sided ? 2.0f : 1.0f) * piece.radiance);
  }
  for (const BrightLight& point : lamp_.points) {
    const bool spot = point.kind == BrightLightKind::kSpot;
    take(point.intensity * (spot ? 2 * kPi * (1 - std::cos(point.outer_cone_rad)) : 4 * kPi));
  }
}

const MeshPart& LampScene::part_of(const TriangleHit& hit) const {
  return still_mesh_.parts[still_.part(hit.first_index).value_or(0)];
}

Vec3 LampScene::facing_normal(const TriangleHit& hit, const Vec3& direction) const {
  const Vec3 normal = triangle_normal(still_mesh_, hit.first_index);
  if (!(glm::dot(normal, direction) > 0)) return normal;
  return is_two_sided(part_of(hit).material) ? -normal : Vec3(0);
}

Vec3 LampScene::reflectance(std::uint32_t part, std::size_t first_index, const Vec2& shares) const {
  return albedo(surfaces_.mesh.parts[part].material, &surfaces_.mesh.indices[first_index], shares);
}

Vec3 LampScene::albedo(std::uint32_t index, const std::uint32_t* corners, const Vec2& shares) const {
  const Material& material = surfaces_.materials[index];
  return base_color_at(surfaces_.mesh, material, surfaces_.textures, corners, shares) *
             ((1 - material.metallic) * (1 - max_component(reflectance_[index]))) +
         reflectance_[index];
}

std::optional<LampScene::LitPlace> LampScene::lit_place(const Vec3& from, const Vec3& direction) const {
  const auto hit = still_.first(from, direction);
  if (!hit || part_of(*hit).lightmap_page < 0) return std::nullopt;
  const Vec3 normal = facing_normal(*hit, direction);
  if (normal == Vec3(0)) return std::nullopt;
  const std::uint32_t* corners = &still_mesh_.indices[hit->first_index];
  const auto& uvs = surfaces_.mesh.lightmap_uvs;
  return LitPlace{static_cast<std::uint32_t>(part_of(*hit).lightmap_page),
                  (1 - hit->u - hit->v) * uvs[corners[0]] + hit->u * uvs[corners[1]] + hit->v * uvs[corners[2]],
                  from + hit->distance * direction, normal};
}

bool LampScene::sees(const Vec3& from, const Vec3& to, const Mat4& lamp_from_pack, Blockers& last) const {
  if (still_.blocks(from, to, last.still)) return false;
  return pieces_.empty() ||
         !lamp_rays_.blocks(Vec3(lamp_from_pack * Vec4(from, 1)), Vec3(lamp_from_pack * Vec4(to, 1)), last.lamp);
}

// Each point light once, the rest on triangles, by their flux.
std::vector<LiveLight> LampScene::lights(std::size_t count, const MoverPose& pose) const {
  std::vector<LiveLight> out;
  if (count == 0) return out;
  const Mat4 pack_from_lamp(pack_from_object(pose));
  for (const BrightLight& point : lamp_.points) {
    LiveLight& light = out.emplace_back();
    light.position = Vec3(pack_from_lamp * Vec4(point.position, 1));
    light.intensity = point.intensity;
    if (point.kind != BrightLightKind::kSpot) continue;
    light.axis = Mat3(pack_from_lamp) * point.direction;
    light.cos_inner = std::cos(point.inner_cone_rad), light.cos_outer = std::cos(point.outer_cone_rad);
  }
  if (pieces_.empty() || !(chosen_[pieces_.size() - 1] > 0)) return out;
  const std::size_t left = std::max(count, lamp_.points.size() + 1) - lamp_.points.size();
  const float total = chosen_[pieces_.size() - 1];
  // Lights from `first` on are those whose middle of even shares of the flux lies beyond that sum.
  const auto first_after = [&](float sum) {
    return static_cast<std::size_t>(
        std::clamp(std::ceil(sum / total * static_cast<float>(left) - 0.5f), 0.0f, static_cast<float>(left)));
  };
  std::size_t first = 0;
  for (std::size_t index = 0; index < pieces_.size(); ++index) {
    const std::size_t end = index + 1 == pieces_.size() ? left : first_after(chosen_[index]), points = end - first;
    first = end;
    const Piece& piece = pieces_[index];
    const float share = (chosen_[index] - (index > 0 ? chosen_[index - 1] : 0.0f)) / total;
    for (std::size_t i = 0; i < points; ++i) {
      const float area = piece.area / (share * static_cast<float>(left));
      const Vec2 w = in_triangle(
          {(static_cast<float>(i) + 0.5f) / static_cast<float>(points), van_der_corput(static_cast<std::uint32_t>(i))});
      out.push_back(point_on(piece, w, area, pack_from_lamp));
    }
  }
  return out;
}

LiveLight LampScene::point_on(const Piece& piece, const Vec2& at, float area, const Mat4& pack_from_lamp) {
  LiveLight light;
  light.normal = Mat3(pack_from_lamp) * piece.normal;
  light.position = Vec3(pack_from_lamp * Vec4(piece.a + at.x * piece.ab + at.y * piece.ac, 1));
  light.intensity = area * piece.radiance;
  light.disk = area / kPi;
  light.two_sided = piece.two_sided;
  return light;
}

std::string LampScene::passes_through(const MoverPose& pose) const {
  constexpr float kWithin = 0.99f;  // lamps may touch what they hang on
  const Mat4 pack_from_lamp(pack_from_object(pose));
  Vec3 middle(0);
  for (const Piece& piece : pieces_) middle += (piece.a + (piece.ab + piece.ac) / 3.0f) / float(pieces_.size());
  const auto met = [&](const Vec3& from, const Vec3& to) {
    const auto hit = still_.first(from, to - from, 1);
    return hit ? still_.part(hit->first_index) : std::nullopt;
  };
  for (const Piece& piece : pieces_) {
    const Vec3 corners[] = {piece.a, piece.a + piece.ab, piece.a + piece.ac};
    for (int c = 0; c < 3; ++c) {
      const Vec3 from = glm::mix(middle, corners[c], kWithin), to = glm::mix(middle, corners[(c + 1) % 3], kWithin);
      const auto part = met(Vec3(pack_from_lamp * Vec4(from, 1)), Vec3(pack_from_lamp * Vec4(to, 1)));
      if (part && !met(from, to)) return still_mesh_.parts[*part].name;
    }
  }
  return {};
}

}  // namespace oriel
