#include "bake/run/light_groups.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "formats/core/check.h"
#include "formats/core/color.h"
#include "formats/core/file.h"
#include "formats/core/json.h"
#include "formats/core/text.h"
#include "formats/query/day_hours.h"

namespace oriel {
namespace {

constexpr std::uint32_t kNoGroup = ~0u;

// A node that shines, or the sky.
struct Lamp {
  std::string name, path, mesh, mark;
  std::vector<std::uint32_t> surfaces, lights;
  bool sky = false;
  std::int32_t motion = -1;
  std::uint32_t group = kNoGroup;
};

bool shines(const Scene& scene, const Surface& surface) {
  const SceneMaterial& material = scene.materials[surface.material];
  return !material.unlit && max_component(material.emission) > 0;
}

std::string last_step(const std::string& path) {
  return path.substr(path.rfind('/') + 1);
}
std::string above(const std::string& path) {
  const auto at = path.rfind('/');
  return at == std::string::npos ? std::string() : path.substr(0, at);
}

// In the scene's order; of one path one: a lamp's shade and its point light are often siblings, but have names of their
// own.
std::vector<Lamp> find_lamps(const Scene& scene) {
  std::vector<Lamp> lamps;
  std::map<std::pair<std::string, std::int32_t>, std::size_t> known;
  const auto lamp_at = [&](const std::string& path, const std::string& name, std::int32_t motion) -> Lamp& {
    // What moves is a lamp of its own: names may repeat.
    const auto [at, added] = known.try_emplace({path.empty() ? name : path, motion}, lamps.size());
    if (added) lamps.push_back({name, path, {}, {}, {}, {}, false, motion});
    return lamps[at->second];
  };
  for (std::uint32_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& surface = scene.surfaces[i];
    if (!shines(scene, surface)) continue;
    Lamp& lamp = lamp_at(surface.node_path, last_step(surface.node_path), surface.motion);
    lamp.surfaces.push_back(i), lamp.mesh = surface.mesh_name, lamp.mark = surface.group_mark;
  }
  for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    if (light.hour >= 0) continue;
    Lamp& lamp = lamp_at(light.node_path, light.name, light.motion);
    lamp.lights.push_back(i), lamp.mark = light.group_mark;
  }
  if (luminance(scene.sky) > 0 && scene.day.empty()) lamps.push_back({"sky", "sky", {}, {}, {}, {}, true});
  return lamps;
}

bool matches(std::string_view pattern, const Lamp& lamp) {
  return fits_pattern(pattern, lamp.name) || fits_pattern(pattern, lamp.path);
}

class Groups {
 public:
  explicit Groups(Scene& scene) : scene_(scene), lamps_(find_lamps(scene)) {}
  std::vector<Lamp>& lamps() { return lamps_; }

  std::uint32_t group(const std::string& name) {
    const auto at = std::ranges::find(names_, name);
    if (at == names_.end()) names_.push_back(name);
    return static_cast<std::uint32_t>(std::ranges::find(names_, name) - names_.begin());
  }

  // Hours come first: they are numbered so already.
  void by_hours() {
    for (const DayHour& hour : scene_.day.hours) {
      if (hour.group == kNight) continue;
      ORIEL_CHECK(group("day " + clock_text(hour.hour)) == hour.group);
    }
  }

  bool is_hour(const std::string& name) const {
    if (scene_.day.hours.empty()) return false;
    return name == "day" || name == "hour" ||  // as the player calls all of them, and the time that it shows
           std::ranges::any_of(scene_.day.hours,
                               [&](const DayHour& hour) { return name == "day " + clock_text(hour.hour); });
  }

  Status by_names(const LightGroupOptions& options) {
    for (const auto& [name, patterns] : options.named) {
      if (is_hour(name))
        return fail(ErrorCode::kUsage, options.file, "found the group \"{}\", expected another name: that is the day's",
                    name);
      const std::uint32_t number = group(name);
      for (const std::string& pattern : patterns) {
        bool any = false;
        for (Lamp& lamp : lamps_) {
          if (!matches(pattern, lamp)) continue;
          any = true;
          if (lamp.group != kNoGroup && lamp.group != number)
            return fail(ErrorCode::kUsage, options.file,
                        "found the lamp \"{}\" in \"{}\" and in \"{}\", expected it in one group", lamp.path,
                        names_[lamp.group], name);
          lamp.group = number;
        }
        if (!any) return no_such_lamp(options.file, name, pattern);
      }
      if (std::ranges::none_of(lamps_, [&](const Lamp& lamp) { return lamp.group == number; }))
        return fail(ErrorCode::kUsage, options.file, "found no lamp in the group \"{}\", expected one at least", name);
    }
    return {};
  }

