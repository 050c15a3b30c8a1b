#include "player/movers/shade_draw.h"

#include <algorithm>

#include "player/scene/surface.h"

namespace oriel {
namespace {

constexpr int kRow = 1024;                        // numbers, or nodes, in a row of a texture
constexpr int kLightTexels = 4, kCellTexels = 4;  // a row, as shaders/lib/shade.glsl and shade_light.vert have it
constexpr float kFar = 1e30f;                     // metres: as good as without end
enum { kMaskUnit = 1, kLightsUnit = 8, kListUnit = 9, kCellsUnit = 10 };

// The last row is filled up.
gpu::Texture2d float_texture(int width, std::vector<Vec4> texels) {
  const auto columns = static_cast<std::size_t>(width);
  texels.resize((std::max<std::size_t>(texels.size(), 1) + columns - 1) / columns * columns, Vec4(0));
  return {gpu::kRgba32f, width, static_cast<int>(texels.size() / columns), texels.data()};
}

// Where a cell's two halves part: axis, place, the first of them. Of a leaf the axis is -1.
Vec4 node_of(std::span<const ShadeCell> cells, const ShadeCell& cell) {
  if (cell.child == 0) return {-1, 0, 0, 0};
  const ShadeCell &low = cells[cell.child], &high = cells[cell.child + 1];
  int axis = 0;
  while (axis < 2 && low.cell.upper[axis] != high.cell.lower[axis]) ++axis;
  return {axis, high.cell.lower[axis], cell.child, 0};
}

}  // namespace

Result<ShadeDraw> ShadeDraw::create(gpu::Dialect dialect) {
  ShadeDraw out;
  ORIEL_TRY(out.boxes_, gpu::Program::create("shade_light", dialect));
  ORIEL_TRY(out.pixels_, gpu::Program::create("screen_shade_light", dialect));
  out.no_vertices_ = gpu::make_vertex_array();
  return out;
}

// One row more than cells: all of space.
Status ShadeDraw::set_scene(const ShadeScene& scene) {
  std::vector<Vec4> corners, nodes;
  Bounds all;
  for (const ShadeCell& cell : scene.cells) {
    for (const Vec3& corner : {cell.cell.lower, cell.cell.upper})
      corners.emplace_back(glm::clamp(corner, Vec3(-kFar), Vec3(kFar)), 0);
    for (const Vec3& corner : {cell.content.lower, cell.content.upper}) corners.emplace_back(corner, 0);
    if (!cell.content.empty()) all.extend(cell.content);
    nodes.push_back(node_of(scene.cells, cell));
  }
  for (const Vec3& corner : {Vec3(-kFar), Vec3(kFar), all.lower, all.upper}) corners.emplace_back(corner, 0);
  cell_count_ = scene.cells.size();
  cells_ = float_texture(kCellTexels, std::move(corners));
  tree_ = float_texture(kRow, std::move(nodes));
  return gpu::check_gl("uploading cells for the shade of movers");
}

Status ShadeDraw::set_lights(const ShadeScene& scene, std::span<const Vec3> intensities) {
  std::vector<Vec4> texels;
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const HemisphereMap& map = scene.maps[l];
    const bool sky = scene.lights[l].source == ScatterSource::kSky;
    const float disk = std::max(scene.lights[l].light.disk, 1e-30f);
    texels.emplace_back(map.from, sky ? -disk : disk);
    texels.emplace_back(intensities[l], map.squeeze);
    texels.emplace_back(map.frame[0], map.nearest);
    texels.emplace_back(map.frame[2], map.farthest);
  }
  lights_ = float_texture(kLightTexels, std::move(texels));
  return gpu::check_gl("uploading lights for the shade of movers");
}

void ShadeDraw::set_movers(std::span<const Vec4> spheres) {
  movers_.fill(Vec4(kFar, kFar, kFar, 0));
  std::copy_n(spheres.begin(), std::min(spheres.size(), movers_.size()), movers_.begin());
}

