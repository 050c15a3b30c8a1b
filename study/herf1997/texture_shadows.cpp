#include "study/herf1997/texture_shadows.h"

#include <algorithm>
#include <chrono>
#include <map>

#include "formats/core/parallel.h"
#include "player/scene/surface.h"

namespace oriel::study {
namespace {

std::array<Vec3, 4> rect_corners(const FlatPlane& plane, const PlaneRect& r) {
  const auto at = [&](double x, double y) { return Vec3(plane.origin + plane.x * x + plane.y * y); };
  return {at(r.lower.x, r.lower.y), at(r.upper.x, r.lower.y), at(r.upper.x, r.upper.y), at(r.lower.x, r.upper.y)};
}

Bounds bounds_of(std::span<const Vec3> points) {
  Bounds box;
  for (const Vec3& p : points) box.extend(p);
  return box;
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

bool boxes_meet(const Bounds& a, const Bounds& b) {
  return glm::all(glm::lessThanEqual(a.lower, b.upper)) && glm::all(glm::lessThanEqual(b.lower, a.upper));
}

// The part of a shadow on a plane that is in view.
PlaneRect seen_of(const FlatPlane& plane, const PlaneRect& shade, const Frustum& frustum) {
  PlaneRect seen{DVec2(1e300), DVec2(-1e300)};
  for (const FlatPiece& piece : plane.pieces) {
    const PlaneRect part = common(shade, {piece.lower, piece.upper});
    if (!part.empty() && may_be_visible(frustum, bounds_of(rect_corners(plane, part)))) seen = around(seen, part);
  }
  return seen;
}

}  // namespace

Result<TextureShadows> TextureShadows::create(gpu::Dialect dialect) {
  TextureShadows shadows;
  ORIEL_TRY(shadows.program_, gpu::Program::create("herf1997_texture", dialect));
  return shadows;
}

void TextureShadows::know(const GpuScene& scene) {
  if (known_ == scene.geometry_serial()) return;
  known_ = scene.geometry_serial();
  flat_ = find_flat_surfaces(scene.pack());
  still_ = still_occluders(scene.pack());
  movers_.clear();
  for (const Mover& mover : scene.pack().movers) movers_.push_back(mover_occluders(mover));
}

void TextureShadows::plan(const FrameContext& context, LitMovers& lit) {
  const BrightLight& light = context.scene.bright_lights()[lit.light];
  if (!is_flat(light)) return;
  const Frustum frustum = make_frustum(context.view.clip_from_pack);
  for (LitMovers::Caster& caster : lit.casters) {
    if (!caster.on_scene) continue;
    const std::array<Vec3, 8> box = corners_of(*caster.mover);
    for (std::size_t p = 0; p < flat_.planes.size(); ++p) {
      const PlaneRect shade = shadow_rect(flat_.planes[p], light, box, caster.box);
      const PlaneRect seen = seen_of(flat_.planes[p], shade, frustum);
      if (seen.empty()) continue;
      patches_.push_back({lit.light, p, {{&movers_[caster.index], DMat4(caster.mover->pack_from_object)}}, seen});
    }
    const Bounds shaft = bounds_of(caster.box);
    caster.on_scene = std::ranges::any_of(
        flat_.rest, [&](const Bounds& rest) { return boxes_meet(rest, shaft) && may_be_visible(frustum, rest); });
  }
}

// Shadows of one light that may meet count once: their patches become one.
void TextureShadows::join_patches() {
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
}

void TextureShadows::paint(const FrameContext& context) {
  std::map<std::uint32_t, ShadowLight> lights;
  for (ShadowPatch& patch : patches_) {
    const FlatPlane& plane = flat_.planes[patch.plane];
    lay_texels(plane, pixel_at(context.view, rect_corners(plane, patch.rect)), patch);
    if (!lights.contains(patch.light))
      lights[patch.light] = shadow_light(context.scene.bright_lights()[patch.light], samples);
  }
  if (painters_.size() < patches_.size()) painters_.resize(patches_.size());
  for_each_parallel(patches_.size(), core_count(), [&](std::size_t i) {
    painters_[i].paint(still_, lights.at(patches_[i].light), flat_.touching, patches_[i]);
  });
}

void TextureShadows::prepare(const FrameContext& context, std::span<LitMovers> lights) {
  patches_.clear(), textures_.clear();
  know(context.scene);
  const auto start = std::chrono::steady_clock::now();
  for (LitMovers& lit : lights) plan(context, lit);
  join_patches();
  paint(context);
  paint_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  gpu::TextureOptions bilinear;
  bilinear.min_filter = bilinear.mag_filter = GL_LINEAR;
  for (const ShadowPatch& patch : patches_)
    textures_.emplace_back(gpu::kR32f, patch.receiver.width, patch.receiver.height, patch.lux.data(), bilinear);
}

void TextureShadows::draw(const FrameContext& context, const gpu::Texture2d& surfaces,
                          std::optional<std::uint32_t> zeros_of) const {
  program_.use();
  program_.set("u_surfaces", kSurfaceUnit);
  program_.set("u_texture", kTakenUnit);
  program_.set("u_clip_from_pack", context.view.clip_from_pack);
  program_.set("u_touching", static_cast<float>(flat_.touching));
  surfaces.bind(kSurfaceUnit);
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const ShadowPatch& patch = patches_[i];
    if (zeros_of && patch.light != *zeros_of) continue;
    const FlatPlane& plane = flat_.planes[patch.plane];
    const ShadowReceiver& r = patch.receiver;
    const DVec3 along = r.x / (glm::dot(r.x, r.x) * r.width), across = r.y / (glm::dot(r.y, r.y) * r.height);
    program_.set("u_corners", std::span<const Vec3>(rect_corners(plane, patch.rect)));
    program_.set("u_plane", Vec4(Vec3(plane.normal), static_cast<float>(glm::dot(plane.normal, plane.origin))));
    program_.set("u_along", Vec4(Vec3(along), static_cast<float>(-glm::dot(along, r.corner))));
    program_.set("u_across", Vec4(Vec3(across), static_cast<float>(-glm::dot(across, r.corner))));
    program_.set("u_radiance", zeros_of ? Vec3(0) : context.scene.bright_lights()[patch.light].intensity);
    textures_[i].bind(kTakenUnit);
    glDrawArrays(GL_TRIANGLE_FAN, 0, 4);
    ++context.stats.draws;
  }
}

}  // namespace oriel::study
