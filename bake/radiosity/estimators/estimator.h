// What estimates the light on an atlas' texels: bake_radiosity refines it until the error asked for holds.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "bake/radiosity/estimators/radiosity_options.h"
#include "bake/radiosity/texels/frame_pixels.h"
#include "bake/radiosity/texels/grouped_light.h"
#include "bake/radiosity/texels/lightmap_scene.h"

namespace oriel {

// What one bake of a lightmap is about. All of it outlives the estimator.
struct RadiosityTask : LightmapScene {
  std::span<const FramePixel> pixels;  // by which the error is told (texels/frame_error.h)
  const RadiosityOptions& options;
  Context& context;
  Stage paths;  // whose rays have been counted so far,
  Stage quick;  // and those towards lights and by probes of points

  // Rays of paths that take about the time of all: measured, two and a half to four quick ones do.
  std::uint64_t work() const { return paths.traced() + quick.traced() / kQuickRays; }
  static constexpr std::uint64_t kQuickRays = 3;
  // At which refinement ends (RadiosityOptions::most_rays); may be infinite.
  double most_work(std::size_t texels) const {
    if (options.most_rays == 0) return HUGE_VAL;
    return static_cast<double>(std::max(options.most_rays, kMostTexelMean * texels));
  }
};

// What an estimate is refined to.
struct Goal {
  double error = 0;             // of frames, relative; 0: all samples are taken
  bool longer_look_up = false;  // cached: rays look texels up from four times as far away, and follow paths till then
};

// Pages of the texel map's sizes, without light.
Radiosity empty_radiosity(std::span<const TexelMapPage> map, bool directional);

struct Texels;
class CacheQuery;
struct CachedLight;
struct Estimate;

// What an estimator knows of the texels beside their light.
struct TexelLight {
  const Texels& texels;
  const CacheQuery& query;
  const CachedLight& cached;
  std::vector<Vec3> beside;           // by texel: light that no gather ray looks for, lux; empty: none
  GroupedLight additional_grouped;    // the same by group of lamps, if asked
  const Estimate& reflected;          // by texel: light that surfaces reflect to it, as it is shown, `beside` in it
  GroupedLight reflected_grouped;     // the same by group of lamps, if asked
  std::span<const float> importance;  // of frames, by texel
};

class LightEstimator {
 public:
  virtual ~LightEstimator() = default;
  // Until the goal holds, all samples are taken, or RadiosityOptions::enough. Error kStopped.
  virtual Status refine(const Goal& goal) = 0;
  // The estimate as it stands: each covered texel's light, standard error and state, its visible share, and the
  // report's numbers of the estimate. `light` is an empty_radiosity().
  virtual void write(Radiosity& light) const = 0;
  // The same light by group of lamps, and so of valid texels alone; false: it does not tell whose light it is.
  // `groups`: of each group pages of the texel map's sizes without light.
  virtual bool write_groups(std::vector<std::vector<LightmapPage>>&) const { return false; }
  // What light between the texels can be found from (detail.h); nothing where all there is is theirs.
  virtual std::optional<TexelLight> texel_light() const { return std::nullopt; }
};

}  // namespace oriel
