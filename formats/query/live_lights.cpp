#include "formats/query/live_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "formats/core/color.h"
#include "formats/query/base_color.h"

namespace oriel {
namespace {

constexpr float kOffset = 1e-4f, kMostOffset_m = 2e-3f;  // of the scene's size
constexpr float kLeastDistance2 = 1e-8f;                 // m², to a light without extent
constexpr float kLeastFacing = 0.05f;                    // cosine: footprints of grazing rays end there
// Dimensions of a walk: who shines, where on it, on which side; the direction; two for each further bounce.
constexpr std::uint32_t kWho = 0, kWhere = 1, kSide = 3, kDirection = 4;
constexpr std::array<std::uint32_t, 16> kPrimes{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53};

std::uint32_t mixed(std::uint32_t x) {
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return x ^ x >> 16;
}

// Halton's sequence with digits that are permuted linearly: the first so many of its points are even too, which walks
// that end early need. Dimensions beyond the primes are plain random numbers.
float halton(std::uint32_t index, std::uint32_t dimension) {
  if (dimension >= kPrimes.size()) return static_cast<float>(mixed(index * 64 + dimension) >> 8) * 0x1p-24f;
  const std::uint32_t base = kPrimes[dimension];
  double value = 0, digit_size = 1.0 / base;
  for (std::uint32_t level = 0; digit_size > 1e-8; ++level, index /= base, digit_size /= base) {
    const std::uint32_t random = mixed(dimension * 32 + level + 1);
    const std::uint32_t digit = (index % base * (1 + random % (base - 1)) + (random >> 16)) % base;
    value += digit * digit_size;
  }
  return std::min(static_cast<float>(value), 0x1.fffffep-1f);
}

Vec2 halton2(std::uint32_t index, std::uint32_t dimension) {
  return {halton(index, dimension), halton(index, dimension + 1)};
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

Vec3 unshadowed(const LiveLight& light, const Vec3& point, const Vec3& normal, Vec3* missing) {
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
  if (missing != nullptr) *missing = Vec3(0);
  if (!(at_point > 0 && at_light > 0)) return Vec3(0);
  const Vec3 facing = light.intensity * (at_point * at_light);
  if (missing != nullptr) *missing = facing * (1 / d2 - 1 / (d2 + light.disk));
  return facing / std::max(d2 + light.disk, kLeastDistance2);
}

struct LampScene::Start {
  Vec3 from{0}, direction{0}, flux{0};  // flux: as if this walk were the only one
  float footprint = 0;                  // 1 / density of directions, steradians
};

struct LampScene::Met {
  bool met = false;  // from its front, and it is none of the lamp
  Vec3 at{0}, normal{0}, albedo{0};
  float distance = 0;
};

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
  double albedo_sum = 0, area = 0;
  Vec3 lower(std::numeric_limits<float>::infinity()), upper(-lower);
  for (std::size_t i = 0; i + 2 < still_mesh_.indices.size(); i += 3) {
    const float own = area_of(still_mesh_, i);
    area += own;
    albedo_sum += own * luminance(albedo({i, 0, 1.0f / 3, 1.0f / 3}));
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& p = still_mesh_.positions[still_mesh_.indices[i + c]];
      lower = glm::min(lower, p), upper = glm::max(upper, p);
    }
  }
  area_ = static_cast<float>(area);
  if (area > 0) {
    mean_albedo_ = static_cast<float>(albedo_sum / area);
    offset_m_ = std::min(kOffset * glm::length(upper - lower), kMostOffset_m);
  }
  float sum = 0;
  const auto take = [&](const Vec3& flux) {
    flux_ += flux;
    chosen_.push_back(sum += luminance(flux));
  };
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

// The same three vertices, of the mesh that has colours.
Vec3 LampScene::albedo(const TriangleHit& hit) const {
  return albedo(part_of(hit).material, &still_mesh_.indices[hit.first_index], {hit.u, hit.v});
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

LampScene::Met LampScene::meet(const Vec3& from, const Vec3& direction, const Mat4& lamp_from_pack) const {
  Met out;
  const auto hit = still_.first(from, direction);
  if (!hit) return out;
  if (!pieces_.empty() &&
      lamp_rays_.first(Vec3(lamp_from_pack * Vec4(from, 1)), Vec3(lamp_from_pack * Vec4(direction, 0)), hit->distance))
    return out;
  out.normal = facing_normal(*hit, direction);
  if (out.normal == Vec3(0)) return out;
  out.met = true;
  out.distance = hit->distance;
  out.at = from + hit->distance * direction + offset_m_ * out.normal;
  out.albedo = albedo(*hit);
  return out;
}

LampScene::Start LampScene::start(std::uint32_t walk, const Mat4& pack_from_lamp) const {
  const float total = chosen_.back(), at = halton(walk, kWho) * total;
  const auto index =
      std::min(static_cast<std::size_t>(std::ranges::upper_bound(chosen_, at) - chosen_.begin()), chosen_.size() - 1);
  const float share = (chosen_[index] - (index > 0 ? chosen_[index - 1] : 0.0f)) / total;
  const Vec2 where = halton2(walk, kWhere), u = halton2(walk, kDirection);
  Start out;
  if (index < pieces_.size()) {
    const Piece& piece = pieces_[index];
    const Vec2 w = in_triangle(where);
    Vec3 normal = Mat3(pack_from_lamp) * piece.normal;
    if (piece.two_sided && halton(walk, kSide) < 0.5f) normal = -normal;
    out.from = Vec3(pack_from_lamp * Vec4(piece.a + w.x * piece.ab + w.y * piece.ac, 1)) + offset_m_ * normal;
    out.direction = cosine_direction(u, normal);
    out.flux = kPi * piece.area * (piece.two_sided ? 2.0f : 1.0f) / share * piece.radiance;
    out.footprint = kPi / std::max(glm::dot(out.direction, normal), kLeastFacing);
    return out;
  }
  const BrightLight& point = lamp_.points[index - pieces_.size()];
  const bool spot = point.kind == BrightLightKind::kSpot;
  const float least = spot ? std::cos(point.outer_cone_rad) : -1.0f, z = 1 - u.x * (1 - least);
  const float r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * kPi * u.y;
  out.direction = Mat3(pack_from_lamp) * (frame_from_normal(spot ? point.direction : Vec3(0, 1, 0)) *
                                          Vec3(r * std::cos(phi), r * std::sin(phi), z));
  out.from = Vec3(pack_from_lamp * Vec4(point.position, 1));
  out.footprint = 2 * kPi * (1 - least);
  out.flux =
      out.footprint / share * point.intensity * (spot ? spot_factor(z, std::cos(point.inner_cone_rad), least) : 1.0f);
  return out;
}

// Each point light once, the rest on triangles, by their flux.
void LampScene::add_direct(std::size_t count, const Mat4& pack_from_lamp, LiveLights& out) const {
  for (std::size_t i = 0; i < std::min(count, lamp_.points.size()); ++i) {
    const BrightLight& point = lamp_.points[i];
    LiveLight& light = out.lights.emplace_back();
    light.position = Vec3(pack_from_lamp * Vec4(point.position, 1));
    light.intensity = point.intensity;
    if (point.kind != BrightLightKind::kSpot) continue;
    light.axis = Mat3(pack_from_lamp) * point.direction;
    light.cos_inner = std::cos(point.inner_cone_rad), light.cos_outer = std::cos(point.outer_cone_rad);
  }
  if (pieces_.empty() || count <= lamp_.points.size() || !(chosen_[pieces_.size() - 1] > 0)) return;
  const std::size_t left = count - lamp_.points.size();
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
          {(static_cast<float>(i) + 0.5f) / static_cast<float>(points), halton(static_cast<std::uint32_t>(i), 0)});
      add_point(piece, w, area, pack_from_lamp, out);
    }
  }
}

