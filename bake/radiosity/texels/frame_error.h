// The error that people see: how far the light of frames' pixels is off, relative to what an eye takes notice of.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/texels/frame_pixels.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// Of the mean diffuse radiance that an eye sees: darker pixels are held against this.
inline constexpr double kFrameFloor = 0.1;
// Of the mean over all eyes: in darker places all is black.
inline constexpr double kDarkFloor = 1e-3;

// The squared relative error of a pixel, mean over channels: error² / (light² + floor²), floor² = (kFrameFloor times
// the mean light A that the eye sees)² + (kDarkFloor times that of all eyes)².
//
// An eye tells a step ΔL in luminance from L where it exceeds a threshold. In the light that it is adapted to, the mean
// A of what it sees, Weber's law holds: ΔL = k L with k = 1 to 2 %. Far below A the threshold no longer falls with L,
// since light scattered in the eye and the display's black lie over dark places: a few percent of A, and the threshold
// there is k times what is seen, L and veil together. That of L² + (A / 10)² has both limits. So
// error / threshold = (error / √(L² + (A / 10)²)) / k, and a root mean square of 1 to 2 % is what can just be seen.
// Nobody adapts to a closed shell in an instant, nor does a display show it beside the rest: a thousandth of the mean
// over all eyes is black.
//
// light2 is the square of the true light. Of an estimate with variance v that is (estimate)² + v: a dark pixel that is
// not known at all counts as its light, not as more.
inline double relative_square(const DVec3& error2, const DVec3& light2, const DVec3& floor2) {
  double sum = 0;
  for (int c = 0; c < 3; ++c)
    if (const double d = light2[c] + floor2[c]; d > 0) sum += error2[c] / d;
  return sum / 3;
}

// Floors of all eyes that see these pixels, squared; light: of pixel i, without what it emits, cd/m².
template <class Light>
std::vector<DVec3> frame_floors2(std::span<const FramePixel> pixels, const Light& light) {
  std::vector<DVec3> sum;
  std::vector<double> count;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t eye = pixels[i].eye;
    if (eye >= sum.size()) sum.resize(eye + 1, DVec3(0)), count.resize(eye + 1);
    sum[eye] += light(i), ++count[eye];
  }
  DVec3 all(0);
  double eyes = 0;
  for (std::size_t e = 0; e < sum.size(); ++e) {
    sum[e] /= std::max(1.0, count[e]);
    all += sum[e], eyes += count[e] > 0;
  }
  const DVec3 dark = kDarkFloor * all / std::max(1.0, eyes);
  for (DVec3& mean : sum) mean = kFrameFloor * kFrameFloor * mean * mean + dark * dark;
  return sum;
}

// The mean square of that over pixels, by texel. Texels are numbered over all pages in the order of the texel map.
// Those without light of their own take that of others: their shares of pixels go to the rest of what is read there.
class FrameError {
 public:
  FrameError(std::span<const FramePixel> pixels, std::span<const TexelMapPage> map, const std::vector<bool>& has_light);

  // By texel: its part of the mean square, which is their sum. Errors of texels that a pixel reads together are taken
  // to be one: noise that the filter spread is. light: lux; variance: squared errors, lux².
  std::vector<float> squares(std::span<const Vec3> light, std::span<const Vec3> variance) const;

  // By texel: the share of all pixels that it fills. Their sum is 1, or 0 where there is no pixel.
  const std::vector<float>& shares() const { return shares_; }

 private:
  std::vector<FramePixel> pixels_;  // texel: numbers; page: of no use
  std::vector<float> shares_;
};

// RadiosityReport::relative_error: the root of that sum, of what pages state.
double stated_error(std::span<const TexelMapPage> map, std::span<const FramePixel> pixels,
                    std::span<const LightmapPage> pages);

}  // namespace oriel
