#include "player/passes/pane_glow.h"

#include "player/gpu/raster_state.h"
#include "player/scene/surface.h"

namespace oriel {
namespace {

enum GlowUnit { kGlowReflectance = 1, kGlowPolygons = 2, kGlowVisibility = 3, kGlowSeen = 4 };

}  // namespace

Result<PaneGlow> PaneGlow::create(gpu::Dialect dialect) {
  PaneGlow pass;
  ORIEL_TRY(pass.program_, gpu::Program::create("pane_glow", dialect));
  return pass;
}

void PaneGlow::draw(const FrameContext& context, const GlassBody& body) const {
  const auto& [scene, view, options, stats] = context;
  const Pack& pack = scene.pack();
  const Material& m = pack.materials[body.material];
  for (const LitSide& side : body.lit) {
    const GpuReflector& pane = scene.frosted_panes()[side.pane];
    if (!pane.emitters.polygons) continue;
    gpu::RasterState state;
    state.depth_test = true;
    state.cull = gpu::Cull::kNone;
    state.blend = gpu::Blend::kAdd;
    state.alpha_write = false;
    gpu::apply(state);
    program_.use();
    program_.set("u_clip_from_pack", view.clip_from_pack);
    program_.set("u_eye", view.eye);
    program_.set("u_tint", glm::clamp(m.base_color, Vec3(0), Vec3(1)) * ((1 - m.metallic) * m.transmission));
    program_.set("u_width", m.roughness * m.roughness);
    program_.set("u_reflectance_row", m.fresnel_map);
    const FresnelMap* fresnel =
        m.fresnel_map < 0 ? nullptr : &pack.fresnel_maps[static_cast<std::size_t>(m.fresnel_map)];
    program_.set("u_reflectance_count", fresnel == nullptr ? 1 : static_cast<int>(fresnel->table.size()));
    const Reflector& shape = pack.frosted_panes[side.pane];
    program_.set("u_cells", IVec2(pane.emitters.cells_x, pane.emitters.cells_y));
    program_.set("u_lower", shape.lower / pane.size);
    program_.set("u_upper", shape.upper / pane.size);
    program_.set("u_emitters_from_pack", Mat4(Mat3(1 / pane.size)) * pane.reflector_from_pack);
    program_.set("u_base_texture", kBaseUnit);
    program_.set("u_reflectance", kGlowReflectance);
    program_.set("u_polygons", kGlowPolygons);
    program_.set("u_visibility", kGlowVisibility);
    program_.set("u_seen", kGlowSeen);
    scene.albedo(m.base_color_texture).bind(kBaseUnit);
    scene.reflectance_tables().bind(kGlowReflectance);
    pane.emitters.polygons.bind(kGlowPolygons);
    pane.emitters.visibility.bind(kGlowVisibility);
    pane.emitters.seen.bind(kGlowSeen);
    scene.bind_geometry();
    draw_indices(side.first_index, side.index_count, stats);
  }
}

}  // namespace oriel
