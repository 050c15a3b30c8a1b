#include "player/reflections/mesh_pass.h"

#include <algorithm>
#include <cmath>

#include "player/reflections/reflected_view.h"
#include "player/scene/surface.h"

namespace oriel {
namespace {

// Marks in the image's stencil what the maps that suit the eye best have drawn.
constexpr GLuint kDrawn = 0x80;
// Of the distance: where maps show the same surface, the one that suits the eye better is in front.
constexpr float kBehind = 0.01f;
// In holes a map that suits the eye less is in front only where it is so much nearer: beside an edge it goes on over
// what it does not see. Gallery, `mirror` and `room C`: FLIP 0.120 and 0.234 by depth alone, 0.111 and 0.162 so; from
// 1.4 on columns go missing in a floor (0.090 to 0.112).
constexpr float kNearer = 1.3f;

gpu::RasterState first_state(const ShownPixels* only) {
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.cull = gpu::Cull::kBack;
  state.stencil_ref = static_cast<GLint>(kDrawn);
  state.stencil_write = kDrawn;
  if (only != nullptr) {
    state.stencil_func = GL_EQUAL;
    state.stencil_ref |= only->value;
    state.stencil_read = only->bits;
  }
  return state;
}

// Where those have left holes.
gpu::RasterState hole_state(const ShownPixels* only) {
  gpu::RasterState state = first_state(only);
  state.stencil_func = GL_EQUAL;
  state.stencil_ref = only != nullptr ? only->value : 0;
  state.stencil_read |= kDrawn;
  state.stencil_write = 0;
  if (only == nullptr) state.stencil_read = kDrawn;
  return state;
}

void clear_depth_and_mark(const ImageRect& rect) {
  gpu::RasterState state;
  state.depth_test = state.depth_write = true;
  state.stencil_write = kDrawn;
  gpu::apply(state);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, rect.width, rect.height);
  glClearStencil(0);
  glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

bool shows(const ReflectorElement& element, const Mat4& image_from_reflector) {
  const Vec2 lower = element.lower, upper = element.upper;
  const std::array<Vec3, 4> corners{Vec3(lower, 0), Vec3(upper.x, lower.y, 0), Vec3(upper, 0),
                                    Vec3(lower.x, upper.y, 0)};
  return !project_polygon(image_from_reflector, corners).empty;
}

}  // namespace

Result<MeshPass> MeshPass::create(const gpu::Device& device) {
  MeshPass pass;
  ORIEL_TRY(pass.program_, gpu::Program::create("map_mesh", device.dialect));
  ORIEL_TRY(pass.holes_, gpu::Program::create("screen_probe", device.dialect));
  pass.no_vertices_ = gpu::make_vertex_array();
  pass.query_ = gpu::make_query();
  pass.conditional_ = device.dialect == gpu::Dialect::kDesktop330;
  return pass;
}

void MeshPass::draw(const FrameContext& context, const ReflectedImage& image, const ShownPixels* only) const {
  const auto& [scene, view, options, stats] = context;
  const GpuReflector& reflector = image.reflector;
  clear_image(image.target, image.rect);
  if (only != nullptr) {
    copy_stencil(image.target, image.rect, *only->frame, view);
    clear_depth_and_mark(image.rect);
  }
  const ReflectedView reflected = reflect_view(reflector, view, image.rect, scene.bounds());
  program_.use();
  program_.set("u_clip_from_mirrored", reflected.image_from_view * reflected.view_from_mirrored);
  program_.set("u_mirrored_eye", reflected.mirrored_eye);
  program_.set("u_depth_row", -glm::transpose(reflected.view_from_mirrored)[2]);
  program_.set("u_ortho", view.orthographic ? 1.0f : 0.0f);
  program_.set("u_near", view.orthographic ? 0.0f : view.near);
  program_.set("u_closest", kClosest);
  program_.set("u_light", 0);
  program_.set("u_disparity", 1);
  const Mat4 image_from_reflector = reflected.image_from_view * reflected.view_from_reflector;
  std::vector<Chosen> elements;
  for (std::size_t e = 0; e < reflector.elements.size(); ++e) {
    if (!shows(reflector.elements[e], image_from_reflector)) continue;
    elements.push_back({e, maps_by_angle(reflector.elements[e], scene.pack().radiance_maps, reflected.mirrored_eye)});
  }
  const auto draw_maps = [&](const gpu::RasterState& state, bool first) {
    gpu::apply(state);
    program_.use();
    for (const Chosen& chosen : elements) draw_element(context, reflector, chosen, first);
  };
  draw_maps(first_state(only), true);
  gpu::RasterState holes = hole_state(only);
  count_holes(holes);
  if (conditional_) glBeginConditionalRender(query_.name(), GL_QUERY_WAIT);
  draw_maps(holes, false);
  if (conditional_) glEndConditionalRender();
  glBindVertexArray(0);
}

void MeshPass::count_holes(gpu::RasterState state) const {
  state.depth_test = state.depth_write = state.color_write = false;
  state.cull = gpu::Cull::kNone;
  gpu::apply(state);
  holes_.use();
  glBindVertexArray(no_vertices_.name());
  glBeginQuery(GL_ANY_SAMPLES_PASSED, query_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glEndQuery(GL_ANY_SAMPLES_PASSED);
}

void MeshPass::draw_element(const FrameContext& context, const GpuReflector& reflector, const Chosen& chosen,
                            bool first) const {
  const auto& [scene, view, options, stats] = context;
  const float unit = view.orthographic ? scene.bounds().radius() : 1.0f;
  const ReflectorElement& element = reflector.elements[chosen.element];
  const MapArray& array = scene.map_array(reflector, chosen.element);
  array.light.bind(0);
  array.disparity.bind(1);
  const std::size_t count = std::min(chosen.maps.size(), static_cast<std::size_t>(options.maps_per_element));
  // The best last: where an orthographic view has no depths left they are in front all the same.
  for (std::size_t i = first ? count : chosen.maps.size(); i-- > (first ? 0 : count);) {
    const std::uint32_t layer = chosen.maps[i], index = element.maps[layer];
    const GpuMapMesh& mesh = scene.map_mesh(index);
    if (mesh.index_count == 0) continue;
    const RadianceMap& map = scene.pack().radiance_maps[index];
    program_.set("u_scale", mesh.scale);
    program_.set("u_map_eye", map.eye);
    program_.set("u_lower", map.lower);
    program_.set("u_upper", map.upper);
    program_.set("u_size", Vec2(array.sizes[layer]));
    program_.set("u_layer", static_cast<float>(layer));
    program_.set("u_light_scale", array.scale[layer]);
    const float behind = first ? kBehind * static_cast<float>(i) / static_cast<float>(kMostMapsPerElement)
                               : std::pow(kNearer, static_cast<float>(i - count)) - 1;
    program_.set("u_behind", unit * behind);
    mesh.draw();
    ++stats.draws;
    stats.maps += first;
    stats.triangles += static_cast<std::uint64_t>(mesh.index_count) / 3;
  }
}

}  // namespace oriel
