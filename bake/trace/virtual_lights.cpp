#include "bake/trace/virtual_lights.h"

#include "bake/trace/light_volumes.h"
#include "bake/trace/lights.h"

namespace oriel {
namespace {

// A ray that goes on from mirror to mirror.
class Walk {
 public:
  Walk(const Scene& scene, const PlanarMirrors& mirrors, const Vec3& p, const DVec3& direction, MirroredSample& sample)
      : scene_(scene), mirrors_(mirrors), sample_(sample), from_(p), at_(p), direction_(direction) {}

  // False where the mirror's plane is not met from its front.
  bool meet(std::size_t m, double& left) {
    const PlanarMirror& mirror = mirrors_[m];
    const double cosine = -glm::dot(mirror.normal, direction_);
    if (!(cosine > 0)) return false;
    const double far = mirror.height(at_) / cosine;
    if (!(far > 0) || far >= left) return false;
    at_ += far * direction_, left -= far;
    const auto on = sample_.legs >= 0 ? mirrors_.on(scene_, m, at_) : std::nullopt;
    const auto cos_theta = static_cast<float>(cosine);
    if (on) {
      const Vec3 reflected = mirror_reflectance(shade_point(scene_, on->triangle, on->barycentric), cos_theta);
      sample_.share *= reflected;
      endless_ *= glm::max(reflected, mirror_reflectance(mirror.shade, cos_theta));
      add_leg(mirror.height(DVec3(from_)) / cosine - mirror_margin(scene_, on->triangle, from_, cosine));
      direction_ = mirror.turned(direction_);
      from_ = spawn_origin(scene_, on->triangle, on->barycentric, Vec3(direction_));
    } else {
      endless_ *= mirror_reflectance(mirror.shade, cos_theta);
      sample_.legs = -1;  // beside it: nothing of what follows is traced
      direction_ = mirror.turned(direction_);
    }
    return true;
  }

  void add_leg(double distance) {
    if (distance > 0)
      sample_.leg[static_cast<std::size_t>(sample_.legs++)] = {from_, Vec3(direction_), static_cast<float>(distance)};
  }
  const Vec3& endless() const { return endless_; }

 private:
  const Scene& scene_;
  const PlanarMirrors& mirrors_;
  MirroredSample& sample_;
  Vec3 from_;  // of the next shadow ray
  DVec3 at_, direction_;
  Vec3 endless_{1};
};

}  // namespace

VirtualLights::VirtualLights(const Scene& scene) : scene_(&scene) {
  const int most_mirrors = std::min(scene.light_mirrors, VirtualLight::kMostMirrors);
  if (scene.lights.empty() || most_mirrors <= 0) return;
  mirrors_ = PlanarMirrors(scene);
  if (mirrors_.empty()) return;
  FoundLights found = find_virtual_lights(scene, mirrors_, most_mirrors, kMost, kLeast);
  lights_ = std::move(found.lights), left_out_ = found.left_out;
  for (const VirtualLight& light : lights_)
    cumulative_.push_back((cumulative_.empty() ? 0 : cumulative_.back()) + light.flux_lm);
}

MirroredSample VirtualLights::sample(std::size_t i, const LightSet& lights, const Vec3& p, const Vec2& v) const {
  const VirtualLight& light = lights_[i];
  MirroredSample sample;
  const PlanarMirror& last = mirrors_[light.mirror[static_cast<std::size_t>(light.order - 1)]];
  if (!(last.height(DVec3(p)) > 0)) return sample;
  const LightSample from = lights.sample_light(light.light, Vec3(light.unfolded * DVec3(p) + light.shift), v);
  if (!(max_component(from.estimate) > 0)) return sample;
  const DVec3 direction = glm::normalize(glm::transpose(light.unfolded) * DVec3(from.direction));
  sample.direction = Vec3(direction), sample.group = from.group, sample.share = Vec3(1);
  Walk walk(*scene_, mirrors_, p, direction, sample);
  double left = from.distance;
  for (int k = light.order; k-- > 0;)
    if (!walk.meet(light.mirror[static_cast<std::size_t>(k)], left)) return {};
  sample.endless = from.estimate * walk.endless();
  if (sample.legs >= 0) walk.add_leg(left);
  if (sample.legs < 0 || !(max_component(sample.endless) > 0)) {
    sample.legs = 0, sample.share = Vec3(0);
    return sample;
  }
  sample.share *= from.estimate / glm::max(sample.endless, Vec3(1e-30f));
  return sample;
}

}  // namespace oriel
