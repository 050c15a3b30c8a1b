#include "player/movers/shadow_textures.h"

#include <algorithm>

#include "formats/core/parallel.h"
#include "player/scene/surface.h"

namespace oriel {
namespace {

// However coarse, a patch is at most two by two tiles: so many find room.
constexpr int kAtlasSide = 1024, kMostPatches = (kAtlasSide / (2 * kTile)) * (kAtlasSide / (2 * kTile));
// Samples of a light for patches of more than that share of the picture; for others, and while frames are coarse.
constexpr double kLargeShare = 0.02;
constexpr int kSamples = 64, kFewSamples = 16;
constexpr std::size_t kMostTiles = 1 << 14;  // that are kept
constexpr int kMostPatchTexels = 256;        // of a patch along a side, about

DVec3 at(const FlatPlane& plane, const DVec2& p) {
  return plane.origin + plane.x * p.x + plane.y * p.y;
}

std::array<Vec3, 4> corners_of(const FlatPlane& plane, const PlaneRect& r) {
  return {Vec3(at(plane, r.lower)), Vec3(at(plane, {r.upper.x, r.lower.y})), Vec3(at(plane, r.upper)),
          Vec3(at(plane, {r.lower.x, r.upper.y}))};
}

// What a pixel of the view is wide at the nearest corner of a patch that is before the eye.
double pixel_at(const View& view, const std::array<Vec3, 4>& corners) {
  const Mat4 rows = glm::transpose(view.clip_from_pack);
  const float scale = glm::length(Vec3(rows[1])) * static_cast<float>(view.height) / 2;
  float least = 1e30f;
  for (const Vec3& c : corners) {
    const float w = (view.clip_from_pack * Vec4(c, 1)).w;
    least = std::min(least, view.orthographic ? 1.0f : std::max(w, view.near));
  }
  return static_cast<double>(least / scale);
}

}  // namespace

Result<ShadowTextures> ShadowTextures::create(gpu::Dialect dialect) {
  ShadowTextures textures;
  ORIEL_TRY(textures.program_, gpu::Program::create("mover_shadow_texture", dialect));
  return textures;
}

void ShadowTextures::know(const GpuScene& scene) {
  if (known_ == scene.geometry_serial()) return;
  known_ = scene.geometry_serial();
  const Pack& pack = scene.pack();
  flat_ = find_flat_surfaces(pack);
  still_ = still_occluders(pack, pack.mesh.positions);
  far_ = 2 * scene.bounds().radius();
  movers_.clear();
  for (const Mover& mover : pack.movers) movers_.emplace_back(mover);
}

// What lies between a light's points and some place: the hull of these; and axes that tell it from others.
struct LightHull {
  std::vector<Vec3> hull;
  std::vector<Vec3> axes;
};
LightHull hull_of(const LightSamples& light, std::span<const Vec3> place, float far) {
  LightHull between{{place.begin(), place.end()}, {light.axis}};
  Vec3 to(0);
  for (const Vec4& at : light.at) {
    if (at.w != 0) between.hull.emplace_back(at);
    if (at.w == 0)
      for (const Vec3& p : place) between.hull.push_back(p + far * Vec3(at));
  }
  for (const Vec3& p : place) to += light.at[0].w != 0 ? light.center - p : light.center;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 unit(0);
    unit[axis] = 1;
    between.axes.push_back(glm::cross(to, unit));
  }
  return between;
}

// What lies in no plane, is in view and may get a mover's shadow.
Bounds ShadowTextures::rest_below(const LitMovers::Caster& caster, const LitMovers& lit, const Frustum& frustum) const {
  const auto box = corners_of(*caster.mover);
  const Mat3 pose(caster.mover->pack_from_object);
  Bounds below;
  for (const Bounds& rest : flat_.rest) {
    if (!may_be_visible(frustum, rest)) continue;
    LightHull between = hull_of(lit.samples, corners_of(rest), far_);
    between.axes.insert(between.axes.end(), {pose[0], pose[1], pose[2]});
    if (may_meet(between.hull, box, between.axes)) below.extend(rest);
  }
  return below;
}

