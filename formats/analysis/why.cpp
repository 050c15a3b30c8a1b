#include "formats/analysis/why.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "formats/analysis/lights.h"
#include "formats/core/color.h"
#include "formats/core/json.h"
#include "formats/core/result.h"
#include "formats/query/sharp_light.h"

namespace oriel {
namespace {

constexpr float kSamePlace_m = 2e-4f;  // surfaces no farther apart coincide: eyes and depth buffers do not part them
constexpr float kParallel = 0.999f;    // of their normals
constexpr float kCovers_m = 0.02f;     // what is no farther before a surface lies on it
constexpr int kLooks = 48;             // directions that are looked along
constexpr float kAll = 0.9f;           // of them, for "all of it"
constexpr double kDarkPlace = 1e-3;    // of the page's mean
constexpr int kFilledReach = 24;       // texels from which light is filled in

struct Nearest {
  std::size_t first_index = 0;
  Vec3 at{0};
  float distance = std::numeric_limits<float>::infinity();
};

// Ericson 2005, Real-Time Collision Detection, 5.1.5.
Vec3 closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const float d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  const float d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d1 <= 0 && d2 <= 0) return a;
  if (d3 >= 0 && d4 <= d3) return b;
  if (d6 >= 0 && d5 <= d6) return c;
  const float vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + d1 / (d1 - d3) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + d2 / (d2 - d6) * ac;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b);
  const float scale = 1 / (va + vb + vc);
  return a + vb * scale * ab + vc * scale * ac;
}

// Of several in one place the one whose front the eye sees.
std::optional<Nearest> nearest_surface(const Pack& pack, const Vec3& place, const WhyOptions& options) {
  const Mesh& mesh = pack.mesh;
  Nearest best;
  bool faces = false;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Vec3 at = closest_on_triangle(place, mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]],
                                        mesh.positions[mesh.indices[i + 2]]);
    const float distance = glm::distance(at, place);
    if (!(distance <= best.distance + kSamePlace_m)) continue;
    const bool facing = options.eye && glm::dot(triangle_normal(mesh, i), *options.eye - at) > 0;
    if (distance > best.distance - kSamePlace_m && (faces || !facing) && best.distance < HUGE_VALF) continue;
    best = {i, at, distance};
    faces = facing;
  }
  if (!(best.distance <= options.reach_m)) return std::nullopt;
  return best;
}

// What a triangle's point has as lightmap coordinates, and the root of a texel's area there.
struct TexelPoint {
  Vec2 uv{0};
  float side_m = 0;
};
TexelPoint texel_point(const Mesh& mesh, const Nearest& n, const LightmapPage& page) {
  const std::uint32_t* c = &mesh.indices[n.first_index];
  const Vec3 a = mesh.positions[c[0]], ab = mesh.positions[c[1]] - a, ac = mesh.positions[c[2]] - a, ap = n.at - a;
  const float d00 = glm::dot(ab, ab), d01 = glm::dot(ab, ac), d11 = glm::dot(ac, ac);
  const float d20 = glm::dot(ap, ab), d21 = glm::dot(ap, ac), det = d00 * d11 - d01 * d01;
  const float v = det > 0 ? (d11 * d20 - d01 * d21) / det : 0, w = det > 0 ? (d00 * d21 - d01 * d20) / det : 0;
  const Vec2 ua = mesh.lightmap_uvs[c[0]], ub = mesh.lightmap_uvs[c[1]] - ua, uc = mesh.lightmap_uvs[c[2]] - ua;
  const float texels =
      std::fabs(ub.x * uc.y - ub.y * uc.x) * static_cast<float>(page.width) * static_cast<float>(page.height);
  return {ua + v * ub + w * uc, texels > 0 ? std::sqrt(std::sqrt(std::max(det, 0.0f)) / texels) : 0};
}

double mean_lux(const LightmapPage& page) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < page.irradiance.size(); ++i)
    if (page.state[i] == TexelState::kValid) sum += luminance(page.irradiance[i]), ++count;
  return count > 0 ? sum / count : 0;
}

void read_texel(const Pack& pack, const Nearest& n, const LightmapPage& page, Why& why) {
  const TexelPoint p = texel_point(pack.mesh, n, page);
  const IVec2 size(page.width, page.height);
  why.texel = glm::clamp(IVec2(glm::floor(p.uv * Vec2(size))), IVec2(0), size - 1);
  const auto i = static_cast<std::size_t>(why.texel.y) * page.width + static_cast<std::size_t>(why.texel.x);
  why.state = page.state[i];
  why.side_m = p.side_m;
  why.lux = luminance(page.irradiance[i]);
  why.lux_error = luminance(page.standard_error[i]);
  if (!page.sharp_at.empty() && page.sharp_at[i] != 0)
    why.sharp_lux = luminance(sharp_irradiance(pack.sharp_light, page, {p.uv, n.at, why.normal}));
  why.dark = why.lux <= kDarkPlace * mean_lux(page);
}

