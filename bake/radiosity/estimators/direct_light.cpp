#include "bake/radiosity/estimators/direct_light.h"

#include "bake/jobs/units.h"
#include "bake/radiosity/estimators/direct_group.h"

namespace oriel {
namespace {

constexpr std::size_t kMaxPolygons = 128;
constexpr std::size_t kTexelsATask = 64;  // texels whose shadow rays to one light are traced together

}  // namespace

DirectLight::DirectLight(const Transport& transport, const Texels& texels, const ExtraSamplePoints& sample_points,
                         std::uint64_t seed, const SharpPart& sharp)
    : t_(transport), texels_(texels), sample_points_(sample_points), seed_(seed), sharp_(sharp) {
  const Scene& scene = transport.accel.scene();
  polygons_ = find_polygon_lights(scene);
  closed_form_ = all_emission_is_plain(scene) && polygons_.size() <= kMaxPolygons;
  if (!closed_form_) polygons_.clear();
  many_punctual_ = scene.lights.size() > kMaxPunctual;
}

Status DirectLight::estimate(std::span<const std::uint32_t> list, std::uint32_t per_half, const Stage& stage,
                             DirectSums& sums) const {
  const auto part = [&](std::size_t g) {
    return list.subspan(g * kTexelsATask, std::min(kTexelsATask, list.size() - g * kTexelsATask));
  };
  UnitLoop loop{.stage = "direct light", .count = (list.size() + kTexelsATask - 1) / kTexelsATask};
  const auto scene_lights = static_cast<std::uint32_t>(t_.accel.scene().lights.size());
  const std::size_t punctual = many_punctual_ ? DirectGroup::kPicks : scene_lights;
  const std::size_t frosted = t_.lights.frosted().empty() ? 0 : 2 * DirectGroup::kFrosted;
  loop.rays = static_cast<double>(kTexelsATask * kHalves * (polygons_.size() + punctual + frosted)) * per_half;
  loop.inputs = [&](std::size_t g, Archive& key) {
    std::vector<char> apart;
    for (const std::uint32_t t : part(g))
      for (std::uint32_t l = 0; l < scene_lights; ++l) apart.push_back(sharp_.has(l, texels_.chart[t]));
    key(part(g), per_half, !sums.moments.empty(), texels_.eyes, apart, sharp_.left_out);
  };
  loop.compute = [&](std::size_t g) {
    DirectGroup group(*this, part(g), per_half, !sums.moments.empty());
    group.run(sums);
    return group.rays();
  };
  loop.results = [&](std::size_t g, Archive& archive) {
    for (const std::uint32_t t : part(g)) {
      archive(sums.value[t], sums.difference[t], sums.variance[t], sums.uneven[t], sums.per_half[t], sums.sharp[t]);
      if (!sums.moments.empty()) archive(sums.moments[t]);
      if (!sums.grouped.empty()) archive(sums.grouped.of(t), sums.grouped_difference.of(t), sums.grouped_sharp.of(t));
    }
  };
  return parallel_units(stage, loop);
}

}  // namespace oriel
