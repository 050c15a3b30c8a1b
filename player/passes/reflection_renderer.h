// What reflectors show, in the frame and in each other: masks, images, and S = (M * K) R made of them (Bastos et al.
// 1999, section 8.2). A mirror in a mirror is drawn by recursion (Diefenbach & Badler 1997, section 3): its mask in the
// image of the first, the eye mirrored again, clipped at its plane; each image has a target of its own, so that the
// number of mirrors on the way needs no bits of the stencil.
#pragma once

#include <deque>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "player/movers/mover_pass.h"
#include "player/navigation/zone.h"
#include "player/passes/frame_extension.h"
#include "player/passes/glass_pass.h"
#include "player/passes/image_budget.h"
#include "player/passes/pass_clock.h"
#include "player/passes/reflector_pass.h"
#include "player/passes/scene_pass.h"
#include "player/passes/targets.h"
#include "player/reflections/convolve_pass.h"
#include "player/reflections/curved_pass.h"
#include "player/reflections/fill_pass.h"
#include "player/reflections/mesh_pass.h"

namespace oriel {

// What all reflections of a frame are drawn with.
struct ReflectionWork {
  FrameContext context;
  const ScenePass& scene_pass;
  const MoverPass& mover_pass;
  std::span<const PlacedMover> movers;  // as mirrors show them: in light without shadows of their own
  GlassPass& glass;
  FrameExtension* extension = nullptr;
  ReflectionWork with(const FrameContext& other) const {
    return {other, scene_pass, mover_pass, movers, glass, extension};
  }
};

// Of a target's stencil.
struct ReflectionMarks {
  std::vector<std::uint32_t> materials;  // of value i + 1
  std::set<std::uint32_t> reflective;    // those that are drawn
};

// A reflector whose mask was drawn.
struct MarkedReflector {
  const GpuReflector* reflector = nullptr;
  NdcRect screen;         // around what is visible of it
  GLint value = 0;        // in the stencil; 0: see-through
  std::size_t query = 0;  // first of kMaskQueries
  bool waits = false;     // for its maps: nothing of it is drawn
  float worth = 0;      // of a frame that it filled: what the mirrors on the way leave of the light, and of the pixels
  float budget_ms = 0;  // of the images in its own
};

class ReflectionRenderer {
 public:
  static Result<ReflectionRenderer> create(const gpu::Device& device);
  // Of half floats, as FrameTarget, are images from now on.
  void use_halves(bool halves) { halves_ = halves; }

  // Marks the reflectors that are seen in the target, whose depth is there. Errors of images.
  Result<std::vector<MarkedReflector>> draw_masks(const FrameContext& context, const ReflectionTarget& target,
                                                  ReflectionMarks& marks);
  // S of one of them into the target: into the frame in place of what is there, or, of see-through ones and in images,
  // added to it.
  Status draw(const ReflectionWork& work, const ReflectionTarget& target, const MarkedReflector& marked,
              PassClock* clock);
  // Curved reflectors: into a frame S of opaque ones, in an image their marks only. Gives those whose S is to be added
  // once the scene is drawn.
  Result<std::vector<const GpuCurvedReflector*>> draw_curved(const FrameContext& context,
                                                             const ReflectionTarget& target, ReflectionMarks& marks);
  void add_curved(const FrameContext& context, const std::vector<const GpuCurvedReflector*>& curved) const;

 private:
  // Those that the target's budget covers.
  void afford(const FrameContext& context, const ReflectionTarget& target, std::vector<MarkedReflector>& found);
  ImageRect rect_of(const FrameContext& context, const MarkedReflector& marked) const;
  // The opaque scene in it.
  std::vector<DrawBatch> batches_in(const FrameContext& context, const ReflectionTarget& target,
                                    const GpuReflector& reflector, const View& mirrored);
  Status draw_image(const ReflectionWork& work, const ReflectionTarget& target, const MarkedReflector& marked,
                    const ReflectedImage& image);
  Status draw_mirrored(const ReflectionWork& work, const ReflectionTarget& target, const MarkedReflector& marked,
                       const ReflectedImage& image);
  Status draw_mirrors_in(const ReflectionWork& work, const ReflectionTarget& target, MirroredScene& mirrored);
  // Into the image of a mirror.
  static Status add_light(const ReflectionWork& work, const ReflectionTarget& target, const MirroredScene& mirrored);
  void compose(const FrameContext& context, const ReflectionTarget& target, const MarkedReflector& marked,
               const ReflectedImage& image) const;

  // Whether sets of what reflectors show hold for the view.
  bool sets_hold(const FrameContext& context, const ReflectionTarget& target);

  gpu::Device device_;
  bool halves_ = false;
  int image_count_ = 0;        // of mirrored geometry in this frame, so far
  std::uint64_t zone_of_ = 0;  // GpuScene::serial()
  Zone zone_;
  ImagePrices prices_;
  ReflectorPass reflector_pass_;
  MeshPass mesh_pass_;
  FillPass fill_pass_;
  ConvolvePass convolve_pass_;
  CurvedPass curved_pass_;
  std::deque<std::optional<ImageTarget>> images_;  // by mirrors on the way
  std::vector<gpu::Query> queries_;
};

// Whether a reflector's image is made of its maps: else the mirrored scene is drawn, as where a lamp has moved, which
// maps' meshes show where it was.
inline bool shows_maps(const GpuScene& scene, const GpuReflector& reflector, const FrameOptions& options) {
  return options.reflections != Reflections::kGeometry && !reflector.elements.empty() && !scene.lamps_moved();
}

}  // namespace oriel
