// The reference: path-traced frames, by component. Unbiased; every faster way is judged against it.
#pragma once

#include <vector>

#include "bake/jobs/context.h"
#include "bake/trace/path.h"

namespace oriel {

struct ReferenceOptions {
  int width = 640, height = 360;
  std::uint32_t samples = 64;  // paths a pixel for each component; best a power of two
  bool antialias = true;       // false: every ray through the pixel's centre, as a rasteriser without samples sees it
};

// Row 0 is the top. cd/m². total = diffuse + specular + emission + what shows through transmission and cut-outs.
struct ReferenceFrame {
  int width = 0, height = 0;
  std::vector<Vec3> total;
  std::vector<Vec3> diffuse;        // D: reflected by the diffuse lobe of the first surface, all bounces before it
  std::vector<Vec3> specular;       // S: reflected by its specular lobe
  std::vector<Vec3> noise;          // standard error of total
  std::vector<Vec3> diffuse_noise;  // and of diffuse
};

Result<ReferenceFrame> render_reference(const Transport& transport, const Camera& camera,
                                        const ReferenceOptions& options, Context& context);

// The primary ray through (x, y) in pixels from the top left of a width × height frame.
Ray camera_ray(const Camera& camera, float x, float y, int width, int height);

}  // namespace oriel