  void by_marks(Context& context) {
    for (Lamp& lamp : lamps_)
      if (!lamp.mark.empty()) lamp.group = group(is_hour(lamp.mark) ? lamp.mark + " lamp" : lamp.mark);
    std::set<std::string> without;
    for (const Surface& surface : scene_.surfaces)
      if (!surface.group_mark.empty() && std::ranges::find(names_, surface.group_mark) == names_.end())
        without.insert(surface.group_mark);
    for (const std::string& name : without)
      context.warning("light-groups",
                      fmt::format("the light group \"{}\" has no lamp: its nodes are there, but none shines", name));
  }

  // A node's lamps, or those with one mesh; what hangs on nothing is alone.
  void by_place() {
    for (Lamp& lamp : lamps_) {
      const std::string parent = above(lamp.path);
      const std::string mesh = lamp.mesh.empty() ? lamp.name : lamp.mesh;
      lamp.group = group(!parent.empty() ? last_step(parent) : mesh);
    }
  }

  void one_each() {
    for (Lamp& lamp : lamps_) {
      lamp.group = group(unused(lamp.name));
    }
  }

  // What is animated moves as a group: it has none with a lamp that does not go along. Of those that get one for that
  // the first few alone: light is kept for each, and takes seconds when it moves.
  void by_motions(Context& context) {
    std::size_t made = 0;
    for (std::int32_t m = 0; m < static_cast<std::int32_t>(scene_.lamp_motions.size()); ++m) {
      std::set<std::uint32_t> with_others;
      for (const Lamp& lamp : lamps_)
        if (lamp.motion != m) with_others.insert(lamp.group);
      std::optional<std::uint32_t> own;
      for (Lamp& lamp : lamps_) {
        if (lamp.motion != m || (lamp.group != kNoGroup && !with_others.contains(lamp.group))) continue;
        if (!own && made == kMostMotions) continue;
        const std::string& name = scene_.lamp_motions[static_cast<std::size_t>(m)].name;
        if (lamp.group != kNoGroup)
          context.warning(
              "light-groups",
              fmt::format("the lamp \"{}\" is animated: it leaves the group \"{}\", which is not, for one of "
                          "its own",
                          lamp.path, names_[lamp.group]));
        if (!own) own = group(unused(name)), ++made;
        lamp.group = *own;
      }
    }
  }

  void write(Context& context) {
    if (names_.empty()) return;
    const auto rest = static_cast<std::uint32_t>(std::min(names_.size(), kMostLightGroups - 1));
    if (names_.size() > kMostLightGroups) {
      context.warning("light-groups",
                      fmt::format("found {} light groups, expected at most {}: the lamps of \"{}\" and those after it "
                                  "are switched together, as \"{}\"; --light-groups FILE chooses",
                                  names_.size(), kMostLightGroups, names_[rest], kOtherLamps));
      for (Lamp& lamp : lamps_)
        if (lamp.group >= rest) lamp.group = kNoGroup;
      names_.resize(rest);
    }
    if (std::ranges::any_of(lamps_, [](const Lamp& lamp) { return lamp.group == kNoGroup; })) group(kOtherLamps);
    scene_.light_groups.clear();
    for (const std::string& name : names_) scene_.light_groups.push_back({name, {}});
    for (const DayHour& hour : scene_.day.hours)
      if (hour.group != kNight)
        scene_.light_groups[hour.group].lamps = {"sun " + clock_text(hour.hour), "sky " + clock_text(hour.hour)};
    for (Light& light : scene_.lights)
      if (light.hour >= 0) light.light_group = scene_.day.hours[static_cast<std::size_t>(light.hour)].group;
    const auto last = static_cast<std::uint32_t>(names_.size() - 1);
    for (const Lamp& lamp : lamps_) {
      const std::uint32_t number = lamp.group == kNoGroup ? last : lamp.group;
      scene_.light_groups[number].lamps.push_back(lamp.path.empty() ? lamp.name : lamp.path);
      for (const std::uint32_t s : lamp.surfaces) scene_.surfaces[s].light_group = number;
      for (const std::uint32_t l : lamp.lights) scene_.lights[l].light_group = number;
      if (lamp.sky) scene_.sky_group = number;
    }
  }

