#include "formats/core/sh.h"

#include <array>

#include "formats/core/check.h"

namespace oriel {
namespace {

int bands_of(std::size_t count) {
  const int bands = static_cast<int>(std::lround(std::sqrt(static_cast<double>(count))));
  ORIEL_CHECK_EQ(static_cast<std::size_t>(sh_count(bands)), count);
  ORIEL_CHECK_LE(bands, kMaxShBands);
  return bands;
}

// Normalised associated Legendre functions times sin^m and cos^m of the azimuth, by the stable recurrences: along the
// diagonal, then up the bands. Factors depend on (l, m) only.
struct Recurrence {
  struct Step {
    double a, b;  // N_l = a z N_(l-1) + b N_(l-2)
  };
  std::array<double, kMaxShBands> diagonal{};  // N_mm over N_(m-1)(m-1)
  std::array<std::array<Step, kMaxShBands>, kMaxShBands> up{};

  Recurrence() {
    for (int m = 1; m < kMaxShBands; ++m) diagonal[static_cast<std::size_t>(m)] = std::sqrt((2.0 * m + 1) / (2.0 * m));
    for (int m = 0; m < kMaxShBands; ++m)
      for (int l = m + 1; l < kMaxShBands; ++l) {
        const double l2 = l * l, m2 = m * m, before = (l - 1) * (l - 1);
        const double a = std::sqrt((4 * l2 - 1) / (l2 - m2));
        const double b = l == m + 1 ? 0 : -a * std::sqrt((before - m2) / (4 * before - 1));
        up[static_cast<std::size_t>(m)][static_cast<std::size_t>(l)] = {a, b};
      }
  }
};

template <class T>
void evaluate(const DVec3& d, std::span<T> out) {
  static const Recurrence steps;
  const int bands = bands_of(out.size());
  const double root = std::sqrt(0.25 / kPiD);
  double diagonal = root;       // N_mm without the power of sinθ
  double cosine = 1, sine = 0;  // sin^m θ times cos mφ and sin mφ: polynomials in x and y
  for (int m = 0; m < bands; ++m) {
    if (m > 0) {
      diagonal *= steps.diagonal[static_cast<std::size_t>(m)];
      const double next = d.x * cosine - d.y * sine;
      sine = d.x * sine + d.y * cosine;
      cosine = next;
    }
    double before = 0, n = diagonal * (m > 0 ? std::sqrt(2.0) : 1.0);
    for (int l = m; l < bands; ++l) {
      if (l > m) {
        const auto& [a, b] = steps.up[static_cast<std::size_t>(m)][static_cast<std::size_t>(l)];
        const double next = a * d.z * n + b * before;
        before = n;
        n = next;
      }
      out[static_cast<std::size_t>(sh_index(l, m))] = static_cast<T>(n * cosine);
      if (m > 0) out[static_cast<std::size_t>(sh_index(l, -m))] = static_cast<T>(n * sine);
    }
  }
}

double legendre(int l, double x) {
  if (l < 0) return 1;  // P_(-1) = P_0
  double before = 1, p = x;
  if (l == 0) return 1;
  for (int i = 2; i <= l; ++i) {
    const double next = ((2 * i - 1) * x * p - (i - 1) * before) / i;
    before = p;
    p = next;
  }
  return p;
}

// Nodes and weights of Gauss and Legendre's rule on [-1, 1].
std::vector<DVec2> gauss_legendre(int count) {
  std::vector<DVec2> rule;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(kPiD * (i + 0.75) / (count + 0.5)), slope = 1;
    for (int step = 0; step < 50; ++step) {
      slope = count * (x * legendre(count, x) - legendre(count - 1, x)) / (x * x - 1);
      x -= legendre(count, x) / slope;
    }
    rule.emplace_back(x, 2 / ((1 - x * x) * slope * slope));
  }
  return rule;
}

// Directions and weights that integrate polynomials up to `degree` exactly.
struct SphereRule {
  std::vector<DVec3> directions;
  std::vector<double> weights;
};
SphereRule sphere_rule(int degree) {
  SphereRule rule;
  const int around = degree + 1;
  for (const DVec2& ring : gauss_legendre(degree / 2 + 1))
    for (int i = 0; i < around; ++i) {
      const double r = std::sqrt(1 - ring.x * ring.x), phi = 2 * kPiD * (i + 0.5) / around;
      rule.directions.emplace_back(r * std::cos(phi), r * std::sin(phi), ring.x);
      rule.weights.push_back(ring.y * 2 * kPiD / around);
    }
  return rule;
}

}  // namespace

