// Lamps whose light is computed by pixel, and what may stand in its way.
#include <optional>

#include "formats/pack/issues.h"

namespace oriel {
namespace {

bool is_unit(const Vec3& v) {
  return std::abs(glm::length(DVec3(v)) - 1) <= 1e-3;
}

bool is_profile(const LampProfile& p) {
  return p.first_deg >= 0 && p.first_deg < p.last_deg && p.last_deg <= 180 && p.rows >= 2 && p.columns >= 1 &&
         p.rows <= kMostProfileSteps + 1 && p.columns <= kMostProfileSteps &&
         p.candela.size() == std::size_t{p.rows} * p.columns &&
         std::ranges::all_of(p.candela, [](float candela) { return not_negative(candela); });
}

bool is_sharp_lamp(const SharpLamp& lamp, std::size_t groups, std::span<const LampProfile> profiles) {
  return bounded(lamp.position) && is_unit(lamp.direction) && is_unit(lamp.right) && is_unit(lamp.over) &&
         lamp.profile < std::ssize(profiles) && not_negative(lamp.intensity) && within(lamp.cos_outer, -2, 1) &&
         lamp.inverse_falloff > 0 && not_negative(lamp.inverse_falloff) && lamp.angular_radius_rad >= 0 &&
         lamp.angular_radius_rad < kPi / 2 && (lamp.light_group < groups || lamp.light_group == ~0u);
}

// Words of the record that begins there; 0: it makes no sense. levels: as sharp_records(), of the records before it.
std::size_t size_of_split(const SharpLight& light, std::size_t place, std::vector<std::uint8_t>& levels) {
  if (light.words.size() - place < 5) return 0;
  std::uint8_t level = 1;
  for (std::size_t k = 1; k <= 4; ++k) {
    const std::uint32_t quarter = light.words[place + k];
    if (quarter >= place || levels[quarter] == 0 || levels[quarter] > kMostSharpSplits) return 0;
    level = std::max<std::uint8_t>(level, levels[quarter] + 1);
  }
  levels[place] = level;
  return 5;
}

std::size_t size_of_lamps(const SharpLight& light, std::size_t place, std::vector<std::uint8_t>& levels) {
  const std::span words = std::span(light.words).subspan(place);
  if (words[0] > kMostShines) return 0;
  std::size_t at = 1;
  for (std::uint32_t lamp = 0; lamp < words[0]; ++lamp) {
    if (at >= words.size()) return 0;
    const SharpShine shine = SharpShine::of(words[at]);
    at += shine.tinted ? 2 : 1;
    if (shine.lamp >= light.lamps.size() || shine.count > kMostListed || at > words.size() ||
        shine.count > words.size() - at)
      return 0;
    for (const std::uint32_t word : words.subspan(at, shine.count))
      if ((word & ((1u << kSharpEdgeShift) - 1)) >= light.triangles.size()) return 0;
    at += shine.count;
  }
  levels[place] = 1;
  return at;
}

// The place of the first record that makes no sense, where there is one.
std::optional<std::size_t> find_records(const SharpLight& light, std::vector<std::uint8_t>& levels) {
  levels.assign(light.words.size(), 0);
  for (std::size_t place = 0; place < light.words.size();) {
    const std::size_t size =
        light.words[place] == kSharpSplit ? size_of_split(light, place, levels) : size_of_lamps(light, place, levels);
    if (size == 0) return place;
    place += size;
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::uint8_t> sharp_records(const SharpLight& light) {
  std::vector<std::uint8_t> levels;
  find_records(light, levels);
  return levels;
}

void validate_sharp_light(const Pack& pack, IssueList& list) {
  const SharpLight& light = pack.sharp_light;
  list.in_section(kSharpLightSection);
  if (light.lamps.size() > kMostSharpLamps || light.words.size() > kMostSharpWords ||
      light.triangles.size() > kMostSharpTriangles || light.empty() != light.words.empty() ||
      (light.empty() && !light.triangles.empty()))
    list.error(311, "found {} lamps, {} words and {} triangles, expected at most {}, {} and {}, or nothing",
               light.lamps.size(), light.words.size(), light.triangles.size(), kMostSharpLamps, kMostSharpWords,
               kMostSharpTriangles);
  for (std::size_t i = 0; i < light.lamps.size(); ++i) {
    const SharpLamp& lamp = light.lamps[i];
    if (!is_sharp_lamp(lamp, pack.light_groups.size(), light.profiles))
      list.error(
          312,
          "lamp {}: found place {}, direction {}, intensity {}, cone {} and {}, radius {}, group {} and profile {}, "
          "expected finite numbers, length 1, intensities from 0 up, -2 to 1, above 0, less than a right angle, one "
          "of {} groups or none, and one of {}",
          i, text_of(lamp.position), text_of(lamp.direction), text_of(lamp.intensity), lamp.cos_outer,
          lamp.inverse_falloff, lamp.angular_radius_rad, lamp.light_group, lamp.profile, pack.light_groups.size(),
          light.profiles.size());
  }
  for (std::size_t i = 0; i < light.profiles.size(); ++i)
    if (const LampProfile& p = light.profiles[i]; !is_profile(p))
      list.error(312,
                 "profile {}: found {} x {} intensities from {} to {} degrees, expected at most {} steps either way, "
                 "angles that rise from 0 to at most 180, intensities from 0 up",
                 i, p.rows, p.columns, p.first_deg, p.last_deg, kMostProfileSteps);
  for (std::size_t i = 0; i < light.triangles.size(); ++i)
    for (const Vec3& corner : light.triangles[i])
      if (!bounded(corner)) {
        list.error(313, "triangle {}: found corner {}, expected finite numbers", i, text_of(corner));
        return;
      }
  std::vector<std::uint8_t> levels;
  if (const auto bad = find_records(light, levels))
    list.error(314,
               "word {} of {}: found no record, expected at most {} lamps with {} triangles that there are, or four "
               "records before it of at most {} splits",
               *bad, light.words.size(), kMostShines, kMostListed, kMostSharpSplits - 1);
  else if (!light.words.empty() && light.words[0] != 0)
    list.error(314, "found {} lamps in the first record, expected none", light.words[0]);
}

void validate_sharp_places(std::span<const std::uint32_t> places, std::span<const std::uint8_t> records,
                           IssueList& list) {
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i] >= records.size() || records[places[i]] == 0) {
      list.error(310, "texel {}: found sharp light at {}, expected a record of the pack's {} words", i, places[i],
                 records.size());
      return;
    }
}

}  // namespace oriel
