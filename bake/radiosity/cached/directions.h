// The directions of gather rays: few sets, shared by many texels, so that neighbours trace the same way.
#pragma once

#include "bake/radiosity/texels/texels.h"

namespace oriel {

// Interleaved sampling (Keller & Heidrich 2001): a texel uses the set of its place in a 4 × 4 pattern, so texels of one
// set, side by side in memory, trace parallel rays (3-4 times faster), while the texels around one together know 16
// sets: what the filter joins is as good as 16 times the rays. Patches of 32 × 32 texels use other sets than their
// neighbours. Each half of the estimate has its own. Points are Owen-scrambled Sobol: prefixes of any power of two are
// (0,2)-nets.
class DirectionSets {
 public:
  static constexpr std::uint32_t kPattern = 4;  // texels
  static constexpr std::uint32_t kTile = 32;    // texels
  static constexpr std::uint32_t kTables = 8;

  // per_half: directions in each set.
  DirectionSets(std::uint64_t seed, std::uint32_t per_half);

  // Which set a place of the lightmap uses.
  static std::uint32_t set_of(std::uint32_t page, std::uint32_t x, std::uint32_t y);
  // Cosine-distributed around +z.
  const Vec3& local(std::uint32_t set, int half, std::uint32_t i) const { return row(set, half)[i]; }
  const Vec3* row(std::uint32_t set, int half) const {
    return &directions_[(std::size_t{set} * kHalves + static_cast<std::size_t>(half)) * per_half_];
  }
  std::uint32_t per_half() const { return per_half_; }

 private:
  std::uint32_t per_half_;
  std::vector<Vec3> directions_;
};

// The order in which texels are traced: those that share a set and a neighbourhood come together.
std::vector<std::uint32_t> coherent_order(const Texels& texels);

// A site made ready for many rays.
class GatherSite {
 public:
  GatherSite() = default;
  explicit GatherSite(const TexelSite& site)
      : frame_(frame_from_normal(site.normal)), site_(site), tilted_(site.normal != site.geometric_normal) {}

  // `local` turned to the site's normal, mirrored above the real surface where it falls below.
  Ray ray(const Vec3& local) const {
    Vec3 direction = frame_ * local;
    if (tilted_)
      if (const float height = glm::dot(direction, site_.geometric_normal); height < 0)
        direction -= 2 * height * site_.geometric_normal;
    return {site_.origin, direction};
  }
  // π times the density of that direction.
  float incidence(const Vec3& direction) const {
    return std::max(oriel::incidence(site_.receiver(), direction), 1e-12f);
  }

 private:
  Mat3 frame_{1};
  TexelSite site_;
  bool tilted_ = false;
};

}  // namespace oriel
