#include "study/herf1997/shadow_patch.h"

#include <algorithm>
#include <cmath>

namespace oriel::study {
namespace {

constexpr int kMostTexels = 256;  // of a patch along a side, as the paper's receivers have

Occluders occluders_of(const Mesh& mesh, const std::vector<Material>* materials) {
  const std::vector<DVec3> points(mesh.positions.begin(), mesh.positions.end());
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const MeshPart& part : mesh.parts) {
    if (materials != nullptr) {
      const Material& m = (*materials)[part.material];
      if (m.alpha_mode == AlphaMode::kBlend || m.transmission > 0) continue;
    }
    for (std::uint32_t i = part.first_index; i < part.first_index + part.index_count; i += 3)
      triangles.push_back({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
  }
  return {points, triangles};
}

DVec3 in_plane(const FlatPlane& plane, const DVec3& p) {
  const DVec3 off = p - plane.origin;
  return {glm::dot(off, plane.x), glm::dot(off, plane.y), glm::dot(off, plane.normal)};
}

// The light as a mover has it, in its own space.
ShadowLight moved(const ShadowLight& light, const DMat4& to) {
  ShadowLight out = light;
  out.normal = DMat3(to) * light.normal;
  for (ShadowLightSample& s : out.samples) s.position = DVec3(to * DVec4(s.position, 1));
  return out;
}

ShadowReceiver moved(const ShadowReceiver& receiver, const DMat4& to) {
  ShadowReceiver out = receiver;
  out.corner = DVec3(to * DVec4(receiver.corner, 1));
  out.x = DMat3(to) * receiver.x, out.y = DMat3(to) * receiver.y, out.normal = DMat3(to) * receiver.normal;
  return out;
}

DMat4 rigid_inverse(const DMat4& m) {
  DMat4 out(glm::transpose(DMat3(m)));
  out[3] = DVec4(-(DMat3(out) * DVec3(m[3])), 1);
  return out;
}

}  // namespace

PlaneRect common(const PlaneRect& a, const PlaneRect& b) {
  return {max(a.lower, b.lower), min(a.upper, b.upper)};
}
PlaneRect around(const PlaneRect& a, const PlaneRect& b) {
  if (a.empty()) return b;
  return b.empty() ? a : PlaneRect{min(a.lower, b.lower), max(a.upper, b.upper)};
}

Occluders still_occluders(const Pack& pack) {
  return occluders_of(pack.mesh, &pack.materials);
}
Occluders mover_occluders(const Mover& mover) {
  return occluders_of(mover.mesh, nullptr);
}

bool is_flat(const BrightLight& light) {
  if (light.kind != BrightLightKind::kPolygon || light.corners.size() < 3) return false;
  float size = 0;
  for (const Vec3& c : light.corners) size = std::max(size, glm::distance(c, light.corners[0]));
  return std::ranges::all_of(light.corners, [&](const Vec3& c) {
    return std::abs(glm::dot(c - light.corners[0], light.direction)) <= 1e-4f * size;
  });
}

ShadowLight shadow_light(const BrightLight& light, int samples) {
  std::vector<LightTriangle> triangles;
  for (std::size_t i = 0; i + 2 < light.corners.size(); i += 3)
    triangles.push_back({DVec3(light.corners[i]), DVec3(light.corners[i + 1]), DVec3(light.corners[i + 2])});
  ShadowLight out = sample_triangles(triangles, 1, samples);
  out.double_sided = light.two_sided;
  return out;
}

namespace {

void extend(PlaneRect& rect, const DVec2& p) {
  rect = {min(rect.lower, p), max(rect.upper, p)};
}

// Where edges of a box go through the plane.
PlaneRect cut_by(const FlatPlane& plane, std::span<const Vec3> box) {
  std::array<DVec3, 8> at;
  for (std::size_t i = 0; i < 8; ++i) at[i] = in_plane(plane, DVec3(box[i]));
  PlaneRect rect{DVec2(1e300), DVec2(-1e300)};
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t bit = 1; bit < 8; bit *= 2) {
      const DVec3 &a = at[i], &b = at[i | bit];
      if ((i & bit) == 0 && a.z != b.z && (a.z > 0) != (b.z > 0))
        extend(rect, DVec2(a) + (DVec2(b) - DVec2(a)) * (a.z / (a.z - b.z)));
    }
  return rect;
}

}  // namespace

PlaneRect shadow_rect(const FlatPlane& plane, const BrightLight& light, std::span<const Vec3> box,
                      std::span<const Vec3> shaft) {
  double low = 1e300, high = -1e300, top = -1e300, bottom = 1e300;
  std::vector<DVec3> apexes, corners;
  for (const Vec3& c : light.corners) apexes.push_back(in_plane(plane, DVec3(c)));
  for (const DVec3& a : apexes) low = std::min(low, a.z), high = std::max(high, a.z);
  for (const Vec3& p : box) corners.push_back(in_plane(plane, DVec3(p)));
  for (const DVec3& p : corners) top = std::max(top, p.z), bottom = std::min(bottom, p.z);
  if (!(high > 0 && top > 0 && bottom < high)) return {};
  const PlaneRect within = cut_by(plane, shaft);
  if (within.empty() || !(top < 0.999 * low)) return within;
  PlaneRect rect{DVec2(1e300), DVec2(-1e300)};
  for (const DVec3& p : corners)
    for (const DVec3& a : apexes)
      if (p.z > 0) extend(rect, seen_at(a, p));
  const PlaneRect through = cut_by(plane, box);  // of a flat box, a line
  rect = {min(rect.lower, through.lower), max(rect.upper, through.upper)};
  return common(rect, within);
}

void lay_texels(const FlatPlane& plane, double wanted, ShadowPatch& patch) {
  const DVec2 size = patch.rect.upper - patch.rect.lower;
  const double texel = std::max(wanted, std::max(size.x, size.y) / (kMostTexels - 2));
  // A texel around it, so that the texture is 0 at its edges.
  const DVec2 corner = patch.rect.lower - texel;
  patch.receiver = {plane.origin + plane.x * corner.x + plane.y * corner.y,
                    plane.x * texel,
                    plane.y * texel,
                    plane.normal,
                    static_cast<int>(std::ceil(size.x / texel)) + 2,
                    static_cast<int>(std::ceil(size.y / texel)) + 2};
}

void PatchPainter::paint(const Occluders& still, const ShadowLight& light, double touching, ShadowPatch& patch) {
  const ShadowReceiver& receiver = patch.receiver;
  patch.lux.assign(static_cast<std::size_t>(receiver.width) * static_cast<std::size_t>(receiver.height), 0.0f);
  shadows_.set_touching(touching);
  const OccluderView lamp = shadows_.view({}, receiver, light);
  taken_.reset(receiver.width, receiver.height, static_cast<int>(lamp.apexes.size()));
  // A sample as high as rounding tells may be before the receiver in one space and not in another: a mover goes
  // without a shadow there.
  for (const PatchCaster& caster : patch.casters) {
    const DMat4 to = rigid_inverse(caster.pack_from_object);
    const ShadowReceiver part = moved(receiver, to);
    const OccluderView view = shadows_.view(*caster.shape, part, moved(light, to));
    if (view.apex_of == lamp.apex_of) taken_.add(shadows_.block(view, part));
  }
  const OccluderView scene = shadows_.view(still, receiver, light);
  taken_.remove(shadows_.block(scene, receiver));
  taken_.invert();
  LightSum(lamp, receiver, light).run(taken_, best_simd(), patch.lux);
}

}  // namespace oriel::study
