// The order of the passes: Bastos et al. 1999, section 6.
#pragma once

#include <memory>
#include <set>
#include <utility>

#include "formats/image/image.h"
#include "player/movers/bright_pass.h"
#include "player/passes/display_pass.h"
#include "player/passes/frame_extension.h"
#include "player/passes/glass_pass.h"
#include "player/passes/pass_clock.h"
#include "player/passes/reflection_renderer.h"
#include "player/passes/scene_pass.h"
#include "player/passes/survey_pass.h"

namespace oriel {

class Renderer {
 public:
  ~Renderer();
  // Compiles all shaders. Error kRuntime holds what the driver said.
  static Result<std::unique_ptr<Renderer>> create(const gpu::Device& device);

  // Draws a frame into the renderer's own picture, of the view's size. Errors: kUsage where that exceeds the device,
  // kRuntime where the driver fails.
  // extension: draws with it.
  Result<FrameStats> render(GpuScene& scene, const View& view, const FrameOptions& options,
                            FrameExtension* extension = nullptr);
  // Of the last frame: see DisplayPass.
  Result<std::optional<float>> meter() { return display_.meter(*frame_); }
  void display(float ev100, ToneCurve curve) const { display_.draw(*frame_, ev100, curve); }
  // Over the window of that size, whatever the frame's.
  Status display_in_window(float ev100, ToneCurve curve, const IVec2& window) {
    return display_.draw_in_window(*frame_, ev100, curve, window, std::exchange(in_window_, true));
  }
  // Light of the last frame, RGB in cd/m², row 0 at the top.
  std::vector<float> read_light() const;
  // RGBA as FrameTarget::light, row 0 at the top.
  FloatImage read_frame() const;
  // A picture as the frame, of that kind. Error kUsage where it exceeds the device.
  Status take_light(const FloatImage& rgba);
  // Whether a frame of the same view would show more than the last one did.
  bool has_news() const { return drew_movers_ && bright_pass_.has_news(); }
  IVec2 frame_size() const { return frame_ ? IVec2(frame_->light.width(), frame_->light.height()) : IVec2(0); }
  // By pixel of the last frame, row 0 at the top: the material (into Pack::materials) of the reflector, planar or
  // curved, that shows its image there; kMoverPixel: a mover; -1: no opaque reflector.
  static constexpr std::int32_t kMoverPixel = -2;
  std::vector<std::int32_t> read_reflective() const;
  // The last frame as display() shows it, RGB, row 0 at the top. Leaves its own framebuffer bound.
  Result<std::vector<std::uint8_t>> read_display(float ev100, ToneCurve curve);

 private:
  Renderer();
  Status ensure_frame(int width, int height, int samples, bool halves);
  // Over the depth of the opaque scene, of which that is shown: movers, reflections and the scene's own light.
  Status draw_light(const FrameContext& context, std::span<const DrawBatch> shown, FrameExtension* extension);
  // What movers change of the light on what is seen, if anything.
  Result<std::optional<BrightChange>> draw_change(const FrameContext& context, std::span<const DrawBatch> shown,
                                                  std::span<const PlacedMover> movers, FrameExtension* extension);
  Status add_light(const FrameContext& context, const LitBatches& lit, FrameExtension& extension);

  gpu::Device device_;
  ScenePass scene_pass_;
  MoverPass mover_pass_;
  BrightPass bright_pass_;
  ReflectionRenderer reflections_;
  GlassPass glass_pass_;
  SurveyPass survey_pass_;
  DisplayPass display_;
  std::optional<FrameTarget> frame_, spare_;  // spare_: the one before of another size, which often comes back
  bool drew_movers_ = false;                  // in the last frame
  bool in_window_ = false;                    // the frame was shown there
  PassClock clock_;
  std::vector<std::uint32_t> marked_;  // of value i + 1 in the last frame's stencil: the reflector's material
};

}  // namespace oriel
