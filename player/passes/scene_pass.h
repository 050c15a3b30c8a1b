// The scene itself: depth first, then the light of opaque surfaces, then see-through ones from far to near.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <set>
#include <span>

#include "player/gpu/program.h"
#include "player/movers/bright_pass.h"
#include "player/scene/frame_context.h"

namespace oriel {

// Weights of the parts of the shading equation.
struct SceneWeights {
  float diffuse = 1;
  float undirected = 1;  // R E / pi on surfaces that no reflector's image covers
  float emission = 1;
};

// Bits of the stencil: the number of the opaque reflector that a pixel shows (kMoverBits: a mover), and whether a
// see-through one lies before it.
inline constexpr GLuint kReflectorBits = 0x7f;
inline constexpr GLuint kSeeThroughBit = 0x80;

// What a mirror shows of the opaque scene.
struct MirroredScene {
  std::vector<DrawBatch> shown;
  std::span<const std::uint32_t> dark;  // of Pack::emitters, those that do not shine
  // Materials of reflectors that are marked in the stencil: there the undirected part is left out.
  std::set<std::uint32_t> reflective;
};

// Draws what is seen through one of GpuScene::glass(), in place of what lies behind it; may bind what it likes. Gives
// whether it has: else the body is drawn thin.
using DrawGlass = std::function<Result<bool>(std::size_t body)>;

class ScenePass {
 public:
  static Result<ScenePass> create(const gpu::Device& device);

  // Depth of the opaque scene into the bound framebuffer. shown: what of it.
  void draw_depth(const FrameContext& context, std::span<const DrawBatch> shown) const;
  // By triangle of the indices that are bound for what is shown, a range a batch: whether a sample of it is seen, over
  // that depth. Waits for the device, which shades_hidden.
  std::vector<std::uint32_t> mark_seen(const FrameContext& context, std::span<const DrawBatch> shown) const;
  // Light of the opaque scene, over that depth. Pixels whose reflector bits are set hold S already: it is kept and
  // added to, without the undirected part. reflective: materials with such pixels. change: what
  // movers take, if anything.
  void draw_opaque(const FrameContext& context, std::span<const DrawBatch> shown, const SceneWeights& weights,
                   const std::set<std::uint32_t>& reflective, const std::optional<BrightChange>& change) const;
  // The sky where nothing was drawn, of a map; an even one is what the target was cleared to. alpha: its own there.
  void draw_sky(const FrameContext& context, float alpha) const;
  // Depth of that part of the scene, of all of the scene's indices.
  void draw_reflected_depth(const FrameContext& context, const MirroredScene& mirrored) const;
  // Its light as the mirror shows it, and its depth where it is not there yet; a: 1 / distance from the view's eye, or
  // for an orthographic view 1 / its depth, at least kClosest.
  void draw_reflected(const FrameContext& context, const MirroredScene& mirrored) const;
  // See-through surfaces, blended; the undirected part only where the see-through bit is clear, in a mirrored view,
  // which has no stencil, everywhere. glass: of bodies; none: all are drawn thin. Errors of it.
  Status draw_transparent(const FrameContext& context, const SceneWeights& weights, const DrawGlass& glass = {}) const;

 private:
  // Where a page has sharp light it takes a program of its own: software rasterisers run every branch.
  struct Shading {
    gpu::Program smooth, points, suns;
    static Result<Shading> create(std::string_view name, gpu::Dialect dialect, const std::string& define = {});
    const gpu::Program& of(const LoadedLightmap& page, const GpuSharpLight& light) const {
      return !page.sharp_at ? smooth : light.suns ? suns : points;
    }
    template <class Visit>
    void each(const Visit& visit) const {
      for (const gpu::Program* program : {&smooth, &points, &suns}) program->use(), visit(*program);
    }
  };
  void draw_depths(const FrameContext& context, std::span<const DrawBatch> shown) const;
  // Gives the program, in use.
  const gpu::Program& set_material(const Shading& shading, const GpuScene& scene, std::uint32_t material,
                                   std::int32_t lightmap_page) const;

  gpu::Program depth_, plain_depth_, seen_, sky_;
  // plain: of surfaces without normal map, cut-outs or change by movers, that are lit; reflected: those in the image of
  // a mirror.
  Shading opaque_, plain_, reflected_, transparent_;
};

}  // namespace oriel