void evaluate_sh(const DVec3& direction, std::span<double> out) {
  evaluate(direction, out);
}
void evaluate_sh(const Vec3& direction, std::span<float> out) {
  evaluate(DVec3(direction), out);
}

double cosine_factor(int l) {
  if (l == 1) return 2 * kPiD / 3;
  if (l % 2 != 0) return 0;
  double choose = 1;  // l! / (2^l (l/2)!²)
  for (int i = 1; i <= l / 2; ++i) choose *= (2.0 * i - 1) / (2.0 * i);
  return (l / 2 % 2 == 0 ? -1 : 1) * 2 * kPiD * choose / ((l + 2.0) * (l - 1.0));
}

void turn_zonal(std::span<const double> zonal, const DVec3& axis, std::span<double> out) {
  evaluate_sh(axis, out);
  for (int l = 0, i = 0; i < static_cast<int>(out.size()); ++l) {
    const double scale = std::sqrt(4 * kPiD / (2 * l + 1)) * zonal[static_cast<std::size_t>(l)];
    for (int m = -l; m <= l; ++m, ++i) out[static_cast<std::size_t>(i)] *= scale;
  }
}

void window_sh(double lambda, std::span<double> coefficients) {
  for (int l = 0, i = 0; i < static_cast<int>(coefficients.size()); ++l)
    for (int m = -l; m <= l; ++m, ++i)
      coefficients[static_cast<std::size_t>(i)] /= 1 + lambda * l * l * (l + 1) * (l + 1);
}

double window_without_ringing(std::span<const double> coefficients, double tolerance) {
  const int bands = bands_of(coefficients.size());
  static const SphereRule directions = sphere_rule(4 * kMaxShBands);
  const std::size_t count = coefficients.size();
  // Band sums at each direction: the window scales whole bands.
  std::vector<double> sums(directions.directions.size() * static_cast<std::size_t>(bands));
  std::vector<double> y(count);
  for (std::size_t d = 0; d < directions.directions.size(); ++d) {
    evaluate_sh(directions.directions[d], y);
    for (int l = 0, i = 0; l < bands; ++l)
      for (int m = -l; m <= l; ++m, ++i)
        sums[d * static_cast<std::size_t>(bands) + static_cast<std::size_t>(l)] +=
            y[static_cast<std::size_t>(i)] * coefficients[static_cast<std::size_t>(i)];
  }
  const double mean = coefficients[0] * std::sqrt(0.25 / kPiD);
  const auto rings = [&](double lambda) {
    for (std::size_t d = 0; d < sums.size(); d += static_cast<std::size_t>(bands)) {
      double value = 0;
      for (int l = 0; l < bands; ++l)
        value += sums[d + static_cast<std::size_t>(l)] / (1 + lambda * l * l * (l + 1) * (l + 1));
      if (value < -tolerance * mean) return true;
    }
    return false;
  };
  if (!(mean > 0) || !rings(0)) return 0;
  double low = 1e-6, high = 1e-6;
  while (rings(high) && high < 1e6) high *= 4;
  if (high > low) low = high / 4;
  while (high > 1.01 * low) {
    const double middle = std::sqrt(low * high);
    (rings(middle) ? low : high) = middle;
  }
  return high;
}

}  // namespace oriel
