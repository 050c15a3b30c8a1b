#include "player/movers/shadow_maps.h"

#include <algorithm>

#include "player/movers/shadow_shaft.h"
#include "player/scene/surface.h"

namespace oriel {
namespace {

constexpr int kMapSize = 256;  // texels of a layer, which its points share, as in passes/mover_shadow.frag
constexpr int kLayers = 128;   // kept: at least those of one light

gpu::TextureArray make_maps(GLenum filter) {
  gpu::TextureOptions options;
  options.min_filter = options.mag_filter = filter;
  options.compare = true;
  return {gpu::kDepth32f, kMapSize, kMapSize, kLayers, options};
}

}  // namespace

static_assert(kLayers >= kMaxShadowMovers * kMaxLightPoints / kPointsOfLayer);

Result<ShadowMaps> ShadowMaps::create(gpu::Dialect dialect) {
  ShadowMaps maps;
  ORIEL_TRY(maps.depth_, gpu::Program::create("depth", dialect));
  ORIEL_TRY(maps.plain_depth_, gpu::Program::create("depth", dialect, "PLAIN"));
  return maps;
}

Status ShadowMaps::ensure_layers() {
  if (mover_depth_) return {};
  mover_depth_ = make_maps(GL_LINEAR);
  scene_depth_ = make_maps(GL_NEAREST);  // edges that show on movers alone: half the price
  target_ = gpu::Framebuffer::create_for_layers();
  return gpu::check_gl("making shadow maps");
}

// One that no map holds, or that of the map that was asked for longest ago.
int ShadowMaps::free_layer() {
  if (free_.empty()) {
    const auto oldest = std::min_element(known_.begin(), known_.end(),
                                         [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
    free_.push_back(oldest->second.layer);
    known_.erase(oldest);
  }
  const int layer = free_.back();
  free_.pop_back();
  return layer;
}

void ShadowMaps::draw_ranges(const GpuScene& scene, const std::vector<DrawRange>& ranges, const Mat4& clip_from_pack,
                             FrameStats& stats) const {
  for (const gpu::Program* program : {&depth_, &plain_depth_}) {
    program->use();
    program->set("u_clip_from_pack", clip_from_pack);
  }
  for (const DrawBatch& batch : visible_batches(ranges, make_frustum(clip_from_pack))) {
    const Material& m = scene.pack().materials[batch.material];
    const bool plain = cutoff_of(m) < 0;
    (plain ? plain_depth_ : depth_).use();
    if (!plain) set_cutout(depth_, scene, m);
    draw_batch(batch, stats);
  }
}

void ShadowMaps::draw(const GpuScene& scene, const Request& request, int layer, bool of_scene, FrameStats& stats) {
  const PlacedMover& placed = *request.mover;
  target_.bind();
  target_.attach_depth_layer(of_scene ? scene_depth_ : mover_depth_, layer);
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.color_write = false;
  gpu::apply(state);
  glClear(GL_DEPTH_BUFFER_BIT);
  if (of_scene)
    scene.bind_geometry();
  else
    glBindVertexArray(placed.mover->vertex_array.name());
  const int side = request.points.size() > 1 ? 2 : 1, tile = kMapSize / side;
  for (std::size_t i = 0; i < request.points.size(); ++i) {
    const Shaft shaft = make_shaft(request.points[i], placed.sphere);
    glViewport(tile * (static_cast<int>(i) % side), tile * (static_cast<int>(i) / side), tile, tile);
    if (of_scene)
      draw_ranges(scene, scene.opaque(), clip_from_pack(shaft, scene_range(shaft, 2 * scene.bounds().radius())), stats);
    else
      draw_ranges(scene, placed.mover->ranges,
                  clip_from_pack(shaft, mover_range(shaft, placed.sphere.w)) * placed.pack_from_object, stats);
  }
}

Result<std::vector<int>> ShadowMaps::layers(const GpuScene& scene, std::span<const Request> requests,
                                            FrameStats& stats) {
  ORIEL_TRY_VOID(ensure_layers());
  ++calls_;
  if (scene.serial() != scene_serial_) {
    scene_serial_ = scene.serial();
    known_.clear();
    free_.clear();
    for (int layer = kLayers; layer-- > 0;) free_.push_back(layer);
  }
  for (const Request& r : requests)
    if (const auto known = known_.find({r.light, r.index, r.group}); known != known_.end()) known->second.used = calls_;
  std::vector<int> out;
  for (const Request& r : requests) {
    const Key key{r.light, r.index, r.group};
    const bool is_new = !known_.contains(key);
    const int layer = is_new ? free_layer() : known_[key].layer;
    Known& known = known_[key];
    const bool points =
        !is_new && std::equal(known.points.begin(), known.points.end(), r.points.begin(), r.points.end());
    const bool still = points && known.sphere == r.mover->sphere;
    if (!still) draw(scene, r, layer, true, stats);
    if (!still || known.pose != r.mover->pack_from_object) draw(scene, r, layer, false, stats);
    known = {layer, r.mover->pack_from_object, r.mover->sphere, {r.points.begin(), r.points.end()}, calls_};
    out.push_back(layer);
  }
  return out;
}

}  // namespace oriel
