// Shadows of movers on flat surfaces of the scene as soft-shadow textures, made by the processor (Herf 1997).
//
// Each patch is a rectangle of a plane in which some movers may shade a flat lamp. Its texels hold what they take of
// the lamp's light, less what the scene blocks anyhow. Patches lie side by side in one texture and are drawn over what
// is seen of their planes.
#pragma once

#include <map>
#include <tuple>

#include "player/movers/lit_movers.h"
#include "player/movers/shadow_patch.h"

namespace oriel {

class ShadowTextures {
 public:
  static Result<ShadowTextures> create(gpu::Dialect dialect);

  // Makes the textures of a frame. Casters that these do all for do not cast by maps any more.
  void prepare(const GpuScene& scene, const View& view, std::span<LitMovers> lights, const FrameOptions& options);
  // Into the bound picture what movers take of all lights, lux; or, of that light, zeros where there are textures.
  void draw(const GpuScene& scene, const View& view, const gpu::Texture2d& surfaces,
            std::optional<std::uint32_t> zeros_of, FrameStats& stats) const;

 private:
  void know(const GpuScene& scene);
  Bounds rest_below(const LitMovers::Caster& caster, const LitMovers& lit, const Frustum& frustum) const;
  bool is_in_the_way(const LitMovers::Caster& caster, const LitMovers& lit) const;
  void plan(const GpuScene& scene, const View& view, LitMovers& lit);
  void lay_out(const View& view, bool coarse);
  bool place_all(const View& view, double coarser);
  void paint(const GpuScene& scene);
  template <class Visit>
  void visit_tiles(const Visit& visit);
  void upload();

  gpu::Program program_;
  gpu::Texture2d atlas_;
  std::uint64_t known_ = 0;  // geometry_serial()
  FlatSurfaces flat_;
  float far_ = 0;  // metres: farther than the scene goes
  Occluders still_;
  std::vector<MoverShape> movers_;  // by Pack::movers
  // Light, its samples, plane, level, place on the plane's grid.
  using TileKey = std::tuple<std::uint32_t, int, std::size_t, int, int, int>;
  std::map<TileKey, std::shared_ptr<StillTile>> tiles_;  // that are known
  std::uint64_t tiles_of_ = 0;                           // serial()
  std::vector<ShadowPatch> patches_;
  std::vector<IVec2> places_;  // of the patches in the atlas
  std::vector<PatchPainter> painters_;
};

}  // namespace oriel
