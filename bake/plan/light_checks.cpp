#include <algorithm>

#include "bake/plan/doctor.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

// What light in photometric units amounts to. A lamp of 1 W gives about 100 lm (LED) or 8 cd all around, so a bulb that
// was written in watts is dimmer than a candle; one that an exporter multiplied by 683 lm/W outshines a stadium's.
constexpr double kDimLamp_cd = 50, kBrightLamp_cd = 1e6;
constexpr double kDimRoom_lux = 5, kBrightRoom_lux = 1e5;  // power over area: streets at night, noon in summer
constexpr double kDimSun_lux = 50, kBrightSun_lux = 2e5;   // moonlight has 0.3, the sun 1.2e5
constexpr double kLumenPerWatt = 683;

// The intensity on the axis, cd, or the illuminance, lux.
double strength(const Light& light) {
  return luminance(light.intensity);
}

bool dim_lamp(const Light& light) {
  return light.type != LightType::kDirectional && light.profile < 0 && strength(light) > 0 &&
         strength(light) < kDimLamp_cd;
}

Finding dim(const Light& light) {
  return {FindingKind::kLightUnits, light.name,
          fmt::format("{:.3g} cd, while all lights together give less than {} lux", strength(light), kDimRoom_lux),
          "candela: a 60 W bulb has about 65, a 9 W LED as much",
          fmt::format("if {:.3g} are watts of an LED, write {:.3g} cd (100 lm/W over 4 pi); Blender: export lights in "
                      "standard units",
                      strength(light), strength(light) * 100 / (4 * kPiD))};
}

Finding bright(const Light& light) {
  return {FindingKind::kLightUnits, light.name, fmt::format("{:.3g} cd", strength(light)),
          fmt::format("at most {:.0g} cd, a lighthouse", kBrightLamp_cd),
          fmt::format("divide by {:.0f} if an exporter took watts for radiant ones: {:.3g} cd", kLumenPerWatt,
                      strength(light) / kLumenPerWatt)};
}

void check_directional(const Light& light, std::vector<Finding>& findings) {
  const double lux = strength(light);
  if (!(lux > 0) || (lux >= kDimSun_lux && lux <= kBrightSun_lux)) return;
  findings.push_back({FindingKind::kLightUnits, light.name, fmt::format("a directional light of {:.3g} lux", lux),
                      "lux: the sun has 30 000 to 120 000, an overcast sky 10 000",
                      lux < kDimSun_lux
                          ? fmt::format("if {:.3g} are W/m², write {:.3g} lux (about 100 lm/W)", lux, 100 * lux)
                          : fmt::format("divide by {:.0f} if an exporter multiplied by it", kLumenPerWatt)});
}

}  // namespace

void check_lights(const Scene& scene, const LightSet& lights, double area_m2, std::vector<Finding>& findings) {
  const bool sky = luminance(scene.sky) > 0;
  if (lights.empty() && !sky) {
    findings.push_back({FindingKind::kNoLight, "scene", "no light at all",
                        "emissive materials, KHR_lights_punctual or a --sky",
                        "export punctual lights, raise emissive_strength, or bake with --sky 1000"});
    return;
  }
  const bool sun = std::any_of(scene.lights.begin(), scene.lights.end(),
                               [](const Light& l) { return l.type == LightType::kDirectional; });
  if (const auto outshone = find_outshone(scene, area_m2))
    findings.push_back({FindingKind::kLightUnits, outshone->lamp, outshone->found, outshone->expected, outshone->fix});
  const double mean_lux = area_m2 > 0 ? luminance(lights.power()) / area_m2 : 0;
  const bool is_dim = !sky && !sun && mean_lux < kDimRoom_lux;
  bool lamp_named = false;
  for (const Light& light : scene.lights) {
    if (light.hour >= 0) {
      continue;  // what it is follows from the sun
    } else if (light.type == LightType::kDirectional) {
      check_directional(light, findings);
    } else if (is_dim && dim_lamp(light)) {
      findings.push_back(dim(light));
      lamp_named = true;
    } else if (strength(light) > kBrightLamp_cd) {
      findings.push_back(bright(light));
      lamp_named = true;
    }
  }
  if (lamp_named || !(is_dim || mean_lux > kBrightRoom_lux)) return;
  findings.push_back({FindingKind::kLightUnits, "scene",
                      fmt::format("{:.3g} lm of lamps for {:.4g} m² of surface: {:.3g} lux", luminance(lights.power()),
                                  area_m2, mean_lux),
                      "50 to 1000 lux in rooms: lit panels have thousands of cd/m²",
                      "set KHR_materials_emissive_strength to the panels' luminance in cd/m²"});
}

}  // namespace oriel