void ShadeDraw::upload_list(std::vector<std::uint32_t> list) {
  const int rows = std::max(static_cast<int>((list.size() + kRow - 1) / kRow), 1);
  list.resize(static_cast<std::size_t>(rows) * kRow, 0);
  if (list_ && list_.height() >= rows)
    list_.upload(0, 0, rows, list.data());
  else
    list_ = gpu::Texture2d(gpu::kR32ui, kRow, rows, list.data());
}

// Of passes: each one's cells, then its lights. By pixel: of each cell where its lights begin and how many there are,
// then all of these.
Status ShadeDraw::set_passes(std::vector<LightPass> passes, bool by_pixel, std::uint32_t lights_a_pass) {
  passes_ = std::move(passes);
  by_pixel_ = by_pixel;
  lights_a_pass_ = std::max(lights_a_pass, 1u);
  std::vector<std::uint32_t> list(by_pixel ? 2 * cell_count_ : 0, 0);
  for (const LightPass& pass : passes_) {
    if (by_pixel) {
      list[2 * pass.cells.front()] = static_cast<std::uint32_t>(list.size());
      list[2 * pass.cells.front() + 1] = static_cast<std::uint32_t>(pass.lights.size());
    } else {
      list.insert(list.end(), pass.cells.begin(), pass.cells.end());
    }
    list.insert(list.end(), pass.lights.begin(), pass.lights.end());
  }
  upload_list(std::move(list));
  return gpu::check_gl("uploading which lights movers may block");
}

void ShadeDraw::bind(const gpu::Program& program, const ShadeMaps& maps, const Seen& seen) const {
  program.use();
  program.set("u_surfaces", kSurfaceUnit);
  program.set("u_mask", kMaskUnit);
  program.set("u_masked", seen.mask != nullptr ? 1 : 0);
  program.set("u_lights", kLightsUnit);
  program.set("u_list", kListUnit);
  program.set("u_mover_depth", kShadowUnit);
  program.set("u_still_depth", kStaticUnit);
  program.set("u_movers", std::span<const Vec4>(movers_));
  seen.surfaces.bind(kSurfaceUnit);
  if (seen.mask != nullptr) seen.mask->bind(kMaskUnit);
  lights_.bind(kLightsUnit), list_.bind(kListUnit);
  maps.movers().bind(kShadowUnit), maps.still().bind(kStaticUnit);
}

void ShadeDraw::draw(const View& view, const ShadeMaps& maps, const Seen& seen, FrameStats& stats) const {
  gpu::RasterState state;
  state.blend = gpu::Blend::kAdd;
  state.cull = by_pixel_ ? gpu::Cull::kNone : gpu::Cull::kFront;  // of boxes one layer of pixels, from within too
  gpu::apply(state);
  glBindVertexArray(no_vertices_.name());
  if (by_pixel_) {
    bind(pixels_, maps, seen);
    pixels_.set("u_tree", kCellsUnit);
    tree_.bind(kCellsUnit);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    ++stats.draws;
    return;
  }
  bind(boxes_, maps, seen);
  boxes_.set("u_clip_from_pack", view.clip_from_pack);
  boxes_.set("u_view", seen.view);
  boxes_.set("u_cells", kCellsUnit);
  cells_.bind(kCellsUnit);
  int at = 0;
  for (const LightPass& pass : passes_) {
    const int cells = static_cast<int>(pass.cells.size()), lights = static_cast<int>(pass.lights.size());
    const int each = static_cast<int>(lights_a_pass_);
    boxes_.set("u_first_cell", at);
    for (int first = 0; first < lights; first += each) {
      boxes_.set("u_first_light", at + cells + first);
      boxes_.set("u_light_count", std::min(each, lights - first));
      glDrawArraysInstanced(GL_TRIANGLES, 0, 36, cells);
      ++stats.draws;
    }
    at += cells + lights;
  }
}

}  // namespace oriel
