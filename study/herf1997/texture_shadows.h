// Shadows of movers on flat surfaces of the scene as soft-shadow textures, made by the processor.
//
// Each patch is a rectangle of a plane in which some movers may shade a flat lamp. Its texels hold what they take of
// the lamp's light, less what the scene blocks anyhow. Patches are drawn over what is seen of their planes.
#pragma once

#include "player/passes/frame_extension.h"
#include "study/herf1997/shadow_patch.h"

namespace oriel::study {

class TextureShadows final : public FrameExtension, public SceneShadows {
 public:
  static Result<TextureShadows> create(gpu::Dialect dialect);

  int samples = 64;     // of each lamp
  double paint_ms = 0;  // that the textures of the last frame took the processor
  std::size_t textures() const { return patches_.size(); }

  SceneShadows* scene_shadows() override { return this; }
  // Casters on planes alone cast no more by maps, the others on what lies in no plane only.
  void prepare(const FrameContext& context, std::span<LitMovers> lights) override;
  void draw(const FrameContext& context, const gpu::Texture2d& surfaces,
            std::optional<std::uint32_t> zeros_of) const override;

 private:
  void know(const GpuScene& scene);
  void plan(const FrameContext& context, LitMovers& lit);
  void join_patches();
  void paint(const FrameContext& context);

  gpu::Program program_;
  std::uint64_t known_ = 0;  // geometry_serial()
  FlatSurfaces flat_;
  Occluders still_;
  std::vector<Occluders> movers_;  // by Pack::movers
  std::vector<ShadowPatch> patches_;
  std::vector<gpu::Texture2d> textures_;  // of the patches
  std::vector<PatchPainter> painters_;
};

}  // namespace oriel::study
