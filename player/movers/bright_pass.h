// Bright lights on movers, with their shadows; and the shadows of movers on the scene around.
//
// A bright light is a few points (LightSamples), and each mover that it shines on has shadow maps from them
// (ShadowMaps): of itself, and of the scene that stands still. On a mover the light's points count where neither the
// scene nor a mover is nearer. The scene's lightmap holds the light as if there were no movers: what they block of
// points that nothing else blocks is to be taken from it.
//
// By pixel: what is seen there (position, normal, which mover) is drawn once. Then, for four points of a light after
// the other, the share that each mover takes from each point is gathered where its shadow can fall, the largest counts,
// and the light that is left or taken is added up. Where neither eye nor mover moved, the pictures stay. Movers are
// seen at full size, the scene at half of it: most shadows are soft. There the shade is added that movers throw in all
// other light (ShadePass).
#pragma once

#include <optional>

#include "player/gpu/raster_state.h"
#include "player/movers/lit_movers.h"
#include "player/movers/scene_shadows.h"
#include "player/movers/shade_pass.h"
#include "player/movers/shadow_maps.h"

namespace oriel {

// What bright lights change, lux by pixel.
struct BrightChange {
  MoverChange on_movers;
  const gpu::Texture2d* on_scene =
      nullptr;  // what movers take of them and of all other light; the view's size or half of it
  const gpu::Texture2d* scene_surfaces = nullptr;  // where that is: shaders/lib/lit_surface.glsl
};

class BrightPass {
 public:
  static Result<BrightPass> create(gpu::Dialect dialect);

  // shown: of the opaque scene. Nothing where movers change nothing;
  // what is given holds until the next call. Own framebuffers stay bound. Error kRuntime.
  // shadows: in place of maps; none: maps alone.
  Result<std::optional<BrightChange>> draw(const FrameContext& context, std::span<const DrawBatch> shown,
                                           std::span<const PlacedMover> movers, SceneShadows* shadows = nullptr);
  // Whether a frame of the same view would show more of the movers' shade.
  bool has_news() const { return shade_.has_news(); }

 private:
  struct Canvas {
    gpu::Texture2d depth, surfaces, taken, change;
    gpu::Framebuffer surfaces_target, taken_target, change_target;
    Status make(int width, int height);
    void bind(const gpu::Framebuffer& target) const;
  };
  Status make_targets(const FrameContext& context);
  void draw_surfaces(const FrameContext& context, std::span<const DrawBatch> shown,
                     std::span<const PlacedMover> movers) const;
  void draw_batches(const FrameContext& context, std::span<const DrawBatch> batches, const Mat4& clip_from_object,
                    const Mat4& pack_from_object, int id) const;
  Status draw_light(const FrameContext& context, const LitMovers& lit, const SceneShadows* shadows);
  void start_shadows(const Canvas& canvas, const View& view, std::span<const Vec4> points) const;
  void set_caster(const LitMovers::Caster& caster, std::span<const Vec4> points, int layer, float reach) const;
  void draw_box(std::span<const Vec3> corners, FrameStats& stats) const;
  void start_light(const Canvas& canvas, const LitMovers& lit, std::span<const Vec4> points) const;
  void add_to_movers(const FrameContext& context, const LitMovers& lit) const;
  void take_from_scene(const FrameContext& context, const LitMovers& lit) const;
  void take_otherwise(const FrameContext& context, const SceneShadows& shadows) const;
  void draw_rectangle(int id, const Vec4& rectangle, FrameStats& stats) const;

  // What the pictures depend on.
  struct Known {
    std::uint64_t scene = 0;
    Mat4 clip_from_pack{0};
    int width = 0, height = 0;
    MoverLights lights = MoverLights::kShadowed;
    const SceneShadows* shadows = nullptr;
    int points = 0;
    std::uint32_t look = 0;
    ShadeSettings shade;
    std::uint64_t shade_version = 0;
    bool shaded = false;
    bool visible_sets = true;  // which batches are shown depends on it
    std::vector<Mat4> poses;
    bool operator==(const Known&) const = default;
  };

  ShadowMaps maps_;
  ShadePass shade_;
  gpu::Program surface_, shadow_, light_;
  gpu::VertexArray no_vertices_;
  Canvas of_movers_, of_scene_;
  std::uint64_t targets_ = 0;  // made so often
  Known known_;
};

}  // namespace oriel
