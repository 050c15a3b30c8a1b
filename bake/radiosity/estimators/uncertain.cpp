#include <algorithm>

#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/filter.h"
#include "formats/core/color.h"

namespace oriel {

void keep_uncertain(const DirectSums& sums, const TexelGraph& graph, float share, Context& context,
                    std::vector<std::uint32_t>& list) {
  constexpr float kUneven = 0.02f;  // least relative error for variance over the texel
  std::vector<float> wide_noise(sums.value.size()), wide_light(sums.value.size());
  for (std::size_t i = 0; i < wide_noise.size(); ++i)
    wide_noise[i] = luminance(sums.variance[i]), wide_light[i] = luminance(sums.value[i]);
  wide_noise = typical_errors(graph, std::move(wide_noise), context);
  wide_light = typical_errors(graph, std::move(wide_light), context);
  const float least = std::max(share, kUneven);
  const auto uncertain = [&](std::uint32_t i) {
    const Vec3 noise = sums.variance[i], light2 = sums.value[i] * sums.value[i];
    return max_component(noise - share * share * light2) > 0 ||
           max_component(noise + sums.uneven[i] - least * least * light2) > 0;
  };
  std::erase_if(list, [&](std::uint32_t i) {
    const auto neighbours = graph.of(i);
    return wide_noise[i] <= kUncertain * kUncertain * wide_light[i] * wide_light[i] && !uncertain(i) &&
           std::none_of(neighbours.begin(), neighbours.end(), uncertain);
  });
}

}  // namespace oriel
