#include "bake/radiosity/estimators/booked_pages.h"

namespace oriel {
namespace {

// light(group): of that group, by texel or point.
template <class Light>
void share_out_all(const std::vector<Vec3>& whole, std::size_t groups, const Light& light) {
  std::vector<Vec3> parts(groups);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (std::size_t g = 0; g < groups; ++g) parts[g] = light(g)[i];
    share_out(parts, whole[i]);
    for (std::size_t g = 0; g < groups; ++g) light(g)[i] = parts[g];
  }
}

}  // namespace

void write_booked(const Texels& texels, const BookedLight& booked, std::vector<std::vector<LightmapPage>>& pages) {
  for (std::size_t i = 0; i < texels.count(); ++i)
    for (std::size_t g = 0; g < booked.groups && texels.visible[i] > 0; ++g) {
      LightmapPage& page = pages[g][texels.page[i]];
      page.irradiance[std::size_t{texels.y[i]} * page.width + texels.x[i]] = glm::max(booked.of(i)[g], Vec3(0));
    }
}

void share_out_page(const LightmapPage& whole, std::size_t page, std::vector<std::vector<LightmapPage>>& groups) {
  share_out_all(whole.irradiance, groups.size(),
                [&](std::size_t g) -> std::vector<Vec3>& { return groups[g][page].irradiance; });
  share_out_all(whole.detail, groups.size(),
                [&](std::size_t g) -> std::vector<Vec3>& { return groups[g][page].detail; });
}

}  // namespace oriel
