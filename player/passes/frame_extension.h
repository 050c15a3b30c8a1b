// What a program above the player draws in its frames otherwise, or besides.
#pragma once

#include <set>
#include <span>

#include "player/gpu/framebuffer.h"
#include "player/movers/mover_pass.h"
#include "player/movers/scene_shadows.h"
#include "player/passes/scene_pass.h"
#include "player/passes/targets.h"
#include "player/reflections/image_target.h"

namespace oriel {

// What is lit: the frame, or the image of a mirror.
struct LitImage {
  const gpu::Framebuffer& from;  // whose depth and stencil tell what is seen
  const gpu::Texture2d* light = nullptr;
  const gpu::MultisampleTexture* samples = nullptr;  // in place of it
  static LitImage of(const FrameTarget& frame) {
    if (frame.light_samples) return {frame.sampled, nullptr, &frame.light_samples};
    return {frame.framebuffer, &frame.light, nullptr};
  }
  static LitImage of(const ImageTarget& image) { return {image.sharp_framebuffer, &image.sharp, nullptr}; }
};

// The part of the scene that it shows, of all indices or of those that are bound by GpuScene::bind_shown().
struct LitBatches {
  std::span<const DrawBatch> shown;
  bool all_indices = false;
  const std::set<std::uint32_t>& reflective;  // materials of reflectors whose images are marked in the stencil
  SceneWeights weights;
};

// A reflector of which a part is seen in the frame.
struct ReflectorInFrame {
  const FrameTarget& frame;
  const GpuReflector& reflector;
  NdcRect screen;   // around that part
  GLint value = 0;  // in the frame's stencil, kReflectorBits; 0: see-through, is added to what is there
};

class FrameExtension {
 public:
  virtual ~FrameExtension() = default;
  // Before the images of a frame.
  virtual Status begin(const FrameContext&, std::span<const PlacedMover>) { return {}; }
  // S of one reflector into the frame; false: as the player draws it. Own framebuffers may stay bound.
  virtual Result<bool> draw_reflection(const FrameContext&, const ReflectorInFrame&) { return false; }
  // Adds light to what the lightmap lights, in the frame and in images of mirrors. Own framebuffers may stay bound.
  virtual Status add_light(const FrameContext&, const LitImage&, const LitBatches&) { return {}; }
  // What draws shadows of movers on the scene; none: shadow maps alone.
  virtual SceneShadows* scene_shadows() { return nullptr; }
};

}  // namespace oriel
