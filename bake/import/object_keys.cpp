#include "bake/import/object_keys.h"

#include <array>
#include <charconv>
#include <cmath>

#include "formats/core/file.h"
#include "formats/core/text.h"

namespace oriel {
namespace {

const std::vector<std::string> kKeys{"density", "exclude",     "light_group", "metal",
                                     "mover",   "reflections", "texel",       "two_sided"};

std::optional<double> number_of(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

Status set_texel(std::string_view key, const std::string& value, ObjectKeys& keys) {
  std::optional<double> metres = number_of(value);
  if (key == "density" && metres) metres = 1 / *metres;
  if (key == "texel" && !metres) {
    ORIEL_TRY(metres, parse_length(value));
  }
  if (!metres || !(*metres >= 1e-6 && *metres <= 1e6))
    return fail(ErrorCode::kUsage, std::string(key), "found {}, expected {}", value,
                key == "density" ? "texels a metre" : "a length");
  keys.texel_m = static_cast<float>(*metres);
  return {};
}

}  // namespace

void ObjectKeys::inherit(const ObjectKeys& above) {
  const auto take = [](auto& own, const auto& from) {
    if (!own) own = from;
  };
  take(exclude, above.exclude), take(two_sided, above.two_sided), take(reflections, above.reflections);
  take(texel_m, above.texel_m), take(light_group, above.light_group);
  if (metal == Metal::kNone) metal = above.metal;
}

Status set_object_key(std::string_view key, const std::string& value, ObjectKeys& keys) {
  const std::string name(key);
  if (std::ranges::find(kKeys, key) == kKeys.end())
    return fail(ErrorCode::kUsage, name, "is no key; {}", names_like(name, kKeys));
  if (key == "texel" || key == "density") return set_texel(key, value, keys);
  if (key == "light_group") {
    if (!value.empty()) keys.light_group = value;
    return {};
  }
  if (key == "metal") {
    const auto metal = metal_by_name(value);
    if (!metal) return fail(ErrorCode::kUsage, name, "found {}, expected {}", value, metal_names());
    keys.metal = *metal;
    return {};
  }
  const bool yes = value == "true" || value == "on" || value == "1" || value.empty();
  if (!yes && value != "false" && value != "off" && value != "0")
    return fail(ErrorCode::kUsage, name, "found {}, expected true or false, on or off", value);
  (key == "mover"       ? keys.mover
   : key == "exclude"   ? keys.exclude
   : key == "two_sided" ? keys.two_sided
                        : keys.reflections) = yes;
  return {};
}

Result<std::vector<ObjectRule>> parse_object_rules(const std::string& text) {
  std::vector<ObjectRule> rules;
  const bool file = text.ends_with(".json");
  if (file) {
    ORIEL_TRY(const Bytes bytes, read_file(text));
    ORIEL_TRY(const Json json, Json::parse(bytes, text));
    for (const auto& [nodes, keys] : json.items()) {
      ObjectRule& rule = rules.emplace_back(ObjectRule{nodes, {}});
      for (const auto& [key, value] : keys.items())
        rule.keys.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump_ascii());
    }
    if (rules.empty() || std::ranges::any_of(rules, [](const ObjectRule& rule) { return rule.keys.empty(); }))
      return invalid(text, "found none, or a node without keys; expected {{\"NODE\": {{\"KEY\": VALUE, …}}, …}}");
  } else {
    const std::size_t colon = text.substr(0, text.find('=')).rfind(':');
    if (colon == 0 || colon == std::string::npos)
      return fail(ErrorCode::kUsage, "", "found '{}', expected NODE:KEY=VALUE,… or a .json file", text);
    ObjectRule& rule = rules.emplace_back(ObjectRule{text.substr(0, colon), {}});
    for (std::size_t at = colon + 1, end = 0; at <= text.size(); at = end + 1) {
      end = std::min(text.find(',', at), text.size());
      const std::string entry = text.substr(at, end - at);
      const std::size_t equals = std::min(entry.find('='), entry.size());
      rule.keys.emplace_back(entry.substr(0, equals), entry.substr(std::min(equals + 1, entry.size())));
    }
  }
  ObjectKeys tried;
  for (const ObjectRule& rule : rules)
    for (const auto& [key, value] : rule.keys)
      if (const auto set = set_object_key(key, value, tried); !set)
        return fail(ErrorCode::kUsage, file ? text : "", "\"{}\", {}: {}", rule.nodes, key, set.error().message);
  return rules;
}

std::string text_of(const ObjectRule& rule) {
  std::string text = rule.nodes;
  for (const auto& [key, value] : rule.keys)
    text += fmt::format("{}{}{}{}", text.size() == rule.nodes.size() ? ":" : ",", key, value.empty() ? "" : "=", value);
  return text;
}

}  // namespace oriel
