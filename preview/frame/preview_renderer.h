// The preview's frame: passes of direct light with its shadows, reflected light, specular pixels by rays, all added up
// while nothing moves (Udeshi & Hansen 1999).
#pragma once

#include <optional>

#include "formats/image/image.h"
#include "player/passes/targets.h"
#include "preview/frame/lamp_pass.h"
#include "preview/frame/lamp_rays.h"
#include "preview/frame/reflected_light.h"
#include "preview/frame/traced.h"

namespace oriel {

enum class ShadowMethod {
  kNone,
  kVolumes,
  kRays,
  kAuto  // the cheaper of the last two, as measured: by rays, and one point of early passes by volumes
};

// Each effect is a switch (U11).
struct PreviewOptions {
  ShadowMethod shadows = ShadowMethod::kAuto;
  std::uint32_t samples = 8;     // points on lamps of a pass, at least one of each kind of lamp
  std::uint32_t elements = 512;  // of what surfaces reflect, of which a pass takes some; 0: none
  bool direct = true, bounce = true, emission = true, traced = true;
  bool antialias = true;  // each pass looks through other points of the pixels
  bool shared = false;    // neighbours share points on lamps (SharedPoints), by rays: a frame that will not stay
  // Where earlier passes saw a lamp wholly or not at all, one ray in eight is traced (ShadowClasses).
  bool classes = true;
  std::uint32_t cap_rays = 0;  // of volumes: what holds the eye, as so many rays tell (sampled_caps.h); 0: exactly
  float glossy = 0.35f;        // roughness below which surfaces are traced
};

// Of the last pass: where its time went, seconds, and what it drew.
struct PreviewStats {
  double surfaces_s = 0, shadows_s = 0, direct_s = 0, bounce_s = 0, traced_s = 0, total_s = 0;
  std::size_t points = 0, shadow_quads = 0, shadow_rays = 0, traced_pixels = 0;  // rays: to lamps
  ShadowMethod shadows = ShadowMethod::kNone;                                    // the one that was taken
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

  // For checks: what the last pass saw, and which pixels a lamp's point does not reach by its shadow volumes.
  SeenPoints read_points() const;
  std::vector<std::uint8_t> read_in_shadow(const LampPoint& point, std::uint32_t cap_rays = 0) const;

 private:
  Status light(const PreviewOptions& options, Context& context, PreviewStats& stats);
  ShadowMethod method(const PreviewOptions& options) const;
  Status add_lamps(std::span<const LampPoint> lamps, const PreviewOptions& options, Context& context,
                   PreviewStats& stats);
  void add_lamp(const LampPoint& point, bool volumes, const PreviewOptions& options, PreviewStats& stats);
  ShadowVolumes volumes_of(const LampPoint& point, std::uint32_t cap_rays) const;
  Status add_lamps_by_rays(std::span<const LampPoint> lamps, const PreviewOptions& options, Context& context,
                           PreviewStats& stats);
  void read_seen();
  // Of the pass so far.
  std::vector<Vec4>& read_light();
  Status share_lamps(Context& context);
  Status reflect(const PreviewOptions& options, Context& context);
  Status add_shadowed_elements(Context& context);
  Status trace(Context& context, PreviewStats& stats);
  void add_elements() const;
  void add_pass(const PreviewOptions& options) const;
  void begin_again() { passes_ = 0, classes_.reset(); }
  View view_of_pass(bool antialias) const;

  gpu::Device device_;
  SurfacePass surface_pass_;
  VolumePass volume_pass_;
  LampPass lamp_pass_;
  gpu::Program elements_pass_, sum_pass_, mean_pass_;
  gpu::VertexArray no_vertices_;
  std::shared_ptr<const PreviewScene> scene_;
  PreviewMesh mesh_;
  Camera camera_;
  View view_;
  std::optional<SeenSurfaces> surfaces_;
  PassLight light_, sum_;
  gpu::Texture2d traced_, paths_;
  std::optional<FrameTarget> frame_;
  SeenPoints points_;                  // of the pass under way, where rays need them
  bool read_ = false;                  // they are there
  std::vector<Vec4> light_here_;       // what light_ holds, where rays found it last; else empty
  LampShares lamp_shares_;             // of this view
  std::vector<LampPoint> reflecting_;  // of that pass
  // Seconds by point on a lamp, of this scene and size.
  struct Costs {
    double rays[2] = {0, 0};  // shared: [1]; 0: not known yet
    double volumes = 0;
    int trials = 0;
  } costs_;
  std::uint32_t passes_ = 0;
  std::optional<ShadowClasses> classes_;  // of those passes
  bool has_traced_ = false;               // traced_ is not black
};

}  // namespace oriel
