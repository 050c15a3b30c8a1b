#include "player/movers/shade_draw.h"

#include <algorithm>

#include "player/scene/surface.h"

namespace oriel {
namespace {

constexpr int kRow = 1024;       // numbers, or nodes, in a row of a texture
constexpr int kLightTexels = 4;  // a row, as shaders/lib/shade.glsl has it
constexpr float kFar = 1e30f;    // metres: as good as without end
enum { kMaskUnit = 1, kLightsUnit = 8, kListUnit = 9, kTreeUnit = 10 };

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
  ORIEL_TRY(out.program_, gpu::Program::create("screen_shade_light", dialect));
  out.no_vertices_ = gpu::make_vertex_array();
  return out;
}

Status ShadeDraw::set_scene(const ShadeScene& scene) {
  std::vector<Vec4> nodes;
  for (const ShadeCell& cell : scene.cells) nodes.push_back(node_of(scene.cells, cell));
  cell_count_ = scene.cells.size();
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

// Of each cell where its lights begin and how many there are, then all of these.
Status ShadeDraw::set_lists(std::span<const CellLights> lists) {
  std::vector<std::uint32_t> list(2 * cell_count_, 0);
  for (const CellLights& one : lists) {
    list[2 * one.cell] = static_cast<std::uint32_t>(list.size());
    list[2 * one.cell + 1] = static_cast<std::uint32_t>(one.lights.size());
    list.insert(list.end(), one.lights.begin(), one.lights.end());
  }
  const int rows = std::max(static_cast<int>((list.size() + kRow - 1) / kRow), 1);
  list.resize(static_cast<std::size_t>(rows) * kRow, 0);
  if (list_ && list_.height() >= rows)
    list_.upload(0, 0, rows, list.data());
  else
    list_ = gpu::Texture2d(gpu::kR32ui, kRow, rows, list.data());
  return gpu::check_gl("uploading which lights movers may block");
}

void ShadeDraw::bind(const gpu::Program& program, const gpu::Texture2d& list, const ShadeMaps& maps,
                     const LitPixels& pixels) const {
  program.use();
  program.set("u_surfaces", kSurfaceUnit);
  program.set("u_mask", kMaskUnit);
  program.set("u_masked", pixels.mask != nullptr ? 1 : 0);
  program.set("u_lights", kLightsUnit);
  program.set("u_list", kListUnit);
  program.set("u_mover_depth", kShadowUnit);
  program.set("u_still_depth", kStaticUnit);
  program.set("u_movers", std::span<const Vec4>(movers_));
  pixels.surfaces.bind(kSurfaceUnit);
  if (pixels.mask != nullptr) pixels.mask->bind(kMaskUnit);
  lights_.bind(kLightsUnit), list.bind(kListUnit);
  maps.movers().bind(kShadowUnit), maps.still().bind(kStaticUnit);
}

void ShadeDraw::draw(const ShadeMaps& maps, const LitPixels& pixels, FrameStats& stats) const {
  gpu::RasterState state;
  state.blend = gpu::Blend::kAdd;
  gpu::apply(state);
  glBindVertexArray(no_vertices_.name());
  bind(program_, list_, maps, pixels);
  program_.set("u_tree", kTreeUnit);
  tree_.bind(kTreeUnit);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ++stats.draws;
}

}  // namespace oriel
