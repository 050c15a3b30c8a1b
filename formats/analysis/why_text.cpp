#include <fmt/format.h>
#include <array>

#include "formats/analysis/why.h"
#include "formats/core/json.h"

namespace oriel {
namespace {

constexpr std::size_t kShownLights = 8;

const char* name_of(LightVerdict::Kind kind) {
  static const std::array names{"lights", "behind the surface", "shines away", "hidden"};
  return names.at(static_cast<std::size_t>(kind));
}

}  // namespace

std::string verdict_text(const LightVerdict& light) {
  switch (light.kind) {
    case LightVerdict::Kind::kLights:
      return light.distance_m > 0
                 ? fmt::format("'{}' lights it: {:.0f} % of it are in sight, from {:.2f} m", light.light,
                               100 * light.share, light.distance_m)
                 : fmt::format("'{}' lights it: {:.0f} % are in sight", light.light, 100 * light.share);
    case LightVerdict::Kind::kFacesAway:
      return fmt::format("'{}' is behind this surface", light.light);
    case LightVerdict::Kind::kTurnedAway:
      return fmt::format("'{}' shines to the other side", light.light);
    case LightVerdict::Kind::kHidden:
      break;
  }
  return fmt::format("'{}' is hidden by '{}'", light.light, light.by);
}

std::string why_text(const Why& why) {
  std::string text = fmt::format("{:.3f}, {:.3f}, {:.3f} m on '{}', material '{}'\n", why.at.x, why.at.y, why.at.z,
                                 why.surface, why.material);
  if (why.page >= 0)
    text += fmt::format("{:.4g} lux, standard error {:.2g} lux: texel {}, {} of page {}, {:.1f} cm wide, {}\n", why.lux,
                        why.lux_error, why.texel.x, why.texel.y, why.page, 100 * why.side_m, name_of(why.state));
  if (why.sharp_lux)
    text += fmt::format("sharp   {:.4g} lux of lamps come by the pixel to this very place\n", *why.sharp_lux);
  for (const Reason& reason : why.reasons)
    text += fmt::format("why     {}: {}\n        to do: {}\n", name_of(reason.cause), reason.text, reason.fix);
  for (std::size_t i = 0; i < std::min(kShownLights, why.lights.size()); ++i)
    text += fmt::format("{}{}\n", i == 0 ? "lights  " : "        ", verdict_text(why.lights[i]));
  const std::size_t more = why.lights_left_out + why.lights.size() - std::min(kShownLights, why.lights.size());
  if (more > 0) text += fmt::format("        and {} lights farther off\n", more);
  if (why.near_share > 0)
    text += fmt::format("sees    {:.0f} % of what it sees is nearer than {:.0f} cm, most of it '{}'\n",
                        100 * why.near_share, 100 * std::max(why.side_m, 0.02f), why.near_by);
  return text;
}

std::string why_json(const Why& why) {
  Json reasons = Json::array(), lights = Json::array();
  for (const Reason& r : why.reasons)
    reasons.push_back({{"cause", name_of(r.cause)}, {"object", r.object}, {"text", r.text}, {"fix", r.fix}});
  for (const LightVerdict& l : why.lights)
    lights.push_back({{"light", l.light},
                      {"verdict", name_of(l.kind)},
                      {"by", l.by},
                      {"share", l.share},
                      {"distance_m", l.distance_m}});
  const Json json = {{"schema", 1},
                     {"at", {why.at.x, why.at.y, why.at.z}},
                     {"surface", why.surface},
                     {"material", why.material},
                     {"page", why.page},
                     {"texel", {why.texel.x, why.texel.y}},
                     {"texel_m", why.side_m},
                     {"state", name_of(why.state)},
                     {"lux", why.lux},
                     {"lux_standard_error", why.lux_error},
                     {"sharp_lux", why.sharp_lux ? Json(*why.sharp_lux) : Json()},
                     {"dark", why.dark},
                     {"reasons", reasons},
                     {"lights", lights},
                     {"lights_left_out", why.lights_left_out},
                     {"near_share", why.near_share},
                     {"near", why.near_by}};
  return json.dump(2) + "\n";
}

}  // namespace oriel
