#include "bake/radiosity/estimators/write_pages.h"

#include "bake/radiosity/gather/moments.h"

namespace oriel {
namespace {

// light(group): the group's light, by texel or point.
template <class Light>
void rescale_all_groups(const std::vector<Vec3>& whole, std::size_t groups, const Light& light) {
  std::vector<Vec3> parts(groups);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (std::size_t g = 0; g < groups; ++g) parts[g] = light(g)[i];
    rescale_groups(parts, whole[i]);
    for (std::size_t g = 0; g < groups; ++g) light(g)[i] = parts[g];
  }
}

}  // namespace

void write_texels(const TexelEstimate& estimate, Radiosity& light) {
  const Texels& texels = estimate.texels;
  light.assumed.resize(light.pages.size());
  light.reach.clear();
  for (const auto& page : light.visible) light.reach.emplace_back(page.size());
  for (std::size_t k = 0; k < texels.count(); ++k) {
    LightmapPage& page = light.pages[texels.page[k]];
    const std::size_t texel = std::size_t{texels.y[k]} * page.width + texels.x[k];
    const std::uint32_t i = texels.shown_by(static_cast<std::uint32_t>(k));
    light.visible[texels.page[k]][texels.index[k]] = i == k ? texels.visible[k] : 1;
    if (i == k) light.reach[texels.page[k]][texels.index[k]] = texels.reach[k];
    page.state[texel] = i == k && texels.visible[k] > 0 ? TexelState::kValid : TexelState::kBuried;
    if (i != k) light.assumed[texels.page[k]].push_back(static_cast<std::uint32_t>(texel));
    if (i == kNoTexel || texels.visible[i] == 0) continue;
    if (!page.direction.empty())
      page.direction[texel] = direction_of(estimate.direct_moments[i] + estimate.gathered_moments[i]);
    page.irradiance[texel] = glm::max(estimate.direct.value[i] + estimate.gathered.value[i], Vec3(0));
    if (!light.sharp.empty()) light.sharp[texels.page[k]].irradiance[texel] = estimate.sharp[i];
    page.standard_error[texel] = glm::sqrt(estimate.direct.variance[i] + estimate.gathered.variance[i]);
  }
}

void write_grouped(const Texels& texels, const GroupedLight& grouped, std::vector<std::vector<LightmapPage>>& pages) {
  for (std::uint32_t k = 0; k < texels.count(); ++k) {
    const std::uint32_t i = texels.shown_by(k);
    for (std::size_t g = 0; g < grouped.groups && i != kNoTexel && texels.visible[i] > 0; ++g) {
      LightmapPage& page = pages[g][texels.page[k]];
      page.irradiance[std::size_t{texels.y[k]} * page.width + texels.x[k]] = glm::max(grouped.of(i)[g], Vec3(0));
    }
  }
}

void rescale_page_groups(const LightmapPage& whole, std::size_t page, std::vector<std::vector<LightmapPage>>& groups) {
  rescale_all_groups(whole.irradiance, groups.size(),
                     [&](std::size_t g) -> std::vector<Vec3>& { return groups[g][page].irradiance; });
  rescale_all_groups(whole.detail, groups.size(),
                     [&](std::size_t g) -> std::vector<Vec3>& { return groups[g][page].detail; });
}

}  // namespace oriel
