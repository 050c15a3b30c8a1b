// The interface of light estimators, which bake_radiosity refines until the error is as requested.
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
#include "bake/radiosity/texels/sharp_charts.h"

namespace oriel {

// The inputs of one lightmap bake. All of them must outlive the estimator.
struct RadiosityTask : LightmapScene {
  std::span<const FramePixel> pixels;  // that measure the error (texels/frame_error.h)
  const RadiosityOptions& options;
  Context& context;
  Stage paths;                         // counts path rays
  Stage quick;                         // counts shadow rays and probe rays
  const SharpCharts* sharp = nullptr;  // null: all light is the texels'

  // The cost so far, in path rays: two and a half to four shadow or probe rays take the time of one, as measured.
  std::uint64_t work() const { return paths.traced() + quick.traced() / kQuickRays; }
  static constexpr std::uint64_t kQuickRays = 3;
  // The cost at which refinement ends (RadiosityOptions::most_rays); may be infinite.
  double most_work(std::size_t texels) const {
    if (options.most_rays == 0) return HUGE_VAL;
    return static_cast<double>(std::max(options.most_rays, kMostTexelMean * texels));
  }
};

// Pages of the texel map's sizes, without light.
Radiosity empty_radiosity(std::span<const TexelMapPage> map, bool directional);

struct Texels;
class CacheQuery;
struct CachedLight;
struct Estimate;

// An estimator's data by texel, for light between the texels.
struct TexelLight {
  const Texels& texels;
  const CacheQuery& query;
  const CachedLight& cached;
  std::vector<Vec3> additional;       // by texel: light that gather rays leave out, lux; empty: none
  GroupedLight additional_grouped;    // the same by light group; may be empty
  const Estimate& reflected;          // by texel: filtered reflected light, `additional` included
  GroupedLight reflected_grouped;     // the same by light group; may be empty
  std::span<const float> importance;  // by texel: fraction of the frame pixels
};

class LightEstimator {
 public:
  virtual ~LightEstimator() = default;
  // Called once. Refines until the error of frames, relative, is as given (0: never), all samples are taken, or
  // RadiosityOptions::enough. Error kStopped.
  virtual Status refine(double error) = 0;
  // Writes the estimate as it stands: light, standard error, state and visible fraction of each covered texel, and the
  // report's fields. `light` is an empty_radiosity().
  virtual void write(Radiosity& light) const = 0;
  // Writes the light of valid texels by light group. groups: by group, empty pages of the texel map's sizes. False: the
  // estimator does not separate groups.
  virtual bool write_groups(std::vector<std::vector<LightmapPage>>&) const { return false; }
  // Data for finding light between the texels (detail.h); nothing from estimators that cannot.
  virtual std::optional<TexelLight> texel_light() const { return std::nullopt; }
};

}  // namespace oriel
