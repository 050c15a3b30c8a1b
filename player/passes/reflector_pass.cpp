#include "player/passes/reflector_pass.h"

#include <algorithm>

#include "player/gpu/raster_state.h"
#include "player/passes/scene_pass.h"
#include "player/reflections/convolve_pass.h"
#include "player/scene/surface.h"

namespace oriel {
namespace {

// Where strip `i` of those across a rectangle begins, along each axis: whole pixels of the frame, that hold all of it.
IVec2 strip_edge(const NdcRect& screen, const View& view, int i) {
  const Vec2 size(static_cast<float>(view.width), static_cast<float>(view.height));
  const IVec2 lower(glm::floor((glm::clamp(screen.lower, -1.0f, 1.0f) * 0.5f + 0.5f) * size));
  const IVec2 upper(glm::ceil((glm::clamp(screen.upper, -1.0f, 1.0f) * 0.5f + 0.5f) * size));
  return lower + (upper - lower) * i / kMaskStrips;
}

// Over what the mask marked with `value`; kAdded…: wherever the depth leaves the reflector visible.
gpu::RasterState where_marked(const View& view, GLint value) {
  gpu::RasterState state;
  state.depth_test = true;
  state.cull = gpu::Cull::kBack;
  state.mirrored = view.mirrored;
  if (value > 0) {
    state.stencil_func = GL_EQUAL;
    state.stencil_ref = value;
    state.stencil_read = kReflectorBits;
  } else {
    state.blend = gpu::Blend::kAdd;
    state.alpha_write = value == kAddedWithDistance;
  }
  return state;
}

}  // namespace

Result<ReflectorPass> ReflectorPass::create(gpu::Dialect dialect) {
  ReflectorPass pass;
  ORIEL_TRY(pass.mask_, gpu::Program::create("reflector_mask", dialect));
  ORIEL_TRY(pass.compose_, gpu::Program::create("reflector_compose", dialect));
  ORIEL_TRY(pass.convolve_, gpu::Program::create("reflector_convolve", dialect));
  ORIEL_TRY(pass.emitters_, gpu::Program::create("reflector_emitters", dialect));
  ORIEL_TRY(pass.emitters_sharp_, gpu::Program::create("reflector_emitters_sharp", dialect));
  return pass;
}

void ReflectorPass::begin_mask(const FrameContext& context, GLuint mark, GLuint bits) const {
  gpu::RasterState state;
  state.depth_test = true;
  state.color_write = false;
  state.cull = gpu::Cull::kBack;
  state.mirrored = context.view.mirrored;
  state.stencil_ref = static_cast<GLint>(mark);
  state.stencil_write = bits;
  gpu::apply(state);
  mask_.use();
  mask_.set("u_clip_from_pack", context.view.clip_from_pack);
  context.scene.bind_geometry();
}

void ReflectorPass::draw_mask(const FrameContext& context, const GpuReflector& reflector, GLuint mark) const {
  begin_mask(context, mark, mark == kSeeThroughBit ? kSeeThroughBit : kReflectorBits);
  draw_indices(reflector.first_index, reflector.index_count, context.stats);
}

void ReflectorPass::ask_visible(const FrameContext& context, const GpuReflector& reflector, const NdcRect& screen,
                                std::span<const gpu::Query> queries) const {
  const auto& [scene, view, options, stats] = context;
  begin_mask(context, 0, 0);
  glEnable(GL_SCISSOR_TEST);
  for (int axis = 0; axis < 2; ++axis) {
    for (int i = 0; i < kMaskStrips; ++i) {
      IVec2 lower = strip_edge(screen, view, 0), upper = strip_edge(screen, view, kMaskStrips);
      lower[axis] = strip_edge(screen, view, i)[axis];
      upper[axis] = strip_edge(screen, view, i + 1)[axis];
      glScissor(lower.x, lower.y, upper.x - lower.x, upper.y - lower.y);
      const gpu::Query& query = queries[static_cast<std::size_t>(axis * kMaskStrips + i)];
      glBeginQuery(GL_ANY_SAMPLES_PASSED, query.name());
      draw_indices(reflector.first_index, reflector.index_count, stats);
      glEndQuery(GL_ANY_SAMPLES_PASSED);
    }
  }
  glDisable(GL_SCISSOR_TEST);
}

NdcRect ReflectorPass::visible_part(const NdcRect& screen, const View& view, std::span<const gpu::Query> queries) {
  NdcRect out;
  for (int axis = 0; axis < 2; ++axis) {
    int first = kMaskStrips, last = -1;
    for (int i = 0; i < kMaskStrips; ++i) {
      GLuint any = 0;
      glGetQueryObjectuiv(queries[static_cast<std::size_t>(axis * kMaskStrips + i)].name(), GL_QUERY_RESULT, &any);
      if (any == 0) continue;
      first = std::min(first, i);
      last = i;
    }
    if (last < 0) return {};
    const auto pixels = static_cast<float>(axis == 0 ? view.width : view.height);
    out.lower[axis] = 2 * static_cast<float>(strip_edge(screen, view, first)[axis]) / pixels - 1;
    out.upper[axis] = 2 * static_cast<float>(strip_edge(screen, view, last + 1)[axis]) / pixels - 1;
  }
  out.empty = false;
  return out;
}

void ReflectorPass::draw_light(const FrameContext& context, const ReflectedImage& image, GLint value) const {
  const gpu::Texture2d& light = image.shown();
  const ImageRect& rect = image.rect;
  gpu::apply(where_marked(context.view, value));
  compose_.use();
  compose_.set("u_image", 0);
  // Images in images are smoothed with what shows them.
  compose_.set("u_smooth", value > 0 && !image.has_holes && context.options.samples > 1 ? 1 : 0);
  compose_.set("u_with_distance", value == kAddedWithDistance ? 1 : 0);
  compose_.set("u_image_size", Vec2(static_cast<float>(rect.width), static_cast<float>(rect.height)));
  compose_.set("u_origin", rect.origin);
  compose_.set("u_missing", image.reflector.mean_radiance);
  set_surface(compose_, context, image.reflector);
  light.bind(0);  // last: what is uploaded on first use is bound meanwhile
  draw_indices(image.reflector.first_index, image.reflector.index_count, context.stats);
}

void ReflectorPass::draw_convolved(const FrameContext& context, const ReflectedImage& image, GLint value) const {
  gpu::apply(where_marked(context.view, value));
  convolve_.use();
  convolve_.set("u_origin", image.rect.origin);
  convolve_.set("u_with_distance", value == kAddedWithDistance ? 1 : 0);
  convolve_.set("u_missing", image.reflector.mean_radiance);
  set_surface(convolve_, context, image.reflector);
  convolve_.set("u_blurred", 6);
  image.target.blurred.bind(6);
  set_convolution(convolve_, context, image);
  draw_indices(image.reflector.first_index, image.reflector.index_count, context.stats);
}

void ReflectorPass::draw_emitters(const FrameContext& context, const GpuReflector& reflector, GLint value) const {
  const gpu::Program* const emitters = set_emitters(context, reflector);
  if (emitters == nullptr) return;
  gpu::RasterState state = where_marked(context.view, value);
  state.blend = gpu::Blend::kAdd;
  state.alpha_write = false;
  gpu::apply(state);
  set_surface(*emitters, context, reflector);
  draw_indices(reflector.first_index, reflector.index_count, context.stats);
}

void ReflectorPass::set_surface(const gpu::Program& program, const FrameContext& context,
                                const GpuReflector& reflector) const {
  const auto& [scene, view, options, stats] = context;
  const Material& material = scene.pack().materials[reflector.material];
  const auto row = material.fresnel_map;
  const FresnelMap* fresnel = row < 0 ? nullptr : &scene.pack().fresnel_maps[static_cast<std::size_t>(row)];
  scene.reflectance_tables().bind(1);
  set_place_reflectance(program, scene, reflector.material, 7);
  scene.bind_geometry();
  program.set("u_clip_from_pack", view.clip_from_pack);
  program.set("u_eye", view.eye);
  program.set("u_normal", Vec3(reflector.pack_from_reflector[2]));
  program.set("u_reflectance", 1);
  program.set("u_reflectance_row", row);
  program.set("u_reflectance_count", fresnel == nullptr ? 1 : static_cast<int>(fresnel->table.size()));
  program.set("u_modulate", options.show == Show::kM || options.show == Show::kMK ? 0 : 1);
}

const gpu::Program* ReflectorPass::set_emitters(const FrameContext& context, const GpuReflector& reflector) const {
  const auto& [scene, view, options, stats] = context;
  const Pack& pack = scene.pack();
  const GpuEmitters& emitters = reflector.emitters;
  const GpuKernel& kernel = scene.kernel(reflector.material, options.coarse);
  // M shows a mirror's world, in which a glossy lobe has no place.
  if (!emitters.polygons || (options.show == Show::kM && kernel.fits)) return nullptr;
  const bool sharp = options.blur == Blur::kOff || !kernel.fits;
  const gpu::Program& program = sharp ? emitters_sharp_ : emitters_;
  program.use();
  program.set("u_polygons", 2);
  program.set("u_visibility", 3);
  program.set("u_seen", 4);
  emitters.polygons.bind(2);
  emitters.visibility.bind(3);
  emitters.seen.bind(4);
  if (!sharp) kernel.fits.bind(5);
  const Reflector& shape = pack.reflectors[reflector.index];
  program.set("u_cells", IVec2(emitters.cells_x, emitters.cells_y));
  program.set("u_lower", shape.lower / reflector.size);
  program.set("u_upper", shape.upper / reflector.size);
  program.set("u_emitters_from_pack", Mat4(Mat3(1 / reflector.size)) * reflector.reflector_from_pack);
  if (!sharp) program.set("u_lobes", 5), program.set("u_lobe_rows", kernel.fits.width());
  return &program;
}

}  // namespace oriel
