// Paths of one texel or pixel alone, with the random numbers that a bake or a frame gives them, told vertex by vertex.
#pragma once

#include "bake/reference/reference.h"
#include "bake/run/options.h"

namespace oriel {

// Which paths of it, by number.
struct PathRange {
  std::uint32_t first = 0, count = 1;
};

// As `--estimator reference` takes them. The text ends with their mean and its standard error. Errors as
// prepare_scene() and lay_out_lightmap(); kUsage for a texel that is not there or shows no surface.
struct TexelAddress {
  std::uint32_t page = 0, x = 0, y = 0;
};
Result<std::string> replay_texel(const BakeOptions& options, const TexelAddress& texel, const PathRange& paths,
                                 Context& context);

// As `oriel-bake render` takes them. Error kUsage for a pixel outside the frame.
Result<std::string> replay_pixel(const Transport& transport, const Camera& camera, const ReferenceOptions& options,
                                 const PixelSample& first, std::uint32_t count);

}  // namespace oriel
