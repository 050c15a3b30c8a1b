#include "bake/trace/sky_sampler.h"

#include "formats/core/color.h"

namespace oriel {
namespace {

// A point of [0,1) with density proportional to a line from a at 0 to b at 1, from a uniform u.
double sample_linear(double a, double b, double u) {
  if (!(a + b > 0)) return u;
  const double x = u * (a + b) / (a + std::sqrt((1 - u) * a * a + u * b * b));
  return std::isfinite(x) ? std::min(x, 1 - 0x1p-30) : 0;
}

double lerp(double a, double b, double t) {
  return a + (b - a) * t;
}

}  // namespace

SkySampler::SkySampler(const SkyImage& image) : image_(&image) {
  const std::uint32_t w = image.width;
  cells_.resize(std::size_t{w} * (image.height + 1));
  std::vector<double> row_sum(w);
  double total = 0;
  for (std::uint32_t k = 0; k <= image.height; ++k) {
    const SkyRow row = sky_row(image, k);
    double sum = 0;
    for (std::uint32_t x = 0; x < w; ++x) {
      const Corners c = corners(row, x);
      row_sum[x] = sum += 0.25 * (c.upper_left + c.upper_right + c.lower_left + c.lower_right);
    }
    for (std::uint32_t x = 0; x < w; ++x)
      cells_[std::size_t{k} * w + x] = static_cast<float>(sum > 0 ? row_sum[x] / sum : (x + 1.0) / w);
    rows_.push_back(total += sum * (row.cos_upper - row.cos_lower) * (2 * kPiD / w));
  }
  if (!(total > 0)) rows_.clear();
}

SkySampler::Corners SkySampler::corners(const SkyRow& row, std::uint32_t x) const {
  const std::uint32_t w = image_->width, right = x + 1 < w ? x + 1 : 0;
  const Vec3 *upper = image_->texels.data() + std::size_t{row.upper} * w,
             *lower = image_->texels.data() + std::size_t{row.lower} * w;
  return {luminance(upper[x]), luminance(upper[right]), luminance(lower[x]), luminance(lower[right])};
}

SkySampler::Sample SkySampler::sample(const Vec2& v) const {
  const std::uint32_t w = image_->width;
  const double at = v.y * rows_.back();
  const auto k = static_cast<std::uint32_t>(
      std::min<std::ptrdiff_t>(std::upper_bound(rows_.begin(), rows_.end(), at) - rows_.begin(), image_->height));
  const double below = k > 0 ? rows_[k - 1] : 0;
  const auto first = cells_.begin() + static_cast<std::ptrdiff_t>(std::size_t{k} * w);
  const auto x =
      static_cast<std::uint32_t>(std::min<std::ptrdiff_t>(std::upper_bound(first, first + w, v.x) - first, w - 1));
  const double before = x > 0 ? first[x - 1] : 0;
  const SkyRow row = sky_row(*image_, k);
  const Corners c = corners(row, x);
  const double t = sample_linear(c.upper_left + c.upper_right, c.lower_left + c.lower_right,
                                 std::clamp((at - below) / (rows_[k] - below), 0.0, 1.0));
  const double left = lerp(c.upper_left, c.lower_left, t), right = lerp(c.upper_right, c.lower_right, t);
  const double s = sample_linear(left, right, std::clamp((v.x - before) / (first[x] - before), 0.0, 1.0));
  const double cosine = lerp(row.cos_upper, row.cos_lower, t), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const double phi = ((x + 0.5 + s) / w - 0.5) * 2 * kPiD - image_->rotation_rad;
  return {Vec3(DVec3(sine * std::cos(phi), cosine, sine * std::sin(phi))),
          static_cast<float>(lerp(left, right, s) / rows_.back())};
}

float SkySampler::pdf(const Vec3& direction) const {
  if (rows_.empty()) return 0;
  const Vec2 uv = sky_uv(*image_, direction);
  const double x = static_cast<double>(uv.x) * image_->width - 0.5, y = static_cast<double>(uv.y) * image_->height;
  const double column = std::floor(x);
  const auto k = static_cast<std::uint32_t>(std::clamp(y + 0.5, 0.0, static_cast<double>(image_->height)));
  const SkyRow row = sky_row(*image_, k);
  const double t = std::clamp((row.cos_upper - std::cos(uv.y * kPiD)) / (row.cos_upper - row.cos_lower), 0.0, 1.0);
  const Corners c =
      corners(row, column < 0 ? image_->width - 1 : std::min(static_cast<std::uint32_t>(column), image_->width - 1));
  const double left = lerp(c.upper_left, c.lower_left, t), right = lerp(c.upper_right, c.lower_right, t);
  return static_cast<float>(lerp(left, right, x - column) / rows_.back());
}

}  // namespace oriel
