// Bodies of solid glass: each shows what the eye sees through it, refracted, absorbed and, frosted, blurred by the
// distance behind it. Rays that leave it see the frame so far, by its depth, beyond it the scene as drawn from the
// apparent eye through the face that they entered by, and where that does not show it as drawn once from the body's
// middle. Frosted panes likewise, without refraction.
#pragma once

#include <optional>
#include <vector>

#include "player/passes/glass_window.h"
#include "player/passes/pane_glow.h"
#include "player/passes/scene_pass.h"
#include "player/passes/targets.h"

namespace oriel {

class GlassPass {
 public:
  // Compiles nothing before glass is seen.
  explicit GlassPass(gpu::Dialect dialect = {}) : dialect_(dialect) {}

  // Before a frame's see-through surfaces are drawn: makes what bodies in view need and do not have yet; nothing where
  // none is. May leave a framebuffer of its own bound. Errors of the driver.
  Status prepare(const FrameContext& context, const ScenePass& scene_pass);
  // One of GpuScene::glass() that prepare() has seen, over the frame, in place of what lies behind it. Leaves the frame
  // bound. Errors of the driver.
  Status draw(const FrameContext& context, const ScenePass& scene_pass, const FrameTarget& frame, std::size_t body);
  std::uint64_t bytes() const;

 private:
  struct Body {
    gpu::CubeTexture shape;
    gpu::CubeTexture around;  // as seen from its centre
    std::uint64_t around_of = 0;
    bool whole = false;                 // all images were there
    std::optional<GlassWindow> window;  // of the frame
  };
  Status compile();
  Status start(const GpuScene& scene);
  Status draw_shape(const FrameContext& context, std::size_t body);
  Status draw_around(const FrameContext& context, std::size_t body, const ScenePass& scene_pass);
  // levels: coarser ones too.
  Status make_canvas(const IVec2& size);
  Status take_behind(const FrameTarget& frame, bool levels, FrameStats& stats);
  // Where it is, by pixel; then its light; then that over the frame. cull: as its faces are seen.
  void draw_surface(const FrameContext& context, const GlassBody& body, gpu::Cull cull) const;
  void shade(const FrameContext& context, std::size_t body, bool inside) const;
  void set_body(const GpuScene& scene, const GlassBody& body, const FrameOptions& options) const;
  // Chooses the windows of a frame. by_share: bodies in view, those that cover most of the picture first.
  void choose_windows(const FrameContext& context, std::span<const std::pair<float, std::size_t>> by_share);
  // What rays see through the window, into through_.
  Status draw_through(const FrameContext& context, const GlassWindow& window, const ScenePass& scene_pass);
  void set_window(const std::optional<GlassWindow>& window) const;
  std::size_t nearest_around(const GpuScene& scene, std::size_t body) const;

  gpu::Dialect dialect_{};
  gpu::Program shape_, copy_, surface_, light_, glass_;
  PaneGlow glow_;
  gpu::VertexArray no_vertices_;
  std::vector<Body> bodies_;  // by GpuScene::glass()
  std::uint64_t geometry_of_ = 0;
  gpu::Texture2d depth_;  // of a face
  gpu::Framebuffer face_;
  gpu::Texture2d behind_, places_, normals_, tints_, nearest_, shaded_;  // of the frame's size
  gpu::Framebuffer behind_framebuffer_, surfaces_framebuffer_, shaded_framebuffer_;
  gpu::Texture2d through_, through_depth_;  // of the frame's size
  gpu::Framebuffer through_framebuffer_;
  bool has_levels_ = false;
  std::optional<std::vector<NdcRect>> since_;  // drawn since behind_ was taken; none: it was not
};

}  // namespace oriel