void LampScene::add_point(const Piece& piece, const Vec2& at, float area, const Mat4& pack_from_lamp, LiveLights& out) {
  LiveLight& light = out.lights.emplace_back();
  light.normal = Mat3(pack_from_lamp) * piece.normal;
  light.position = Vec3(pack_from_lamp * Vec4(piece.a + at.x * piece.ab + at.y * piece.ac, 1));
  light.intensity = area * piece.radiance;
  light.disk = area / kPi;
  light.two_sided = piece.two_sided;
}

// By bounce: as many walks go on after one as surfaces reflect on average.
std::vector<std::uint32_t> LampScene::walks_by_bounce(std::size_t count, std::uint32_t bounces) const {
  float sum = 0, power = 1;
  for (std::uint32_t j = 0; j < bounces; ++j, power *= mean_albedo_) sum += power;
  std::vector<std::uint32_t> walks;
  if (count == 0 || !(sum > 0) || chosen_.empty() || !(chosen_.back() > 0)) return walks;
  float wanted = static_cast<float>(count) / sum;
  for (std::uint32_t j = 0; j < bounces; ++j, wanted *= mean_albedo_)
    if (const auto w = static_cast<std::uint32_t>(std::lround(wanted)); w > 0) walks.push_back(w);
  return walks;
}

