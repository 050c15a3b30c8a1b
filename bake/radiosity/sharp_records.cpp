#include "bake/radiosity/sharp_records.h"

#include <algorithm>
#include <cmath>

#include "bake/radiosity/texels/sharp_charts.h"
#include "bake/trace/punctual.h"
#include "formats/assets/light_field.h"
#include "formats/core/half.h"

namespace oriel {

std::size_t SharpRecord::words() const {
  std::size_t sum = is_split() ? 5 : 1;
  for (const LampShine& shine : shines) sum += 2 + shine.casters.size() + shine.screens.size();
  return sum;
}

namespace {

LampProfile even_profile(const LightProfile& measured) {
  LampProfile out{measured.vertical_deg.front(), measured.vertical_deg.back(), 0, 1, {}};
  const float range = out.last_deg - out.first_deg;
  const auto [last, around] = profile_steps(measured);
  out.rows = last + 1, out.columns = around;
  for (std::uint32_t i = 0; i < out.rows * out.columns; ++i) {
    const float down = static_cast<float>(i / out.columns) / static_cast<float>(last),
                turn = static_cast<float>(i % out.columns) / static_cast<float>(out.columns);
    out.candela.push_back(profile_candela(measured, out.first_deg + down * range, 360 * turn));
  }
  return out;
}

}  // namespace

void add_lamps(const Scene& scene, std::span<const std::uint32_t> lights, SharpLight& out) {
  std::map<std::int32_t, std::int32_t> profiles;
  for (const std::uint32_t index : lights) {
    const Light& light = scene.lights[index];
    SharpLamp lamp{.sun = light.type == LightType::kDirectional,
                   .position = light.position,
                   .direction = light.direction,
                   .intensity = light.intensity,
                   .angular_radius_rad = light.angular_radius_rad};
    if (light.profile >= 0) {
      const auto [known, anew] = profiles.try_emplace(light.profile, static_cast<std::int32_t>(out.profiles.size()));
      if (anew) out.profiles.push_back(even_profile(scene.profiles[static_cast<std::size_t>(light.profile)]));
      lamp.profile = known->second, lamp.intensity = light.color;
      lamp.right = light.right, lamp.over = (light.mirrored ? -1.0f : 1.0f) * glm::cross(light.right, light.direction);
    } else if (light.type == LightType::kSpot) {
      lamp.cos_outer = std::cos(light.outer_cone_rad);
      lamp.inverse_falloff = 1 / std::max(kSharpestCone, std::cos(light.inner_cone_rad) - lamp.cos_outer);
    }
    if (!scene.light_groups.empty()) lamp.light_group = light.light_group;
    out.lamps.push_back(lamp);
  }
}

SharpWriter::SharpWriter(const ShadowCasters& casters, SharpLight& light) : casters_(casters), light_(light) {
  light_.words.push_back(0);  // place 0 stands for none
}

std::uint32_t SharpWriter::place_of(const SharpRecord& record) {
  std::vector<std::uint32_t> words;
  if (record.is_split()) {
    words.push_back(kSharpSplit);
    for (const auto& quarter : record.quarters) words.push_back(place_of(*quarter));
  } else {
    words.push_back(static_cast<std::uint32_t>(record.shines.size()));
    for (const LampShine& shine : record.shines) add(shine, words);
  }
  const auto [at, anew] = places_.try_emplace(words, static_cast<std::uint32_t>(light_.words.size()));
  if (anew) light_.words.insert(light_.words.end(), words.begin(), words.end());
  return at->second;
}

void SharpWriter::add(const LampShine& shine, std::vector<std::uint32_t>& words) {
  const bool tinted = shine.tint != Vec3(1);
  const std::size_t triangles = shine.casters.size() + shine.screens.size();
  words.push_back(SharpShine{shine.lamp, tinted, static_cast<std::uint32_t>(triangles)}.code());
  if (tinted) words.push_back(rgb9e5_from_rgb(shine.tint));
  for (std::size_t i = 0; i < shine.casters.size(); ++i)
    words.push_back(number_of(shine.casters[i]) | std::uint32_t{shine.edges[i]} << kSharpEdgeShift);
  for (const auto& [t, edges] : shine.screens) {
    words.push_back(static_cast<std::uint32_t>(light_.triangles.size()) | std::uint32_t{edges} << kSharpEdgeShift);
    light_.triangles.push_back({Vec3(t[0]), Vec3(t[1]), Vec3(t[2])});
  }
}

std::uint32_t SharpWriter::number_of(std::uint32_t caster) {
  const auto [at, anew] = numbers_.try_emplace(caster, static_cast<std::uint32_t>(light_.triangles.size()));
  const BeamTriangle& t = casters_.triangle(caster);
  if (anew) light_.triangles.push_back({Vec3(t[0]), Vec3(t[1]), Vec3(t[2])});
  return at->second;
}

}  // namespace oriel
