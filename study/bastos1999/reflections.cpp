#include "study/bastos1999/reflections.h"

#include <algorithm>
#include <chrono>

#include "player/gpu/raster_state.h"
#include "player/passes/scene_pass.h"
#include "player/reflections/convolve_pass.h"
#include "study/bastos1999/pixel_kernel.h"

namespace oriel::study {
namespace {

// Adds the milliseconds of what `draw` does on the device.
template <class Draw>
void timed(double& ms, const Draw& draw) {
  glFinish();
  const auto start = std::chrono::steady_clock::now();
  draw();
  glFinish();
  ms += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

gpu::Texture2d upload_sphere_map(const SphereMap& map) {
  std::vector<Vec4> texels;
  for (const Vec3& r : map.texels) texels.emplace_back(r, 1);
  gpu::TextureOptions options;
  options.min_filter = options.mag_filter = GL_LINEAR;
  const int side = static_cast<int>(map.side);
  return {gpu::kRgba32f, side, side, texels.data(), options};
}

}  // namespace

float even_pixels_per_tangent(const GpuReflector& reflector, float distance, const View& view) {
  const float pixels = 0.5f * static_cast<float>(view.height) / view.tangents.y;
  if (view.orthographic) return pixels * distance;
  const Vec3 middle = 0.5f * (reflector.corners[0] + reflector.corners[2]);
  return pixels * distance / std::max(distance + glm::length(Vec3(view.eye) - middle), 1e-30f);
}

View reduced_view(const View& view, int reduction) {
  const auto up = [&](int size) { return (size + reduction - 1) / reduction; };
  View out = part_of(view, Vec2(0), up(view.width) * reduction, up(view.height) * reduction);
  out.width = up(view.width);
  out.height = up(view.height);
  return out;
}

NdcRect in_reduced_view(const NdcRect& screen, const View& view, const View& reduced, int reduction) {
  const Vec2 share =
      Vec2(view.width, view.height) / (Vec2(reduced.width, reduced.height) * static_cast<float>(reduction));
  NdcRect out = screen;
  out.lower = (screen.lower + 1.0f) * share - 1.0f;
  out.upper = (screen.upper + 1.0f) * share - 1.0f;
  return out;
}

Result<std::unique_ptr<ImageReflections>> ImageReflections::create(const gpu::Device& device, const BakedMethod& baked,
                                                                   int cells) {
  auto out = std::make_unique<ImageReflections>();
  out->device_ = device;
  out->baked_ = &baked;
  out->cells_ = cells;
  ORIEL_TRY(out->points_, PointsPass::create(device));
  ORIEL_TRY(out->kernel_, gpu::Program::create("screen_bastos1999_kernel", device.dialect));
  ORIEL_TRY(out->compose_, gpu::Program::create("bastos1999_compose", device.dialect));
  out->no_vertices_ = gpu::make_vertex_array();
  for (const BakedReflector& one : baked.reflectors) out->spheres_.push_back(upload_sphere_map(one.sphere));
  return out;
}

Status ImageReflections::begin(const FrameContext&, std::span<const PlacedMover>) {
  ++frames_;
  return {};
}

Result<bool> ImageReflections::draw_reflection(const FrameContext& context, const ReflectorInFrame& in) {
  const auto& [scene, view, options, stats] = context;
  if (in.value == 0) return false;
  const BakedReflector& baked = baked_->reflectors[in.reflector.index];
  const bool glossy = baked.kernel.size > 1;
  Drawn drawn{baked, {}, 1, glossy && options.show != Show::kM};
  if (glossy)
    drawn.reduction = choose_reduction(baked.kernel, even_pixels_per_tangent(in.reflector, baked.mean_distance, view));
  const View small = drawn.reduction > 1 ? reduced_view(view, drawn.reduction) : view;
  drawn.rect = choose_image(in_reduced_view(in.screen, view, small, drawn.reduction), 0, small, device_.texture_size);
  ORIEL_TRY_VOID(ensure_image_target(target_, drawn.rect.width, drawn.rect.height, device_.texture_size, false));
  stats.image_pixels += static_cast<std::uint64_t>(drawn.rect.width) * static_cast<std::uint64_t>(drawn.rect.height);
  timed(ms_.points, [&] {
    points_.draw({scene, small, options, stats}, {in.reflector, baked.elements, baked_->maps, drawn.rect, *target_});
  });
  if (options.count_holes) count_holes(in, drawn, stats);
  if (drawn.blurs) timed(ms_.kernel, [&] { convolve(in.reflector, small, drawn); });
  timed(ms_.sphere, [&] { compose(context, in, drawn); });
  ++stats.reflectors;
  return true;
}

void ImageReflections::count_holes(const ReflectorInFrame& in, const Drawn& drawn, FrameStats& stats) const {
  const IVec2 size = in.frame.size();
  const ImageRect& rect = drawn.rect;
  std::vector<Vec4> image(static_cast<std::size_t>(rect.width) * static_cast<std::size_t>(rect.height));
  std::vector<std::uint8_t> stencil(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  target_->sharp_framebuffer.bind();
  glReadPixels(0, 0, rect.width, rect.height, GL_RGBA, GL_FLOAT, image.data());
  in.frame.framebuffer.bind();
  glReadPixels(0, 0, size.x, size.y, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, stencil.data());
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) {
      if (static_cast<GLint>(stencil[static_cast<std::size_t>(y * size.x + x)] & kReflectorBits) != in.value) continue;
      const Vec2 at = (Vec2(x, y) + 0.5f) / static_cast<float>(drawn.reduction) - rect.origin;
      const IVec2 pixel = glm::clamp(IVec2(at), IVec2(0), IVec2(rect.width, rect.height) - 1);
      ++stats.reflected_pixels;
      if (image[static_cast<std::size_t>(pixel.y * rect.width + pixel.x)].a == 0) ++stats.holes;
    }
}

// view: of the image.
void ImageReflections::convolve(const GpuReflector& reflector, const View& view, const Drawn& drawn) const {
  const PixelKernel kernel =
      make_pixel_kernel(drawn.baked.kernel, even_pixels_per_tangent(reflector, drawn.baked.mean_distance, view));
  const int side = 2 * kernel.radius + 1;
  const gpu::Texture2d weights(gpu::kR32f, side, side, kernel.weights.data());
  target_->level_framebuffer.bind();
  target_->level_framebuffer.attach_color_level(target_->blurred, 0);
  glViewport(0, 0, drawn.rect.width, drawn.rect.height);
  gpu::apply({});
  glBindVertexArray(no_vertices_.name());
  kernel_.use();
  kernel_.set("u_image", 0);
  kernel_.set("u_kernel", 2);
  kernel_.set("u_image_size", IVec2(drawn.rect.width, drawn.rect.height));
  kernel_.set("u_radius", kernel.radius);
  weights.bind(2);
  target_->sharp.bind(0);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

// A grid over the reflector's bounds, of which the stencil leaves what is the reflector's.
void ImageReflections::compose(const FrameContext& context, const ReflectorInFrame& in, const Drawn& drawn) {
  const View& view = context.view;
  const Show show = context.options.show;
  ReflectionTarget{&in.frame}.bind(view);
  gpu::RasterState state;
  state.stencil_func = GL_EQUAL;
  state.stencil_ref = in.value;
  state.stencil_read = kReflectorBits;
  gpu::apply(state);
  const gpu::Texture2d& light = drawn.blurs ? target_->blurred : target_->sharp;
  compose_.use();
  compose_.set("u_clip_from_pack", view.clip_from_pack);
  compose_.set("u_eye", view.eye);
  compose_.set("u_normal", Vec3(in.reflector.pack_from_reflector[2]));
  compose_.set("u_cells", cells_);
  const std::array<Vec3, 3> corners{in.reflector.corners[0], in.reflector.corners[1], in.reflector.corners[3]};
  compose_.set("u_corners", corners);
  compose_.set("u_image", 0);
  compose_.set("u_sphere", 1);
  compose_.set("u_texture_size", Vec2(static_cast<float>(light.width()), static_cast<float>(light.height())));
  compose_.set("u_image_size", Vec2(static_cast<float>(drawn.rect.width), static_cast<float>(drawn.rect.height)));
  compose_.set("u_origin", drawn.rect.origin);
  compose_.set("u_reduction", static_cast<float>(drawn.reduction));
  compose_.set("u_modulate", show == Show::kM || show == Show::kMK ? 0 : 1);
  light.bind(0);
  spheres_[in.reflector.index].bind(1);
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 6 * cells_ * cells_);
  ++context.stats.draws;
}

ImageReflections::StageMs ImageReflections::take_times() {
  const double n = std::max(frames_, 1);
  const StageMs out{ms_.points / n, ms_.kernel / n, ms_.sphere / n};
  ms_ = {};
  frames_ = 0;
  return out;
}

}  // namespace oriel::study
