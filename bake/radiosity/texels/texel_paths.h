// Unbiased path tracing from the sample points of a texel.
#pragma once

#include "bake/jobs/context.h"
#include "bake/radiosity/texels/lightmap_scene.h"
#include "formats/core/archive.h"

namespace oriel {

// Moments of the path samples of one texel or point, lux.
struct TexelSums {
  DVec3 sum{0}, squares{0};
  DVec3 vector{0};  // first moment of luminance, as in IrradianceSample
  double mean = 0;
  std::uint32_t count = 0;  // paths; fewer than requested where points are buried

  void add(const IrradianceSample& e) {
    const DVec3 value(e.direct + e.indirect);
    sum += value;
    squares += value * value;
    vector += DVec3(e.vector);
    mean += e.mean;
    ++count;
  }
  DVec3 irradiance() const { return count > 0 ? sum / double(count) : DVec3(0); }
  // The squared standard error of irradiance(), lux². For a single path, whose spread is unknown, it is the square of
  // the value.
  DVec3 variance() const {
    const DVec3 m = irradiance();
    if (count < 2) return m * m;
    return glm::max(DVec3(0), squares / double(count) - m * m) / double(count - 1);
  }
};

inline void fields(Archive& archive, TexelSums& s) {
  archive(s.sum, s.squares, s.vector, s.mean, s.count);
}

// A texel of the map: a page and an index into its TexelMapPage::texel.
struct MapTexel {
  std::size_t page = 0, index = 0;
};
// A range of path numbers, `end` excluded.
struct PathNumbers {
  std::uint32_t first = 0, end = 0;
};

class TexelPaths {
 public:
  // directional: fill IrradianceSample's moments, too. eyes: as in list_texels().
  TexelPaths(const LightmapScene& scene, std::span<const Vec3> eyes, bool directional, std::uint64_t seed,
             const Context& context)
      : t_(scene.transport), scene_(scene), eyes_(eyes), directional_(directional), seed_(seed), context_(context) {}

  // Adds the paths of that range to `sums`, and their rays to `rays`. A path whose point is inside other geometry
  // (is_buried) or outside the texel's part (TexelPart) is left out.
  void add(const MapTexel& texel, const PathNumbers& paths, TexelSums& sums, std::uint64_t& rays) const;

 private:
  SurfacePoint point_of(const MapTexel& texel, const Vec3& u) const;
  bool any_buried(const MapTexel& texel, std::uint64_t stream, std::uint64_t& rays) const;

  const Transport& t_;
  LightmapScene scene_;
  std::span<const Vec3> eyes_;
  bool directional_;
  std::uint64_t seed_;
  const Context& context_;
};

}  // namespace oriel
