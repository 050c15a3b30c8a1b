#include "player/reflections/convolve_pass.h"

#include <algorithm>

#include "player/gpu/raster_state.h"

namespace oriel {
namespace {

// Pixels of blur from which M * K is made at fewer pixels, of a whole frame and of one that moves; and from how
// many times as much at fewer still.
constexpr float kBlur = 6, kCoarseBlur = 1.5f, kWideBlur = 16 / 6.0f;

float pixels_per_tangent(const View& view) {
  return 0.5f * static_cast<float>(view.height) / view.tangents.y;
}

// What shaders/passes/screen_blur_width.glsl asks for, to the program in use.
void set_blur_width(const gpu::Program& program, const FrameContext& context, const ReflectedImage& image) {
  const View& view = context.view;
  const Mat4 view_from_reflector = view.view_from_pack * image.reflector.pack_from_reflector;
  const Vec3 normal = normalize_or(Vec3(view_from_reflector[2]), Vec3(0, 0, 1));
  const Vec2 aside = view.centre / view.tangents;
  program.set("u_ndc_from_image", ndc_from_image(image.rect, view) + Vec4(0, 0, aside.x, aside.y));
  program.set("u_tangents", view.tangents);
  program.set("u_ortho", view.orthographic ? 1.0f : 0.0f);
  program.set("u_plane_normal", normal);
  program.set("u_plane_offset", glm::dot(normal, Vec3(view_from_reflector[3])));
  program.set("u_farthest", 1e4f * std::max(context.scene.bounds().radius(), 1e-12f));
  program.set("u_median", image.kernel.median);
  program.set("u_coarse", image.rect.coarse);
  program.set("u_pixels_per_tangent", pixels_per_tangent(view));
}

}  // namespace

ImageRect choose_image(const NdcRect& screen, float median, const View& view, int texture_limit, bool coarse) {
  ImageRect rect;
  const Vec2 size(static_cast<float>(view.width), static_cast<float>(view.height));
  // Half of the lobe's energy falls within this many pixels for what lies as far behind the reflector as the eye before
  // it.
  const float blur = view.orthographic ? 0.0f : 0.5f * median * pixels_per_tangent(view);
  const float least = coarse ? kCoarseBlur : kBlur;
  if (blur >= least) rect.coarse = 2;
  if (blur >= kWideBlur * least) rect.coarse = 4;
  float margin = std::ceil(std::clamp(4 * blur, 4.0f, 0.15f * std::max(size.x, size.y) + 4));
  margin = std::min(margin, std::floor(0.5f * (static_cast<float>(texture_limit) - std::max(size.x, size.y)) - 8));
  margin = std::max(margin, 0.0f);
  // Snapped to whole coarse pixels, so that a standing image does not shimmer when its rectangle grows.
  const Vec2 lower = (screen.lower * 0.5f + 0.5f) * size - margin;
  const Vec2 upper = (screen.upper * 0.5f + 0.5f) * size + margin;
  const auto step = static_cast<float>(rect.coarse);
  const Vec2 first = step * glm::floor(lower / step), last = step * glm::ceil(upper / step);
  rect.origin = first;
  rect.width = std::max(static_cast<int>(last.x - first.x), 1);
  rect.height = std::max(static_cast<int>(last.y - first.y), 1);
  return rect;
}

Result<ConvolvePass> ConvolvePass::create(gpu::Dialect dialect) {
  ConvolvePass pass;
  ORIEL_TRY(pass.cut_, gpu::Program::create("screen_cut", dialect));
  ORIEL_TRY(pass.program_, gpu::Program::create("screen_convolve", dialect));
  pass.no_vertices_ = gpu::make_vertex_array();
  return pass;
}

void set_convolution(const gpu::Program& program, const FrameContext& context, const ReflectedImage& image) {
  set_blur_width(program, context, image);
  const gpu::Texture2d& filled = image.target.filled;
  filled.bind(0);
  image.kernel.taps.bind(2);
  program.set("u_image", 0);
  program.set("u_image_size", IVec2(image.rect.width, image.rect.height));
  program.set("u_texture_size", Vec2(static_cast<float>(filled.width()), static_cast<float>(filled.height())));
  program.set("u_taps", 2);
  program.set("u_tap_count", image.kernel.count);
  program.set("u_tap_rows", image.kernel.rows);
}

void ConvolvePass::draw_into(const ReflectedImage& image, const gpu::Texture2d& texture, const IVec2& size) const {
  image.target.level_framebuffer.bind();
  image.target.level_framebuffer.attach_color_level(texture, 0);
  glViewport(0, 0, size.x, size.y);
  gpu::apply({});
  glBindVertexArray(no_vertices_.name());
}

void ConvolvePass::cut(const FrameContext& context, const ReflectedImage& image, const gpu::Texture2d& depth,
                       bool whole) const {
  const Reflector& reflector = context.scene.pack().reflectors[image.reflector.index];
  draw_into(image, image.target.sharp, IVec2(image.rect.width, image.rect.height));
  cut_.use();
  set_blur_width(cut_, context, image);
  cut_.set("u_reflector_from_view", glm::inverse(context.view.view_from_pack * reflector.pack_from_reflector));
  cut_.set("u_reflector_bounds", Vec4(reflector.lower, reflector.upper));
  depth.bind(0);
  cut_.set("u_depth", 0);
  image.target.depth.bind(1);
  cut_.set("u_image_depth", 1);
  cut_.set("u_whole", whole ? 1 : 0);
  cut_.set("u_view_size", IVec2(context.view.width, context.view.height));
  cut_.set("u_clip_from_view", context.view.clip_from_view);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ++context.stats.draws;
}

void ConvolvePass::draw(const FrameContext& context, const ReflectedImage& image) const {
  draw_into(image, image.target.blurred, IVec2(image.rect.width, image.rect.height) / image.rect.coarse);
  program_.use();
  set_convolution(program_, context, image);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  ++context.stats.draws;
}

}  // namespace oriel
