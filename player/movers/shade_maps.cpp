#include "player/movers/shade_maps.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "player/scene/surface.h"

namespace oriel {
namespace {

constexpr int kLeastSide = 16;
constexpr std::size_t kMostMapTexels = std::size_t{1} << 26;  // of 4 bytes, in all maps of movers
constexpr std::size_t kEnough = 3000;  // triangles of a mover: one with more is drawn with about so many,
constexpr float kMostError = 0.02f;    // off by so much of its size,
constexpr float kWorthIt = 0.7f;       // where that is at most so much of its triangles

// A mover as maps of many lights draw it: these are coarser than what is left out. Nothing where it has few triangles
// anyhow, or where there is no doing with fewer.
std::optional<GpuMover> make_shade_shape(const Mover& mover) {
  const Mesh& mesh = mover.mesh;
  const std::size_t triangles = mesh.indices.size() / 3;
  if (triangles <= kEnough || mesh.positions.empty()) return std::nullopt;
  Mover fewer;
  fewer.mesh = mesh;
  fewer.mesh.indices.clear();
  for (MeshPart& part : fewer.mesh.parts) {
    const std::uint32_t* first = mesh.indices.data() + part.first_index;
    std::vector<std::uint32_t> left(part.index_count);
    left.resize(meshopt_simplify(left.data(), first, part.index_count, &mesh.positions[0].x, mesh.positions.size(),
                                 sizeof(Vec3), part.index_count / 3 * kEnough / triangles * 3, kMostError));
    part.first_index = static_cast<std::uint32_t>(fewer.mesh.indices.size());
    part.index_count = static_cast<std::uint32_t>(left.size());
    fewer.mesh.indices.insert(fewer.mesh.indices.end(), left.begin(), left.end());
  }
  if (static_cast<float>(fewer.mesh.indices.size()) > kWorthIt * static_cast<float>(mesh.indices.size()))
    return std::nullopt;
  fewer.transfer.cluster.assign(mesh.positions.size(), 0);
  return upload_mover(fewer);
}

}  // namespace

Result<ShadeMaps> ShadeMaps::create(gpu::Dialect dialect) {
  ShadeMaps maps;
  ORIEL_TRY(maps.depth_, gpu::Program::create("shade_depth", dialect));
  ORIEL_TRY(maps.plain_depth_, gpu::Program::create("shade_depth", dialect, "PLAIN"));
  return maps;
}

Status ShadeMaps::begin(const ShadeScene& scene, std::span<const Mover> movers, int side) {
  const auto layers = static_cast<int>(std::max<std::size_t>(scene.lights.size(), 1));
  wanted_side_ = side;
  while (side > kLeastSide && std::size_t(side) * std::size_t(side) * std::size_t(layers) > kMostMapTexels) side /= 2;
  gpu::TextureOptions options;
  options.min_filter = options.mag_filter = GL_LINEAR;
  options.compare = true;
  side_ = side;
  movers_ = gpu::TextureArray(gpu::kDepth32f, side, side, layers, options);
  still_ = gpu::TextureArray(gpu::kDepth32f, kStillSide, kStillSide, layers, options);
  for (int layer = 0; layer < static_cast<int>(scene.lights.size()); ++layer)
    still_.upload(0, layer, 0, {kStillSide, kStillSide},
                  &scene.still[static_cast<std::size_t>(layer) * kStillSide * kStillSide]);
  if (!target_) target_ = gpu::Framebuffer::create_for_layers();
  // Until a map is drawn it holds nothing.
  target_.bind();
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  gpu::apply(state);
  for (int layer = 0; layer < layers; ++layer) {
    target_.attach_depth_layer(movers_, layer);
    glClear(GL_DEPTH_BUFFER_BIT);
  }
  if (shapes_.size() != movers.size()) {
    shapes_.clear();
    for (const Mover& mover : movers) shapes_.push_back(make_shade_shape(mover));
  }
  maps_ = scene.maps;
  known_.assign(scene.lights.size(), {});
  return gpu::check_gl("making shadow maps of many lights");
}

void ShadeMaps::draw_face(const GpuScene& scene, const GpuMover& shape, const Face& face, FrameStats& stats) const {
  for (const DrawBatch& batch : visible_batches(shape.ranges, make_frustum(face.clip_from_object))) {
    const Material& m = scene.pack().materials[batch.material];
    const bool plain = cutoff_of(m) < 0;
    const gpu::Program& program = plain ? plain_depth_ : depth_;
    program.use();
    program.set("u_clip_from_object", face.clip_from_object);
    program.set("u_light_from_object", face.light_from_object);
    program.set("u_signs", face.signs);
    if (!plain) set_cutout(program, scene, m);
    draw_batch(batch, stats);
  }
  ++stats.shade.faces;
}

void ShadeMaps::draw(const GpuScene& scene, std::uint32_t light, std::span<const PlacedMover> movers,
                     FrameStats& stats) const {
  const HemisphereMap& map = maps_[light];
  target_.attach_depth_layer(movers_, static_cast<int>(light));
  glClear(GL_DEPTH_BUFFER_BIT);
  Mat4 light_from_pack(glm::transpose(map.frame));
  light_from_pack[3] = Vec4(glm::transpose(map.frame) * -map.from, 1);
  for (std::size_t m = 0; m < movers.size(); ++m) {
    const PlacedMover& placed = movers[m];
    const GpuMover& shape = m < shapes_.size() && shapes_[m] ? *shapes_[m] : *placed.mover;
    glBindVertexArray(shape.vertex_array.name());
    for (int face = 0; face < kHemisphereFaces; ++face)
      if (may_touch_face(map, face, placed.sphere))
        draw_face(scene, shape,
                  {clip_from_pack(map, face) * placed.pack_from_object, light_from_pack * placed.pack_from_object,
                   face_signs(face)},
                  stats);
  }
  ++stats.shade.maps;
}

std::size_t ShadeMaps::refresh(const FrameContext& context, std::span<const CellLights> wanted,
                               std::span<const Vec3> intensities, std::span<const PlacedMover> movers) {
  std::vector<Mat4> poses;
  for (const PlacedMover& placed : movers) poses.push_back(placed.pack_from_object);
  std::vector<std::pair<float, std::uint32_t>> late;
  std::vector<std::uint8_t> is_wanted(known_.size(), 0);
  for (const CellLights& one : wanted)
    for (const std::uint32_t l : one.lights) is_wanted[l] = 1;
  for (std::uint32_t l = 0; l < known_.size(); ++l)
    if (is_wanted[l] != 0 && known_[l].poses != poses)
      late.emplace_back(-max_component(intensities[l]) * static_cast<float>(++known_[l].late), l);
  std::ranges::sort(late);
  const std::size_t most = context.options.shade.maps_a_frame;
  const std::size_t drawn = most == 0 ? late.size() : std::min(most, late.size());
  if (drawn == 0) return late.size();
  target_.bind();
  glViewport(0, 0, side_, side_);
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.color_write = false;
  gpu::apply(state);
  for (std::size_t i = 0; i < drawn; ++i) {
    const std::uint32_t light = late[i].second;
    draw(context.scene, light, movers, context.stats);
    known_[light] = {poses, 0};
  }
  return late.size() - drawn;
}

}  // namespace oriel
