// Groups of lamps and their light.
#include <set>

#include "formats/pack/issues.h"

namespace oriel {
namespace {

// That no index is out of range, and none of two groups.
class Owned {
 public:
  Owned(const char* what, std::size_t count) : what_(what), owner_(count) {}

  void check(const LightGroup& group, const std::vector<std::uint32_t>& indices, IssueList& list) {
    for (const std::uint32_t index : indices) {
      if (index >= owner_.size())
        list.error(762, "group '{}': found {} {}, expected less than {}", group.name, what_, index, owner_.size());
      else if (owner_[index])
        list.error(763, "group '{}': found {} {}, which is of '{}' as well", group.name, what_, index,
                   owner_[index]->name);
      else
        owner_[index] = &group;
    }
  }

 private:
  const char* what_;
  std::vector<const LightGroup*> owner_;
};

void validate_group(const Pack& pack, const LightGroup& group, IssueList& list) {
  if (!not_negative(group.value) || !not_negative(group.color) || !not_negative(group.own_color))
    list.error(761, "group '{}': found value {} and colour {}, expected finite numbers from 0 up", group.name,
               group.value, text_of(group.color));
  const std::size_t probes = pack.light_field.probes.size();
  if (group.reflectors.size() != pack.reflectors.size() || group.surrounds.size() != pack.surround_maps.size() ||
      group.probes.size() != probes)
    list.error(764,
               "group '{}': found shares of {} reflectors, {} surround maps and {} probes, expected of {}, {} and {}",
               group.name, group.reflectors.size(), group.surrounds.size(), group.probes.size(), pack.reflectors.size(),
               pack.surround_maps.size(), probes);
  validate_motion(fmt::format("group '{}'", group.name), group.rest, group.keys, list);
  for (const auto* shares : {&group.reflectors, &group.surrounds, &group.probes})
    list.each(
        764, "shares of maps", *shares, [](const Vec3& v) { return within(v, 0, 1); }, "0 to 1");
}

// `rest` and codes of a page, or of its details: as many as there are texels.
void validate_texels(const Pack& pack, std::size_t texels, const std::vector<std::uint8_t>& rest, IssueList& list) {
  if (rest.size() != texels) list.error(766, "found brightest groups of {} texels, expected {}", rest.size(), texels);
  list.each(
      767, "brightest groups", rest, [&](std::uint8_t group) { return group < pack.light_groups.size(); },
      "groups of the pack");
}

void validate_page(const Pack& pack, const PageGroups& page, IssueList& list) {
  if (page.page >= pack.lightmaps.size()) {
    list.error(765, "found page {}, expected less than {}", page.page, pack.lightmaps.size());
    return;
  }
  const LightmapPage& of = pack.lightmaps[page.page];
  if (page.width != of.width || page.height != of.height || page.detail_width != of.detail_width ||
      page.detail_height != of.detail_height)
    list.error(766, "found {} x {} texels and {} x {} details, expected the page's {} x {} and {} x {}", page.width,
               page.height, page.detail_width, page.detail_height, of.width, of.height, of.detail_width,
               of.detail_height);
  const std::size_t texels = std::size_t{page.width} * page.height;
  const std::size_t details = std::size_t{page.detail_width} * page.detail_height;
  validate_texels(pack, texels, page.rest, list);
  validate_texels(pack, details, page.rest_of_detail, list);
  std::set<std::uint32_t> seen;
  for (const GroupTexels& other : page.others) {
    if (other.group >= pack.light_groups.size() || !seen.insert(other.group).second)
      list.error(765, "found light of group {}, expected less than {} and each once", other.group,
                 pack.light_groups.size());
    if (other.light.size() != texels || other.detail.size() != details)
      list.error(766, "found light of {} texels and {} points of group {}, expected {} and {}", other.light.size(),
                 other.detail.size(), other.group, texels, details);
  }
}

void validate_day(const Pack& pack, IssueList& list) {
  const Day& day = pack.day;
  if (day.empty()) return;
  list.in_section(kDaySection);
  const auto finite = [](float v) { return std::isfinite(v); };
  if (!(std::abs(day.latitude_deg) <= 90) || !(std::abs(day.longitude_deg) <= 180) || !finite(day.north_deg) ||
      !finite(day.utc_offset_h) || !(day.shown_hour >= day.hours.front().hour) ||
      !(day.shown_hour <= day.hours.back().hour))
    list.error(769, "found latitude {}, longitude {} and the hour {}, expected a place on earth and one of the hours",
               day.latitude_deg, day.longitude_deg, day.shown_hour);
  std::set<std::uint32_t> groups;
  for (std::size_t i = 0; i < day.hours.size(); ++i) {
    const DayHour& hour = day.hours[i];
    if (!finite(hour.hour) || (i > 0 && !(hour.hour > day.hours[i - 1].hour)))
      list.error(770, "found the hour {} at {}, expected later ones", hour.hour, i);
    if (hour.group != kNight && (hour.group >= pack.light_groups.size() || !groups.insert(hour.group).second))
      list.error(770, "found group {} of the hour {}, expected less than {} and each once", hour.group, hour.hour,
                 pack.light_groups.size());
    if (!is_finite(hour.to_sun) || !not_negative(hour.sun_lux) || !not_negative(hour.sky_lux) ||
        !not_negative(hour.sky))
      list.error(770, "found {} lux of the sun, {} of the sky at {}, expected finite numbers from 0 up", hour.sun_lux,
                 hour.sky_lux, hour.hour);
  }
  if (groups.empty()) list.error(770, "found no hour with a sun, expected one at least");
}

}  // namespace

void validate_light_groups(const Pack& pack, IssueList& list) {
  list.in_section(kLightGroupSection);
  if (pack.light_groups.size() > kMaxLightGroups)
    list.error(768, "found {} groups, expected at most {}", pack.light_groups.size(), kMaxLightGroups);
  std::set<std::string> names;
  Owned materials("material", pack.materials.size()), emitters("emitter", pack.emitters.size()),
      bright("bright light", pack.light_field.lights.size());
  for (const LightGroup& group : pack.light_groups) {
    if (!names.insert(group.name).second) list.error(761, "found two groups with the name '{}'", group.name);
    validate_group(pack, group, list);
    materials.check(group, group.materials, list);
    emitters.check(group, group.emitters, list);
    bright.check(group, group.bright_lights, list);
  }
  validate_day(pack, list);
  std::set<std::uint32_t> pages;
  for (std::size_t i = 0; i < pack.page_groups.size(); ++i) {
    list.in_section(kPageGroupsSection, i);
    validate_page(pack, pack.page_groups[i], list);
    if (!pages.insert(pack.page_groups[i].page).second)
      list.error(765, "found page {} a second time", pack.page_groups[i].page);
  }
}

}  // namespace oriel
