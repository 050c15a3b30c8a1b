// The frame that passes draw into, and images of it.
#pragma once

#include <limits>

#include "player/gpu/framebuffer.h"
#include "player/reflections/image_target.h"

namespace oriel {

// The frame: light in cd/m² (a: 0 nothing, 1 of lit surfaces, 2 of unlit ones, to be shown by their own white), depth,
// stencil. With several samples a pixel passes draw into those, and the frame itself is what resolve_…() last made of
// them.
struct FrameTarget {
  gpu::Texture2d light, depth;
  gpu::Framebuffer framebuffer;
  gpu::MultisampleTexture light_samples, depth_samples;  // none: a sample a pixel
  gpu::Framebuffer sampled;
  int asked = 1;               // samples; the device may have given more
  float unlit_white = 1;       // of the unlit ones, cd/m²
  bool halves = false;         // light is half floats
  bool shows_samples = false;  // what is shown is the mean of the samples, once each is tone-mapped; else `light`

  const gpu::Framebuffer& drawn() const { return light_samples ? sampled : framebuffer; }
  IVec2 size() const { return {light.width(), light.height()}; }
  int samples() const { return light_samples ? light_samples.samples() : 1; }
  // Both leave drawn() bound.
  void resolve_light() const;
  void resolve_depth_stencil() const;
};
// samples: at least 1, within the device's.
Result<FrameTarget> make_frame_target(int width, int height, int samples, bool halves);

// Where scene and reflections are drawn: the frame, or the image of a reflector.
struct ReflectionTarget {
  const FrameTarget* frame = nullptr;  // null: an image
  const ImageTarget* image = nullptr;
  int mirrors = 0;                                           // on the way to it
  float reflectance = 1;                                     // of those, at 60 degrees
  float share = 1;                                           // of the frame's pixels
  float budget_ms = std::numeric_limits<float>::infinity();  // of the images in it
  bool blurs = false;                                        // an image that is convolved once it is drawn
  void bind(const View& view) const;
};

}  // namespace oriel
