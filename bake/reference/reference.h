// The reference: path-traced frames, by component. Unbiased; every faster way is judged against it.
#pragma once

#include <vector>

#include "bake/jobs/context.h"
#include "bake/trace/path.h"

namespace oriel {

struct ReferenceOptions {
  int width = 640, height = 360;
  std::uint32_t samples = 64;  // paths a pixel for each component at most; best a power of two
  bool antialias = true;       // false: every ray through the pixel's centre, as a rasteriser without samples sees it
  double error = 0;            // stop at the power of two whose noise() is at most this; 0: take all samples
};

// Row 0 is the top. cd/m². total = direct + indirect + specular + emission.
struct ReferenceFrame {
  int width = 0, height = 0;
  std::uint32_t samples = 0;        // taken of each pixel
  std::vector<Vec3> total;          //
  std::vector<Vec3> direct;         // reflected by the diffuse lobe of the first surface, straight from emitters
  std::vector<Vec3> indirect;       // and after bounces
  std::vector<Vec3> specular;       // S: reflected by its specular lobe
  std::vector<Vec3> emission;       // of the first surface or the sky, and what shows through transmission and cut-outs
  std::vector<Vec3> noise;          // standard error of total,
  std::vector<Vec3> diffuse_noise;  // of D = direct + indirect
  std::vector<Vec3> specular_noise;  // and of specular

  std::vector<Vec3> diffuse() const;  // D
  // Root of the mean of noise² / (total² + (0.01 mean)²) over pixels and channels, mean by channel.
  double relative_noise() const;
};

// Paths start as pixel_ray() of formats/camera has them. Error kStopped only.
Result<ReferenceFrame> render_reference(const Transport& transport, const Camera& camera,
                                        const ReferenceOptions& options, Context& context);

}  // namespace oriel
