// The two components of the light, direct and gathered, during refinement.
#pragma once

#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/estimators/worst.h"

namespace oriel {

// The limit on gather rays of a texel, both halves together: 1024 for an error of 2 %. Noisier texels are mostly a
// handful in the dark, on which half of all rays would be spent. The limit is raised where they prevent the goal.
class MostRays {
 public:
  explicit MostRays(const RadiosityOptions& options);
  std::uint32_t of_both() const { return most_; }
  // Doubles the limit. False: it is at RadiosityOptions::samples already.
  bool raise();

 private:
  std::uint32_t most_, last_;
};

struct LightComponent {
  const std::vector<std::uint32_t>& samples;  // of each half, by texel
  std::uint32_t max_samples = 0;              // limit on them
  double gain = 0;                            // fraction of the squared error that the next refinement removes
  double rays = 0;                            // cost of refining it so far, in shadow rays
  std::vector<float> squares;                 // by texel: contribution to the frames' mean square

  // Computes the members below, over `texels`. importance: by texel, fraction of the frame pixels.
  void measure(std::span<const std::uint32_t> texels, const std::vector<float>& importance);
  double mean = 0, converged = 0;  // the mean square; the part of texels that have all their samples
  double refinable_rays = 0;       // the part of `rays` for the other texels
  double refinable() const { return mean - converged; }

  // True if rays spent here reduce the error more: error over rays, of texels that can be refined.
  bool pays_more_than(const LightComponent& other) const {
    return refinable() * other.refinable_rays > other.refinable() * refinable_rays;
  }
};

// The common goal of both components.
struct FrameGoal {
  const std::vector<float>& importance;  // by texel: fraction of the frame pixels, neighbourhood average
  double now = 0, asked = 0;             // mean squares over frames
};
// Chooses texels to refine, from the measured ones in coherent_order, by worst_texels(): enough to bring the component
// closer to its share of the goal.
std::vector<std::uint32_t> worst_of(const TexelGraph& graph, std::vector<std::uint32_t> texels,
                                    const LightComponent& component, const FrameGoal& goal, Context& context);

}  // namespace oriel
