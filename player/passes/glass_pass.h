// Bodies of solid glass: each shows what the eye sees through it, refracted, absorbed and, frosted, blurred by the
// distance behind it. Rays that leave it see the frame so far, or the image of the reflector that shows it, by its
// depth, beyond it the scene as drawn from the apparent eye through the face that they entered by, and where that does
// not show it as drawn once from the body's middle. Frosted panes likewise, without refraction.
#pragma once

#include <optional>
#include <vector>

#include "player/gpu/raster_state.h"
#include "player/passes/glass_canvas.h"
#include "player/passes/glass_cubes.h"
#include "player/passes/glass_window.h"
#include "player/passes/pane_glow.h"

namespace oriel {

class GlassPass {
 public:
  // Compiles nothing before glass is seen.
  explicit GlassPass(gpu::Dialect dialect = {}) : dialect_(dialect) {}

  // Makes what bodies in view of the target need and do not have yet, and chooses those that are drawn as such; nothing
  // where none is. May leave a framebuffer of its own bound. Errors of the driver.
  Status prepare(const FrameContext& context, const ScenePass& scene_pass, const ReflectionTarget& target);
  // See-through surfaces over the target, glass in place of what lies behind it. Of the frame all glass is so, of an
  // image what is large enough; else it is drawn thin. Leaves the target bound. Errors of the driver.
  Status draw_see_through(const FrameContext& context, const ScenePass& scene_pass, const ReflectionTarget& target,
                          const SceneWeights& weights);
  std::uint64_t bytes() const { return cubes_.bytes() + canvases_.bytes(); }

 private:
  struct Body {
    std::optional<GlassWindow> window;  // of the target
    bool shown = false;                 // in it, as such
  };
  Status compile();
  // Bodies that are drawn as such, those that cover most of the picture first; with minus the share of it.
  static std::vector<std::pair<float, std::size_t>> shown_in(const FrameContext& context,
                                                             const ReflectionTarget& target);
  Status draw(const FrameContext& context, const ScenePass& scene_pass, const ReflectionTarget& target,
              std::size_t body);
  // levels: coarser ones too.
  Status take_behind(const FrameContext& context, const ReflectionTarget& target, bool levels);
  // Where it is, by pixel; then its light; then that over the target. state: as its faces are seen.
  void draw_surface(const FrameContext& context, const GlassBody& body, gpu::RasterState state) const;
  void shade(const FrameContext& context, std::size_t body, bool inside) const;
  void set_body(const gpu::Program& light, const GpuScene& scene, const GlassBody& body,
                const FrameOptions& options) const;
  // by_share: as shown_in() has them.
  void choose_windows(const FrameContext& context, const ReflectionTarget& target,
                      std::span<const std::pair<float, std::size_t>> by_share);
  // What rays see through the window, into the canvas.
  Status draw_through(const FrameContext& context, const GlassWindow& window, const ScenePass& scene_pass);
  void set_window(const gpu::Program& light, const std::optional<GlassWindow>& window) const;

  gpu::Dialect dialect_{};
  gpu::Program copy_, surface_, light_, glass_;
  PaneGlow glow_;
  std::optional<gpu::Program> tree_light_;  // of bodies that have a tree; compiled when the first is seen
  gpu::VertexArray no_vertices_;
  std::vector<Body> bodies_;  // by GpuScene::glass()
  GlassCubes cubes_;
  GlassCanvases canvases_;
  GlassCanvas* canvas_ = nullptr;  // of the target
  bool few_looks_ = false;         // of a lobe, in it
  bool has_levels_ = false;
  std::optional<std::vector<NdcRect>> since_;  // drawn since what is behind was taken; none: it was not
};

}  // namespace oriel
