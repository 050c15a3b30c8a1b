#include "player/passes/survey_pass.h"

#include "player/gpu/raster_state.h"
#include "player/passes/charts.h"
#include "player/passes/survey_colors.h"
#include "player/scene/surface.h"

namespace oriel {

Result<SurveyPass> SurveyPass::create(gpu::Dialect dialect) {
  SurveyPass pass;
  ORIEL_TRY(pass.program_, gpu::Program::create("survey_surface", dialect));
  return pass;
}

Status SurveyPass::prepare(GpuScene& scene, Show show) {
  const Pack& pack = scene.pack();
  if (painted_ != show || scene_ != scene.serial()) {
    painted_ = show;
    scene_ = scene.serial();
    pages_.clear();
    pages_.resize(pack.lightmaps.size());
    const auto charts = show == Show::kCharts ? chart_colors(pack) : std::vector<std::vector<std::uint8_t>>();
    for (std::size_t i = 0; i < charts.size(); ++i)  // of coordinates alone
      pages_[i] = {gpu::kSrgbAlpha8, static_cast<int>(pack.lightmaps[i].width),
                   static_cast<int>(pack.lightmaps[i].height), charts[i].data()};
  }
  for (std::size_t i = 0; i < pages_.size(); ++i) {
    if (pages_[i]) continue;
    ORIEL_TRY(const LightmapPage* const page, scene.page(static_cast<std::uint32_t>(i)));
    if (page == nullptr) continue;
    const std::vector<std::uint8_t> colors = survey_colors(*page, show);
    pages_[i] = {gpu::kSrgbAlpha8, static_cast<int>(page->width), static_cast<int>(page->height), colors.data()};
    if (scene.images().in_background()) return {};  // one a frame: it takes some milliseconds
  }
  return {};
}

Status SurveyPass::draw(const FrameContext& context, std::span<const DrawBatch> shown) {
  const auto& [scene, view, options, stats] = context;
  const Show show = options.show;
  ORIEL_TRY_VOID(prepare(scene, show));
  program_.use();
  program_.set("u_clip_from_pack", view.clip_from_pack);
  program_.set("u_survey", kLightmapUnit);
  scene.bind_shown();
  gpu::RasterState state;
  state.depth_test = true;
  for (const DrawBatch& batch : shown) {
    const Material& m = scene.pack().materials[batch.material];
    state.cull = cull_of(m);
    gpu::apply(state);
    set_cutout(program_, scene, m);
    const bool surveyed = batch.lightmap_page >= 0 && pages_[static_cast<std::size_t>(batch.lightmap_page)];
    program_.set("u_surveyed", surveyed ? 1 : 0);
    if (surveyed) pages_[static_cast<std::size_t>(batch.lightmap_page)].bind(kLightmapUnit);
    draw_batch(batch, stats);
  }
  return {};
}

}  // namespace oriel
