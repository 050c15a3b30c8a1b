#include "study/barczak2006/cell_boxes.h"

#include <algorithm>

#include "player/scene/surface.h"

namespace oriel::study {
namespace {

constexpr int kRow = 1024;     // numbers in a row of the list
constexpr float kFar = 1e30f;  // metres: as good as without end
constexpr int kCellsUnit = 10;

// Where a pixel of a picture of fewer is the middle of the pixel that it stands for: scale and offset, in the whole
// view's coordinates from -1 to 1.
Vec4 place_in_view(const View& view, const gpu::Texture2d& picture) {
  const Vec2 whole(view.width, view.height), few(picture.width(), picture.height());
  if (whole == few) return {1, 1, 0, 0};
  constexpr auto kStep = static_cast<float>(FewPixels::kStep);
  const Vec2 scale = whole / (kStep * few);
  const float off = static_cast<float>(FewPixels::kStep / 2) + 0.5f - 0.5f * kStep;
  return {scale, scale - 2 * off / (kStep * few) - 1.0f};
}

}  // namespace

Result<CellBoxes> CellBoxes::create(gpu::Dialect dialect) {
  CellBoxes out;
  ORIEL_TRY(out.program_, gpu::Program::create("barczak2006_boxes", dialect));
  out.no_vertices_ = gpu::make_vertex_array();
  return out;
}

// By row: the cell's lower and upper corner, its content's.
Status CellBoxes::set_scene(const ShadeScene& scene) {
  std::vector<Vec4> corners;
  Bounds all;
  for (const ShadeCell& cell : scene.cells) {
    for (const Vec3& corner : {cell.cell.lower, cell.cell.upper})
      corners.emplace_back(glm::clamp(corner, Vec3(-kFar), Vec3(kFar)), 0);
    for (const Vec3& corner : {cell.content.lower, cell.content.upper}) corners.emplace_back(corner, 0);
    if (!cell.content.empty()) all.extend(cell.content);
  }
  for (const Vec3& corner : {Vec3(-kFar), Vec3(kFar), all.lower, all.upper}) corners.emplace_back(corner, 0);
  cells_ = gpu::Texture2d(gpu::kRgba32f, 4, static_cast<int>(corners.size() / 4), corners.data());
  return gpu::check_gl("uploading cells of space");
}

// The list holds each element's cells, then its lights.
Status CellBoxes::set_passes(std::vector<LightPass> passes, std::size_t lights_a_pass) {
  passes_ = std::move(passes);
  lights_a_pass_ = std::max<std::size_t>(lights_a_pass, 1);
  std::vector<std::uint32_t> list;
  for (const LightPass& pass : passes_) {
    list.insert(list.end(), pass.cells.begin(), pass.cells.end());
    list.insert(list.end(), pass.lights.begin(), pass.lights.end());
  }
  const int rows = std::max(static_cast<int>((list.size() + kRow - 1) / kRow), 1);
  list.resize(static_cast<std::size_t>(rows) * kRow, 0);
  list_ = gpu::Texture2d(gpu::kR32ui, kRow, rows, list.data());
  return gpu::check_gl("uploading passes of lights");
}

void CellBoxes::draw(const View& view, const ShadeDraw& lights, const ShadeMaps& maps, const LitPixels& pixels,
                     FrameStats& stats) const {
  gpu::RasterState state;
  state.blend = gpu::Blend::kAdd;
  state.cull = gpu::Cull::kFront;  // one layer of pixels, from within too
  gpu::apply(state);
  glBindVertexArray(no_vertices_.name());
  lights.bind(program_, list_, maps, pixels);
  program_.set("u_clip_from_pack", view.clip_from_pack);
  program_.set("u_view", place_in_view(view, pixels.surfaces));
  program_.set("u_cells", kCellsUnit);
  cells_.bind(kCellsUnit);
  std::size_t at = 0;
  for (const LightPass& pass : passes_) {
    program_.set("u_first_cell", static_cast<int>(at));
    at += pass.cells.size();
    for (std::size_t first = 0; first < pass.lights.size(); first += lights_a_pass_) {
      program_.set("u_first_light", static_cast<int>(at + first));
      program_.set("u_light_count", static_cast<int>(std::min(lights_a_pass_, pass.lights.size() - first)));
      glDrawArraysInstanced(GL_TRIANGLES, 0, 36, static_cast<GLsizei>(pass.cells.size()));
      ++stats.draws;
    }
    at += pass.lights.size();
  }
}

}  // namespace oriel::study
