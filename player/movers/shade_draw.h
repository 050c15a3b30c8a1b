// Draws the light that movers take: of lights of a ShadeScene, those that movers may block in the cell of space that
// each pixel's surface lies in. One pass, in which each pixel finds its cell's list of lights.
#pragma once

#include <array>

#include "player/movers/few_pixels.h"
#include "player/movers/shade_maps.h"

namespace oriel {

class ShadeDraw {
 public:
  static Result<ShadeDraw> create(gpu::Dialect dialect);

  Status set_scene(const ShadeScene& scene);
  Status set_lights(const ShadeScene& scene, std::span<const Vec3> intensities);
  // Where they are: the farther from them, the wider are the edges of their shade. The first kMovers of them count.
  void set_movers(std::span<const Vec4> spheres);
  // What draw() draws from now on.
  Status set_lists(std::span<const CellLights> lists);

  // Adds lux to the framebuffer that is bound.
  void draw(const ShadeMaps& maps, const LitPixels& pixels, FrameStats& stats) const;
  // For a program that uses shaders/lib/shade.glsl: lights, movers, maps and pixels, and numbers for its list.
  void bind(const gpu::Program& program, const gpu::Texture2d& list, const ShadeMaps& maps,
            const LitPixels& pixels) const;

 private:
  gpu::Program program_;
  gpu::VertexArray no_vertices_;
  gpu::Texture2d lights_, tree_, list_;
  static constexpr std::size_t kMovers = 16;  // as shaders/lib/shade.glsl has it
  std::array<Vec4, kMovers> movers_{};
  std::size_t cell_count_ = 0;
};

}  // namespace oriel
