#include "player/movers/shadow_patch.h"

#include <algorithm>
#include <cmath>

namespace oriel {
namespace {

static_assert(kTile == 32);  // texels of BlockedRows' words

Occluders occluders_of(const Mesh& mesh, std::span<const Vec3> positions, const std::vector<Material>* materials) {
  std::vector<DVec3> points(positions.begin(), positions.end());
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

// The part of the patch that a caster's shadow lies in.
TexelWindow window_of(const ShadowPatch& patch, const PlaneRect& rect) {
  const double texel = std::exp2(patch.level);
  const DVec2 corner = DVec2(patch.tile) * (kTile * texel);
  const DVec2 from = (rect.lower - corner) / texel, to = (rect.upper - corner) / texel;
  const auto within = [](double x, int most) {
    return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(most)));
  };
  const int words = tiles_of(patch).x, rows = patch.receiver.height;
  TexelWindow w{within(from.x / kTile, words), within(from.y, rows), 0, 0};
  w.columns = within(std::ceil(to.x / kTile), words) - w.column;
  w.rows = within(std::ceil(to.y), rows) - w.row;
  return w;
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

Occluders still_occluders(const Pack& pack, std::span<const Vec3> positions) {
  return occluders_of(pack.mesh, positions, &pack.materials);
}
MoverShape::MoverShape(const Mover& mover)
    : occluders(occluders_of(mover.mesh, mover.mesh.positions, nullptr)), body(occluders) {}

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
  ShadowLight out = sample_triangles(triangles, Vec3(1), samples);
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
  if (const PlaneRect through = cut_by(plane, box); !through.empty()) rect = around(rect, through);
  return common(rect, within);
}

void lay_texels(const FlatPlane& plane, int level, ShadowPatch& patch) {
  const double texel = std::exp2(level), tile = kTile * texel;
  // A texel around it, so that the texture is 0 at its edges.
  const DVec2 from = floor((patch.rect.lower - texel) / tile), to = ceil((patch.rect.upper + texel) / tile);
  patch.level = level, patch.tile = IVec2(from);
  patch.receiver = {plane.origin + plane.x * (from.x * tile) + plane.y * (from.y * tile),
                    plane.x * texel,
                    plane.y * texel,
                    plane.normal,
                    kTile * static_cast<int>(to.x - from.x),
                    kTile * static_cast<int>(to.y - from.y)};
  patch.still.assign(static_cast<std::size_t>(tiles_of(patch).x) * static_cast<std::size_t>(tiles_of(patch).y),
                     nullptr);
}

void PatchPainter::block(const PatchCaster& caster, const ShadowLight& light, const ShadowPatch& patch) {
  const TexelWindow w = window_of(patch, caster.rect);
  if (w.columns <= 0 || w.rows <= 0) return;
  const DMat4 to = rigid_inverse(caster.pack_from_object);
  const ShadowReceiver receiver = moved(patch.receiver, to);
  const ShadowLight lamp = moved(light, to);
  std::vector<DVec3> samples;
  for (const std::uint32_t s : lamp_.apex_of) samples.push_back(lamp.samples[s].position);
  const BodyPlace place{ReceiverSpace(receiver), samples, lamp_.apexes, touching_};
  if (silhouettes_.add(caster.shape->body, place, w, best_simd(), taken_)) return;
  ShadowReceiver part = receiver;
  part.corner += receiver.x * static_cast<double>(kTile * w.column) + receiver.y * static_cast<double>(w.row);
  part.width = kTile * w.columns, part.height = w.rows;
  const OccluderView view = shadows_.view(caster.shape->occluders, part, lamp);
  if (view.apex_of == lamp_.apex_of) taken_.add(shadows_.block(view, part), w.column, w.row);
}

// Whether movers block anything in a tile.
bool PatchPainter::takes_in(const IVec2& tile) const {
  for (int s = 0; s < taken_.samples(); ++s)
    for (int row = kTile * tile.y; row < kTile * (tile.y + 1); ++row)
      if (taken_.word(s, tile.x, row) != 0) return true;
  return false;
}

void PatchPainter::leave(const StillTile& tile, const IVec2& at) {
  if (tile.size() != static_cast<std::size_t>(taken_.samples()) * kTile) return;  // empty, or of other samples
  const std::uint32_t* bits = tile.data();
  for (int s = 0; s < taken_.samples(); ++s)
    for (int row = kTile * at.y; row < kTile * (at.y + 1); ++row) taken_.word(s, at.x, row) &= ~*bits++;
}

// The tiles that are wanted and not known, by the rectangle around them.
void PatchPainter::find_still(const Occluders& still, const ShadowLight& light, ShadowPatch& patch) {
  const IVec2 tiles = tiles_of(patch);
  IVec2 lower = tiles, upper(0);
  std::vector<IVec2> missing;
  for (int y = 0; y < tiles.y; ++y)
    for (int x = 0; x < tiles.x; ++x)
      if (patch.still[static_cast<std::size_t>(y * tiles.x + x)] == nullptr && takes_in({x, y}))
        missing.emplace_back(x, y), lower = min(lower, IVec2(x, y)), upper = max(upper, IVec2(x + 1, y + 1));
  if (missing.empty()) return;
  ShadowReceiver part = patch.receiver;
  part.corner += part.x * static_cast<double>(kTile * lower.x) + part.y * static_cast<double>(kTile * lower.y);
  part.width = kTile * (upper.x - lower.x), part.height = kTile * (upper.y - lower.y);
  const OccluderView view = shadows_.view(still, part, light);
  // A sample as high as rounding tells may be before one receiver and not before the other: that patch goes without.
  const bool blocks = view.apex_of == lamp_.apex_of && (!view.faces.empty() || !view.beside_light.empty());
  const BlockedRows* rows = blocks ? &shadows_.block(view, part) : nullptr;
  for (const IVec2& at : missing) {
    auto tile = std::make_shared<StillTile>();
    std::uint32_t any = 0;
    if (blocks)
      for (int s = 0; s < rows->samples(); ++s)
        for (int row = 0; row < kTile; ++row) {
          tile->push_back(rows->word(s, at.x - lower.x, kTile * (at.y - lower.y) + row));
          any |= tile->back();
        }
    if (any == 0) tile->clear();
    patch.still[static_cast<std::size_t>(at.y * tiles.x + at.x)] = std::move(tile);
  }
}

void PatchPainter::paint(const Occluders& still, const ShadowLight& light, double touching, ShadowPatch& patch) {
  const ShadowReceiver& receiver = patch.receiver;
  patch.lux.assign(static_cast<std::size_t>(receiver.width) * static_cast<std::size_t>(receiver.height), 0.0f);
  shadows_.set_touching(touching_ = touching);
  lamp_ = shadows_.view({}, receiver, light);
  taken_.reset(receiver.width, receiver.height, static_cast<int>(lamp_.apexes.size()));
  for (const PatchCaster& caster : patch.casters) block(caster, light, patch);
  find_still(still, light, patch);
  const IVec2 tiles = tiles_of(patch);
  for (int y = 0; y < tiles.y; ++y)
    for (int x = 0; x < tiles.x; ++x)
      if (const auto& tile = patch.still[static_cast<std::size_t>(y * tiles.x + x)]) leave(*tile, {x, y});
  taken_.invert();
  std::vector<float> powers(lamp_.apexes.size());
  for (std::size_t i = 0; i < powers.size(); ++i) powers[i] = light.samples[lamp_.apex_of[i]].power.x;
  LightSum(lamp_, receiver, light, powers).run(taken_, best_simd(), patch.lux);
}

}  // namespace oriel
