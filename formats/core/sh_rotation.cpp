#include <cstdlib>

#include "formats/core/check.h"
#include "formats/core/sh.h"

namespace oriel {
namespace {

std::size_t band_offset(int l) {
  return static_cast<std::size_t>(l) * static_cast<std::size_t>(4 * l * l - 1) / 3;  // Σ (2k+1)², k < l
}

// One band's entry from the band before it: Ivanic & Ruedenberg 1996, table 1 and 2. r(l, m, n) reads finished bands.
template <class Read>
class BandEntry {
 public:
  BandEntry(const Read& r, int l, int m, int n) : r_(r), l_(l), m_(m), n_(n) {}

  double value() const {
    const int a = std::abs(m_);
    const double below = std::abs(n_) == l_ ? 2.0 * l_ * (2 * l_ - 1) : static_cast<double>(l_ + n_) * (l_ - n_);
    const double u = std::sqrt((l_ + m_) * (l_ - m_) / below);
    const double v = 0.5 * std::sqrt((m_ == 0 ? 2 : 1) * (l_ + a - 1.0) * (l_ + a) / below) * (m_ == 0 ? -1 : 1);
    const double w = m_ == 0 ? 0 : -0.5 * std::sqrt((l_ - a - 1.0) * (l_ - a) / below);
    // A factor of 0 goes with indices that the band before does not have.
    return (u != 0 ? u * p(0, m_) : 0) + (v != 0 ? v * v_part() : 0) + (w != 0 ? w * w_part() : 0);
  }

 private:
  double p(int i, int m) const {
    if (n_ == -l_) return r_(1, i, 1) * r_(l_ - 1, m, 1 - l_) + r_(1, i, -1) * r_(l_ - 1, m, l_ - 1);
    if (n_ == l_) return r_(1, i, 1) * r_(l_ - 1, m, l_ - 1) - r_(1, i, -1) * r_(l_ - 1, m, 1 - l_);
    return r_(1, i, 0) * r_(l_ - 1, m, n_);
  }
  double v_part() const {
    if (m_ == 0) return p(1, 1) + p(-1, -1);
    if (m_ == 1) return p(1, 0) * std::sqrt(2.0);
    if (m_ == -1) return p(-1, 0) * std::sqrt(2.0);
    return m_ > 0 ? p(1, m_ - 1) - p(-1, 1 - m_) : p(1, m_ + 1) + p(-1, -m_ - 1);
  }
  double w_part() const { return m_ > 0 ? p(1, m_ + 1) + p(-1, -m_ - 1) : p(1, m_ - 1) - p(-1, 1 - m_); }

  const Read& r_;
  int l_, m_, n_;
};

}  // namespace

ShRotation::ShRotation(const DMat3& rotation, int bands) : bands_(bands) {
  ORIEL_CHECK_LE(bands, kMaxShBands);
  matrices_.resize(band_offset(bands));
  matrices_[0] = 1;
  constexpr int kAxis[3] = {1, 2, 0};  // of m = -1, 0, 1
  const auto read = [this](int l, int m, int n) { return at(l, m, n); };
  for (int l = 1; l < bands; ++l) {
    double* out = matrices_.data() + band_offset(l);
    for (int m = -l; m <= l; ++m)
      for (int n = -l; n <= l; ++n)
        *out++ = l == 1 ? rotation[kAxis[n + 1]][kAxis[m + 1]] : BandEntry(read, l, m, n).value();
  }
}

double ShRotation::at(int l, int m, int n) const {
  return matrices_[band_offset(l) + static_cast<std::size_t>((m + l) * (2 * l + 1) + n + l)];
}

void ShRotation::apply(std::span<const double> in, std::span<double> out) const {
  for (int l = 0; l < bands_; ++l)
    for (int m = -l; m <= l; ++m) {
      double sum = 0;
      for (int n = -l; n <= l; ++n) sum += at(l, m, n) * in[static_cast<std::size_t>(sh_index(l, n))];
      out[static_cast<std::size_t>(sh_index(l, m))] = sum;
    }
}

void ShRotation::apply(std::span<const float> in, std::span<float> out) const {
  const std::vector<double> from(in.begin(), in.end());
  std::vector<double> to(out.size());
  apply(std::span<const double>(from), std::span<double>(to));
  for (std::size_t i = 0; i < to.size(); ++i) out[i] = static_cast<float>(to[i]);
}

}  // namespace oriel
