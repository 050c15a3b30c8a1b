// The two parts of the light, direct and gathered, as refinement sees them.
#pragma once

#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/estimators/worst.h"

namespace oriel {

// Gathered rays that a texel may take, of both halves. 1024 at 2 %: what is noisier than that is most often a handful
// of texels in the dark, on which half of all rays would go. Where the goal is missed by such texels it is raised.
class MostRays {
 public:
  explicit MostRays(const RadiosityOptions& options);
  std::uint32_t of_both() const { return most_; }
  // False: it is RadiosityOptions::samples already.
  bool raise();

 private:
  std::uint32_t most_, last_;
};

struct Part {
  const std::vector<std::uint32_t>& samples;  // by texel, of each half
  std::uint32_t most = 0;                     // of them
  double gain = 0;                            // part of its squared error that the next refinement takes away
  double rays = 0;                            // spent on refining it so far; as many shadow rays take its time
  std::vector<float> squares;                 // by texel: its part of the frames' mean square

  // Over the pixels that show `texels`. shares: by texel, of frames that it fills.
  void measure(std::span<const std::uint32_t> texels, const std::vector<float>& importance);
  double mean = 0, stuck = 0;  // the mean square, and of it what has all its samples and stays
  double open_rays = 0;        // of `rays` those of the rest
  double open() const { return mean - stuck; }

  // Where errors fall with the rays spent on them, those do most that are spent where this is larger.
  bool pays_more_than(const Part& other) const { return open() * other.open_rays > other.open() * open_rays; }
};

// What both parts are to reach together.
struct FrameGoal {
  const std::vector<float>& importance;  // by texel, of frames that it fills, as its surroundings tell
  double now = 0, asked = 0;                  // mean squares over frames
};
// Those of the measured texels (in coherent_order) whose refinement brings the part nearer to its share of the goal, as
// worst_texels.
std::vector<std::uint32_t> worst_of(const TexelGraph& graph, std::vector<std::uint32_t> texels, const Part& part,
                                    const FrameGoal& goal, Context& context);

}  // namespace oriel
