#include "bake/radiosity/estimators/path_estimator.h"

#include <algorithm>

#include "bake/jobs/units.h"
#include "bake/radiosity/texels/frame_error.h"
#include "bake/radiosity/texels/texel_paths.h"

namespace oriel {
namespace {

constexpr std::uint32_t kFirstPaths = 16;  // a texel, before the error is checked
constexpr std::size_t kRaysAPath = 10;     // about
constexpr std::size_t kRun = 64;  // texels a unit: long enough to hide scheduling, short enough to stop at once

struct Run {
  std::size_t page, first, last;
};

Vec3 direction_of(const TexelSums& sums) {
  if (!(sums.mean > 0)) return Vec3(0);
  const DVec3 d = sums.vector / sums.mean;
  return Vec3(d / std::max(1.0, glm::length(d)));  // longer than 1 by rounding only
}

void store(const TexelSums& sums, std::uint32_t asked, LightmapPage& page, std::size_t texel) {
  // A texel is visible if at least a sixteenth of its points are.
  if (sums.count * 16 < asked || sums.count == 0) {
    page.state[texel] = TexelState::kBuried;
    return;
  }
  page.irradiance[texel] = Vec3(sums.irradiance());
  if (!page.direction.empty()) page.direction[texel] = direction_of(sums);
  page.standard_error[texel] = Vec3(glm::sqrt(sums.variance()));
  page.state[texel] = TexelState::kValid;
}

class PathEstimator : public LightEstimator {
 public:
  explicit PathEstimator(const RadiosityTask& task)
      : task_(task), paths_(task, task.options.eyes, task.options.directional, task.context.seed, task.context) {
    for (std::size_t p = 0; p < task.map.size(); ++p) {
      const std::size_t texels = task.map[p].texel.size();
      sums_.emplace_back(texels);
      for (std::size_t first = 0; first < texels; first += kRun)
        runs_.push_back({p, first, std::min(first + kRun, texels)});
    }
  }

  // Doubles the paths in rounds. Sums continue from round to round: the result equals that of a single round.
  Status refine(double wanted) override {
    const RadiosityOptions& options = task_.options;
    const bool in_rounds = wanted > 0 || options.enough;
    while (path_count_ < options.samples) {
      const std::uint32_t first = in_rounds ? std::min(options.samples, kFirstPaths) : options.samples;
      ORIEL_TRY_VOID(add_paths(path_count_ == 0 ? first : std::min(options.samples, 2 * path_count_)));
      if (task_.context.stopped() || (wanted > 0 && error() <= wanted)) return {};
      if (path_count_ == options.samples) return {};
      if (options.enough) task_.context.finishable = true;
      if ((ended_early_ = options.enough && options.enough())) return {};
    }
    return {};
  }

  void write(Radiosity& light) const override {
    light.report.ended_early = ended_early_;
    for (std::size_t p = 0; p < sums_.size(); ++p)
      for (std::size_t i = 0; i < sums_[p].size(); ++i) {
        light.visible[p][i] = static_cast<float>(sums_[p][i].count) / static_cast<float>(std::max(path_count_, 1u));
        store(sums_[p][i], path_count_, light.pages[p], task_.map[p].texel[i]);
      }
  }

 private:
  // Adds paths up to that number for every texel.
  Status add_paths(std::uint32_t until) {
    const auto sums_of = [&](std::size_t r, Archive& archive) {
      for (std::size_t i = runs_[r].first; i < runs_[r].last; ++i) archive(sums_[runs_[r].page][i]);
    };
    UnitLoop loop{.stage = "paths",
                  .count = runs_.size(),
                  .rays = static_cast<double>(kRun * kRaysAPath) * (until - path_count_)};
    loop.inputs = [&](std::size_t r, Archive& key) {
      key(task_.options.directional, task_.options.eyes, runs_[r].page, runs_[r].first, runs_[r].last, path_count_,
          until);
      sums_of(r, key);  // paths are added to them
    };
    loop.compute = [&](std::size_t r) {
      const std::size_t page = runs_[r].page;
      std::uint64_t traced = 0;
      for (std::size_t i = runs_[r].first; i < runs_[r].last && !task_.context.stopped(); ++i)
        paths_.add({page, i}, {path_count_, until}, sums_[page][i], traced);
      return traced;
    };
    loop.results = sums_of;
    ORIEL_TRY_VOID(parallel_units(task_.paths, loop));
    path_count_ = until;
    return {};
  }

  double error() const {
    Radiosity light = empty_radiosity(task_.map, false);
    write(light);
    return stated_error(task_.map, task_.pixels, light.pages);
  }

  RadiosityTask task_;
  TexelPaths paths_;
  std::vector<Run> runs_;
  std::vector<std::vector<TexelSums>> sums_;  // by page and covered texel
  std::uint32_t path_count_ = 0;              // paths of each texel
  bool ended_early_ = false;
};

}  // namespace

std::unique_ptr<LightEstimator> make_path_estimator(const RadiosityTask& task) {
  return std::make_unique<PathEstimator>(task);
}

}  // namespace oriel