// Whether the scene may stand between a mover and the points of a light.
bool ShadowTextures::is_in_the_way(const LitMovers::Caster& caster, const LitMovers& lit) const {
  const Mat3 pose(caster.mover->pack_from_object);
  LightHull between = hull_of(lit.samples, corners_of(*caster.mover), far_);
  between.axes.insert(between.axes.end(), {pose[0], pose[1], pose[2]});
  const float touching = static_cast<float>(flat_.touching);
  std::vector<std::uint32_t> open{0};
  const auto meets = [&](const Bounds& box) {
    const Vec3 half = glm::max(0.5f * (box.upper - box.lower) - touching, Vec3(0)), middle = box.center();
    return may_meet(corners_of({middle - half, middle + half}), between.hull, between.axes);
  };
  while (!open.empty()) {
    const OccluderNode& node = still_.nodes[open.back()];
    open.pop_back();
    if (!meets({Vec3(node.lower), Vec3(node.upper)})) continue;
    if (node.left != 0) {
      open.insert(open.end(), {node.left + 1, node.left});
      continue;
    }
    for (std::uint32_t f = node.first; f < node.first + node.count; ++f) {
      Bounds box;
      for (const std::uint32_t p : still_.faces[f].points) box.extend(Vec3(still_.points[p]));
      if (meets(box)) return true;
    }
  }
  return false;
}

void ShadowTextures::plan(const GpuScene& scene, const View& view, LitMovers& lit) {
  const BrightLight& light = scene.bright_lights()[lit.light];
  if (!is_flat(light)) return;
  const Frustum frustum = make_frustum(view.clip_from_pack);
  for (LitMovers::Caster& caster : lit.casters) {
    if (!caster.on_scene) continue;
    const std::array<Vec3, 8> box = corners_of(*caster.mover);
    std::vector<ShadowPatch> patches;
    for (std::size_t p = 0; p < flat_.planes.size(); ++p) {
      const FlatPlane& plane = flat_.planes[p];
      const PlaneRect shade = shadow_rect(plane, light, box, caster.box);
      PlaneRect seen{DVec2(1e300), DVec2(-1e300)};
      for (const FlatPiece& piece : plane.pieces) {
        const PlaneRect part = common(shade, {piece.lower, piece.upper});
        if (part.empty()) continue;
        Bounds bounds;
        for (const Vec3& c : corners_of(plane, part)) bounds.extend(c);
        if (may_be_visible(frustum, bounds)) seen = around(seen, part);
      }
      if (seen.empty()) continue;
      patches.push_back({lit.light, p, {{&movers_[caster.index], DMat4(caster.mover->pack_from_object), seen}}, seen});
    }
    if (patches_.size() + patches.size() > std::size_t{kMostPatches}) continue;  // it keeps its maps
    patches_.insert(patches_.end(), patches.begin(), patches.end());
    const Bounds below = rest_below(caster, lit, frustum);
    caster.on_scene = !below.empty();
    caster.scene_box = corners_of(below);
  }
}

void ShadowTextures::lay_out(const View& view, bool coarse) {
  // Shadows of one light that may meet count once: their patches become one.
  for (std::size_t i = 0; i < patches_.size(); ++i)
    for (std::size_t j = i + 1; j < patches_.size();) {
      ShadowPatch &a = patches_[i], &b = patches_[j];
      if (a.light != b.light || a.plane != b.plane || common(a.rect, b.rect).empty()) {
        ++j;
        continue;
      }
      a.rect = around(a.rect, b.rect);
      a.casters.insert(a.casters.end(), b.casters.begin(), b.casters.end());
      patches_.erase(patches_.begin() + static_cast<std::ptrdiff_t>(j));
      j = i + 1;
    }
  for (ShadowPatch& patch : patches_) {
    const double pixel = pixel_at(view, corners_of(flat_.planes[patch.plane], patch.rect));
    const DVec2 pixels = (patch.rect.upper - patch.rect.lower) / pixel;
    const bool large = pixels.x * pixels.y > kLargeShare * view.width * view.height;
    patch.samples = large && !coarse ? kSamples : kFewSamples;
  }
  double coarser = 1;
  while (!place_all(view, coarser)) coarser *= 2;
}

// Lays the patches' texels and gives them places in the atlas, as far as they fit.
bool ShadowTextures::place_all(const View& view, double coarser) {
  IVec2 at(0);
  int high = 0;
  places_.clear();
  for (ShadowPatch& patch : patches_) {
    const FlatPlane& plane = flat_.planes[patch.plane];
    const DVec2 size = patch.rect.upper - patch.rect.lower;
    const double least = std::max(size.x, size.y) / kMostPatchTexels;
    const double wanted = coarser * std::max(pixel_at(view, corners_of(plane, patch.rect)), least);
    lay_texels(plane, static_cast<int>(std::ceil(std::log2(wanted))), patch);
    const IVec2 texels(patch.receiver.width, patch.receiver.height);
    if (at.x + texels.x > kAtlasSide) at = {0, at.y + high}, high = 0;
    if (at.y + texels.y > kAtlasSide) return false;
    places_.push_back(at);
    at.x += texels.x, high = std::max(high, texels.y);
  }
  return true;
}

