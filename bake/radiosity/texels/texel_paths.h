// Unbiased paths from the points of a texel.
#pragma once

#include "bake/jobs/context.h"
#include "bake/radiosity/texels/lightmap_scene.h"
#include "formats/core/archive.h"

namespace oriel {

// What the paths of one texel or point found, lux.
struct TexelSums {
  DVec3 sum{0}, squares{0};
  DVec3 vector{0};  // of luminance, as IrradianceSample's
  double mean = 0;
  std::uint32_t count = 0;  // paths; fewer than asked where points are buried

  void add(const IrradianceSample& e) {
    const DVec3 value(e.direct + e.indirect);
    sum += value;
    squares += value * value;
    vector += DVec3(e.vector);
    mean += e.mean;
    ++count;
  }
  DVec3 irradiance() const { return count > 0 ? sum / double(count) : DVec3(0); }
  // Squared standard error of irradiance(). One path says nothing of its spread: its error is taken to be as large as
  // itself.
  DVec3 variance() const {
    const DVec3 m = irradiance();
    if (count < 2) return m * m;
    return glm::max(DVec3(0), squares / double(count) - m * m) / double(count - 1);
  }
};

inline void fields(Archive& archive, TexelSums& s) {
  archive(s.sum, s.squares, s.vector, s.mean, s.count);
}

// A texel of the map: of a page the index into TexelMapPage::texel.
struct MapTexel {
  std::size_t page = 0, index = 0;
};
struct PathNumbers {
  std::uint32_t first = 0, end = 0;
};

class TexelPaths {
 public:
  // directional: sample so that IrradianceSample's moments are known, too. eyes: as list_texels().
  TexelPaths(const LightmapScene& scene, std::span<const Vec3> eyes, bool directional, std::uint64_t seed,
             const Context& context)
      : t_(scene.transport), scene_(scene), eyes_(eyes), directional_(directional), seed_(seed), context_(context) {}

  // So many paths of a texel, numbered from `first`. Points inside other geometry (independent probes meet little but
  // back faces of one-sided materials) are left out, and so is what a thin wall cuts off the texel. Adds to rays.
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
