#include "formats/image/relative_error.h"

#include <limits>

#include "formats/core/vec.h"

namespace oriel {
namespace {

Status check_same_shape(const FloatImage& a, const FloatImage& b) {
  if (a.channels == 3 && b.channels == 3 && a.width == b.width && a.height == b.height) return {};
  return invalid("", "found pictures of {} x {} x {} and {} x {} x {}, expected three channels and one size", a.width,
                 a.height, a.channels, b.width, b.height, b.channels);
}

DVec3 pixel(const FloatImage& image, std::size_t i) {
  return {image.pixels[3 * i], image.pixels[3 * i + 1], image.pixels[3 * i + 2]};
}

double sum(const DVec3& v) {
  return v.x + v.y + v.z;
}

}  // namespace

double RelativeError::net() const {
  const double square = rel_rmse * rel_rmse - noise * noise;
  return square < 0 ? 0 : std::sqrt(square);  // what is not a number stays one that is none
}

Result<RelativeError> relative_error(const FloatImage& frame, const FloatImage& reference, const FloatImage& noise,
                                     const Region& region) {
  ORIEL_TRY_VOID(check_same_shape(frame, reference));
  const bool noisy = !noise.pixels.empty();
  if (noisy) ORIEL_TRY_VOID(check_same_shape(noise, reference));
  const std::size_t pixels = std::size_t{reference.width} * reference.height;
  DVec3 mean(0), mean_frame(0);
  double count = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!counts(region, i)) continue;
    mean += pixel(reference, i);
    mean_frame += pixel(frame, i);
    ++count;
  }
  RelativeError e;
  if (sum(mean) == 0) {
    if (sum(mean_frame) != 0) e.rel_rmse = e.n_rmse = e.bias = std::numeric_limits<double>::infinity();
    return e;
  }
  mean /= count;
  mean_frame /= count;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!counts(region, i)) continue;
    const DVec3 r = pixel(reference, i), off = pixel(frame, i) - r, s = noisy ? pixel(noise, i) : DVec3(0);
    const DVec3 scale = r * r + 1e-4 * mean * mean;
    e.n_rmse += sum(off * off) / (3 * count);
    for (int c = 0; c < 3; ++c) {
      if (scale[c] == 0) continue;
      e.rel_rmse += off[c] * off[c] / scale[c] / (3 * count);
      e.noise += s[c] * s[c] / scale[c] / (3 * count);
    }
  }
  e.rel_rmse = std::sqrt(e.rel_rmse);
  e.noise = std::sqrt(e.noise);
  e.n_rmse = std::sqrt(e.n_rmse) * 3 / sum(mean);
  e.bias = sum(mean_frame) / sum(mean) - 1;
  return e;
}

FloatImage shrink(const FloatImage& image, std::uint32_t n) {
  FloatImage out{image.width / n, image.height / n, image.channels, {}};
  out.pixels.resize(std::size_t{out.width} * out.height * out.channels);
  const std::size_t c = image.channels;
  for (std::size_t y = 0; y < std::size_t{out.height} * n; ++y)
    for (std::size_t i = 0; i < std::size_t{out.width} * n * c; ++i)
      out.pixels[y / n * out.width * c + i / c / n * c + i % c] +=
          image.pixels[y * image.width * c + i] / static_cast<float>(n * n);
  return out;
}

}  // namespace oriel