// The first walks go on; what they carry makes up for those that end (Keller 1997, section 3.2). A light where a walk
// first meets a surface stands for the walk's footprint there; a later one for an even share of what these cover.
void LampScene::add_walks(std::size_t count, std::uint32_t bounces, const MoverPose& pose, LiveLights& out) const {
  const std::vector<std::uint32_t> walks = walks_by_bounce(count, bounces);
  if (walks.empty()) return;
  const DMat4 pack_from_lamp = pack_from_object(pose);
  const Mat4 lamp_from_pack(glm::inverse(pack_from_lamp));
  std::vector<std::size_t> bounce_of;  // of lights from `first` on
  const std::size_t first = out.lights.size();
  float lit = 0;  // m², about, that the lamp shines on
  for (std::uint32_t w = 0; w < walks[0]; ++w) {
    const Start begun = start(w, Mat4(pack_from_lamp));
    Vec3 from = begun.from, direction = begun.direction, flux = begun.flux / static_cast<float>(walks[0]);
    for (std::size_t j = 0; j < walks.size() && w < walks[j]; ++j) {
      if (j > 0) flux *= static_cast<float>(walks[j - 1]) / static_cast<float>(walks[j]);
      const Met surface = max_component(flux) > 0 ? meet(from, direction, lamp_from_pack) : Met{};
      flux = surface.met ? flux * surface.albedo : Vec3(0);  // a walk that ends keeps its place among the lights
      LiveLight& light = out.lights.emplace_back();
      bounce_of.push_back(j);
      if (!surface.met) continue;
      light.position = surface.at, light.normal = surface.normal;
      light.intensity = flux / kPi;
      if (j == 0) {
        const float facing = std::max(-glm::dot(direction, surface.normal), kLeastFacing);
        const float footprint = begun.footprint * surface.distance * surface.distance / facing;
        light.disk = std::min(footprint, area_) / static_cast<float>(walks[0]) / kPi;
        lit += kPi * light.disk;
      }
      from = surface.at;
      direction = cosine_direction(halton2(w, kDirection + 2 + 2 * static_cast<std::uint32_t>(j)), surface.normal);
      if (j + 1 == walks.size()) out.left += flux * mean_albedo_;
    }
  }
  for (std::size_t i = 0; i < bounce_of.size(); ++i) {
    float& disk = out.lights[first + i].disk;
    const float even = lit / static_cast<float>(walks[bounce_of[i]]) / kPi;
    disk = bounce_of[i] == 0 ? std::min(disk, even) : even;
  }
}

LiveLights LampScene::lights(const LiveOptions& options, const MoverPose& pose) const {
  LiveLights out;
  out.flux = flux_;
  const bool all_direct = options.indirect == LiveIndirect::kTexels || options.bounce_count() == 0;
  const float share = all_direct ? 1.0f : std::clamp(options.direct_share, 0.0f, 1.0f);
  // Each point light has one, and all surfaces together: fewer would leave out light.
  const bool any = options.lights > 0 && share > 0;
  const std::size_t least = any ? lamp_.points.size() + (pieces_.empty() ? 0 : 1) : 0;
  const auto asked = static_cast<std::size_t>(std::lround(share * static_cast<float>(options.lights)));
  const std::size_t direct = std::max(asked, least);
  add_direct(direct, Mat4(pack_from_object(pose)), out);
  out.direct = out.lights.size();
  if (!all_direct && options.lights > direct) add_walks(options.lights - direct, options.bounce_count(), pose, out);
  return out;
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
