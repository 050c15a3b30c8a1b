// Light that surfaces pass on to each other, found at texels by rays from texel to texel. What stands still is met but
// once: after that the light of any lamp bounces for the price of sums (radiosity by Jacobi's iteration: Cohen and
// Greenberg 1985, with rays in place of form factors). Lights that stand for surfaces would lose what is cut near them.
#pragma once

#include <atomic>
#include <span>
#include <vector>

#include "formats/query/live_sums.h"
#include "formats/query/page_points.h"

namespace oriel {

// By page and by point of it; lux. Refers to the LiveBounces that it is of.
struct BouncedLight {
  std::vector<LiveSum> sums;
  std::span<const std::vector<std::uint32_t>> row_of;  // by page and point: into sums, or kNone
  double left = 0;                                     // what one bounce more would bring, over all light there is
  static constexpr std::uint32_t kNone = ~0u;

  // Nothing where `sums` has none: between texels.
  LiveSum at(std::size_t page, std::size_t point) const {
    const std::uint32_t row = row_of[page][point];
    return row == kNone ? LiveSum{} : sums[row];
  }
};

class LiveBounces {
 public:
  // points: by page (page_points()). Light is found at texels, and at points of finer cells that have no
  // texel around them. All outlive it.
  LiveBounces(const LampScene& scene, std::span<const LightmapPage> pages,
              std::span<const std::vector<PagePoint>> points);

  // The surfaces' textures, or who looks at them, have changed: what texels reflect is found anew, rays stay. Not while
  // trace() or bounced() run.
  void look_again(const LampScene& scene);
  // Rays that each texel should have: 64, fewer where that would be too many in all.
  std::uint32_t wanted_rays() const;
  // Traces what is missing to so many rays a texel, in all threads. stop: ends it early, with fewer.
  void trace(std::uint32_t rays, const std::atomic<bool>* stop);
  std::uint32_t rays() const { return kRound * static_cast<std::uint32_t>(rounds_.size()); }

  // direct: light of the lamp by page and texel, now and as baked. The mean of each texel and its neighbours in the
  // same plane. Of stop as trace().
  BouncedLight bounced(std::span<const std::vector<LiveSum>> direct, std::uint32_t bounces,
                       const std::atomic<bool>* stop) const;

 private:
  static constexpr std::uint32_t kRound = 8;  // rays of a row that are traced together
  // Irradiance, lux.
  struct Light {
    Vec3 now{0}, baked{0};
  };

  std::uint32_t row_near(const LampScene::LitPlace& place) const;
  std::uint32_t met(std::size_t row, std::uint32_t ray) const;
  bool in_plane(const PagePoint& point, const Vec3& position, const Vec3& normal) const;
  Light gathered(std::size_t row, std::span<const Light> light) const;
  LiveSum summed(std::size_t row, std::span<const Light> light) const;
  LiveSum smoothed(std::size_t row, std::span<const LiveSum> sums) const;

  const LampScene* scene_;
  std::span<const LightmapPage> pages_;
  struct Row {
    std::uint32_t page = 0, index = 0;  // as PagePoint::index
    const PagePoint* point = nullptr;
  };
  std::vector<Row> rows_;                           // texels of all pages, then others
  std::size_t texels_ = 0;                          // of rows_
  std::vector<std::vector<std::uint32_t>> row_at_;  // by page and texel
  std::vector<std::vector<std::uint32_t>> row_of_;  // by page and point
  std::vector<Vec3> reflectance_;                   // of texels' rows
  std::vector<std::vector<std::uint32_t>> rounds_;  // the rows that rays meet, kRound of each row
};

}  // namespace oriel
