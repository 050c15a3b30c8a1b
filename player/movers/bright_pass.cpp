#include "player/movers/bright_pass.h"

#include "player/movers/shadow_shaft.h"
#include "player/scene/surface.h"

namespace oriel {
namespace {

constexpr int kMapSize = 512;                // texels of a layer, as in passes/mover/bright_light.frag
constexpr int kNoShadows = -2, kScene = -1;  // u_receiver

Vec3 inverse_half(const Bounds& box) {
  const Vec3 half = 0.5f * (box.upper - box.lower);
  return {half.x > 0 ? 1 / half.x : 0, half.y > 0 ? 1 / half.y : 0, half.z > 0 ? 1 / half.z : 0};
}

const LinearShare* share_of(const PlacedMover& placed, std::uint32_t light) {
  for (const LinearShare& share : placed.light.bright)
    if (share.light == light) return &share;
  return nullptr;
}

// A layer's maps, one for each point, lie side by side.
int tiles_aside(const LightSamples& light) {
  return light.at.size() > 4 ? 4 : light.at.size() > 1 ? 2 : 1;
}

gpu::TextureArray make_maps(int layers) {
  gpu::TextureOptions options;
  options.min_filter = options.mag_filter = GL_LINEAR;
  options.compare = true;
  return {gpu::kDepth32f, kMapSize, kMapSize, layers, options};
}

}  // namespace

Result<BrightPass> BrightPass::create(gpu::Dialect dialect) {
  BrightPass pass;
  ORIEL_TRY(pass.depth_, gpu::Program::create("depth", dialect));
  ORIEL_TRY(pass.light_, gpu::Program::create("mover/bright_light", dialect));
  return pass;
}

Status BrightPass::ensure_targets(int width, int height, const gpu::Texture& depth, int layers) {
  if (!framebuffer_ || change_.width() != width || change_.height() != height || depth_of_frame_ != depth.name()) {
    change_ = gpu::Texture(gpu::kRgba32f, width, height, nullptr);
    depth_of_frame_ = depth.name();
    ORIEL_TRY(framebuffer_, gpu::Framebuffer::create("bright lights", &change_, &depth, true));
  }
  if (layers > layers_) {
    mover_depth_ = make_maps(layers);
    scene_depth_ = make_maps(layers);
    if (!layers_target_) layers_target_ = gpu::Framebuffer::create_for_layers();
    layers_ = layers;
  }
  return gpu::check_gl("making shadow maps");
}

void BrightPass::draw_depth(const GpuScene& scene, const std::vector<DrawRange>& ranges, const Mat4& clip_from_pack,
                            FrameStats& stats) const {
  depth_.set("u_clip_from_pack", clip_from_pack);
  const Frustum frustum = make_frustum(clip_from_pack);
  for (const DrawRange& range : ranges) {
    if (!may_be_visible(frustum, range.bounds)) continue;
    const Material& m = scene.pack().materials[range.material];
    depth_.set("u_alpha", m.alpha);
    depth_.set("u_alpha_cutoff", cutoff_of(m));
    scene.albedo(m.base_color_texture).bind(kBaseUnit);
    draw_indices(range.first_index, range.index_count, stats);
  }
}

void BrightPass::draw_maps(const GpuScene& scene, const LightSamples& light,
                           std::span<const PlacedMover* const> casters, FrameStats& stats) const {
  const int side = tiles_aside(light), tile = kMapSize / side;
  const float reach = 2 * scene.bounds().radius();
  depth_.use();
  depth_.set("u_base_texture", kBaseUnit);
  layers_target_.bind();
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.color_write = false;
  gpu::apply(state);
  for (std::size_t layer = 0; layer < casters.size(); ++layer) {
    const PlacedMover& placed = *casters[layer];
    for (const bool of_scene : {false, true}) {
      layers_target_.attach_depth_layer(of_scene ? scene_depth_ : mover_depth_, static_cast<int>(layer));
      glViewport(0, 0, kMapSize, kMapSize);
      glClear(GL_DEPTH_BUFFER_BIT);
      if (of_scene) scene.bind_geometry();
      if (!of_scene) glBindVertexArray(placed.mover->vertex_array.name());
      for (std::size_t i = 0; i < light.at.size(); ++i) {
        const Shaft shaft = make_shaft(light.at[i], placed.sphere);
        const auto column = static_cast<int>(i) % side, row = static_cast<int>(i) / side;
        glViewport(tile * column, tile * row, tile, tile);
        if (of_scene)
          draw_depth(scene, scene.opaque(), clip_from_pack(shaft, scene_range(shaft, reach)), stats);
        else
          draw_depth(scene, placed.mover->ranges,
                     clip_from_pack(shaft, mover_range(shaft, placed.sphere.w)) * placed.pack_from_object, stats);
      }
    }
  }
}

void BrightPass::set_light(const LightSamples& light, std::span<const PlacedMover* const> casters, float reach) const {
  std::vector<Vec4> spheres;
  for (const PlacedMover* caster : casters) spheres.push_back(caster->sphere);
  light_.use();
  light_.set("u_base_texture", kBaseUnit);
  light_.set("u_mover_depth", kShadowUnit);
  light_.set("u_scene_depth", kStaticUnit);
  light_.set("u_at", std::span<const Vec4>(light.at));
  light_.set("u_samples", static_cast<int>(light.at.size()));
  light_.set("u_side", tiles_aside(light));
  light_.set("u_intensity", light.intensity);
  light_.set("u_axis", light.axis);
  light_.set("u_cones", light.cones);
  light_.set("u_cosine", light.cosine ? 1 : 0);
  light_.set("u_center", light.center);
  light_.set("u_radius", light.radius);
  if (!spheres.empty()) light_.set("u_spheres", std::span<const Vec4>(spheres));
  light_.set("u_movers", static_cast<int>(spheres.size()));
  light_.set("u_reach", reach);
  mover_depth_.bind(kShadowUnit);
  scene_depth_.bind(kStaticUnit);
}

void BrightPass::draw_receiver(const GpuScene& scene, const std::vector<DrawRange>& ranges, const Frustum* frustum,
                               FrameStats& stats) const {
  gpu::RasterState state;
  state.depth_test = true;
  state.blend = gpu::Blend::kAdd;
  for (const DrawRange& range : ranges) {
    const Material& m = scene.pack().materials[range.material];
    if (m.unlit || (frustum != nullptr && !may_be_visible(*frustum, range.bounds))) continue;
    state.cull = cull_of(m);
    gpu::apply(state);
    light_.set("u_alpha", m.alpha);
    light_.set("u_alpha_cutoff", cutoff_of(m));
    scene.albedo(m.base_color_texture).bind(kBaseUnit);
    draw_indices(range.first_index, range.index_count, stats);
  }
}

Status BrightPass::draw(const GpuScene& scene, const View& view, std::span<const PlacedMover> movers,
                        const FrameOptions& options, const gpu::Texture& depth, FrameStats& stats) {
  ORIEL_TRY_VOID(
      ensure_targets(view.width, view.height, depth, std::min(static_cast<int>(movers.size()), kMaxShadowMovers)));
  framebuffer_.bind();
  glViewport(0, 0, view.width, view.height);
  gpu::apply({});
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  const Frustum frustum = make_frustum(view.clip_from_pack);
  const std::vector<BrightLight>& lights = scene.pack().light_field.lights;
  for (std::uint32_t l = 0; l < lights.size(); ++l) {
    std::vector<const PlacedMover*> lit;
    for (const PlacedMover& placed : movers)
      if (share_of(placed, l) != nullptr) lit.push_back(&placed);
    const LightSamples light = sample_light(lights[l], std::clamp(options.light_points, 1, kMaxLightSamples));
    if (lit.empty() || light.at.empty()) continue;
    std::stable_sort(lit.begin(), lit.end(), [&](const PlacedMover* a, const PlacedMover* b) {
      return length2(Vec3(a->sphere) - light.center) < length2(Vec3(b->sphere) - light.center);
    });
    const std::size_t casting =
        options.mover_lights == MoverLights::kShadowed ? std::min<std::size_t>(lit.size(), kMaxShadowMovers) : 0;
    const std::span<const PlacedMover* const> casters(lit.data(), casting);
    draw_maps(scene, light, casters, stats);
    framebuffer_.bind();
    glViewport(0, 0, view.width, view.height);
    set_light(light, casters, 2 * scene.bounds().radius());
    for (std::size_t i = 0; i < lit.size(); ++i) {
      const PlacedMover& placed = *lit[i];
      light_.set("u_clip_from_pack", clip_from_object(view, placed));
      light_.set("u_pack_from_object", placed.pack_from_object);
      light_.set("u_box_center", placed.mover->bounds.center());
      light_.set("u_box_scale", inverse_half(placed.mover->bounds));
      light_.set("u_share", share_of(placed, l)->fit);
      light_.set("u_receiver", i < casting ? static_cast<int>(i) : kNoShadows);
      glBindVertexArray(placed.mover->vertex_array.name());
      draw_receiver(scene, placed.mover->ranges, nullptr, stats);
    }
    if (casting == 0) continue;
    light_.set("u_clip_from_pack", view.clip_from_pack);
    light_.set("u_pack_from_object", Mat4(1));
    light_.set("u_receiver", kScene);
    scene.bind_geometry();
    draw_receiver(scene, scene.opaque(), &frustum, stats);
  }
  return {};
}

}  // namespace oriel
