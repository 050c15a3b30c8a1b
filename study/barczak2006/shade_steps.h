// The shade of a pack's movers in light from everywhere, by each step of Barczak 2006 ("Realistic Rendering of Large
// Sets of Point Lights", chapter 4) and as the player draws it: the same lights, maps and cells, another way through
// them.
#pragma once

#include <optional>

#include "formats/image/image.h"
#include "player/scene/gpu_scene.h"
#include "study/barczak2006/cell_boxes.h"

namespace oriel::study {

// Each light at each pixel; those that movers may block in a cell of space, at its pixels (4.3.1); likewise at one of
// sixteen pixels, and at all of them where surfaces end (4.3.3); likewise, cells with like lights drawn together
// (4.3.5); or, as the player does, in one pass in which each pixel finds its cell's lights.
enum class ShadeStep { kEachLight, kCells, kFewPixels, kMerged, kLists };
inline constexpr ShadeStep kShadeSteps[] = {ShadeStep::kEachLight, ShadeStep::kCells, ShadeStep::kFewPixels,
                                            ShadeStep::kMerged, ShadeStep::kLists};
const char* name_of(ShadeStep step);

inline constexpr std::size_t kPublishedLights = 7;  // a pass, on the hardware of 2006

// What one of them did for a frame.
struct StepCost {
  ShadeStats shade;
  std::size_t passes = 0;
  double merge_ms = 0;
  double sum_ms() const { return shade.cells_ms + merge_ms + shade.maps_ms + shade.light_ms; }
};

class ShadeSteps {
 public:
  static Result<ShadeSteps> create(gpu::Dialect dialect);

  // Chooses lights anew, options.shade.lights of them, for movers at the poses of the options. Errors of images.
  Status begin(GpuScene& scene, const FrameOptions& options);
  // The light that movers take from what is seen there, of the scene alone. Movers are at options.poses: where they
  // have moved far since begin(), lights no longer are those that matter most. Error kRuntime.
  Result<StepCost> draw(const View& view, const FrameOptions& options, ShadeStep step,
                        std::size_t lights_a_pass = kPublishedLights);
  // That light, lux, row 0 at the top.
  FloatImage read() const;

 private:
  Status make_pictures(const View& view);
  void draw_surfaces(const FrameContext& context) const;

  gpu::Program surface_;
  ShadeMaps maps_;
  ShadeDraw lists_;
  CellBoxes boxes_;
  FewPixels few_;
  GpuScene* scene_ = nullptr;
  std::shared_ptr<const ShadeScene> shade_;
  std::optional<BlockedLights> blocked_;
  std::vector<Vec3> intensities_;
  std::vector<Vec4> spheres_;
  gpu::Texture2d depth_, surfaces_, light_;
  gpu::Framebuffer surfaces_target_, light_target_;
  std::uint64_t pictures_ = 0;  // made so often
};

}  // namespace oriel::study
