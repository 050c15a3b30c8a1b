#include "bake/radiosity/estimators/group_filter.h"

#include "bake/radiosity/texels/frame_error.h"
#include "formats/core/color.h"

namespace oriel {

GroupedLight filter_groups(const Texels& texels, const TexelGraph& graph, const GroupHalves& halves,
                           const FilterOptions& options, Context& context) {
  const auto& [light, steps] = halves;
  GroupedLight out = light[0];
  const std::vector<Vec3> none(texels.count(), Vec3(0));
  for (std::size_t g = 0; g < out.groups; ++g) {
    if (light[0].is_dark(g) && light[1].is_dark(g)) continue;
    const Halves own{{light[0].of_group(g), light[1].of_group(g)}, none, none, steps};
    out.set_group(g, filter(texels, graph, own, options, context).value);
  }
  return out;
}

GroupedLight filter_groups(const Texels& texels, const TexelGraph& graph, const LightSums& sums,
                           const FilterOptions& options, Context& context) {
  GroupedLight out = filter_groups(texels, graph, GroupHalves{sums.gathered.grouped_halves(), false}, options, context);
  const auto halves = sums.direct.grouped_halves();
  const std::vector<Vec3> none(texels.count(), Vec3(0));
  for (std::size_t g = 0; g < out.groups; ++g) {
    if (sums.direct.grouped.is_dark(g)) continue;
    const Halves own{{halves[0].of_group(g), halves[1].of_group(g)}, none, out.of_group(g)};
    std::vector<Vec3> sum = filter(texels, graph, own, narrow(options), context).value;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += own.additional[i];
    out.set_group(g, sum);
  }
  return out;
}

double noise_of_hours(const CacheQuery& query, std::span<const float> importance, const LightSums& sums) {
  const Day& day = query.transport().accel.scene().day;
  if (day.empty() || query.groups() == 0) return 1;
  const auto gathered = sums.gathered.grouped_halves();
  struct Noise {
    double mean = 0, squares = 0;
    double light = 0, difference = 0;  // of the texel at hand
    void add_to_mean(double share) { mean += share * light; }
    void add(double share) {
      const double by = light * light + kFrameFloor * kFrameFloor * mean * mean;
      if (by > 0) squares += share * difference * difference / by;
    }
  };
  const std::size_t groups = gathered[0].groups;
  Noise all;
  std::vector<Noise> each(groups);
  const auto load_texel = [&](std::size_t i) {
    all.light = all.difference = 0;
    for (std::size_t g = 0; g < groups; ++g) {
      const double a = luminance(gathered[0].of(i)[g]), b = luminance(gathered[1].of(i)[g]);
      each[g].light = 0.5 * (a + b) + luminance(sums.direct.grouped.of(i)[g]), each[g].difference = 0.5 * (a - b);
      all.light += each[g].light, all.difference += each[g].difference;
    }
  };
  for (const bool means : {true, false})
    for (std::size_t i = 0; i < importance.size(); ++i) {
      if (!(importance[i] > 0)) continue;
      load_texel(i);
      means ? all.add_to_mean(importance[i]) : all.add(importance[i]);
      for (Noise& one : each) means ? one.add_to_mean(importance[i]) : one.add(importance[i]);
    }
  double hours = 0;
  for (const DayHour& hour : day.hours)
    if (hour.group != kNight) hours += each[hour.group].squares / static_cast<double>(day.lit());
  return all.squares > 0 ? std::max(1.0, std::sqrt(hours / all.squares)) : 1;
}

}  // namespace oriel
