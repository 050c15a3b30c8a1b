#include "player/passes/glass_canvas.h"

#include <algorithm>
#include <array>
#include <bit>

#include "player/gpu/device.h"
#include "player/gpu/raster_state.h"

namespace oriel {
namespace {

// Of all canvases of images; one alone may have more. At about 100 bytes each.
constexpr std::int64_t kMostPixels = std::int64_t{1} << 21;

gpu::TextureOptions with_levels(const IVec2& size) {
  gpu::TextureOptions options;
  options.levels = gpu::mip_levels(size.x, size.y);
  options.mag_filter = GL_LINEAR;
  options.min_filter = GL_LINEAR_MIPMAP_NEAREST;
  return options;
}

std::int64_t pixels(const IVec2& size) {
  return std::int64_t{size.x} * size.y;
}

// Up to the next of four steps to twice as much.
int roomy(int size) {
  const int step = std::max(static_cast<int>(std::bit_floor(static_cast<unsigned>(size))) / 4, 16);
  return (size + step - 1) / step * step;
}

}  // namespace

Result<GlassCanvas> GlassCanvas::create(const IVec2& size) {
  GlassCanvas out;
  out.behind = gpu::Texture2d(gpu::kRgba32f, size.x, size.y, nullptr, with_levels(size));
  out.places = gpu::Texture2d(gpu::kRgba32f, size.x, size.y, nullptr);
  out.normals = gpu::Texture2d(gpu::kRgba32f, size.x, size.y, nullptr);
  out.tints = gpu::Texture2d(gpu::kRgba8, size.x, size.y, nullptr);
  out.shaded = gpu::Texture2d(gpu::kRgba32f, size.x, size.y, nullptr);
  out.nearest = gpu::Texture2d(gpu::kDepthStencil, size.x, size.y, nullptr);
  ORIEL_TRY_VOID(gpu::check_gl("making the images of glass"));
  ORIEL_TRY(out.behind_framebuffer, gpu::Framebuffer::create("the image behind glass", &out.behind, nullptr));
  ORIEL_TRY(out.surfaces_framebuffer,
            gpu::Framebuffer::create("surfaces of glass",
                                     std::array<const gpu::Texture2d*, 3>{&out.places, &out.normals, &out.tints},
                                     out.nearest));
  ORIEL_TRY(out.shaded_framebuffer, gpu::Framebuffer::create("light of glass", &out.shaded, nullptr));
  return out;
}

Status GlassCanvas::make_through() {
  if (through) return {};
  through = gpu::Texture2d(gpu::kRgba32f, size().x, size().y, nullptr, with_levels(size()));
  through_depth = gpu::Texture2d(gpu::kDepthStencil, size().x, size().y, nullptr);
  ORIEL_TRY_VOID(gpu::check_gl("making the image through glass"));
  ORIEL_TRY(through_framebuffer, gpu::Framebuffer::create("the image through glass", &through, &through_depth, true));
  return {};
}

std::uint64_t GlassCanvas::bytes() const {
  std::uint64_t sum = 0;
  for (const gpu::Texture2d* t : {&behind, &places, &normals, &tints, &nearest, &shaded, &through, &through_depth})
    sum += t->bytes();
  return sum;
}

void clear_all(const Vec4& color) {
  gpu::RasterState all;
  all.depth_write = true;
  all.stencil_write = 0xff;
  gpu::apply(all);
  glClearColor(color.x, color.y, color.z, color.w);
  glClearStencil(0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

Result<GlassCanvas*> GlassCanvases::of(const ReflectionTarget& target, const View& view) {
  if (target.frame != nullptr) {
    const IVec2 size = target.frame->size();
    if (frame_ && frame_->size() == size) return &*frame_;
    frame_.reset();
    ORIEL_TRY(frame_, GlassCanvas::create(size));
    return &*frame_;
  }
  const IVec2 size(roomy(view.width), roomy(view.height));
  ++calls_;
  auto found = std::ranges::find_if(images_, [&](const GlassCanvas& canvas) { return canvas.size() == size; });
  if (found == images_.end()) {
    std::int64_t sum = pixels(size);
    for (const GlassCanvas& canvas : images_) sum += pixels(canvas.size());
    while (!images_.empty() && sum > kMostPixels) {
      const auto oldest = std::ranges::min_element(images_, {}, &GlassCanvas::used);
      sum -= pixels(oldest->size());
      images_.erase(oldest);
    }
    ORIEL_TRY(GlassCanvas made, GlassCanvas::create(size));
    images_.push_back(std::move(made));
    found = std::prev(images_.end());
  }
  found->used = calls_;
  return &*found;
}

std::uint64_t GlassCanvases::bytes() const {
  std::uint64_t sum = frame_ ? frame_->bytes() : 0;
  for (const GlassCanvas& canvas : images_) sum += canvas.bytes();
  return sum;
}

}  // namespace oriel
