#include "player/survey/survey_pass.h"

#include "player/gpu/raster_state.h"
#include "player/scene/surface.h"
#include "player/survey/survey_colors.h"

namespace oriel {

Result<SurveyPass> SurveyPass::create(gpu::Dialect dialect) {
  SurveyPass pass;
  ORIEL_TRY(pass.program_, gpu::Program::create("survey", dialect));
  return pass;
}

void SurveyPass::draw(const GpuScene& scene, const View& view, std::span<const DrawBatch> shown, Show show,
                      FrameStats& stats) {
  if (painted_ != show || scene_ != scene.serial()) {
    pages_.clear();
    for (const LightmapPage& page : scene.pack().lightmaps) {
      const std::vector<std::uint8_t> colors = survey_colors(page, show);
      pages_.emplace_back(gpu::kSrgbAlpha8, static_cast<int>(page.width), static_cast<int>(page.height), colors.data());
    }
    painted_ = show;
    scene_ = scene.serial();
  }
  program_.use();
  program_.set("u_clip_from_pack", view.clip_from_pack);
  program_.set("u_base_texture", kBaseUnit);
  program_.set("u_survey", kLightmapUnit);
  scene.bind_shown();
  gpu::RasterState state;
  state.depth_test = true;
  for (const DrawBatch& batch : shown) {
    const Material& m = scene.pack().materials[batch.material];
    state.cull = cull_of(m);
    gpu::apply(state);
    program_.set("u_alpha", m.alpha);
    program_.set("u_alpha_cutoff", cutoff_of(m));
    scene.albedo(m.base_color_texture).bind(kBaseUnit);
    program_.set("u_surveyed", batch.lightmap_page >= 0 ? 1 : 0);
    if (batch.lightmap_page >= 0) pages_[static_cast<std::size_t>(batch.lightmap_page)].bind(kLightmapUnit);
    draw_batch(batch, stats);
  }
}

}  // namespace oriel
