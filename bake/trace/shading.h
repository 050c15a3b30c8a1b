// The scattering of a surface in world space.
#pragma once

#include "bake/trace/path.h"

namespace oriel {

// Straight passes through cut-outs and glass that one path segment may make; a stack of more is taken as black.
inline constexpr int kMaxPasses = 256;

// A shading normal tilts the lobe, and a part of it falls below the geometric surface; that part is mirrored back above
// it, in evaluation, pdf and sampling alike. So no energy is lost at smooth normals (a closed sphere of triangles stays
// an exact furnace), and light never leaks through. Where the body is rounded (SurfacePoint::rounded) nothing is
// mirrored: rays below the facet leave from the rounded surface.
//
// Refers to the surface, whose shade must stay what it is once lobes were asked for. wo, wi: unit, world, away from the
// surface on its side of wo.
class Shading {
 public:
  Shading(const SurfacePoint& surface, const Vec3& wo_world);

  Vec3 fold(const Vec3& w) const { return w - 2 * glm::dot(w, surface_.geometric_normal) * surface_.geometric_normal; }

  // Sum of g over w and, if folded, its mirror image; g takes local directions.
  template <class G>
  auto both(const Vec3& w, const G& g, bool folded) const {
    auto value = g(local(w));
    if (folded) value += g(local(fold(w)));
    return value;
  }
  // The same of reflected light; w where it may come from. punctual: from one direction (punctual_incidence).
  template <class G>
  auto reflected(const Vec3& w, const G& g, bool punctual = false) const {
    return both(w, g, tilted_ && !punctual && !(surface_.rounded > 0));
  }
  // f cosθ, delta lobes excluded.
  Vec3 eval(const Vec3& wi, bool punctual = false) const {
    return reflected(
        wi, [&](const Vec3& w) { return bsdf().eval(w); }, punctual);
  }
  // Per steradian, of what sample() and above() choose; delta lobes excluded.
  float pdf(const Vec3& wi) const {
    return reflected(wi, [&](const Vec3& w) { return bsdf().pdf(w); });
  }
  // A local direction (Bsdf::sample).
  std::optional<BsdfSample> sample(float u, const Vec2& v) const { return bsdf().sample(u, v); }
  // As Bsdf::refracted().
  std::optional<BsdfSample> refracted(const Vec2& v) const { return bsdf().refracted(v); }
  // As Bsdf::spread(), as a world direction below the geometric surface.
  Vec3 spread(const Vec2& v) const { return below(bsdf().spread(v)); }
  // Per steradian, of what spread() chooses; wi: any direction.
  float spread_pdf(const Vec3& wi) const {
    if (glm::dot(wi, surface_.geometric_normal) >= 0) return 0;
    return both(
        wi, [&](const Vec3& w) { return bsdf().spread_pdf(w); }, tilted_);
  }
  static float cosine_of(const Vec3& w) { return std::max(0.0f, w.z); }
  float cosine(const Vec3& wi, bool punctual = false) const { return reflected(wi, cosine_of, punctual); }

  Vec3 local(const Vec3& w) const { return glm::transpose(frame_) * w; }
  // A sampled local direction as a world direction above the surface.
  Vec3 above(const Vec3& w) const {
    const Vec3 world = glm::normalize(frame_ * w);
    return glm::dot(world, surface_.horizon()) < 0 ? fold(world) : world;
  }

  // The same of refracted light below it, and of any other above it.
  Vec3 world(const BsdfSample& sample) const {
    return sample.lobe == Lobe::kRefraction ? below(sample.wi) : above(sample.wi);
  }

 private:
  Vec3 below(const Vec3& w) const {
    const Vec3 world = glm::normalize(frame_ * w);
    return glm::dot(world, surface_.geometric_normal) > 0 ? fold(world) : world;
  }
  const Bsdf& bsdf() const {
    if (!bsdf_) bsdf_.emplace(surface_.shade, wo_);
    return *bsdf_;
  }

  const SurfacePoint& surface_;
  Mat3 frame_;
  Vec3 wo_;  // local
  bool tilted_;
  mutable std::optional<Bsdf> bsdf_;  // once lobes are asked for: cosines need none
};

}  // namespace oriel
