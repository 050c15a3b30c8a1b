// Light of lamps in passes of their own (Diefenbach & Badler 1997, sections 4 and 7): over what the lightmap alone
// lights, and for each point of a lamp, straight and by way of mirrors, its shadow volumes into the stencil and the
// scene in its light where the stencil says that nothing stands between.
//
// The passes have a depth and stencil of their own, copied from the image that they light. Of its eight bits one says
// where a reflector's image is, one where light by mirrors comes through all of them, and six count shadow volumes: 64
// triangles between a pixel and its light, 32 closed objects, count as none.
#pragma once

#include <optional>
#include <set>

#include "player/gpu/framebuffer.h"
#include "player/passes/scene_pass.h"
#include "player/passes/targets.h"
#include "player/passes/volume_cache.h"
#include "player/reflections/image_target.h"

namespace oriel {

// What is lit: the frame, or the image of a mirror.
struct LitImage {
  const gpu::Framebuffer& from;  // whose depth and stencil tell what is seen
  const gpu::Texture2d* light = nullptr;
  const gpu::MultisampleTexture* samples = nullptr;  // in place of it
  static LitImage of(const FrameTarget& frame);
  static LitImage of(const ImageTarget& image) { return {image.sharp_framebuffer, &image.sharp, nullptr}; }
};

// The part of the scene that it shows, of all indices or of those that are bound by GpuScene::bind_shown().
struct LitBatches {
  std::span<const DrawBatch> shown;
  bool all_indices = false;
  const std::set<std::uint32_t>& reflective;  // materials of reflectors whose images are marked in the stencil
  SceneWeights weights;
};

class MultiPass {
 public:
  explicit MultiPass(gpu::Dialect dialect = {}) : dialect_(dialect) {}

  // Before the images of a frame. Error kRuntime: the device has no OpenGL that clamps depth, or refuses a shader.
  Status begin(const FrameContext& context, std::span<const PlacedMover> movers);
  // Adds the light of lamps; own framebuffers stay bound. Error kRuntime.
  Status draw(const FrameContext& context, const LitImage& image, const LitBatches& lit);

 private:
  struct Target {
    gpu::Texture2d depth;
    gpu::MultisampleTexture depth_samples;
    gpu::Framebuffer framebuffer;
  };
  Status make_programs();
  Result<Target*> target_of(const LitImage& image);
  void mark_reflectors() const;
  void mark_apertures(const FrameContext& context, const LightPath& path, std::span<const PathLeg> legs);
  void mark_shadows(const FrameContext& context, const LightPath& path, std::span<const PathLeg> legs);
  void count_from(std::uint32_t around) const;
  void draw_fullscreen(const gpu::RasterState& state) const;
  void add_light(const FrameContext& context, const LitBatches& lit, const LightPath& path,
                 std::span<const PathLeg> legs) const;
  void set_path(const gpu::Program& program, const FrameContext& context, const LightPath& path,
                std::span<const PathLeg> legs) const;

  gpu::Dialect dialect_{};
  std::optional<VolumeCache> volumes_;
  gpu::Program light_, plain_light_, every_pixel_;
  gpu::VertexArray no_vertices_;
  std::vector<LightSource> sources_;
  std::vector<LightMirror> mirrors_;
  LightPaths paths_;
  std::vector<Target> targets_;
};

}  // namespace oriel