// Calls visit(tile of a patch, its key).
template <class Visit>
void ShadowTextures::visit_tiles(const Visit& visit) {
  for (ShadowPatch& patch : patches_) {
    const int columns = tiles_of(patch).x;
    for (std::size_t i = 0; i < patch.still.size(); ++i) {
      const IVec2 at = patch.tile + IVec2(static_cast<int>(i) % columns, static_cast<int>(i) / columns);
      visit(patch.still[i], TileKey{patch.light, patch.samples, patch.plane, patch.level, at.x, at.y});
    }
  }
}

void ShadowTextures::paint(const GpuScene& scene) {
  if (tiles_of_ != scene.serial() || tiles_.size() > kMostTiles) tiles_.clear();
  tiles_of_ = scene.serial();
  visit_tiles([&](std::shared_ptr<StillTile>& tile, const TileKey& key) {
    if (const auto known = tiles_.find(key); known != tiles_.end()) tile = known->second;
  });
  if (painters_.size() < patches_.size()) painters_.resize(patches_.size());
  std::map<std::pair<std::uint32_t, int>, ShadowLight> lights;
  for (const ShadowPatch& patch : patches_)
    if (ShadowLight& light = lights[{patch.light, patch.samples}]; light.samples.empty())
      light = shadow_light(scene.bright_lights()[patch.light], patch.samples);
  for_each_parallel(patches_.size(), core_count(), [&](std::size_t i) {
    ShadowPatch& patch = patches_[i];
    painters_[i].paint(still_, lights.at({patch.light, patch.samples}), flat_.touching, patch);
  });
  visit_tiles([&](const std::shared_ptr<StillTile>& tile, const TileKey& key) {
    if (tile) tiles_.emplace(key, tile);
  });
}

void ShadowTextures::upload() {
  if (!atlas_) atlas_ = gpu::Texture2d(gpu::kR32f, kAtlasSide, kAtlasSide, nullptr);
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const ShadowReceiver& r = patches_[i].receiver;
    atlas_.upload(0, places_[i], {r.width, r.height}, patches_[i].lux.data());
  }
}

void ShadowTextures::prepare(const GpuScene& scene, const View& view, std::span<LitMovers> lights,
                             const FrameOptions& options) {
  patches_.clear();
  if (options.mover_shadows == MoverShadows::kMaps || options.mover_lights != MoverLights::kShadowed) return;
  know(scene);
  for (LitMovers& lit : lights) plan(scene, view, lit);
  for (LitMovers& lit : lights)
    for (LitMovers::Caster& caster : lit.casters)
      caster.scene_counts = caster.on_scene || (!still_.nodes.empty() && is_in_the_way(caster, lit));
  lay_out(view, options.coarse);
  paint(scene);
  upload();
}

void ShadowTextures::draw(const GpuScene& scene, const View& view, const gpu::Texture2d& surfaces,
                          std::optional<std::uint32_t> zeros_of, FrameStats& stats) const {
  if (patches_.empty()) return;
  program_.use();
  program_.set("u_surfaces", kSurfaceUnit);
  program_.set("u_atlas", kTakenUnit);
  program_.set("u_clip_from_pack", view.clip_from_pack);
  program_.set("u_touching", static_cast<float>(flat_.touching));
  surfaces.bind(kSurfaceUnit);
  atlas_.bind(kTakenUnit);
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const ShadowPatch& patch = patches_[i];
    if (zeros_of && patch.light != *zeros_of) continue;
    const FlatPlane& plane = flat_.planes[patch.plane];
    const double texel = std::exp2(patch.level), tile = kTile * texel;
    const std::array<Vec3, 4> corners =
        corners_of(plane, {DVec2(patch.tile) * tile, DVec2(patch.tile + tiles_of(patch)) * tile});
    const DVec3 x = plane.x / texel, y = plane.y / texel;
    program_.set("u_corners", std::span<const Vec3>(corners));
    program_.set("u_plane", Vec4(Vec3(plane.normal), static_cast<float>(glm::dot(plane.normal, plane.origin))));
    program_.set("u_along", Vec4(Vec3(x), static_cast<float>(-glm::dot(x, patch.receiver.corner))));
    program_.set("u_across", Vec4(Vec3(y), static_cast<float>(-glm::dot(y, patch.receiver.corner))));
    program_.set("u_place", places_[i]);
    program_.set("u_size", IVec2(patch.receiver.width, patch.receiver.height));
    program_.set("u_radiance", zeros_of ? Vec3(0) : scene.bright_lights()[patch.light].intensity);
    glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
    ++stats.draws;
  }
}

}  // namespace oriel