// The nearest texel that was baked.
std::optional<IVec2> source_of(const LightmapPage& page, const IVec2& texel) {
  std::optional<IVec2> best;
  int nearest = kFilledReach * kFilledReach + 1;
  for (int dy = -kFilledReach; dy <= kFilledReach; ++dy)
    for (int dx = -kFilledReach; dx <= kFilledReach; ++dx) {
      const IVec2 at = texel + IVec2(dx, dy);
      if (at.x < 0 || at.y < 0 || at.x >= static_cast<int>(page.width) || at.y >= static_cast<int>(page.height))
        continue;
      const auto i = static_cast<std::size_t>(at.y) * page.width + static_cast<std::size_t>(at.x);
      if (page.state[i] != TexelState::kValid || dx * dx + dy * dy >= nearest) continue;
      nearest = dx * dx + dy * dy;
      best = at;
    }
  return best;
}

void add_coincident(const Pack& pack, const Nearest& n, std::uint32_t own, Why& why) {
  const Vec3 from = n.at + 2 * kSamePlace_m * why.normal;
  for (const TriangleHit& hit : triangles_along(pack.mesh, from, -why.normal, 4 * kSamePlace_m)) {
    const auto part = part_of_triangle(pack.mesh, hit.first_index);
    if (hit.first_index == n.first_index || !part || *part == own) continue;
    const float along = glm::dot(triangle_normal(pack.mesh, hit.first_index), why.normal);
    const float apart_mm = 1000 * std::fabs(hit.distance - 2 * kSamePlace_m);
    const std::string& name = pack.mesh.parts[*part].name;
    // The two sides of a double-sided surface lie there on purpose.
    if (std::fabs(along) < kParallel || apart_mm > 1000 * kSamePlace_m || along < 0) continue;
    why.reasons.push_back(
        {Cause::kCoincident, name,
         fmt::format("'{}' lies in the same place ({:.2g} mm apart): each hides the other from light, "
                     "and frames show now one, now the other",
                     name, apart_mm),
         "delete one of the two, or move one out by 1 mm or more"});
    return;
  }
}

// What is met by looking all around.
struct LookAround {
  std::map<std::string, int> backs, near;
  int back = 0, nearby = 0;
  std::string first_back;
  float first_back_m = std::numeric_limits<float>::infinity();
};

LookAround look_around(const Pack& pack, const MeshRays& rays, const SeenPoint& point, float near_m) {
  LookAround out;
  for (const Vec3& way : cosine_directions(point.normal, kLooks)) {
    const auto hit = first_blocker(pack, rays, point.at, way, std::numeric_limits<float>::infinity());
    if (!hit) continue;
    const bool back = !hit->front && !pack.materials[pack.mesh.parts[hit->part].material].double_sided;
    if (back) {
      ++out.back;
      ++out.backs[hit->name];
      if (hit->distance < out.first_back_m) out.first_back_m = hit->distance, out.first_back = hit->name;
    }
    if (hit->distance < near_m) {
      ++out.nearby;
      ++out.near[hit->name];
    }
  }
  return out;
}

std::string most_of(const std::map<std::string, int>& counts) {
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? std::string() : most->first;
}

void add_surroundings(const Pack& pack, const MeshRays& rays, const SeenPoint& point, Why& why) {
  const float near_m = std::max(why.side_m, kCovers_m);
  const LookAround seen = look_around(pack, rays, point, near_m);
  why.near_share = static_cast<float>(seen.nearby) / kLooks;
  why.near_by = most_of(seen.near);
  const std::string inside_of = most_of(seen.backs);
  const int of_one = seen.backs.empty() ? 0 : seen.backs.at(inside_of);
  const bool enclosed = seen.back >= kAll * kLooks && of_one >= kAll * static_cast<float>(seen.back);
  if (why.state == TexelState::kBuried || enclosed) {
    const std::string& object = seen.first_back.empty() ? why.near_by : inside_of;
    why.reasons.push_back({Cause::kInside, object,
                           object.empty()
                               ? "it lies inside other geometry, where nobody sees it and no light comes"
                               : fmt::format("it lies inside '{}' ({:.1f} cm to its wall): no light comes there",
                                             object, 100 * std::min(seen.first_back_m, 1e3f)),
                           "nothing where nobody sees it; else move one of the two apart"});
    return;
  }
  const auto cover = first_blocker(pack, rays, point.at, point.normal, std::max(kCovers_m, 0.25f * why.side_m));
  if (cover && cover->front && why.near_share >= kAll) {
    why.reasons.push_back(
        {Cause::kCovered, cover->name,
         fmt::format("'{}' lies on it, {:.2g} mm before it: next to no light comes between", cover->name,
                     1000 * cover->distance),
         "nothing: what is under things is dark. If it should be seen, raise it above what covers it"});
    return;
  }
  if (why.dark && seen.back >= kAll * kLooks)
    why.reasons.push_back(
        {Cause::kSeesBacks, inside_of,
         fmt::format("it sees backs of one-sided surfaces alone, most of '{}': those reflect nothing", inside_of),
         "turn their faces over, or bake with --double-sided"});
}

