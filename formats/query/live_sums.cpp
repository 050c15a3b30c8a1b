#include "formats/query/live_sums.h"

#include <algorithm>

#include "formats/core/check.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

// Of pairs of numbers.
struct Moments {
  double a = 0, b = 0, ab = 0, bb = 0, count = 0;
  void add(double x, double y) { a += x, b += y, ab += x * y, bb += y * y, count += 1; }
  double covariance() const { return count > 0 ? ab - a * b / count : 0; }
  double variance() const { return count > 0 ? bb - b * b / count : 0; }
};

}  // namespace

PosedLights pose_lights(const LiveScene& scene, const LiveOptions& options, const MoverPose& pose) {
  return {scene.lights(options, pose), glm::inverse(pack_from_object(pose))};
}

LiveSum live_sum(const LiveScene& scene, const PosedLights& now, const PosedLights& baked, const Vec3& point,
                 const Vec3& normal) {
  ORIEL_CHECK(now.of.lights.size() == baked.of.lights.size() && now.of.direct == baked.of.direct);
  const Vec3 from = point + scene.offset_m() * normal;
  const auto light_of = [&](const PosedLights& posed, std::size_t i, Vec3* missing) {
    const LiveLight& light = posed.of.lights[i];
    const Vec3 light_there = unshadowed(light, point, normal, missing);
    if (light_there == Vec3(0)) return light_there;
    const Vec3 off = scene.offset_m() * (glm::dot(light.normal, from - light.position) < 0 ? -light.normal : light.normal);
    if (scene.sees(from, light.position + off, posed.lamp_from_pack)) return light_there;
    if (missing != nullptr) *missing = Vec3(0);
    return Vec3(0);
  };
  LiveSum out;
  Moments parts[2];
  for (std::size_t i = 0; i < now.of.lights.size(); ++i) {
    const bool indirect = i >= now.of.direct;
    Vec3 missing(0);
    const Vec3 a = light_of(now, i, indirect ? &missing : nullptr), b = light_of(baked, i, nullptr);
    out.now += a, out.baked += b;
    if (is_finite(missing)) out.missing += missing;
    parts[indirect ? 1 : 0].add(double{luminance(a)}, double{luminance(b)});
  }
  const double variance = parts[0].variance() + parts[1].variance();
  const double covariance = parts[0].covariance() + parts[1].covariance();
  if (variance > 0) out.kept = static_cast<float>(std::clamp(covariance / variance, 0.0, 1.0));
  return out;
}

}  // namespace oriel
