#include "formats/export/place_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace oriel::report {
namespace {

constexpr float kBefore_m = 3, kLeastBefore_m = 0.3f;  // from the place to the eye
constexpr float kTangent = 0.55f;                      // of half the picture's width
constexpr float kRing = 0.05f;                         // its radius, in the picture's half width

// Texels are read at their centre: pages' colours, not their filtering.
Vec3 light_of(const Pack& pack, const MeshPart& part, const TriangleHit& hit) {
  const Material& m = pack.materials[part.material];
  if (m.unlit) return unlit_white(m) * m.base_color;
  Vec3 light = m.emission;
  if (part.lightmap_page < 0) return light;
  const LightmapPage& page = pack.lightmaps[static_cast<std::size_t>(part.lightmap_page)];
  const std::uint32_t* c = &pack.mesh.indices[hit.first_index];
  const Vec2 uv = pack.mesh.lightmap_uvs[c[0]] * (1 - hit.u - hit.v) + pack.mesh.lightmap_uvs[c[1]] * hit.u +
                  pack.mesh.lightmap_uvs[c[2]] * hit.v;
  const IVec2 size(page.width, page.height);
  const IVec2 texel = glm::clamp(IVec2(glm::floor(uv * Vec2(size))), IVec2(0), size - 1);
  const std::size_t i = static_cast<std::size_t>(texel.y) * page.width + static_cast<std::size_t>(texel.x);
  return light + page.irradiance[i] * m.base_color / kPi;
}

struct Look {
  Vec3 eye{0}, ahead{0}, right{0}, up{0};
};

// From the side that the surface faces, somewhat aside and above, as far off as there is room for.
Look look_at_place(const MeshRays& rays, const Vec3& at, const Vec3& normal) {
  const Vec3 level = normalize_or(Vec3(normal.x, 0, normal.z), Vec3(0.6f, 0, 0.8f));
  const Vec3 aside = normalize_or(glm::cross(level, Vec3(0, 1, 0)), Vec3(1, 0, 0));
  const std::array<Vec3, 4> ways{normal + 0.4f * aside + Vec3(0, 0.35f, 0), normal - 0.4f * aside + Vec3(0, 0.35f, 0),
                                 normal + 0.8f * level, normal};
  Look look;
  float farthest = 0;
  for (const Vec3& way : ways) {
    const Vec3 direction = normalize_or(way, normal);
    const auto hit = rays.first(at + 1e-3f * normal, direction, kBefore_m / 0.9f);
    const float room = hit ? 0.9f * hit->distance : kBefore_m;
    if (room <= farthest) continue;
    farthest = room;
    look.eye = at + 1e-3f * normal + std::max(room, kLeastBefore_m) * direction;
  }
  look.ahead = normalize_or(at - look.eye, -normal);
  const Vec3 upright = std::fabs(look.ahead.y) < 0.98f ? Vec3(0, 1, 0) : Vec3(0, 0, -1);
  look.right = normalize_or(glm::cross(look.ahead, upright), Vec3(1, 0, 0));
  look.up = glm::cross(look.right, look.ahead);
  return look;
}

}  // namespace

Raster place_picture(const Pack& pack, const MeshRays& rays, const Vec3& at, const Vec3& normal) {
  const Look look = look_at_place(rays, at, normal);
  Raster out;
  out.light = {kPlaceWidth, kPlaceHeight, 3, {}};
  out.light.pixels.reserve(std::size_t{3} * kPlaceWidth * kPlaceHeight);
  for (std::uint32_t y = 0; y < kPlaceHeight; ++y)
    for (std::uint32_t x = 0; x < kPlaceWidth; ++x) {
      const Vec2 p((2 * (static_cast<float>(x) + 0.5f) - kPlaceWidth) / kPlaceWidth,
                   (kPlaceHeight - 2 * (static_cast<float>(y) + 0.5f)) / kPlaceWidth);
      const Vec3 way = glm::normalize(look.ahead + kTangent * (p.x * look.right + p.y * look.up));
      const auto hit = rays.first(look.eye, way);
      const auto part = hit ? rays.part(hit->first_index) : std::nullopt;
      const Vec3 light = part ? light_of(pack, pack.mesh.parts[*part], *hit) : pack.sky;
      for (int c = 0; c < 3; ++c) out.light.pixels.push_back(light[c]);
      // The ring is what is not known: grey on any light.
      out.known.push_back(std::fabs(glm::length(p) - kRing) > 1.5f / kPlaceWidth ? 1 : 0);
    }
  return out;
}

}  // namespace oriel::report
