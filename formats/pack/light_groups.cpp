// Lamps: groups of them, what lightmap pages have of each, and those whose light is computed by pixel.
#include "formats/pack/sections.h"

namespace oriel {
namespace {

// Green as it is, the others as their difference from it: all three rise and fall together.
void describe_codes(Serial& s, std::vector<GroupCode>& codes, std::uint64_t n) {
  s.coded<GroupCode>(
      codes, n,
      [](const GroupCode& c) {
        return GroupCode{static_cast<std::uint16_t>(c[0] - c[1]), c[1], static_cast<std::uint16_t>(c[2] - c[1])};
      },
      [&](const GroupCode& c, std::size_t i) {
        const GroupCode code{static_cast<std::uint16_t>(c[0] + c[1]), c[1], static_cast<std::uint16_t>(c[2] + c[1])};
        for (const std::uint16_t channel : code)
          if (channel > kLargestGroupCode)
            s.refuse("found code {:#x} of light at {}, expected at most {:#x}", channel, i, kLargestGroupCode);
        return code;
      });
}

}  // namespace

void describe(Serial& s, LightGroup& group) {
  s(group.name);
  s.list(group.lamps, s.count(group.lamps), [&](std::string& lamp) { s(lamp); });
  s(group.value, group.color, group.own_color);
  for (auto* indices : {&group.materials, &group.emitters, &group.bright_lights}) s.array(*indices, s.count(*indices));
  s.choice("sky flag", 1, group.sky);
  bool moves = !group.keys.empty();
  s.choice("motion flag", 1, moves);
  s.reserved(2);
  for (auto* shares : {&group.reflectors, &group.surrounds, &group.probes})
    s.list(*shares, s.count(*shares), [&](Vec3& share) { s(share); });
  if (moves) describe_motion(s, group.rest, group.keys);
}

void describe(Serial& s, PageGroups& page) {
  s(page.page);
  s.size(page.width, page.height);
  s(page.detail_width, page.detail_height);
  if (page.detail_width > kMaxDetailSide || page.detail_height > kMaxDetailSide)
    s.refuse("found details of {} x {} points, expected at most {} a side", page.detail_width, page.detail_height,
             kMaxDetailSide);
  s.scale_exponent(page.exponent);
  const std::uint64_t texels = std::uint64_t{page.width} * page.height;
  const std::uint64_t details = std::uint64_t{page.detail_width} * page.detail_height;
  const std::uint32_t others = s.count(page.others);
  if (others > kMaxLightGroups) s.refuse("found light of {} groups, expected at most {}", others, kMaxLightGroups);
  s.planes(page.rest, texels);
  s.planes(page.rest_of_detail, details);
  s.list(page.others, others, [&](GroupTexels& of_group) {
    s(of_group.group);
    describe_codes(s, of_group.light, texels);
    describe_codes(s, of_group.detail, details);
  });
}

void describe(Serial& s, Day& day) {
  s(day.date);
  s(day.latitude_deg, day.longitude_deg, day.north_deg);
  s.choice("clock", 1, day.solar_time);
  s.as<std::uint8_t>(day.sky_type);
  s.reserved(2);
  s(day.utc_offset_h, day.shown_hour);
  const std::uint32_t hours = s.count(day.hours);
  if (hours > kMaxDayHours) s.refuse("found {} hours, expected at most {}", hours, kMaxDayHours);
  s.list(day.hours, hours,
         [&](DayHour& hour) { s(hour.hour, hour.group, hour.to_sun, hour.sun_lux, hour.sky_lux, hour.sky); });
}

void describe(Serial& s, SharpLight& light) {
  const std::uint32_t lamps = s.count(light.lamps), words = s.count(light.words), triangles = s.count(light.triangles);
  std::int32_t profiles = 0;
  s.list(light.lamps, lamps, [&](SharpLamp& lamp) {
    std::uint8_t kind = lamp.profile >= 0 ? 2 : lamp.sun ? 1 : 0;
    s.choice("kind of lamp", 2, kind);
    lamp.sun = kind == 1;
    s.reserved(3);
    s(lamp.position, lamp.direction, lamp.intensity, lamp.cos_outer, lamp.inverse_falloff, lamp.angular_radius_rad,
      lamp.light_group);
    if (kind != 2) return;
    s(lamp.profile, lamp.right, lamp.over);
    if (lamp.profile < 0 || lamp.profile >= static_cast<std::int32_t>(kMostSharpLamps))
      return s.refuse("found profile {}, expected 0 to {}", lamp.profile, kMostSharpLamps - 1);
    profiles = std::max(profiles, lamp.profile + 1);
  });
  s.planes(light.words, words);
  s.planes(light.triangles, triangles);
  s.list(light.profiles, static_cast<std::uint32_t>(profiles), [&](LampProfile& profile) {
    s(profile.first_deg, profile.last_deg);
    s.size(profile.rows, profile.columns);
    s.planes(profile.candela, std::uint64_t{profile.rows} * profile.columns);
  });
}

}  // namespace oriel
