#include "bake/radiance/sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/scene/shade.h"
#include "bake/trace/albedo.h"

namespace oriel {
namespace {

constexpr float kImage = 0.5f;      // reflectance from which depth is that of the mirror's image
constexpr float kBackdrop = 1e-3f;  // of the scene's diagonal: how far outside its bounds a plain sky stands

}  // namespace

bool is_among(const Scene& scene, std::span<const std::uint32_t> triangles, std::uint32_t triangle) {
  const auto listed = [&](std::uint32_t t) { return std::ranges::binary_search(triangles, t); };
  return listed(triangle) || (!scene.twin.empty() && listed(scene.twin[triangle]));
}

ReflectedSurroundings::ReflectedSurroundings(const Accel& accel, std::span<const FoundReflector> reflectors,
                                             const SightOptions& options)
    : accel_(accel), reflectors_(reflectors), options_(options), reflector_of_(accel.scene().triangles.size()) {
  for (std::uint32_t r = 0; r < reflectors.size(); ++r)
    for (const std::uint32_t t : reflectors[r].triangles) reflector_of_[t] = r + 1;
}

const FoundReflector* ReflectedSurroundings::reflector_at(std::uint32_t triangle) const {
  return reflector_of_[triangle] > 0 ? &reflectors_[reflector_of_[triangle] - 1] : nullptr;
}

class ReflectedSurroundings::Walk {
 public:
  // from: the ray's origin lies on the reflector's plane.
  Walk(const ReflectedSurroundings& surroundings, std::uint32_t reflector, const Ray& from, const Visit& visit,
       const Cone& cone)
      : in_(surroundings),
        scene_(surroundings.accel_.scene()),
        visit_(visit),
        cone_(cone),
        left_(&surroundings.reflectors_[reflector]),
        orders_left_(std::max(surroundings.options_.orders, 1u) - 1),
        start_(from.origin) {
    // Coordinates' rounding near the reflector, and how far its triangles bulge from its plane.
    const Reflector& r = left_->reflector;
    step_ = kSightStep * (max_component(glm::abs(Vec3(r.pack_from_reflector[3]))) + glm::length(r.upper - r.lower));
    ray_ = {from.origin + step_ * Vec3(r.pack_from_reflector[2]), from.direction};
  }

  Sight run() {
    for (int layer = 0; layer < kMostSightLayers; ++layer) {
      const Hit hit = in_.accel_.intersect(ray_);
      ++sight_.rays;
      if (!hit) return leave();
      const Vec3 p = point_on(scene_, hit.triangle, hit.barycentric);
      const bool own = hit.triangle == last_ || is_among(scene_, left_->triangles, hit.triangle);
      if (!own && meets(hit, p)) return sight_;
      last_ = hit.triangle;
      ray_.origin = p + ray_.direction * (kSightStep * (max_component(glm::abs(p)) + step_) + 1e-7f * hit.distance);
    }
    if (!depth_known_) sight_.state = Sight::kNothing;  // nothing opaque within reason
    return sight_;
  }

 private:
  Sight leave() {
    sight_.sky_direction = ray_.direction;
    sight_.sky_throughput = throughput_;
    if (depth_known_) return sight_;
    sight_.state = Sight::kSky;
    if (scene_.sky_image.texels.empty()) meet_backdrop();
    return sight_;
  }

  // Where the ray leaves the scene's bounds.
  void meet_backdrop() {
    const float margin = kBackdrop * glm::length(scene_.upper - scene_.lower);
    float nearest = std::numeric_limits<float>::max();
    int side = -1;
    for (int axis = 0; axis < 3; ++axis) {
      if (ray_.direction[axis] == 0) continue;
      const float face = ray_.direction[axis] > 0 ? scene_.upper[axis] + margin : scene_.lower[axis] - margin;
      const float distance = (face - ray_.origin[axis]) / ray_.direction[axis];
      if (distance < nearest) nearest = distance, side = axis;
    }
    if (!(nearest > 0) || side < 0) return;
    Vec3 normal(0);
    normal[side] = -std::copysign(1.0f, ray_.direction[side]);
    sight_.state = Sight::kSurface;
    sight_.backdrop = true;
    sight_.mirrored = mirrors_passed_ > 0;
    sight_.offset = offset_ + unfold_ * (ray_.origin + nearest * ray_.direction - start_);
    sight_.normal = unfold_ * normal;
  }

