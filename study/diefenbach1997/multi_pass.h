// Light of lamps in passes of their own (Diefenbach & Badler 1997, sections 4 and 7), as Renderer::render() takes them:
// over what the lightmap alone lights, and for each point of a lamp, straight and by way of mirrors, its shadow volumes
// into the stencil and the scene in its light where the stencil says that nothing stands between.
//
// The passes have a depth and stencil of their own, copied from the image that they light. Of its eight bits one says
// where a reflector's image is, one where light by mirrors comes through all of them, and six count shadow volumes: 64
// triangles between a pixel and its light, 32 closed objects, count as none.
#pragma once

#include <optional>

#include "player/passes/frame_extension.h"
#include "study/diefenbach1997/volume_cache.h"

namespace oriel::study {

struct MultiPassSettings {
  int points = 4;            // of a lamp that has a size, each a source: 1 to kMaxLightPoints
  int mirrors = 1;           // on the way of light from a lamp to what it lights, at most: 0 to kMostLightMirrors
  int shadow_mirrors = 3;    // ways by more of them have no shadows
  bool bent_shadows = true;  // of what stands before a mirror on the way; else of what stands behind the last one alone
};

// Of a frame, as the paper counts.
struct MultiPassStats {
  std::uint32_t paths = 0;            // from a source by mirrors to what it lights
  std::uint32_t left_out = 0;         // more than a frame draws
  std::uint32_t images = 0;           // the frame's own view and those of mirrors: passes without lamps
  std::uint32_t light_passes = 0;     // the scene in the light of one path
  std::uint32_t shadow_passes = 0;    // shadow volumes of all objects, of one stretch of a path
  std::uint32_t aperture_passes = 0;  // light volumes, of one mirror on a path
  VolumeStats volumes{};
};

class MultiPass : public FrameExtension {
 public:
  explicit MultiPass(gpu::Dialect dialect, const MultiPassSettings& how) : settings(how), dialect_(dialect) {}

  // Before the images of a frame. Error kRuntime: the device has no OpenGL that clamps depth, or refuses a shader.
  Status begin(const FrameContext& context, std::span<const PlacedMover> movers) override;
  // Adds the light of lamps; own framebuffers stay bound. Error kRuntime.
  Status add_light(const FrameContext& context, const LitImage& image, const LitBatches& lit) override;
  // Of the last frame.
  MultiPassStats stats() const;

  MultiPassSettings settings;  // of the next frame

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
                 std::span<const PathLeg> legs);
  void set_path(const gpu::Program& program, const FrameContext& context, const LightPath& path,
                std::span<const PathLeg> legs) const;

  gpu::Dialect dialect_{};
  MultiPassStats stats_;
  std::optional<VolumeCache> volumes_;
  gpu::Program light_, plain_light_, every_pixel_;
  gpu::VertexArray no_vertices_;
  std::vector<LightSource> sources_;
  std::vector<LightMirror> mirrors_;
  LightPaths paths_;
  std::vector<Target> targets_;
};

}  // namespace oriel::study
