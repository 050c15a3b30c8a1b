// The real programs, run one after the other, and frames compared.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bake/reference/reference.h"
#include "formats/image/image.h"

namespace oriel::test {

// Runs a program of the build with arguments (shell syntax); its exit code. Output goes to `log` in the working folder.
int run(const std::filesystem::path& folder, const std::string& command);

// Means over n × n pixels of an RGB image.
FloatImage shrink(const FloatImage& image, std::uint32_t n);

// Root of the mean of |x - r|² / (r² + (0.01 mean r)²) over pixels and channels, and the same of the reference's own
// noise.
struct FrameError {
  double rel_rmse = 0, noise = 0;
  double net() const;  // with the noise removed in quadrature
  double n_rmse = 0;   // root of the mean of |x - r|² over the mean of r
  double bias = 0;     // mean(x) / mean(r) - 1, over all channels
};
FrameError compare(const FloatImage& frame, const std::vector<Vec3>& reference, const std::vector<Vec3>& noise);

// Peak signal-to-noise ratio in dB of tone-mapped values (sRGB of exposure * radiance, clamped to [0,1]) where mask is
// set.
double psnr_srgb(const FloatImage& frame, const std::vector<Vec3>& reference, float exposure,
                 const std::vector<char>& mask);

}  // namespace oriel::test
