#include "player/session/idle_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace oriel {
namespace {

// Null where the option has an effect.
using Reason = const char* (*)(const Pack&, const PlayArguments&);
struct Rule {
  const char* option;
  Reason reason;
};

bool has_maps(const Pack& pack) {
  return !pack.map_meshes.empty();
}

bool draws_maps(const Pack& pack, const PlayArguments& a) {
  return has_maps(pack) && a.frame.reflections != Reflections::kGeometry && a.frame.reflections != Reflections::kOff;
}

const char* no_reflections(const Pack& pack, const PlayArguments& a) {
  if (pack.reflectors.empty() && pack.curved_reflectors.empty()) return "the pack has no reflectors";
  return a.frame.reflections == Reflections::kOff ? "--reflections off draws none" : nullptr;
}

const char* no_planar_reflections(const Pack& pack, const PlayArguments& a) {
  return pack.reflectors.empty() ? "the pack has no planar reflectors" : no_reflections(pack, a);
}

const char* no_movers(const Pack& pack, const PlayArguments&) {
  return pack.movers.empty() ? "the pack has no movers" : nullptr;
}

// In a window lamps can be dragged.
const char* no_moved_lamps(const Pack& pack, const PlayArguments& a) {
  if (pack.light_groups.empty()) return "the pack has no light groups, so its lamps cannot be moved";
  const bool animated = std::any_of(pack.light_groups.begin(), pack.light_groups.end(),
                                    [](const LightGroup& group) { return !group.keys.empty(); });
  return a.offscreen && a.moves.empty() && !animated ? "no lamp is moved" : nullptr;
}

const char* no_window(const Pack&, const PlayArguments& a) {
  return a.offscreen ? "--offscreen has no window" : nullptr;
}

bool is_exr(const std::string& file) {
  return std::filesystem::path(file).extension() == ".exr";
}

bool is_picture_file(const std::string& file) {
  return is_exr(file) || std::filesystem::path(file).extension() == ".png";
}

// Offscreen pictures as .exr alone.
const char* no_exposure(const Pack&, const PlayArguments& a) {
  const bool of_light = is_exr(a.output) || (a.format == "exr" && !a.output.empty() && !is_picture_file(a.output));
  return a.offscreen && a.reference.empty() && of_light ? ".exr files hold light, not what is shown" : nullptr;
}

bool has_rough_glass(const Pack& pack) {
  return std::any_of(pack.materials.begin(), pack.materials.end(),
                     [](const Material& m) { return m.transmission > 0 && m.alpha > 0; });
}

const Rule kRules[] = {
    {"--blur",
     [](const Pack& pack, const PlayArguments& a) -> const char* {
       if (has_rough_glass(pack)) return nullptr;
       return pack.kernels.empty() ? "the pack has no kernels: its reflectors are mirrors" : no_reflections(pack, a);
     }},
    {"--exposure", no_exposure},
    {"--eye-height", no_window},
    {"--format",
     [](const Pack&, const PlayArguments& a) -> const char* {
       return a.path.empty() && (a.output.empty() || is_picture_file(a.output)) ? "it is of files in a folder"
                                                                                : nullptr;
     }},
    {"--live-lights", no_moved_lamps},
    {"--log-frames", no_window},
    {"--maps",
     [](const Pack& pack, const PlayArguments& a) {
       if (!has_maps(pack)) return "the pack has no radiance maps";
       return draws_maps(pack, a) ? nullptr : "--reflections draws none of them";
     }},
    {"--mover-lights", no_movers},
    {"--frame-budget", no_planar_reflections},
    {"--orders", no_planar_reflections},
    {"--pvs",
     [](const Pack& pack, const PlayArguments&) {
       return pack.visible_sets.empty() ? "the pack does not know what is seen from where" : nullptr;
     }},
    {"--reflections",
     [](const Pack& pack, const PlayArguments& a) -> const char* {
       if (pack.reflectors.empty() && pack.curved_reflectors.empty()) return "the pack has no reflectors";
       return a.frame.reflections == Reflections::kGeometry && !has_maps(pack)
                  ? "the pack has no radiance maps: its mirrors are drawn as geometry"
                  : nullptr;
     }},
    {"--shade", no_movers},
    {"--time",
     [](const Pack& pack, const PlayArguments&) {
       const auto moves = [](const auto& one) { return !one.keys.empty(); };
       return std::none_of(pack.movers.begin(), pack.movers.end(), moves) &&
                      std::none_of(pack.light_groups.begin(), pack.light_groups.end(), moves)
                  ? "nothing in the pack is animated"
                  : nullptr;
     }},
    {"--tonemap", no_exposure},
};

}  // namespace

std::vector<std::string> idle_option_names() {
  std::vector<std::string> names;
  for (const Rule& rule : kRules) names.push_back(rule.option);
  return names;
}

std::vector<std::string> idle_options(const Pack& pack, const PlayArguments& arguments) {
  std::vector<std::string> lines;
  for (const std::string& name : arguments.given)
    for (const Rule& rule : kRules)
      if (name == rule.option)
        if (const char* reason = rule.reason(pack, arguments))
          lines.push_back(fmt::format("{} has no effect: {}", name, reason));
  return lines;
}

}  // namespace oriel
