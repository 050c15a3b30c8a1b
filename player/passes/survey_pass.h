// Draws surfaces in the colours of survey_colors, charts.
#pragma once

#include "player/gpu/program.h"
#include "player/scene/frame_context.h"

namespace oriel {

class SurveyPass {
 public:
  static Result<SurveyPass> create(gpu::Dialect dialect);

  // Opaque surfaces, what of them is shown, over their depth, in the colours that the options show; those without a
  // lightmap are grey, and those whose page has not come yet. Colours are kept until others or another scene are asked
  // for. Errors of pages.
  Status draw(const FrameContext& context, std::span<const DrawBatch> shown);

 private:
  // What is kept of a scene for a `show`.
  Status prepare(GpuScene& scene, Show show);

  gpu::Program program_;
  std::vector<gpu::Texture2d> pages_;
  Show painted_ = Show::kAll;
  std::uint64_t scene_ = 0;  // whose pages they are
};

}  // namespace oriel
