// Groups of lamps and their light.
#include <algorithm>
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
  if (!not_negative(group.value) || !not_negative(group.color))
    list.error(761, "group '{}': found value {} and colour {}, expected finite numbers from 0 up", group.name,
               group.value, text_of(group.color));
  if (group.reflectors.size() != pack.reflectors.size() || group.surrounds.size() != pack.surround_maps.size())
    list.error(764, "group '{}': found shares of {} reflectors and {} surround maps, expected of {} and {}", group.name,
               group.reflectors.size(), group.surrounds.size(), pack.reflectors.size(), pack.surround_maps.size());
  for (const auto* shares : {&group.reflectors, &group.surrounds})
    list.each(
        764, "shares of maps", *shares, [](const Vec3& v) { return within(v, 0, 1); },
        [](const Vec3& v) { return text_of(v); }, "0 to 1");
}

void validate_light(const Pack& pack, const GroupLight& light, IssueList& list) {
  if (light.group >= pack.light_groups.size() || light.page >= pack.lightmaps.size()) {
    list.error(765, "found light of group {} on page {}, expected less than {} and {}", light.group, light.page,
               pack.light_groups.size(), pack.lightmaps.size());
    return;
  }
  const LightmapPage& page = pack.lightmaps[light.page];
  if (light.width != page.width || light.height != page.height || light.detail_width != page.detail_width ||
      light.detail_height != page.detail_height ||
      light.irradiance.size() != std::size_t{light.width} * light.height ||
      light.detail.size() != std::size_t{light.detail_width} * light.detail_height)
    list.error(766, "found {} x {} texels and {} x {} details, expected the page's {} x {} and {} x {}", light.width,
               light.height, light.detail_width, light.detail_height, page.width, page.height, page.detail_width,
               page.detail_height);
  for (const auto* values : {&light.irradiance, &light.detail})
    list.each(
        767, "texels of light", *values, [](const Vec3& v) { return not_negative(v); },
        [](const Vec3& v) { return text_of(v); }, "finite numbers from 0 up");
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
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  for (std::size_t i = 0; i < pack.group_lights.size(); ++i) {
    list.in_section(kGroupLightSection, i);
    const GroupLight& light = pack.group_lights[i];
    validate_light(pack, light, list);
    if (!seen.emplace(light.group, light.page).second)
      list.error(765, "found light of group {} on page {} a second time", light.group, light.page);
  }
}

}  // namespace oriel
