#include "formats/image/flip.h"

#include <algorithm>
#include <array>

#include "formats/core/color.h"
#include "formats/core/vec.h"
#include "formats/image/filter.h"

namespace oriel {
namespace {

// Numbers of the paper, by section.
constexpr double kColorExponent = 0.7, kColorKnee = 0.4, kColorAtKnee = 0.95;  // 4.1.3: qc, pc, pt
constexpr double kFeatureWidthDeg = 0.082, kFeatureExponent = 0.5;             // 4.2.1: w; 4.2.2: qf

// sRGB primaries and D65, as columns.
const DMat3 kXyzFromRgb(0.41239080, 0.21263901, 0.01933082, 0.35758434, 0.71516868, 0.11919478, 0.18048079, 0.07219232,
                        0.95053215);
const DMat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);
const DVec3 kWhite = kXyzFromRgb * DVec3(1);

// Linear opponent space: luminance, red-green, blue-yellow.
DVec3 opponent_from_xyz(const DVec3& xyz) {
  const DVec3 v = xyz / kWhite;
  return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}

DVec3 xyz_from_opponent(const DVec3& c) {
  const double y = (c.x + 16) / 116;
  return DVec3(y + c.y / 500, y, y - c.z / 200) * kWhite;
}

// CIE L*a*b* with Hunt's effect: dark colours look less colourful.
DVec3 hunt_lab(const DVec3& linear_rgb) {
  const DVec3 v = kXyzFromRgb * linear_rgb / kWhite;
  DVec3 f;
  for (int i = 0; i < 3; ++i) {
    constexpr double kDelta = 6.0 / 29;
    f[i] = v[i] > kDelta * kDelta * kDelta ? std::cbrt(v[i]) : v[i] / (3 * kDelta * kDelta) + 4.0 / 29;
  }
  const double l = 116 * f.y - 16, hunt = 0.01 * l;
  return {l, hunt * 500 * (f.x - f.y), hunt * 200 * (f.y - f.z)};
}

// HyAB (Abasi et al. 2020): better for large differences than Euclid's.
double hyab(const DVec3& a, const DVec3& b) {
  const DVec3 d = a - b;
  return std::abs(d.x) + std::hypot(d.y, d.z);
}

double color_error(const DVec3& reference_rgb, const DVec3& test_rgb) {
  static const double kLargest = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kColorExponent);
  const double error = std::pow(hyab(hunt_lab(reference_rgb), hunt_lab(test_rgb)), kColorExponent);
  const double knee = kColorKnee * kLargest;
  if (error < knee) return kColorAtKnee / knee * error;
  return kColorAtKnee + (error - knee) / (kLargest - knee) * (1 - kColorAtKnee);
}

// A term of a contrast sensitivity function: a sqrt(pi / b) exp(-(pi x)² / b) for x in degrees.
struct SensitivityTerm {
  double a, b;
};
using Sensitivity = std::vector<SensitivityTerm>;

const std::array<Sensitivity, 3> kSensitivity = {
    {{{1, 0.0047}}, {{1, 0.0053}}, {{34.1, 0.04}, {13.5, 0.025}}}};  // luminance, red-green, blue-yellow

Plane seen(const Plane& plane, const Sensitivity& sensitivity, double pixels_per_degree) {
  constexpr double kWidest = 0.04;  // b: all kernels have one radius
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPiD * kPiD)) * pixels_per_degree));
  Plane out{plane.width, plane.height, std::vector<float>(plane.values.size(), 0)};
  std::vector<std::vector<double>> kernels;
  std::vector<double> weights;
  double total = 0;
  for (const auto& [a, b] : sensitivity) {
    const double sigma = std::sqrt(b / 2) / kPiD * pixels_per_degree;
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) sum += std::exp(-0.5 * x * x / (sigma * sigma));
    kernels.push_back(gaussian(sigma, radius));
    weights.push_back(a * std::sqrt(kPiD / b) * sum * sum);
    total += weights.back();
  }
  for (std::size_t k = 0; k < kernels.size(); ++k) {
    const Plane part = filtered(plane, kernels[k], kernels[k]);
    for (std::size_t i = 0; i < out.values.size(); ++i)
      out.values[i] += static_cast<float>(weights[k] / total * part.values[i]);
  }
  return out;
}

