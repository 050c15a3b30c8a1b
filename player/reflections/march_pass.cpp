#include "player/reflections/march_pass.h"

#include <algorithm>

#include "player/gpu/raster_state.h"
#include "player/reflections/convolve_pass.h"
#include "player/reflections/reflected_view.h"
#include "player/scene/surface.h"

namespace oriel {
namespace {

// Instead of 1 / distance where a coarse pixel sees nothing: what is interpolated with it is below 0 too.
constexpr float kCoarseHole = -6e4f;

// Of the lobe, in coarse pixels for those to do; in a frame that moves.
constexpr float kLeastRadius = 2, kLeastCoarseRadius = 0.25f;

struct PlaneRect {
  Vec2 from{0}, to{0};
};

// What an element's maps serve: itself, and where it borders on the reflector's edge all of the plane beyond, which the
// kernel reaches.
PlaneRect served_by(const ReflectorElement& element, const Reflector& reflector, float beyond) {
  const float eps = 1e-4f * glm::length(reflector.upper - reflector.lower);
  PlaneRect rect{element.lower, element.upper};
  for (int axis = 0; axis < 2; ++axis) {
    if (element.lower[axis] <= reflector.lower[axis] + eps) rect.from[axis] -= beyond;
    if (element.upper[axis] >= reflector.upper[axis] - eps) rect.to[axis] += beyond;
  }
  return rect;
}

// Pixels of the image whose stencil, copied from the frame's or 1 all over, tells that they show the reflector, or not.
gpu::RasterState where(const ShownPixels& shown, GLenum equal_or_not) {
  gpu::RasterState state;
  state.stencil_func = equal_or_not;
  state.stencil_ref = shown.value != 0 ? shown.value : 1;
  state.stencil_read = shown.value != 0 ? shown.bits : 0xff;
  return state;
}

}  // namespace

Result<MarchPass> MarchPass::create(gpu::Dialect dialect) {
  MarchPass pass;
  ORIEL_TRY(pass.program_, gpu::Program::create("march", dialect));
  ORIEL_TRY(pass.spread_, gpu::Program::create("screen_spread", dialect));
  ORIEL_TRY(pass.spread_everywhere_, gpu::Program::create("screen_spread", dialect, "EVERYWHERE"));
  pass.no_vertices_ = gpu::make_vertex_array();
  return pass;
}

void MarchPass::draw(const FrameContext& context, const ReflectedImage& image, const ShownPixels& shown) const {
  const auto& [scene, view, options, stats] = context;
  const bool coarse = image.blurs && image.rect.marched > 1;
  gpu::RasterState state;
  if (coarse) {
    draw_coarse(context, image, shown);
    state = where(shown, GL_EQUAL);
  } else {
    clear_image(image.target, image.rect);
    if (!image.blurs && shown.value != 0) {
      copy_stencil(image.target, image.rect, *shown.frame, view);
      state = where(shown, GL_EQUAL);
    }
  }
  gpu::apply(state);
  FrameStats again;
  march({scene, view, options, coarse ? again : stats}, image, 1);
  stats.draws += again.draws;
}

void MarchPass::draw_coarse(const FrameContext& context, const ReflectedImage& image, const ShownPixels& shown) const {
  const auto& [scene, view, options, stats] = context;
  const ImageRect& rect = image.rect;
  const ImageTarget& target = image.target;
  const gpu::Texture2d& marched = target.blurred;  // M * K comes later
  const float least_radius = (options.coarse ? kLeastCoarseRadius : kLeastRadius) * static_cast<float>(rect.marched);
  target.level_framebuffer.bind();
  target.level_framebuffer.attach_color_level(marched, 0);
  gpu::apply({});
  const int width = rect.width / rect.marched, height = rect.height / rect.marched;
  glViewport(0, 0, width, height);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, width, height);
  glClearColor(0, 0, 0, kCoarseHole);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
  march(context, image, rect.marched);

