// What the shade of movers needs to know of a scene that stands still: lights that stand for all that comes from
// everywhere, what each of them sees, and cells of space. No OpenGL.
#pragma once

#include <atomic>

#include "formats/query/scattered_lights.h"
#include "player/images/image_source.h"
#include "player/movers/blocked_lights.h"
#include "player/movers/hemisphere_map.h"
#include "player/scene/lights.h"

namespace oriel {

inline constexpr int kStillSide = 64;  // texels of a light's map of what stands still

struct ShadeScene {
  std::vector<ScatteredLight> lights;
  std::vector<HemisphereMap> maps;  // by light
  // By light kStillSide² texels, row by row: depth of the first thing that stands still.
  std::vector<float> still;
  std::vector<ShadeCell> cells;
  // As lamps shone when the lights were drawn: by material, and the sky.
  std::vector<Vec3> emission_then;
  Vec3 sky_then{0};
  Bounds bounds;             // of lit surfaces
  std::vector<Vec4> places;  // by mover: the lights are those that matter in these spheres
  // What lights are drawn from, and what stands still; they do not read the pack any more.
  std::shared_ptr<const ScatterSources> sources;
  std::shared_ptr<const LampScene> around;
  double seconds = 0;  // that it took

  // Whether what stands still hides all of a box from a light, as its map tells it.
  bool hides(std::uint32_t light, const Bounds& box) const;
  std::vector<ShadeLight> shade_lights() const;
  // Intensities of lights as lamps shine now. materials, sky: as they shine. Errors of images.
  Result<std::vector<Vec3>> shine(const ImageSource& images, std::span<const Material> materials,
                                  const Vec3& sky) const;
};

// A leaf and the lights that movers may block there, ascending.
struct CellLights {
  std::uint32_t cell = 0;
  std::vector<std::uint32_t> lights;
};
// Leaves in view where they may block some. blocked: of the scene's cells and lights.
std::vector<CellLights> lights_in_view(const ShadeScene& scene, const BlockedLights& blocked, const Frustum& frustum);

// Whether lights that matter in these places matter to movers in those spheres.
bool holds(std::span<const Vec4> places, std::span<const Vec4> spheres);

// A ShadeScene in two steps. The first reads the pack and its images; the second, which takes longer, neither.
class ShadeMaker {
 public:
  // pack: whose textures are all there. baked: how its lamps shone then. Errors of images.
  static Result<ShadeMaker> begin(const Pack& pack, const ImageSource& images, const BakedLamps& baked);
  // The same for movers that have gone elsewhere.
  static ShadeMaker again(const ShadeScene& scene);
  // In any thread. movers: spheres. lights: 1 to kMostShadeLights. stop: ends it early, with what is of no use.
  ShadeScene finish(std::span<const Vec4> movers, std::uint32_t lights, const std::atomic<bool>* stop);

 private:
  ShadeScene scene_;
  std::vector<ShadeTriangle> triangles_;  // whose cells are still to be made
};

}  // namespace oriel
