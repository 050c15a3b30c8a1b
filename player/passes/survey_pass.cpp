#include "player/passes/survey_pass.h"

#include "formats/core/color.h"
#include "player/gpu/raster_state.h"
#include "player/passes/charts.h"
#include "player/passes/survey_colors.h"
#include "player/passes/zone_mesh.h"
#include "player/scene/surface.h"

namespace oriel {

Result<SurveyPass> SurveyPass::create(gpu::Dialect dialect) {
  SurveyPass pass;
  ORIEL_TRY(pass.program_, gpu::Program::create("survey_surface", dialect));
  ORIEL_TRY(pass.zone_program_, gpu::Program::create("survey_zone", dialect));
  return pass;
}

Status SurveyPass::prepare(GpuScene& scene, Show show) {
  const Pack& pack = scene.pack();
  const bool has_pages = show != Show::kZones && show != Show::kOverdraw;
  if (painted_ != show || scene_ != scene.serial()) {
    painted_ = show;
    scene_ = scene.serial();
    pages_.clear();
    if (has_pages) pages_.resize(pack.lightmaps.size());
    if (show == Show::kZones) {
      zone_ = planned_zone(pack);
      const ZoneMesh mesh = zone_mesh(zone_);
      zone_array_ = gpu::make_vertex_array();
      glBindVertexArray(zone_array_.name());
      zone_buffers_.clear();
      gpu::add_attribute(zone_buffers_, 0, mesh.positions, {3, GL_FLOAT});
      gpu::add_attribute(zone_buffers_, 1, mesh.colors, {4, GL_UNSIGNED_BYTE, true});
      zone_corners_ = static_cast<GLsizei>(mesh.positions.size());
    }
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

void SurveyPass::draw_zone(const View& view, FrameStats& stats) {
  if (zone_corners_ == 0) return;
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.cull = gpu::Cull::kBack;
  gpu::apply(state);
  zone_program_.use();
  zone_program_.set("u_clip_from_pack", view.clip_from_pack);
  glBindVertexArray(zone_array_.name());
  glDrawArrays(GL_TRIANGLES, 0, zone_corners_);
  ++stats.draws;
  stats.triangles += static_cast<std::uint64_t>(zone_corners_ / 3);
}

Status SurveyPass::draw(const FrameContext& context, std::span<const DrawBatch> shown) {
  const auto& [scene, view, options, stats] = context;
  const Show show = options.show;
  ORIEL_TRY_VOID(prepare(scene, show));
  program_.use();
  program_.set("u_clip_from_pack", view.clip_from_pack);
  program_.set("u_survey", kLightmapUnit);
  program_.set("u_mode", show == Show::kOverdraw ? 1 : show == Show::kZones ? 2 : 0);
  program_.set("u_added", kOverdrawStep);
  program_.set("u_eye", view.eye);
  program_.set("u_tint", linear_from_srgb(kZoneColor));
  const Zone::Box no_box{Vec3(1), Vec3(-1)};
  program_.set("u_box_lower", zone_.box.value_or(no_box).lower);
  program_.set("u_box_upper", zone_.box.value_or(no_box).upper);
  scene.bind_shown();
  gpu::RasterState state;
  state.depth_test = show != Show::kOverdraw;
  if (show == Show::kOverdraw) state.blend = gpu::Blend::kAdd;
  for (const DrawBatch& batch : shown) {
    const Material& m = scene.pack().materials[batch.material];
    state.cull = cull_of(m);
    gpu::apply(state);
    set_cutout(program_, scene, m);
    const bool surveyed =
        batch.lightmap_page >= 0 && !pages_.empty() && pages_[static_cast<std::size_t>(batch.lightmap_page)];
    program_.set("u_surveyed", surveyed ? 1 : 0);
    if (surveyed) pages_[static_cast<std::size_t>(batch.lightmap_page)].bind(kLightmapUnit);
    draw_batch(batch, stats);
  }
  if (show == Show::kZones) draw_zone(view, stats);
  return {};
}

}  // namespace oriel
