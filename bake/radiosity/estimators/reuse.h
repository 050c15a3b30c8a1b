// Reuse of the previous bake's light where an edit of the scene hardly changes it, with a measured error.
#pragma once

#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/gather/gather.h"

namespace oriel {

// The final state of a bake by texel, stored in the cache for the next one.
struct PreviousLight {
  std::vector<std::uint32_t> page, x, y, chart;  // identify a texel; chart: other numbers where other light is sharp
  std::vector<Vec3> first_pass;                  // direct light by the first few samples, lux
  std::vector<Vec3> unrefined_direct;            // direct light before refinement, lux
  std::vector<Vec3> coarse;                      // all light before the final gather, lux
  float min_distance = 1;                        // CacheQuery::min_distance() of its gather
  bool lamps = false;                            // particles carried the light of lamps
  DirectSums direct{0, false};
  HalfSums gathered{0, false};

  std::size_t count() const { return page.size(); }
};

// The cache key of the last bake with these options, of a scene with as many triangles and surfaces on pages of the
// same size.
Hash128 previous_light_key(const Scene& scene, const Texels& texels, const RadiosityOptions& options,
                           const PathOptions& paths, std::uint64_t seed);
// Loads it. Nothing, with a warning, if the cache has none or an incomplete one.
std::optional<PreviousLight> load_previous_light(Context& context, const Hash128& name, bool directional);
void store_light(Context& context, const Hash128& name, PreviousLight previous);

// Decides which texels reuse the previous bake's light, by tiles of 64 texels that are gathered together. Both bakes
// have a coarse estimate of all texels with the same sample points and random numbers (64 rays a texel, 4096 a tile,
// into the light after all bounces). A difference between the two is due to the edit, or to rays that hit something
// else: its root mean square over a tile is a conservative estimate of the tile's change. A tile is reused if that is
// below the allowed error, relative to its light (at least 1 % of the mean).
class Reuse {
 public:
  // Matches texels: the same place on the same page, and the same chart, as PreviousLight::chart numbers it.
  Reuse(const Texels& texels, std::span<const std::uint32_t> chart, PreviousLight before);

  // The number of a texel in the previous bake; kNoTexel without one.
  std::uint32_t before(std::size_t texel) const { return previous_number_[texel]; }
  const PreviousLight& previous() const { return previous_; }
  // Per texel: true if the first-pass direct light there and at all neighbours is equal to the bit.
  std::vector<bool> same_first_pass(const TexelGraph& graph, std::span<const Vec3> first_pass) const;

  // Chooses the tiles. coarse, lamps: as in PreviousLight, for the scene as it is now. order: coherent_order. error:
  // allowed, relative. Nothing is reused if `lamps` differ: the light of lamps would be lost, or count twice.
  void compare(const Texels& texels, std::span<const std::uint32_t> order, std::span<const Vec3> coarse, bool lamps,
               double error);
  bool reuses(std::size_t texel) const { return reused_[texel]; }
  // Sets direct light with an equal first pass to the previous one before refinement.
  void restore_unrefined(const std::vector<bool>& same_direct, std::vector<Vec3>& direct) const {
    for (std::size_t i = 0; i < direct.size(); ++i)
      if (same_direct[i]) direct[i] = previous_.unrefined_direct[previous_number_[i]];
  }
  // Copies the previous estimate to reused texels, and the direct light to those of `same_direct`.
  void restore(const std::vector<bool>& same_direct, DirectSums& direct, HalfSums& gathered) const {
    for (std::size_t i = 0; i < reused_.size(); ++i) {
      if (same_direct[i] || reused_[i]) direct.copy(i, previous_.direct, previous_number_[i]);
      if (reused_[i]) gathered.copy(i, previous_.gathered, previous_number_[i]);
    }
  }
  // Relative change of a reused texel's light by the edit: root mean square over its tile.
  float change(std::size_t texel) const { return change_[texel]; }
  const ReuseReport& report() const { return report_; }

 private:
  PreviousLight previous_;
  std::vector<std::uint32_t> previous_number_;
  std::vector<bool> reused_;
  std::vector<float> change_;
  ReuseReport report_;
};

}  // namespace oriel
