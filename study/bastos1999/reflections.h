// S = (M * K) R of planar reflectors as the paper draws it: points, one kernel for an image of fewer pixels, a sphere
// map at the reflected vectors of vertices (Bastos et al. 1999, section 8).
#pragma once

#include "player/passes/frame_extension.h"
#include "study/bastos1999/baked_method.h"
#include "study/bastos1999/points_pass.h"

namespace oriel::study {

// Where one kernel blurs all: pixels of the view's picture that a tangent of the kernel spans, as if all lay at that
// distance behind the reflector's middle.
float even_pixels_per_tangent(const GpuReflector& reflector, float distance, const View& view);
// The view in a picture of as many times fewer pixels a side, its right and upper edges moved out to whole ones; and
// where something of the whole picture lies in it.
View reduced_view(const View& view, int reduction);
NdcRect in_reduced_view(const NdcRect& screen, const View& view, const View& reduced, int reduction);

class ImageReflections : public FrameExtension {
 public:
  // cells: a reflector is divided into so many a side, at whose corners the sphere map is looked up. baked outlives it.
  static Result<std::unique_ptr<ImageReflections>> create(const gpu::Device& device, const BakedMethod& baked,
                                                          int cells);
  Status begin(const FrameContext&, std::span<const PlacedMover>) override;
  // See-through reflectors are the player's: the paper has none.
  Result<bool> draw_reflection(const FrameContext& context, const ReflectorInFrame& in) override;

  // Since the last call: milliseconds a frame of each stage.
  struct StageMs {
    double points = 0, kernel = 0, sphere = 0;
  };
  StageMs take_times();

 private:
  struct Drawn {
    const BakedReflector& baked;
    ImageRect rect;
    int reduction = 1;  // pixels of the frame along a side of one of the image
    bool blurs = false;
  };
  void count_holes(const ReflectorInFrame& in, const Drawn& drawn, FrameStats& stats) const;
  void convolve(const GpuReflector& reflector, const View& view, const Drawn& drawn) const;
  void compose(const FrameContext& context, const ReflectorInFrame& in, const Drawn& drawn);

  gpu::Device device_;
  const BakedMethod* baked_ = nullptr;
  int cells_ = 1, frames_ = 0;
  PointsPass points_;
  gpu::Program kernel_, compose_;
  gpu::VertexArray no_vertices_;
  std::vector<gpu::Texture2d> spheres_;  // by reflector
  std::optional<ImageTarget> target_;
  StageMs ms_;
};

}  // namespace oriel::study