  // True where the ray ends there.
  bool meets(const Hit& hit, const Vec3& p) {
    const SceneMaterial& material = scene_.material_of(hit.triangle);
    const bool back = !hit.front && !material.double_sided;
    const float cosine = std::abs(glm::dot(geometric_normal(scene_, hit.triangle), ray_.direction));
    if (may_transmit(material) && !material.unlit) {  // light passes unlit surfaces, but eyes see them
      const ShadePoint point = shade_point(scene_, hit.triangle, hit.barycentric);
      const Vec3 through = straight_transmittance(point, cosine);
      const bool passes = max_component(through) >= kSeeThrough;
      if (!passes) note_depth(hit, p, back);
      if (point.coverage > 0 && !back)
        visit_({.hit = hit,
                .towards_eye = -ray_.direction,
                .throughput = throughput_ * point.coverage,
                .mirrors_passed = mirrors_passed_,
                .width_m = width_at(p)});
      throughput_ *= through;
      return !passes;
    }
    const FoundReflector* reflector = back ? nullptr : in_.reflector_at(hit.triangle);
    const bool narrow = reflector && reflector->roughness <= in_.options_.max_chain_roughness;
    const FoundReflector* mirror = narrow && orders_left_ > 0 ? reflector : nullptr;
    const Vec3 r = mirror ? reflectance(shade_point(scene_, hit.triangle, hit.barycentric), cosine) : Vec3(0);
    if (max_component(r) < in_.options_.min_chain_reflectance) mirror = nullptr;
    if (!mirror || max_component(r) < kImage) note_depth(hit, p, back);
    const bool goes_on = !back && visit_({.hit = hit,
                                          .towards_eye = -ray_.direction,
                                          .throughput = throughput_,
                                          .mirror = mirror != nullptr,
                                          .mirrors_passed = mirrors_passed_,
                                          .planar = reflector != nullptr,
                                          .glossy = reflector && !narrow,
                                          .width_m = width_at(p)});
    if (!mirror || (depth_known_ && !goes_on)) return true;
    bounce(*mirror, r, p);
    return false;
  }

  float width_at(const Vec3& p) const { return cone_.width_m + cone_.spread * (way_m_ + glm::length(p - start_)); }

  void note_depth(const Hit& hit, const Vec3& p, bool back) {
    if (depth_known_) return;
    depth_known_ = true;
    sight_.state = back ? Sight::kNothing : Sight::kSurface;
    sight_.back = back;
    sight_.mirrored = mirrors_passed_ > 0;
    sight_.offset = offset_ + unfold_ * (p - start_);
    sight_.normal = unfold_ * geometric_normal(scene_, hit.triangle);
  }

  void bounce(const FoundReflector& mirror, const Vec3& r, const Vec3& p) {
    const Vec3 normal(mirror.reflector.pack_from_reflector[2]);
    offset_ += unfold_ * (p - start_);
    way_m_ += glm::length(p - start_);
    start_ = p;
    throughput_ *= r;
    unfold_ = unfold_ * (Mat3(1) - 2.0f * glm::outerProduct(normal, normal));
    ray_.direction = glm::normalize(glm::reflect(ray_.direction, normal));
    left_ = &mirror;
    --orders_left_;
    ++mirrors_passed_;
  }

  const ReflectedSurroundings& in_;
  const Scene& scene_;
  const Visit& visit_;
  Cone cone_;
  const FoundReflector* left_;  // the reflector that the ray left last
  std::uint32_t orders_left_, mirrors_passed_ = 0;
  Ray ray_;
  Vec3 start_;       // of the stretch since the last mirror
  Vec3 offset_{0};   // of that start, unfolded
  float way_m_ = 0;  // to that start
  float step_ = 0;
  Vec3 throughput_{1};
  Mat3 unfold_{1};
  std::uint32_t last_ = ~0u;
  bool depth_known_ = false;
  Sight sight_;
};

Sight ReflectedSurroundings::look(std::uint32_t reflector, const Vec3& from, const Vec3& direction, const Visit& visit,
                                  const Cone& cone) const {
  return Walk(*this, reflector, {from, direction}, visit, cone).run();
}

}  // namespace oriel
