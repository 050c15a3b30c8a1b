// A perceptual error metric: errors of frame pixels, relative to what a viewer can notice.
#pragma once

#include "bake/atlas/texel_map.h"
#include "bake/radiosity/texels/frame_pixels.h"
#include "formats/assets/lightmap.h"

namespace oriel {

// A fraction of the mean diffuse radiance seen from a view: errors of darker pixels are relative to it.
inline constexpr double kFrameFloor = 0.1;
// A fraction of the mean over all views: darker places count as black.
inline constexpr double kDarkFloor = 1e-3;

// The squared relative error of a pixel, mean over channels: error² / (light² + floor²), floor² = (kFrameFloor times
// the mean light A of the view)² + (kDarkFloor times that of all views)².
//
// The eye notices a step ΔL from a luminance L where ΔL exceeds a threshold. At its adaptation luminance, the mean A of
// what it sees, Weber's law holds: ΔL = k L with k = 1 to 2 %. Far below A the threshold stays, because light scattered
// in the eye and the display's black level veil dark places by a few percent of A. The threshold there is k times the
// sum of L and that veil. √(L² + (A / 10)²) has both limits. So error / threshold = (error / √(L² + (A / 10)²)) / k,
// and a root mean square of 1 to 2 % is just noticeable. A dark room among bright ones has a floor of its own: a viewer
// does not adapt to it at once, and a display cannot show both, so a thousandth of the mean over all views is black.
//
// error2: squared error. light2: square of the true light; for an estimate with variance v it is (estimate)² + v, so
// that an unresolved dark pixel has an error of 100 %, not more. floor2: from frame_floors2(). All three in the same
// unit, by channel.
inline double relative_square(const DVec3& error2, const DVec3& light2, const DVec3& floor2) {
  double sum = 0;
  for (int c = 0; c < 3; ++c)
    if (const double d = light2[c] + floor2[c]; d > 0) sum += error2[c] / d;
  return sum / 3;
}

// The squared floors of all views, by FramePixel::view. light(i): reflected light of pixel i, cd/m².
template <class Light>
std::vector<DVec3> frame_floors2(std::span<const FramePixel> pixels, const Light& light) {
  std::vector<DVec3> sum;
  std::vector<double> count;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t view = pixels[i].view;
    if (view >= sum.size()) sum.resize(view + 1, DVec3(0)), count.resize(view + 1);
    sum[view] += light(i), ++count[view];
  }
  DVec3 all(0);
  double views = 0;
  for (std::size_t e = 0; e < sum.size(); ++e) {
    sum[e] /= std::max(1.0, count[e]);
    all += sum[e], views += count[e] > 0;
  }
  const DVec3 dark = kDarkFloor * all / std::max(1.0, views);
  for (DVec3& mean : sum) mean = kFrameFloor * kFrameFloor * mean * mean + dark * dark;
  return sum;
}

// The mean of relative_square() over frame pixels, divided among texels. Texels are numbered over all pages in the
// order of the texel map. A texel without light (has_light false) is filled from others: its bilinear weight in a pixel
// goes to the other texels of that pixel.
class FrameError {
 public:
  FrameError(std::span<const FramePixel> pixels, std::span<const TexelMapPage> map, const std::vector<bool>& has_light);

  // Per texel: its contribution to the mean square; the contributions sum to it. Errors of texels that a pixel reads
  // together count as fully correlated, as filtered noise is. light: lux; variance: squared errors, lux².
  std::vector<float> squares(std::span<const Vec3> light, std::span<const Vec3> variance) const;

  // Per texel: the fraction of all frame pixels that it fills. The sum is 1, or 0 without pixels.
  const std::vector<float>& importance() const { return importance_; }

 private:
  std::vector<FramePixel> pixels_;  // `texel` holds texel numbers, `page` is unused
  std::vector<float> importance_;
};

// The square root of that mean square by the pages' standard errors: RadiosityReport::relative_error.
double stated_error(std::span<const TexelMapPage> map, std::span<const FramePixel> pixels,
                    std::span<const LightmapPage> pages);

}  // namespace oriel
