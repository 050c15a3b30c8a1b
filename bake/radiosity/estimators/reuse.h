// Light that an edit of the scene hardly changes: it is taken from the bake before, with the error which that brings.
#pragma once

#include "bake/radiosity/estimators/direct_light.h"
#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/gather/gather.h"

namespace oriel {

// What a bake knew in the end, by texel.
struct KnownLight {
  std::vector<std::uint32_t> page, x, y, chart;  // which texel
  std::vector<Vec3> glance;                      // its direct light as the first few samples saw it, lux
  std::vector<Vec3> first_direct;                // before it was refined, lux
  std::vector<Vec3> coarse;                      // all light, before the final gather, lux
  float near = 1;                                // Surroundings::near() of its gather
  bool lamps = false;                            // whether that left light of lamps to particles
  DirectSums direct{0, false};
  HalfSums gathered{0, false};

  std::size_t count() const { return page.size(); }
};

// Where in the cache the last bake with these options of a scene with this many triangles on pages like these left it.
Hash128 name_of_known_light(const Scene& scene, const Texels& texels, const RadiosityOptions& options,
                            const PathOptions& paths, std::uint64_t seed);
// Nothing, with a warning, where the cache holds none, or one that is not whole.
std::optional<KnownLight> recall_light(Context& context, const Hash128& name, bool directional);
void remember_light(Context& context, const Hash128& name, KnownLight known);

// Which texels keep their light. A tile is a group of 64 that are gathered together. Both bakes know the light of all
// texels coarsely: from the same sites, by rays of the same random numbers (64 a texel, 4096 a tile) that find the
// light after all bounces. What differs between the two is due to the edit, and to rays that meet something else: the
// root mean square of these differences over a tile is how much its light changes, rather more than less. The tile
// keeps its light where that is below what is allowed, relative to its light (dark texels by 1 % of the mean).
class Reuse {
 public:
  // A texel is the same as before where it lies at the same place of the same page and belongs to the same chart.
  Reuse(const Texels& texels, KnownLight before);

  // The number that a texel had; kNoTexel: there was none.
  std::uint32_t before(std::size_t texel) const { return number_[texel]; }
  const KnownLight& known() const { return known_; }
  // Whether a few samples of the direct light there and beside it are what they were, to the last bit.
  std::vector<bool> same_glance(const TexelGraph& graph, std::span<const Vec3> glance) const;

  // coarse, lamps: as KnownLight's, of the scene as it is now. order: coherent_order. Nothing is kept where light of
  // lamps is not left to particles as it was: it would be lost, or count twice.
  void compare(const Texels& texels, std::span<const std::uint32_t> order, std::span<const Vec3> coarse, bool lamps,
               double error);
  bool keeps(std::size_t texel) const { return kept_[texel]; }
  // Direct light that looks the same at a glance is taken as it was before it was refined.
  void give_first(const std::vector<bool>& same_direct, std::vector<Vec3>& direct) const {
    for (std::size_t i = 0; i < direct.size(); ++i)
      if (same_direct[i]) direct[i] = known_.first_direct[number_[i]];
  }
  // Texels that are kept get what was known of them; those of `same_direct` the direct light.
  void give(const std::vector<bool>& same_direct, DirectSums& direct, HalfSums& gathered) const {
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      if (same_direct[i] || kept_[i]) direct.copy(i, known_.direct, number_[i]);
      if (kept_[i]) gathered.copy(i, known_.gathered, number_[i]);
    }
  }
  // Root mean square, over its tile, of what the edit changes in the light of a texel that is kept, relative.
  float change(std::size_t texel) const { return change_[texel]; }
  const ReuseReport& report() const { return report_; }

 private:
  KnownLight known_;
  std::vector<std::uint32_t> number_;
  std::vector<bool> kept_;
  std::vector<float> change_;
  ReuseReport report_;
};

}  // namespace oriel
