#include "bake/radiosity/cached/gather.h"

#include "bake/jobs/parallel.h"
#include "bake/radiosity/cached/moments.h"
#include "formats/core/color.h"

namespace oriel {
namespace {

constexpr std::size_t kGroup = 64;  // texels whose rays of one number are traced together: four packets

// One group of texels, in its thread's memory.
class GroupGather {
 public:
  GroupGather(const Texels& texels, const Surroundings& around, const DirectionSets& sets,
              std::span<const std::uint32_t> list, std::span<const Vec3> irradiance)
      : texels_(texels), around_(around), sets_(sets), list_(list), irradiance_(irradiance) {}

  void run(std::uint32_t per_half, HalfSums& sums) {
    for (int half = 0; half < kHalves; ++half) {
      std::uint32_t first = per_half;
      for (const std::uint32_t t : list_) first = std::min(first, sums.samples[t]);
      for (std::uint32_t k = first; k < per_half; ++k) add_sample(half, k, sums);
    }
    for (const std::uint32_t t : list_)
      if (texels_.visible[t] > 0) sums.samples[t] = per_half;
  }
  std::uint64_t rays() const { return rays_; }

 private:
  void add_sample(int half, std::uint32_t k, HalfSums& sums) {
    batch_.clear(), about_.clear(), target_.clear();
    for (const std::uint32_t t : list_) {
      if (texels_.visible[t] == 0 || sums.samples[t] > k) continue;
      const TexelSite& site = texels_.site_for(t, half, k);
      const std::uint32_t set = DirectionSets::set_of(texels_.page[t], texels_.x[t], texels_.y[t]);
      GatherRay about;
      batch_.push_back(gather_ray(site, sets_.local(set, half, k), about.incidence));
      about.stream = std::uint64_t{t} * kHalves + static_cast<std::uint64_t>(half);
      about.sample = k;
      about_.push_back(about);
      target_.push_back(t);
    }
    around_.answer(batch_, about_, answers_);
    rays_ += batch_.size() + answers_.rays;
    auto& light = answers_.light;
    for (const Link& link : answers_.links) light[link.ray] += link.weight * irradiance_[link.texel] / kPi;
    for (std::size_t i = 0; i < batch_.size(); ++i) {
      sums.sum[half][target_[i]] += kPi * light[i];
      if (!sums.moments.empty())
        sums.moments[target_[i]] +=
            moments_of(luminance(light[i]) * kPi / std::max(about_[i].incidence, kLeastCosine), batch_[i].direction);
    }
  }

  const Texels& texels_;
  const Surroundings& around_;
  const DirectionSets& sets_;
  std::span<const std::uint32_t> list_;
  std::span<const Vec3> irradiance_;
  std::vector<Ray> batch_;
  std::vector<GatherRay> about_;
  std::vector<std::uint32_t> target_;
  Answers answers_;
  std::uint64_t rays_ = 0;
};

}  // namespace

Status gather(const Texels& texels, const Surroundings& around, const DirectionSets& sets,
              std::span<const std::uint32_t> list, std::uint32_t per_half, std::span<const Vec3> irradiance,
              Context& context, HalfSums& sums, std::atomic<std::uint64_t>& rays) {
  const auto body = [&](std::size_t g) {
    const std::size_t first = g * kGroup;
    GroupGather group(texels, around, sets, list.subspan(first, std::min(kGroup, list.size() - first)), irradiance);
    group.run(per_half, sums);
    rays += group.rays();
  };
  return parallel_for(context, "gather", (list.size() + kGroup - 1) / kGroup, body, &rays);
}

}  // namespace oriel
