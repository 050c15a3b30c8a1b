// Draws surfaces in the colours of survey_colors.
#pragma once

#include "player/gpu/program.h"
#include "player/scene/frame_options.h"
#include "player/scene/gpu_scene.h"
#include "player/view/view.h"

namespace oriel {

class SurveyPass {
 public:
  static Result<SurveyPass> create(gpu::Dialect dialect);

  // Opaque surfaces, what of them is shown, over their depth, in the colours of `show`; those without a lightmap are
  // grey, and those whose page has not come yet. Colours are kept until another `show` or scene is asked for. Errors of
  // pages.
  Status draw(GpuScene& scene, const View& view, std::span<const DrawBatch> shown, Show show, FrameStats& stats);

 private:
  Status paint(GpuScene& scene, Show show);
  gpu::Program program_;
  std::vector<gpu::Texture> pages_;
  Show painted_ = Show::kAll;
  std::uint64_t scene_ = 0;  // whose pages they are
};

}  // namespace oriel
