#include "formats/query/live_sums.h"

#include <algorithm>

#include "formats/core/check.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

// Of lights that face the point.
struct Seen {
  std::size_t all = 0, seen = 0;
  SeenLights sight() const {
    return all == 0      ? SeenLights::kFacesNone
           : seen == 0   ? SeenLights::kNone
           : seen == all ? SeenLights::kAll
                         : SeenLights::kSome;
  }
};

}  // namespace

PosedLights pose_lights(const LampScene& scene, std::size_t count, const MoverPose& pose) {
  return {scene.lights(count, pose), Mat4(glm::inverse(pack_from_object(pose)))};
}

LiveSum& LiveSum::operator+=(const LiveSum& other) {
  add_share(*this, 1, other);
  return *this;
}

std::optional<float> LiveSum::kept() const {
  if (!(squares > 0)) return std::nullopt;
  return static_cast<float>(std::clamp(products / squares, 0.0, 1.0));
}

LiveSums::LiveSums(const LampScene& scene, const LightPair& lights)
    : scene_(scene), lights_(lights), now_(lights.now.lights.size()), baked_(now_.size()) {
  ORIEL_CHECK(now_.size() == lights.baked.lights.size());
}

LiveSum LiveSums::at(const Vec3& point, const Vec3& normal) {
  const Vec3 from = point + scene_.offset_m() * normal;
  const auto light_of = [&](const PosedLights& posed, std::size_t i, Seen& seen) {
    const LiveLight& light = posed.lights[i];
    const Vec3 given = unshadowed(light, point, normal);
    if (given == Vec3(0)) return given;
    ++seen.all;
    const float side = glm::dot(light.normal, from - light.position) < 0 ? -1.0f : 1.0f;
    const Vec3 to = light.position + side * scene_.offset_m() * light.normal;
    if (scene_.sees(from, to, posed.lamp_from_pack, (&posed == &lights_.now ? now_ : baked_)[i])) {
      ++seen.seen;
      return given;
    }
    return Vec3(0);
  };
  LiveSum out;
  Seen seen_now, seen_baked;
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const Vec3 a = light_of(lights_.now, i, seen_now), b = light_of(lights_.baked, i, seen_baked);
    out.now += a, out.baked += b;
    const double x = luminance(a), y = luminance(b);
    out.products += x * y, out.squares += y * y;
  }
  out.products *= static_cast<double>(now_.size()), out.squares *= static_cast<double>(now_.size());
  out.sees_now = seen_now.sight(), out.sees_baked = seen_baked.sight();
  return out;
}

void add_share(LiveSum& to, float share, const LiveSum& sum) {
  to.now += share * sum.now, to.baked += share * sum.baked;
  to.products += double{share} * sum.products, to.squares += double{share} * sum.squares;
}

LiveSum mix_sums(const std::array<const LiveSum*, 4>& corners, const std::array<float, 4>& weights) {
  constexpr float kLeast = 1e-3f;  // so that a point at a corner without light has some
  LiveSum sum, out;
  float total = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    if (corners[c] == nullptr) continue;
    const float weight = std::max(weights[c], kLeast);
    add_share(sum, weight, *corners[c]);
    total += weight;
  }
  add_share(out, 1 / total, sum);
  return out;
}

}  // namespace oriel