// A picture in the opponent space, by channel.
using Opponent = std::array<Plane, 3>;

Opponent opponent(const FloatImage& srgb) {
  const Plane empty{static_cast<int>(srgb.width), static_cast<int>(srgb.height), {}};
  Opponent out{empty, empty, empty};
  for (std::size_t i = 0; i < srgb.pixels.size(); i += 3) {
    DVec3 linear;
    for (int c = 0; c < 3; ++c) linear[c] = linear_from_srgb(srgb.pixels[i + static_cast<std::size_t>(c)]);
    const DVec3 v = opponent_from_xyz(kXyzFromRgb * linear);
    for (int c = 0; c < 3; ++c) out[static_cast<std::size_t>(c)].values.push_back(static_cast<float>(v[c]));
  }
  return out;
}

// What is left of it for the eye, linear RGB in [0, 1].
std::vector<DVec3> seen_colors(const Opponent& picture, double pixels_per_degree) {
  Opponent planes;
  for (std::size_t c = 0; c < 3; ++c) planes[c] = seen(picture[c], kSensitivity[c], pixels_per_degree);
  std::vector<DVec3> out;
  for (std::size_t i = 0; i < planes[0].values.size(); ++i) {
    const DVec3 v(planes[0].values[i], planes[1].values[i], planes[2].values[i]);
    out.push_back(glm::clamp(kRgbFromXyz * xyz_from_opponent(v), 0.0, 1.0));
  }
  return out;
}

// Scales positive and negative weights to sums of 1 and -1.
void normalize_signs(std::vector<double>& kernel) {
  double positive = 0, negative = 0;
  for (const double v : kernel) (v > 0 ? positive : negative) += v;
  for (double& v : kernel) v /= v > 0 ? positive : -negative;
}

// Strength of edges and of points, by pixel.
struct Features {
  std::vector<float> edges, points;
};

std::vector<float> magnitude(const Plane& plane, const std::vector<double>& derivative,
                             const std::vector<double>& smooth) {
  const Plane x = filtered(plane, derivative, smooth), y = filtered(plane, smooth, derivative);
  std::vector<float> out;
  for (std::size_t i = 0; i < x.values.size(); ++i) out.push_back(std::hypot(x.values[i], y.values[i]));
  return out;
}

Features features(const Plane& opponent_luminance, double pixels_per_degree) {
  const double sigma = 0.5 * kFeatureWidthDeg * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const std::vector<double> smooth = gaussian(sigma, radius);
  std::vector<double> first, second;
  for (int x = -radius; x <= radius; ++x) {
    const double g = smooth[static_cast<std::size_t>(x + radius)];
    first.push_back(-x * g);
    second.push_back((x * x / (sigma * sigma) - 1) * g);
  }
  normalize_signs(first);
  normalize_signs(second);
  Plane luminance = opponent_luminance;
  for (float& v : luminance.values) v = (v + 16) / 116;
  return {magnitude(luminance, first, smooth), magnitude(luminance, second, smooth)};
}

}  // namespace

FloatImage flip_map(const FloatImage& reference, const FloatImage& test, double pixels_per_degree) {
  const Opponent a = opponent(reference), b = opponent(test);
  const std::vector<DVec3> colors_a = seen_colors(a, pixels_per_degree), colors_b = seen_colors(b, pixels_per_degree);
  const Features features_a = features(a[0], pixels_per_degree), features_b = features(b[0], pixels_per_degree);
  FloatImage out{reference.width, reference.height, 1, {}};
  for (std::size_t i = 0; i < colors_a.size(); ++i) {
    const double feature = std::max(std::abs(features_a.edges[i] - features_b.edges[i]),
                                    std::abs(features_a.points[i] - features_b.points[i]));
    const double exponent = 1 - std::min(1.0, std::pow(feature / std::sqrt(2.0), kFeatureExponent));
    out.pixels.push_back(static_cast<float>(std::pow(color_error(colors_a[i], colors_b[i]), exponent)));
  }
  return out;
}

}  // namespace oriel