// Why nothing shines there, of one that is dark.
void add_darkness(const Pack& pack, Why& why) {
  if (why.lights.empty()) {
    const Json plan = Json::parse(pack.plan).value_or(Json());
    const auto scene = plan.is_object() ? plan.value("scene", Json()) : Json();
    const bool untold = scene.is_object() && scene.contains("punctual_lights") && scene["punctual_lights"] != 0;
    why.reasons.push_back(
        untold ? Reason{Cause::kIndirect, "", "the pack does not tell where its point and sun lights are",
                        "bake again: packs name their lights now"}
               : Reason{Cause::kNoLight, "", "the scene has no light: no emissive material, no punctual light, no sky",
                        "export punctual lights, raise emissive_strength, or bake with --sky 1000"});
    return;
  }
  std::map<std::string, int> hiders;
  const LightVerdict* seen = nullptr;
  for (const LightVerdict& light : why.lights) {
    if (light.kind == LightVerdict::Kind::kHidden) ++hiders[light.by];
    if (light.kind == LightVerdict::Kind::kLights && seen == nullptr) seen = &light;
  }
  if (seen != nullptr) {
    why.reasons.push_back({Cause::kIndirect, seen->light,
                           fmt::format("'{}' is in sight from here, but gives next to nothing beside the rest of the "
                                       "scene, or the texel ({:.0f} cm wide) lies mostly where it is not",
                                       seen->light, 100 * why.side_m),
                           "a smaller --texel, if the light should show"});
  } else if (!hiders.empty()) {
    const std::string by = most_of(hiders);
    why.reasons.push_back({Cause::kShadow, by,
                           fmt::format("every light is hidden from here, most by '{}', and what reflects is dark", by),
                           fmt::format("nothing where '{}' should cast a shadow; else move it or a light", by)});
  } else {
    why.reasons.push_back({Cause::kFacesAway, "",
                           "it faces away from every light, and what it faces reflects next to nothing",
                           "turn its faces over if its other side is the one that should be seen, or add a light"});
  }
}

}  // namespace

const char* name_of(Cause cause) {
  static const std::array names{"unlit",      "black",  "coincident",       "inside",
                                "covered",    "filled", "seen from behind", "no light",
                                "faces away", "shadow", "sees backs",       "indirect"};
  return names.at(static_cast<std::size_t>(cause));
}

std::optional<Why> why_at(const Pack& pack, const MeshRays& rays, const Vec3& place, const WhyOptions& options,
                          const WhyPage& page_of) {
  const auto nearest = nearest_surface(pack, place, options);
  const auto own = nearest ? rays.part(nearest->first_index) : std::nullopt;
  if (!own) return std::nullopt;
  const MeshPart& part = pack.mesh.parts[*own];
  const Material& material = pack.materials[part.material];
  Why why;
  why.surface = part.name;
  why.material = material.name;
  why.at = DVec3(nearest->at) + pack.mesh.origin;
  why.off_m = nearest->distance;
  why.normal = triangle_normal(pack.mesh, nearest->first_index);
  why.page = part.lightmap_page;
  if (options.eye && !material.double_sided && glm::dot(*options.eye - nearest->at, why.normal) < 0)
    why.reasons.push_back(
        {Cause::kSeenBehind, material.name,
         fmt::format("this is the back of '{}', which is one-sided: light is baked for its front", material.name),
         "turn its faces over, or make the material double-sided and bake again"});
  if (why.page < 0) {
    why.reasons.push_back(
        material.unlit
            ? Reason{Cause::kUnlit, material.name,
                     fmt::format("'{}' has no lightmap: its material is unlit and shows its colour as it is",
                                 part.name),
                     "take KHR_materials_unlit from the material, and bake again"}
            : Reason{
                  Cause::kBlack, material.name,
                  fmt::format("'{}' has no lightmap: '{}' has no diffuse colour, so light leaves it as dark as it is",
                              part.name, material.name),
                  "a base colour above black, less metal or less transmission, and bake again"});
    return why;
  }
  const LightmapPage* page = page_of(static_cast<std::uint32_t>(why.page));
  if (page != nullptr) read_texel(pack, *nearest, *page, why);
  const float eps = kSamePlace_m + 1e-6f * glm::length(nearest->at);
  const SeenPoint point{nearest->at + eps * why.normal, why.normal, eps};
  add_coincident(pack, *nearest, *own, why);
  add_surroundings(pack, rays, point, why);
  if (page != nullptr && (why.state == TexelState::kDilated || why.state == TexelState::kBuried)) {
    const auto source = source_of(*page, why.texel);
    why.reasons.push_back(
        {Cause::kFilled, "",
         source ? fmt::format("its texel was not baked: it holds the light of its neighbours, the nearest at {}, {}",
                              source->x, source->y)
                : std::string("its texel was not baked, and no neighbour was"),
         "nothing; a smaller --texel where the border shows"});
  }
  why.lights = judge_lights(pack, rays, point, why.lights_left_out);
  if (why.dark && why.reasons.empty()) add_darkness(pack, why);
  return why;
}

}  // namespace oriel
