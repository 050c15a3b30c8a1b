#include "player/movers/mover_pass.h"

#include "formats/query/mover_pose.h"
#include "player/scene/surface.h"

namespace oriel {
namespace {

MoverPose placed_pose(const Pack& pack, std::span<const MoverPose> poses, std::size_t i) {
  return i < poses.size() ? poses[i] : pack.movers[i].rest;
}

}  // namespace

std::array<Vec3, 8> corners_of(const PlacedMover& placed) {
  const Bounds& box = placed.mover->bounds;
  std::array<Vec3, 8> out;
  for (std::size_t i = 0; i < 8; ++i) {
    const Vec3 corner = glm::mix(box.lower, box.upper, Vec3(i & 1, i >> 1 & 1, i >> 2));
    out[i] = Vec3(placed.pack_from_object * Vec4(corner, 1));
  }
  return out;
}

std::vector<PlacedMover> place_movers(const GpuScene& scene, const FrameOptions& options) {
  const Pack& pack = scene.pack();
  std::vector<PlacedMover> out;
  for (std::size_t i = 0; i < scene.movers().size(); ++i) {
    const Mover& mover = pack.movers[i];
    PlacedMover placed;
    placed.mover = &scene.movers()[i];
    const Bounds& box = placed.mover->bounds;
    if (box.empty()) continue;
    const MoverPose pose = placed_pose(pack, options.poses, i);
    placed.pack_from_object = Mat4(pack_from_object(pose));
    placed.sphere = Vec4(Vec3(placed.pack_from_object * Vec4(box.center(), 1)), box.radius());
    placed.normal_mapped = !mover.mesh.normal_uvs.empty();
    placed.components = mover.transfer.components;
    placed.light =
        light_mover(pack.light_field, mover.transfer, box, pose, options.mover_lights == MoverLights::kHarmonics);
    placed.table =
        gpu::Texture2d(gpu::kRgba32f, 3 * (placed.components + 1), mover.transfer.clusters, placed.light.table.data());
    out.push_back(std::move(placed));
  }
  return out;
}

Bounds bounds_with_movers(const GpuScene& scene, std::span<const MoverPose> poses) {
  Bounds bounds = scene.bounds();
  for (std::size_t i = 0; i < scene.movers().size(); ++i) {
    const Bounds& box = scene.movers()[i].bounds;
    if (box.empty()) continue;
    const DMat4 pack_from = pack_from_object(placed_pose(scene.pack(), poses, i));
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 upper(corner & 1, corner >> 1 & 1, corner >> 2);
      bounds.extend(Vec3(pack_from * DVec4(DVec3(glm::mix(box.lower, box.upper, upper)), 1)));
    }
  }
  return bounds;
}

Result<MoverPass> MoverPass::create(gpu::Dialect dialect) {
  MoverPass pass;
  ORIEL_TRY(pass.depth_, gpu::Program::create("depth", dialect));
  ORIEL_TRY(pass.light_, gpu::Program::create("mover_light", dialect));
  return pass;
}

void MoverPass::draw_depth(const FrameContext& context, std::span<const PlacedMover> movers) const {
  const auto& [scene, view, options, stats] = context;
  depth_.use();
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.color_write = false;
  state.mirrored = view.mirrored;
  for (const PlacedMover& placed : movers) {
    depth_.set("u_clip_from_pack", clip_from_object(view, placed));
    glBindVertexArray(placed.mover->vertex_array.name());
    for (const DrawRange& range : placed.mover->ranges) {
      const Material& m = scene.pack().materials[range.material];
      state.cull = cull_of(m);
      gpu::apply(state);
      set_cutout(depth_, scene, m);
      draw_indices(range.first_index, range.index_count, stats);
    }
  }
}

void MoverPass::draw(const FrameContext& context, std::span<const PlacedMover> movers, const Vec3& weights,
                     const MoverChange* change) const {
  light_.use();
  light_.set("u_alpha_kind", 0);
  light_.set("u_changed", change != nullptr ? 1 : 0);
  if (change != nullptr) change->light->bind(kChangeUnit), change->surfaces->bind(kPlaceUnit);
  draw_light(context, movers, weights);
}

void MoverPass::draw_reflected(const FrameContext& context, std::span<const PlacedMover> movers) const {
  set_distance_alpha(light_, context.view);
  light_.set("u_changed", 0);
  draw_light(context, movers, Vec3(1));
}

void MoverPass::draw_light(const FrameContext& context, std::span<const PlacedMover> movers,
                           const Vec3& weights) const {
  const auto& [scene, view, options, stats] = context;
  light_.set("u_eye", view.eye);
  light_.set("u_base_texture", kBaseUnit);
  light_.set("u_reflectance", kReflectanceUnit);
  light_.set("u_normal_texture", kNormalUnit);
  light_.set("u_change", kChangeUnit);
  light_.set("u_surfaces", kPlaceUnit);
  light_.set("u_codes", kWeightUnit);
  light_.set("u_table", kTableUnit);
  light_.set("u_weights", weights);
  light_.set("u_reflectance_count", scene.reflectance_tables().width());
  scene.reflectance_tables().bind(kReflectanceUnit);
  gpu::RasterState state;
  state.mirrored = view.mirrored;
  state.depth_test = true;
  state.stencil_ref = static_cast<GLint>(kMoverBits);
  state.stencil_write = kMoverBits;
  for (const PlacedMover& placed : movers) {
    const Vec3 half = 0.5f * (placed.mover->bounds.upper - placed.mover->bounds.lower);
    light_.set("u_clip_from_pack", clip_from_object(view, placed));
    light_.set("u_pack_from_object", placed.pack_from_object);
    light_.set("u_box_center", placed.mover->bounds.center());
    light_.set("u_box_scale",
               Vec3(half.x > 0 ? 1 / half.x : 0, half.y > 0 ? 1 / half.y : 0, half.z > 0 ? 1 / half.z : 0));
    light_.set("u_components", placed.components);
    placed.mover->weights.bind(kWeightUnit);
    placed.table.bind(kTableUnit);
    glBindVertexArray(placed.mover->vertex_array.name());
    for (const DrawRange& range : placed.mover->ranges) {
      state.cull = cull_of(scene.pack().materials[range.material]);
      gpu::apply(state);
      set_surface(light_, scene, range.material, placed.normal_mapped);
      draw_indices(range.first_index, range.index_count, stats);
    }
  }
}

}  // namespace oriel
