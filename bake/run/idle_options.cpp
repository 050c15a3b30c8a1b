#include "bake/run/idle_options.h"

namespace oriel {
namespace {

// Null where the option has an effect.
struct IdleRule {
  const char* option;
  const char* (*reason)(const BakeOptions&, const IdleFacts&);
};

const char* no_sky_file(const BakeOptions& o, const IdleFacts&) {
  return o.import.sky_file.empty() ? "--sky names no file" : nullptr;
}

const char* no_light_field(const BakeOptions& o, const IdleFacts& facts) {
  if (!o.with_transfer) return "--only leaves movers out";
  return facts.light_field ? nullptr : "nothing in the scene moves";
}

const char* paths_alone(const BakeOptions& o, const IdleFacts&) {
  return o.radiosity.estimator == Estimator::kReference ? "--estimator reference does without" : nullptr;
}

const char* no_reflectors(const BakeOptions& o, const IdleFacts& facts) {
  if (!o.with_radiance) return "--only leaves reflections out";
  return facts.reflectors ? nullptr : "the scene has no reflectors that eyes see";
}

const char* no_maps(const BakeOptions& o, const IdleFacts& facts) {
  if (const char* reason = no_reflectors(o, facts)) return reason;
  return facts.maps ? nullptr : "no reflector has radiance maps (--reflections maps)";
}

const IdleRule kRules[] = {
    {"--detail", paths_alone},
    {"--map-resolution", no_maps},
    {"--memory", no_reflectors},
    {"--orders", no_maps},
    {"--probe", no_light_field},
    {"--reflections", no_reflectors},
    {"--sh-bands", no_light_field},
    {"--sky-rotation", no_sky_file},
    {"--sky-scale", no_sky_file},
    {"--sun-angle",
     [](const BakeOptions&, const IdleFacts& facts) {
       return facts.suns ? nullptr : "the scene has no directional lights";
     }},
    {"--target",
     [](const BakeOptions& o, const IdleFacts& facts) {
       return o.ways == WaysWanted::kAuto ? no_reflectors(o, facts) : "--reflections decides";
     }},
    {"--verify", paths_alone},
    {"--views", no_maps},
};

}  // namespace

std::vector<std::string> idle_bake_option_names() {
  std::vector<std::string> names;
  for (const IdleRule& rule : kRules) names.push_back(rule.option);
  return names;
}

std::vector<std::string> idle_options(const BakeOptions& options, const IdleFacts& facts) {
  std::vector<std::string> lines;
  for (const std::string& name : options.given)
    for (const IdleRule& rule : kRules)
      if (name == rule.option)
        if (const char* reason = rule.reason(options, facts))
          lines.push_back(fmt::format("{} has no effect: {}", name, reason));
  return lines;
}

}  // namespace oriel
