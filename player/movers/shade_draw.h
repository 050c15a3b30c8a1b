// Draws the light that movers take: of lights of a ShadeScene, cell by cell those that they may block there. As
// published, boxes around cells in passes of a few lights each; or in one pass, in which each pixel finds its cell.
#pragma once

#include <array>

#include "player/movers/light_passes.h"
#include "player/movers/shade_maps.h"

namespace oriel {

class ShadeDraw {
 public:
  static Result<ShadeDraw> create(gpu::Dialect dialect);

  Status set_scene(const ShadeScene& scene);
  Status set_lights(const ShadeScene& scene, std::span<const Vec3> intensities);
  // Where they are: the farther from them, the wider are the edges of their shade. The first kMovers of them count.
  void set_movers(std::span<const Vec4> spheres);
  // What draw() draws from now on. by_pixel: each element is one leaf.
  Status set_passes(std::vector<LightPass> passes, bool by_pixel, std::uint32_t lights_a_pass);

  // What is seen (shaders/lib/lit_surface.glsl), or some of its pixels. mask: 0 where nothing is wanted; may be null.
  // view: scale and offset of those pixels' places in the whole view, from -1 to 1.
  struct Seen {
    const gpu::Texture2d& surfaces;
    const gpu::Texture2d* mask = nullptr;
    Vec4 view{1, 1, 0, 0};
  };
  // Adds lux to the framebuffer that is bound.
  void draw(const View& view, const ShadeMaps& maps, const Seen& seen, FrameStats& stats) const;

 private:
  void bind(const gpu::Program& program, const ShadeMaps& maps, const Seen& seen) const;
  void upload_list(std::vector<std::uint32_t> list);

  gpu::Program boxes_, pixels_;
  gpu::VertexArray no_vertices_;
  gpu::Texture2d lights_, cells_, tree_, list_;
  static constexpr std::size_t kMovers = 16;  // as shaders/lib/shade.glsl has it
  std::array<Vec4, kMovers> movers_{};
  std::size_t cell_count_ = 0;
  std::vector<LightPass> passes_;
  bool by_pixel_ = false;
  std::uint32_t lights_a_pass_ = 1;
};

}  // namespace oriel
