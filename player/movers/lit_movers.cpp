#include "player/movers/lit_movers.h"

#include <algorithm>

#include "formats/core/color.h"

namespace oriel {
namespace {

// Of what all bright lights give a mover: a light of less casts its shadow on nothing but itself.
constexpr float kFaintShare = 0.1f;

const LinearShare* share_of(const PlacedMover& placed, std::uint32_t light) {
  for (const LinearShare& share : placed.light.bright)
    if (share.light == light) return &share;
  return nullptr;
}

// Luminance of a light at the mover's centre, on what faces it.
float lux_of(const PlacedMover& placed, const BrightLight& light, float share) {
  const LightSamples samples = sample_light(light);
  Vec3 sum(0), towards;
  for (std::size_t i = 0; i < samples.at.size(); ++i)
    sum += facing_irradiance(samples, i, Vec3(placed.sphere), towards);
  return luminance(sum) * std::clamp(share, 0.0f, 1.0f) /
         static_cast<float>(std::max<std::size_t>(samples.at.size(), 1));
}

bool is_faint(const PlacedMover& placed, std::uint32_t light, std::span<const BrightLight> lights) {
  float all = 0, one = 0;
  for (const LinearShare& share : placed.light.bright) {
    const float lux = lux_of(placed, lights[share.light], share.fit.x);
    all += lux;
    if (share.light == light) one = lux;
  }
  return one < kFaintShare * all;
}

void find_casters(std::span<const BrightLight> lights, const Frustum& frustum, const Bounds& bounds, LitMovers& lit) {
  const bool parallel = lit.samples.at[0].w == 0;
  const std::size_t casting = std::min<std::size_t>(lit.receivers.size(), kMaxShadowMovers);
  for (const LitMovers::Receiver& r : std::span(lit.receivers).first(casting)) {
    const ShadowCone cone = make_shadow_cone(r.mover->sphere, lit.samples.center, lit.samples.radius, parallel);
    LitMovers::Caster caster{r.mover, r.index, make_shadow_box(cone, bounds), false, {}, {}};
    caster.scene_box = caster.box;
    Bounds box;
    for (const Vec3& corner : caster.box) box.extend(corner);
    const bool faint = is_faint(*r.mover, lit.light, lights);
    caster.on_scene = may_be_visible(frustum, box) && !faint;
    for (std::size_t i = 0; i < lit.receivers.size(); ++i) {
      const LitMovers::Receiver& other = lit.receivers[i];
      if (!other.visible || (faint && other.index != r.index)) continue;
      if (may_meet(cone, other.mover->sphere)) caster.on_movers.push_back(i);
    }
    if (caster.on_scene || !caster.on_movers.empty()) lit.casters.push_back(std::move(caster));
  }
}

}  // namespace

std::vector<LitMovers> find_lit(std::span<const BrightLight> lights, std::span<const PlacedMover> movers,
                                const Frustum& frustum, const Bounds& bounds, const FrameOptions& options) {
  std::vector<LitMovers> out;
  std::size_t pairs = 0;
  for (const PlacedMover& placed : movers) pairs += placed.light.bright.size();
  for (std::uint32_t l = 0; l < lights.size(); ++l) {
    LitMovers lit;
    lit.light = l;
    std::vector<Vec4> spheres;
    for (std::uint32_t i = 0; i < movers.size(); ++i) {
      const LinearShare* share = share_of(movers[i], l);
      if (share == nullptr) continue;
      const Vec3 middle(movers[i].sphere);
      const Bounds box{middle - movers[i].sphere.w, middle + movers[i].sphere.w};
      lit.receivers.push_back({&movers[i], i, share->fit, may_be_visible(frustum, box)});
      spheres.push_back(movers[i].sphere);
    }
    if (lit.receivers.empty()) continue;
    lit.samples = sample_light(lights[l], choose_points(lights[l], spheres, pairs, options.light_points), options.look);
    if (lit.samples.at.empty()) continue;
    const auto away = [&](const LitMovers::Receiver& r) { return length2(Vec3(r.mover->sphere) - lit.samples.center); };
    std::stable_sort(lit.receivers.begin(), lit.receivers.end(),
                     [&](const auto& a, const auto& b) { return away(a) < away(b); });
    if (options.mover_lights == MoverLights::kShadowed) find_casters(lights, frustum, bounds, lit);
    const auto visible = [](const LitMovers::Receiver& r) { return r.visible; };
    if (!lit.casters.empty() || std::any_of(lit.receivers.begin(), lit.receivers.end(), visible))
      out.push_back(std::move(lit));
  }
  return out;
}

}  // namespace oriel
