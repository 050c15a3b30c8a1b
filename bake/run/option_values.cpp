#include "bake/run/option_values.h"

#include <sstream>

namespace oriel {

std::string verify_text(double share) {
  return share > 0 ? share_text(share) : "off";
}

std::string length_text(float metres) {
  return fmt::format("{}m", metres);
}

std::string time_text(double seconds) {
  return seconds > 0 ? fmt::format("{}s", seconds) : "";
}

std::string bytes_text(std::uint64_t bytes) {
  return bytes % (1u << 20) == 0 ? fmt::format("{}MiB", bytes >> 20) : fmt::format("{}B", bytes);
}

OptionValue or_auto(bool& chosen, const std::string& type, OptionValue inner) {
  return {"auto|" + type,
          [&chosen, set = inner.set](const std::string& typed) -> Status {
            chosen = typed == "auto";
            if (chosen) return {};
            return set(typed);
          },
          [&chosen, get = inner.get] { return chosen ? "auto" : get(); },
          [&chosen, json = inner.json] { return chosen ? Json("auto") : json(); }};
}

OptionValue memory_limit(BakeOptions& o) {
  return {"SIZE",
          [&o](const std::string& typed) -> Status {
            ORIEL_TRY(o.memory_bytes, parse_bytes(typed));
            o.memory_given = true;
            return {};
          },
          [&o] { return o.memory_given ? bytes_text(o.memory_bytes) : ""; },
          [&o] { return Json(o.memory_given ? o.memory_bytes : 0); }};
}

OptionValue samples(BakeOptions& o) {
  OptionValue value = number(o.radiosity.samples, 1, 1u << 24);
  value.get = [&o] { return o.radiosity.samples > 0 ? std::to_string(o.radiosity.samples) : ""; };
  return value;
}

OptionValue hidden_black(BakeOptions& o) {
  return {"",
          [&o](const std::string&) -> Status {
            o.radiosity.hidden = Hidden::kBlack;
            return {};
          },
          [&o] { return o.radiosity.hidden == Hidden::kBlack ? "on" : "off"; },
          [&o] { return Json(o.radiosity.hidden == Hidden::kBlack ? "black" : "left out"); }};
}

OptionValue texel_means(BakeOptions& o) {
  OptionValue value = flag(o.radiosity.fit_texels, false);
  value.json = [&o] { return Json(o.radiosity.fit_texels ? "fitted" : "means"); };
  return value;
}

OptionValue detail_steps(BakeOptions& o) {
  OptionValue value = choice(o.radiosity.detail, {{"1", 1}, {"2", 2}, {"4", 4}, {"8", kMostCellSide}});
  value.json = json_of(o.radiosity.detail);
  return value;
}

OptionValue parts(BakeOptions& o) {
  const auto set = [&o](const std::string& typed) -> Status {
    o.with_radiance = o.with_material = o.with_transfer = false;
    std::istringstream in(typed);
    for (std::string part; std::getline(in, part, ',');) {
      if (part == "radiance")
        o.with_radiance = true;
      else if (part == "material")
        o.with_material = true;
      else if (part == "transfer")
        o.with_transfer = true;
      else if (part != "radiosity")
        return fail(ErrorCode::kUsage, "", "found '{}', expected radiosity, radiance, material or transfer", part);
    }
    return {};
  };
  const auto get = [&o] {
    if (o.with_radiance && o.with_material && o.with_transfer) return std::string();
    return std::string("radiosity") + (o.with_radiance ? ",radiance" : "") + (o.with_material ? ",material" : "") +
           (o.with_transfer ? ",transfer" : "");
  };
  const auto json = [&o] {
    return Json{{"radiance", o.with_radiance}, {"material", o.with_material}, {"transfer", o.with_transfer}};
  };
  return {"LIST", set, get, json};
}

OptionValue eyes(BakeOptions& o) {
  const auto name = [&o] {
    return o.eyes.source == EyeSource::kWalk ? "walk" : o.eyes.source == EyeSource::kBox ? "box" : "file";
  };
  return {"walk|box|FILE",
          [&o](const std::string& typed) -> Status {
            ORIEL_TRY(o.eyes, parse_eye_source(typed));
            return {};
          },
          name,
          [&o, name] {
            Json points = Json::array();
            for (const DVec3& p : o.eyes.points) points.push_back({p.x, p.y, p.z});
            return Json{{"eyes", name()}, {"eye_points", points}};
          }};
}

OptionValue sky(ImportOptions& o) {
  return {"auto|none|L|R,G,B|FILE",
          [&o](const std::string& typed) -> Status {
            ORIEL_TRY(SkyChoice choice, parse_sky(typed));
            o.sky = choice.radiance;
            o.clear_sky = choice.clear;
            o.sky_file = std::move(choice.file);
            return {};
          },
          [&o] {
            if (!o.sky_file.empty()) return o.sky_file.string();
            if (o.sky == Vec3(0)) return std::string(o.clear_sky ? "auto" : "none");
            if (o.sky == Vec3(o.sky.r)) return fmt::format("{}", o.sky.r);
            return fmt::format("{},{},{}", o.sky.r, o.sky.g, o.sky.b);
          },
          [&o] {
            return Json{{"sky_cd_m2", {o.sky.r, o.sky.g, o.sky.b}},
                        {"sky_file", o.sky_file.filename().string()},
                        {"clear_sky", o.clear_sky}};
          }};
}

OptionValue day(ImportOptions& o) {
  return {"DATE@LAT,LON[,NORTH]", [&o](const std::string& typed) { return parse_day(typed, o.day); },
          [&o] { return day_text(o.day); }, [&o] { return o.day.wanted ? Json(day_text(o.day)) : Json(); }};
}

OptionValue hours(ImportOptions& o) {
  return {"FROM-TO/STEP[+HH:MM]", [&o](const std::string& typed) { return parse_hours(typed, o.day); },
          [&o] { return hours_text(o.day); }, [&o] { return Json(hours_text(o.day)); }};
}

OptionValue objects(std::vector<ObjectRule>& rules) {
  OptionValue value(
      "NODE:KEY=VALUE,…|FILE.json",
      [&rules](const std::string& typed) -> Status {
        ORIEL_TRY(const std::vector<ObjectRule> more, parse_object_rules(typed));
        rules.insert(rules.end(), more.begin(), more.end());
        return {};
      },
      [&rules] {
        std::string all;
        for (const ObjectRule& rule : rules) add_word(all, text_of(rule));
        return all;
      });
  value.repeats = true;
  value.json = [&rules] {
    Json all = Json::array();
    for (const ObjectRule& rule : rules) all.push_back(text_of(rule));
    return all;
  };
  return value;
}

OptionValue moves(std::vector<MoverMove>& moves) {
  OptionValue value = each(moves, "NODE=x,y,z[,yaw]", parse_move, text_of);
  value.json = [&moves] {
    Json all = Json::array();
    for (const MoverMove& move : moves) all.push_back(text_of(move));
    return all;
  };
  return value;
}

OptionValue light_scales(std::vector<LightScale>& scales) {
  OptionValue value = each(scales, "F|NAME=F", parse_light_scale, [](const LightScale& scale) {
    return fmt::format("{}{}{}", scale.names, scale.names.empty() ? "" : "=", scale.factor);
  });
  value.json = [get = value.get] { return Json(get()); };
  return value;
}

OptionValue profiles(ImportOptions& o) {
  OptionValue value = each(o.ies, "NODE=FILE", parse_ies_option,
                           [](const auto& profile) { return profile.first + "=" + profile.second.string(); });
  value.json = [&o] {
    Json json = Json::object();
    for (const auto& [node, file] : o.ies) json[node] = file.filename().string();
    return json;
  };
  return value;
}

OptionValue light_groups(BakeOptions& o) {
  const auto name = [&o]() -> std::string {
    constexpr std::array<const char*, 4> kNames{"marked", "off", "auto", "each"};
    const auto by = static_cast<std::size_t>(o.light_groups.by);
    return by < kNames.size() ? kNames[by] : o.light_groups.file;
  };
  return {"marked|off|auto|each|FILE",
          [&o](const std::string& typed) -> Status {
            ORIEL_TRY(o.light_groups, parse_light_groups(typed));
            return {};
          },
          name,
          [&o, name] {
            if (o.light_groups.by != LightGrouping::kNamed) return Json(name());
            Json json = Json::object();
            for (const auto& [group, nodes] : o.light_groups.named) json[group] = nodes;
            return Json{{"light_groups", json}};
          }};
}

OptionValue unit(double& unit_m, bool& guess) {
  OptionValue value =
      choice(unit_m, {{"mm", 0.001}, {"cm", 0.01}, {"in", 0.0254}, {"ft", 0.3048}, {"m", 1}, {"km", 1000}});
  value.json = json_of(unit_m);
  const std::string type = value.type;
  return or_auto(guess, type, std::move(value));
}

}  // namespace oriel