  // A group moves where all of its lamps do.
  void find_motions(Context& context) {
    if (names_.empty()) return;
    std::vector<std::set<std::int32_t>> motions(scene_.light_groups.size());
    for (const Lamp& lamp : lamps_)
      motions[lamp.group == kNoGroup ? motions.size() - 1 : lamp.group].insert(lamp.motion);
    for (std::size_t g = 0; g < motions.size(); ++g) {
      if (motions[g].size() == 1)
        scene_.light_groups[g].motion = *motions[g].begin();
      else if (motions[g].size() > 1)
        context.warning("light-groups",
                        fmt::format("the light group \"{}\" has lamps that are animated and others: they stand still",
                                    scene_.light_groups[g].name));
    }
  }

 private:
  std::string unused(const std::string& wanted) const {
    std::string name = wanted;
    for (int n = 2; std::ranges::find(names_, name) != names_.end(); ++n) name = fmt::format("{} {}", wanted, n);
    return name;
  }

  Status no_such_lamp(const std::string& file, const std::string& name, const std::string& pattern) const {
    std::vector<std::string> names;
    for (const Lamp& lamp : lamps_) names.push_back(lamp.name);
    for (const Surface& surface : scene_.surfaces)
      if (fits_pattern(pattern, surface.name) || fits_pattern(pattern, surface.node_path))
        return fail(ErrorCode::kUsage, file, "found \"{}\" in the group \"{}\", which does not shine; lamps are {}",
                    pattern, name, names_like(pattern, names));
    return fail(ErrorCode::kUsage, file, "found \"{}\" in the group \"{}\", expected lamps of the scene: {}", pattern,
                name, names_like(pattern, names));
  }

  Scene& scene_;
  std::vector<Lamp> lamps_;
  std::vector<std::string> names_;
};

Result<LightGroupOptions> read_groups(const std::string& file) {
  ORIEL_TRY(const Bytes bytes, read_file(file));
  const Json json = Json::parse(bytes).value_or(Json());
  const char* expected = "expected {\"group\": [\"node\", …], …}";
  if (!json.is_object()) return invalid(file, "found no JSON object, {}", expected);
  LightGroupOptions options{LightGrouping::kNamed, file, {}};
  for (const auto& [name, nodes] : json.items()) {
    if (!nodes.is_array() || std::ranges::any_of(nodes, [](const Json& node) { return !node.is_string(); }))
      return invalid(file, "found no list of names in \"{}\", {}", name, expected);
    if (name.empty()) return invalid(file, "found a group without a name, {}", expected);
    options.named.emplace_back(name, nodes.get<std::vector<std::string>>());
  }
  if (options.named.empty()) return invalid(file, "found no group, {}", expected);
  return options;
}

}  // namespace

Result<LightGroupOptions> parse_light_groups(const std::string& text) {
  for (const auto& [name, by] : {std::pair("marked", LightGrouping::kMarked),
                                 {"off", LightGrouping::kOff},
                                 {"auto", LightGrouping::kAuto},
                                 {"each", LightGrouping::kEach}})
    if (text == name) return LightGroupOptions{by, {}, {}};
  if (text.empty()) return fail(ErrorCode::kUsage, "", "found '', expected marked, off, auto, each or a file");
  return read_groups(text);
}

Status assign_light_groups(const LightGroupOptions& options, Scene& scene, Context& context) {
  if (options.by == LightGrouping::kOff && !scene.lamp_motions.empty())
    context.warning("light-groups", fmt::format("{} lamps are animated: without light groups they stand still",
                                                scene.lamp_motions.size()));
  if (options.by == LightGrouping::kOff && scene.day.empty()) return {};
  Groups groups(scene);
  groups.by_hours();
  if (options.by == LightGrouping::kNamed) ORIEL_TRY_VOID(groups.by_names(options));
  if (options.by == LightGrouping::kMarked) groups.by_marks(context);
  if (options.by == LightGrouping::kAuto) groups.by_place();
  if (options.by == LightGrouping::kEach) groups.one_each();
  if (options.by != LightGrouping::kOff) groups.by_motions(context);
  groups.write(context);
  if (options.by != LightGrouping::kOff) groups.find_motions(context);
  return {};
}

}  // namespace oriel
