// The image that a reflector sees, and where it lies in the frame.
#pragma once

#include <optional>

#include "player/gpu/framebuffer.h"
#include "player/navigation/view.h"
#include "player/scene/gpu_scene.h"

namespace oriel {

// The part of the frame that a reflected image covers, with a margin around it that may lie outside the frame.
struct ImageRect {
  Vec2 origin{0};             // lower left corner, pixels of the view
  int width = 0, height = 0;  // pixels of the view
  int coarse = 1;             // of them along a side of a pixel of M * K, where the lobe is wide: 1, 2 or 4
};

// Where the frame shows a reflector: its stencil holds `value` in `bits`. value 0: the stencil does not tell.
struct ShownPixels {
  const gpu::Framebuffer* frame = nullptr;
  GLint value = 0;
  GLuint bits = 0;
};

// Image pixels to normalised device coordinates of the frame: scale in xy, offset in zw.
Vec4 ndc_from_image(const ImageRect& rect, const View& view);

// The reflected image: rgb light, a 1 / distance (0: hole). sharp: as drawn, with its coarser levels; filled: without
// holes, with its coarser levels; blurred: convolved. Textures are powers of two; an image uses their lower left
// corner.
struct ImageTarget {
  gpu::Texture2d sharp, filled, blurred, depth;
  bool halves = false;
  gpu::Framebuffer sharp_framebuffer;  // with depth and stencil
  gpu::Framebuffer level_framebuffer;  // no depth; passes attach what they draw into
};

// A reflector's image: where it lies, and what it is made of and for.
struct ReflectedImage {
  const GpuReflector& reflector;
  const GpuKernel& kernel;
  ImageRect rect;
  const ImageTarget& target;
  bool blurs = false;     // M becomes M * K; else M is shown, as by a mirror
  bool has_holes = true;  // M is made of maps, which may know nothing of a pixel

  // M with its holes filled, where it has some.
  const gpu::Texture2d& shown() const { return has_holes ? target.filled : target.sharp; }
};

// At least that large, of half floats or of floats; keeps `current` where it suffices.
Status ensure_image_target(std::optional<ImageTarget>& current, int width, int height, int limit, bool halves);
// Binds the image to be drawn into, with depth and stencil, and fills its rectangle: with a hole, or with light all
// over.
void clear_image(const ImageTarget& target, const ImageRect& rect, const Vec4& light = Vec4(0));
// Binds the image, and gives it the stencil (and depth) of the frame of that view, where it lies within.
void copy_stencil(const ImageTarget& target, const ImageRect& rect, const gpu::Framebuffer& frame, const View& view);

}  // namespace oriel
