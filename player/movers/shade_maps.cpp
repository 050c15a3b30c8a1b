#include "player/movers/shade_maps.h"

#include <algorithm>

#include "player/scene/surface.h"

namespace oriel {

Result<ShadeMaps> ShadeMaps::create(gpu::Dialect dialect) {
  ShadeMaps maps;
  ORIEL_TRY(maps.depth_, gpu::Program::create("shade_depth", dialect));
  return maps;
}

Status ShadeMaps::begin(const ShadeScene& scene, int side) {
  const auto layers = static_cast<int>(std::max<std::size_t>(scene.lights.size(), 1));
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
  maps_ = scene.maps;
  known_.assign(scene.lights.size(), {});
  int t = 0, e = 0, k = 0;
  for (auto& l : scene.lights) {
    (l.source == ScatterSource::kTexel ? t : l.source == ScatterSource::kSky ? k : e)++;
  }
  return gpu::check_gl("making shadow maps of many lights");
}

void ShadeMaps::draw(std::uint32_t light, std::span<const PlacedMover> movers, FrameStats& stats) const {
  const HemisphereMap& map = maps_[light];
  target_.attach_depth_layer(movers_, static_cast<int>(light));
  glClear(GL_DEPTH_BUFFER_BIT);
  Mat4 light_from_pack(glm::transpose(map.frame));
  light_from_pack[3] = Vec4(glm::transpose(map.frame) * -map.from, 1);
  for (const PlacedMover& placed : movers) {
    glBindVertexArray(placed.mover->vertex_array.name());
    depth_.set("u_light_from_object", light_from_pack * placed.pack_from_object);
    for (int face = 0; face < kHemisphereFaces; ++face) {
      if (!may_touch_face(map, face, placed.sphere)) continue;
      const Mat4 clip = clip_from_pack(map, face) * placed.pack_from_object;
      depth_.set("u_clip_from_object", clip);
      depth_.set("u_signs", face_signs(face));
      for (const DrawBatch& batch : visible_batches(placed.mover->ranges, make_frustum(clip))) draw_batch(batch, stats);
      ++stats.shade.faces;
    }
  }
  ++stats.shade.maps;
}

std::size_t ShadeMaps::refresh(std::span<const Wanted> wanted, std::span<const PlacedMover> movers, std::size_t most,
                               FrameStats& stats) {
  std::vector<Mat4> poses;
  for (const PlacedMover& placed : movers) poses.push_back(placed.pack_from_object);
  std::vector<std::pair<float, std::uint32_t>> late;
  for (const Wanted& w : wanted)
    if (known_[w.light].poses != poses)
      late.emplace_back(-w.brightest * static_cast<float>(++known_[w.light].late), w.light);
  std::ranges::sort(late);
  const std::size_t drawn = most == 0 ? late.size() : std::min(most, late.size());
  if (drawn == 0) return late.size();
  target_.bind();
  glViewport(0, 0, side_, side_);
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.color_write = false;
  gpu::apply(state);
  depth_.use();
  for (std::size_t i = 0; i < drawn; ++i) {
    const std::uint32_t light = late[i].second;
    draw(light, movers, stats);
    known_[light] = {poses, 0};
  }
  return late.size() - drawn;
}

}  // namespace oriel
