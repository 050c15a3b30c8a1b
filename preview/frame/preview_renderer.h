// The preview's frame: passes of direct light with its shadows, reflected light, specular pixels by rays, all added up
// while nothing moves (after Udeshi & Hansen 1999).
#pragma once

#include <optional>

#include "formats/image/image.h"
#include "player/passes/targets.h"
#include "preview/frame/lamp_rays.h"
#include "preview/frame/reflected_light.h"
#include "preview/frame/surface_pass.h"
#include "preview/frame/traced.h"

namespace oriel {

// Each effect is a switch (U11).
struct PreviewOptions {
  std::uint32_t samples = 8;     // points on lamps of a pass, at least one of each kind of lamp
  std::uint32_t elements = 512;  // of what surfaces reflect, of which a pass takes some; 0: none
  bool direct = true, bounce = true, emission = true, traced = true;
  bool antialias = true;  // each pass looks through other points of the pixels
  bool shared = false;    // neighbours share points on lamps (SharedPoints): a frame that will not stay
  float glossy = 0.35f;   // roughness below which surfaces are traced
};

// Of the last pass: where its time went, seconds, and what it drew.
struct PreviewStats {
  double surfaces_s = 0, direct_s = 0, bounce_s = 0, traced_s = 0, total_s = 0;
  std::size_t points = 0, shadow_rays = 0, traced_pixels = 0;  // rays: to lamps
};

class PreviewRenderer {
 public:
  // Compiles all shaders; kRuntime holds what the driver said.
  static Result<PreviewRenderer> create(const gpu::Device& device);

  // To be drawn from now on; what was added up is left.
  Status take(std::shared_ptr<const PreviewScene> scene);
  // The scene was edited (edit_scene()); what was added up is left.
  void take_edits() { mesh_.take_materials(), begin_again(); }
  // From here, of that size; what was added up is left.
  Status look(const Camera& camera, int width, int height);
  // One more pass. context: for rays. Errors: kRuntime of the driver, kStopped.
  Result<PreviewStats> pass(const PreviewOptions& options, Context& context);
  std::uint32_t passes() const { return passes_; }

  // The mean of the passes, cd/m², into a frame that DisplayPass shows; `paths` (RGBA, row 0 at the top, a: its
  // weight) over it, if any. Before the first pass: what was shown last.
  Result<const FrameTarget*> frame(const FloatImage* paths);
  // The mean of the passes, RGB, row 0 at the top.
  FloatImage read_mean();

  const SeenPoints& points() const { return points_; }  // that the last pass saw

 private:
  Status light(const PreviewOptions& options, Context& context, PreviewStats& stats);
  Status add_lamps(const PreviewOptions& options, Context& context, PreviewStats& stats);
  Status share_lamps(Context& context);
  Status reflect(const PreviewOptions& options, Context& context);
  Status trace(Context& context, PreviewStats& stats);
  void add_pass(const PreviewOptions& options) const;
  void begin_again() { passes_ = 0, classes_.reset(); }
  View view_of_pass(bool antialias) const;

  gpu::Device device_;
  SurfacePass surface_pass_;
  gpu::Program sum_pass_, mean_pass_;
  gpu::VertexArray no_vertices_;
  std::shared_ptr<const PreviewScene> scene_;
  PreviewMesh mesh_;
  Camera camera_;
  View view_;
  std::optional<SeenSurfaces> surfaces_;
  gpu::Texture2d light_, sum_, traced_, paths_;
  gpu::Framebuffer sum_framebuffer_;
  std::optional<FrameTarget> frame_;
  SeenPoints points_;                  // of the pass under way
  std::vector<Vec4> light_here_;       // of that pass so far, which light_ is to hold
  LampShares lamp_shares_;             // of this view
  std::vector<LampPoint> reflecting_;  // of that pass
  std::uint32_t passes_ = 0;
  std::optional<ShadowClasses> classes_;  // of those passes
  bool has_traced_ = false;               // traced_ is not black
};

}  // namespace oriel