  clear_image(target, rect, Vec4(0), shown.value == 0 ? 1 : 0);
  if (shown.value != 0) copy_stencil(target, rect, *shown.frame, view);
  marched.bind(0);
  glBindVertexArray(no_vertices_.name());
  const Vec2 texels(static_cast<float>(marched.width()), static_cast<float>(marched.height()));
  const auto spread = [&](const gpu::Program& program, const gpu::RasterState& state) {
    gpu::apply(state);
    program.use();
    program.set("u_marched", 0);
    program.set("u_marched_scale", 1.0f / (static_cast<float>(rect.marched) * texels));
    program.set("u_marched_last", (Vec2(static_cast<float>(width), static_cast<float>(height)) - 0.5f) / texels);
    set_blur_width(program, context, image);
    program.set("u_least_radius", least_radius);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    ++stats.draws;
  };
  spread(spread_everywhere_, where(shown, GL_NOTEQUAL));
  gpu::RasterState done = where(shown, GL_EQUAL);
  done.stencil_write = 0xff;
  done.stencil_pass = GL_ZERO;
  spread(spread_, done);
}

void MarchPass::march(const FrameContext& context, const ReflectedImage& image, int coarse) const {
  const auto& [scene, view, options, stats] = context;
  const GpuReflector& reflector = image.reflector;
  const ReflectedView reflected = reflect_view(reflector, view, image.rect, scene.bounds());
  program_.use();
  const Mat4 image_from_reflector = reflected.image_from_view * reflected.view_from_reflector;
  program_.set("u_clip_from_reflector", image_from_reflector);
  program_.set("u_mirrored_eye", reflected.mirrored_eye);
  program_.set("u_depth_row", -glm::transpose(reflected.view_from_reflector)[2]);
  program_.set("u_ortho", view.orthographic ? 1.0f : 0.0f);
  program_.set("u_pixel", 2 * static_cast<float>(coarse) * view.tangents.y / static_cast<float>(view.height));
  program_.set("u_closest", kClosest);
  program_.set("u_hole", coarse > 1 ? kCoarseHole : 0.0f);
  program_.set("u_light", 0);
  program_.set("u_disparity", 1);
  program_.set("u_ranges", 2);
  glBindVertexArray(no_vertices_.name());
  const Reflector& shape = scene.pack().reflectors[reflector.index];
  const float beyond = 4 * (reflector.size + std::fabs(reflected.mirrored_eye.z));
  for (std::size_t e = 0; e < reflector.elements.size(); ++e) {
    const ReflectorElement& element = reflector.elements[e];
    const PlaneRect served = served_by(element, shape, beyond);
    const std::array<Vec3, 4> corners{Vec3(served.from, 0), Vec3(served.to.x, served.from.y, 0), Vec3(served.to, 0),
                                      Vec3(served.from.x, served.to.y, 0)};
    if (project_polygon(image_from_reflector, corners).empty) continue;
    program_.set("u_from", served.from);
    program_.set("u_to", served.to);
    program_.set("u_lower", element.lower);
    program_.set("u_upper", element.upper);
    choose_maps(context, element, scene.map_array(reflector, e), reflected.mirrored_eye);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    ++stats.draws;
  }
}

void MarchPass::choose_maps(const FrameContext& context, const ReflectorElement& element, const MapArray& array,
                            const Vec4& mirrored_eye) const {
  const auto& [scene, view, options, stats] = context;
  const std::vector<RadianceMap>& maps = scene.pack().radiance_maps;
  std::vector<WeighedMap> chosen = weigh_maps(element, maps, mirrored_eye, options.maps_per_element);
  chosen.resize(std::min(chosen.size(), kMostMapsPerElement));

  array.light.bind(0);
  array.disparity.bind(1);
  array.ranges.bind(2);
  std::vector<Vec4> eyes, sizes;
  for (const WeighedMap& m : chosen) {
    const RadianceMap& map = maps[element.maps[m.map]];
    eyes.emplace_back(map.eye, m.weight);
    sizes.emplace_back(Vec2(array.sizes[m.map]), m.map, array.scale[m.map]);
  }
  program_.set("u_eyes", eyes);
  program_.set("u_maps", sizes);
  program_.set("u_count", static_cast<int>(chosen.size()));
  program_.set("u_blended", options.maps_per_element);
  stats.maps +=
      std::min(static_cast<std::uint32_t>(chosen.size()), static_cast<std::uint32_t>(options.maps_per_element));
}

}  // namespace oriel
