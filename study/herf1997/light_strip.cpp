#include "study/herf1997/light_strip.h"

#include <algorithm>
#include <cmath>
#include <cstring>

// Vectors are passed between functions that are always part of their caller.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace oriel::study {
namespace {

constexpr int kBlock = 32;  // rows

// Lanes of one register: wider vectors than there are would be taken apart number by number.
template <int N>
struct Registers;
template <>
struct Registers<4> {
  using F = float __attribute__((vector_size(16)));
  using U = std::uint32_t __attribute__((vector_size(16)));
};
template <>
struct Registers<8> {
  using F = float __attribute__((vector_size(32)));
  using U = std::uint32_t __attribute__((vector_size(32)));
};
template <>
struct Registers<16> {
  using F = float __attribute__((vector_size(64)));
  using U = std::uint32_t __attribute__((vector_size(64)));
};

template <int N>
struct Lanes : Registers<N> {
  using F = typename Registers<N>::F;
  static constexpr int kParts = kStrip / N;

  [[gnu::always_inline]] static F load(const float* from) {
    F f;
    std::memcpy(&f, from, sizeof(f));
    return f;
  }
};

using Strip = std::array<float, kStrip>;

constexpr std::array<float, kStrip> kCenter = [] {
  std::array<float, kStrip> center{};
  for (int i = 0; i < kStrip; ++i) center[i] = static_cast<float>(i) + 0.5f;
  return center;
}();
constexpr std::array<std::uint32_t, kStrip> kBit = [] {
  std::array<std::uint32_t, kStrip> bit{};
  for (int i = 0; i < kStrip; ++i) bit[i] = 1u << i;
  return bit;
}();

// Samples as a row sees them. Of one more than there are the weight is 0: they are summed in pairs.
struct Terms {
  float *along, *distance2, *weight;
  std::uint32_t* bits;
};

struct Square {
  std::array<float, kMostNodes> nodes{};                  // -1 to 1
  std::array<std::array<float, kMostNodes>, 32> basis{};  // of the texels' centres
};

struct Scratch {
  std::vector<float> along, distance2, weight, picked_along, picked_distance2, picked_weight;
  std::vector<std::uint32_t> bits, picked_bits;
  std::array<float, kBlock * kStrip> open{};  // a square's light without shadows,
  bool has_open = false;                      // once it is known
  Square square;
};

template <int N>
[[gnu::always_inline]] inline typename Lanes<N>::F where_set(std::uint32_t bits, const typename Lanes<N>::U& bit,
                                                             float value) {
  using L = Lanes<N>;
  return ((typename L::U{} + bits) & bit) != 0 ? typename L::F{} + value : typename L::F{};
}

// Two samples share a division: a / r⁴ + b / s⁴ = (a s⁴ + b r⁴) / (r⁴ s⁴).
template <int N>
[[gnu::always_inline]] inline typename Lanes<N>::F pair(const typename Lanes<N>::F& x, const Terms& t, int i,
                                                        const typename Lanes<N>::U& bit) {
  using F = typename Lanes<N>::F;
  const F dx = x - t.along[i], dy = x - t.along[i + 1];
  const F r2 = dx * dx + t.distance2[i], s2 = dy * dy + t.distance2[i + 1];
  const F r4 = r2 * r2, s4 = s2 * s2;
  const F a = where_set<N>(t.bits[i], bit, t.weight[i]), b = where_set<N>(t.bits[i + 1], bit, t.weight[i + 1]);
  return (a * s4 + b * r4) / (r4 * s4);
}

// Σ weight / r⁴ over the samples whose bits are set.
template <int N>
[[gnu::always_inline]] inline Strip sum_where_set(const Terms& t, int count, float first, float step) {
  using L = Lanes<N>;
  typename L::F x[L::kParts], sum[L::kParts];
  typename L::U bit[L::kParts];
  for (int k = 0; k < L::kParts; ++k) {
    x[k] = (first + L::load(&kCenter[static_cast<std::size_t>(k) * N])) * step, sum[k] = typename L::F{};
    std::memcpy(&bit[k], &kBit[static_cast<std::size_t>(k) * N], sizeof(bit[k]));
  }
  for (int i = 0; i < count; i += 2)
    for (int k = 0; k < L::kParts; ++k) sum[k] += pair<N>(x[k], t, i, bit[k]);
  Strip out;
  std::memcpy(&out, sum, sizeof(out));
  return out;
}

// The same of all samples at one point of a row.
[[gnu::always_inline]] inline float sum_at(const Terms& t, int count, float x) {
  std::array<float, 16> sums{};
  for (int i = 0; i < count; i += 16)
    for (int k = 0; k < std::min(16, count - i); ++k) {
      const float dx = x - t.along[i + k], r2 = dx * dx + t.distance2[i + k];
      sums[k] += t.weight[i + k] / (r2 * r2);
    }
  float sum = 0;
  for (const float s : sums) sum += s;
  return sum;
}

// Samples as the point y of the receiver's rows has them.
[[gnu::always_inline]] inline void place_samples(const StripTask& task, float y, const Terms& t) {
  const auto& s = task.samples;
  const float skew = y * task.steps.skew, across = y * task.steps.across;
  const auto count = static_cast<int>(s.weight.size());
  for (int i = 0; i < count; ++i) {
    const float d = s.across[i] - across;
    t.along[i] = s.along[i] - skew;
    t.distance2[i] = d * d + s.height2[i];
  }
}

// Light without shadows on 32 x 32 texels, by its values at Chebyshev points.
[[gnu::always_inline]] inline void sum_square(const StripTask& task, int column, int row, Scratch& scratch) {
  const int n = task.steps.nodes, count = static_cast<int>(task.samples.weight.size());
  const Terms t{scratch.picked_along.data(), scratch.picked_distance2.data(), scratch.weight.data(), nullptr};
  std::array<std::array<float, kStrip>, kMostNodes> lines{};
  for (int j = 0; j < n; ++j) {
    place_samples(task, static_cast<float>(row) + 16 + 16 * scratch.square.nodes[j], t);
    for (int k = 0; k < n; ++k) {
      const float value =
          sum_at(t, count, (static_cast<float>(32 * column) + 16 + 16 * scratch.square.nodes[k]) * task.steps.along);
      for (int i = 0; i < kStrip; ++i) lines[j][i] += scratch.square.basis[i][k] * value;
    }
  }
  for (int r = 0; r < kBlock; ++r) {
    Strip sum{};
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < kStrip; ++i) sum[i] += scratch.square.basis[r][j] * lines[j][i];
    std::ranges::copy(sum, scratch.open.begin() + static_cast<std::ptrdiff_t>(r) * kStrip);
  }
}

// The samples of which the strip has bits, one after the other; returns how many, made even.
[[gnu::always_inline]] inline int pick(const Terms& from, int count, const Terms& to) {
  int n = 0;
  for (int i = 0; i < count; ++i) {
    to.along[n] = from.along[i], to.distance2[n] = from.distance2[i], to.weight[n] = from.weight[i];
    to.bits[n] = from.bits[i];
    n += from.bits[i] != 0;
  }
  to.along[n] = 0, to.distance2[n] = 1, to.weight[n] = 0, to.bits[n] = 0;
  return n + n % 2;
}

struct Found {
  std::uint32_t any = 0, all = ~0u;  // blocked
  int some = 0, open = 0;            // samples of which a texel is blocked, and of which one is not
};

[[gnu::always_inline]] inline Found find_bits(const BlockedRows& rows, int column, int row, std::uint32_t* bits) {
  Found found;
  const std::uint32_t full = rows.full(column);
  const std::uint32_t* word = rows.of_sample(0) + rows.column_stride() * static_cast<std::size_t>(column) + row;
  for (int s = 0; s < rows.samples(); ++s, word += rows.sample_stride()) {
    const std::uint32_t w = *word;
    bits[s] = w;
    found.any |= w, found.all &= w;
    found.some += w != 0, found.open += w != full;
  }
  return found;
}

// 32 texels of a row. `open` is made where it is needed first.
template <int N>
[[gnu::always_inline]] inline Strip sum_strip(const StripTask& task, const Terms& terms, int column, int row,
                                              Scratch& scratch) {
  const int count = task.rows.samples();
  const Found found = find_bits(task.rows, column, row, terms.bits);
  const std::uint32_t full = task.rows.full(column);
  if (found.all == full) return Strip{};
  const bool from_open = task.steps.nodes > 0 && 2 * found.some < found.open;
  Strip open{};
  if (from_open) {
    if (!scratch.has_open) sum_square(task, column, row - row % kBlock, scratch);
    scratch.has_open = true;
    std::memcpy(&open, &scratch.open[static_cast<std::size_t>(row % kBlock) * kStrip], sizeof(open));
    if (found.any == 0) return open;
  } else {
    for (int s = 0; s < count; ++s) terms.bits[s] = ~terms.bits[s] & full;
  }
  const Terms picked{scratch.picked_along.data(), scratch.picked_distance2.data(), scratch.picked_weight.data(),
                     scratch.picked_bits.data()};
  const float first = static_cast<float>(32 * column);
  Strip sum{};
  if (!from_open && found.open == count) {
    sum = sum_where_set<N>(terms, count + count % 2, first, task.steps.along);
  } else {
    sum = sum_where_set<N>(picked, pick(terms, count, picked), first, task.steps.along);
  }
  if (from_open)
    for (int i = 0; i < kStrip; ++i) sum[i] = open[i] - sum[i];
  return sum;
}

// Times the cosine at the light.
[[gnu::always_inline]] inline void put(const StripTask& task, Strip sum, int column, int row) {
  const auto& s = task.steps;
  const float base = s.emission + (static_cast<float>(row) + 0.5f) * s.emission_y, x = static_cast<float>(32 * column);
  for (int i = 0; i < kStrip; ++i) {
    const float cosine = base + (x + kCenter[i]) * s.emission_x;
    sum[i] = std::max(sum[i], 0.0f) * (s.double_sided ? std::abs(cosine) : std::max(cosine, 0.0f));
  }
  const int width = task.rows.width(), texels = std::min(kStrip, width - 32 * column);
  float* out = task.out.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + 32 * column;
  if (texels == kStrip) {
    std::memcpy(out, &sum, sizeof(sum));
  } else {
    std::memcpy(out, &sum, sizeof(float) * static_cast<std::size_t>(texels));
  }
}

template <int N>
[[gnu::always_inline]] inline void sum_all(const StripTask& task, Scratch& scratch) {
  const std::size_t stride = scratch.weight.size();
  for (int top = 0; top < task.rows.height(); top += kBlock) {
    const int end = std::min(top + kBlock, task.rows.height());
    const auto terms_of = [&](int row) __attribute__((always_inline)) {
      const std::size_t at = static_cast<std::size_t>(row - top) * stride;
      return Terms{&scratch.along[at], &scratch.distance2[at], scratch.weight.data(), scratch.bits.data()};
    };
    for (int row = top; row < end; ++row) place_samples(task, static_cast<float>(row) + 0.5f, terms_of(row));
    for (int column = 0; column < task.rows.words(); ++column) {
      scratch.has_open = false;
      for (int row = top; row < end; ++row)
        put(task, sum_strip<N>(task, terms_of(row), column, row, scratch), column, row);
    }
  }
}

void sum_baseline(const StripTask& task, Scratch& scratch) {
  sum_all<4>(task, scratch);
}
[[gnu::target("avx2")]] void sum_avx2(const StripTask& task, Scratch& scratch) {
  sum_all<8>(task, scratch);
}
[[gnu::target("avx2,avx512f,avx512dq,avx512bw,avx512vl")]] void sum_avx512(const StripTask& task, Scratch& scratch) {
  sum_all<16>(task, scratch);
}

// Chebyshev points of the first kind, and what each weighs at the centres of 32 texels (barycentric form: Berrut and
// Trefethen 2004).
Square square_of(int n) {
  Square square;
  for (int k = 0; k < n; ++k) square.nodes[k] = static_cast<float>(std::cos((k + 0.5) * kPiD / n));
  for (int i = 0; i < 32; ++i) {
    const double x = (i + 0.5) / 16 - 1;
    std::array<double, kMostNodes> weight{};
    double sum = 0;
    for (int k = 0; k < n; ++k) {
      const double d = x - square.nodes[k];
      weight[k] = (k % 2 == 0 ? 1 : -1) * std::sin((k + 0.5) * kPiD / n) / (d == 0 ? 1e-12 : d);
      sum += weight[k];
    }
    for (int k = 0; k < n; ++k) square.basis[i][k] = static_cast<float>(weight[k] / sum);
  }
  return square;
}

}  // namespace

void sum_strips(const StripTask& task, Simd simd) {
  const std::size_t count = task.samples.weight.size(), padded = count + 2;
  Scratch scratch;
  scratch.along.resize(padded * kBlock), scratch.distance2.resize(padded * kBlock, 1.0f);
  scratch.weight = task.samples.weight;
  scratch.weight.resize(padded);
  scratch.bits.resize(padded);
  scratch.picked_along.resize(padded), scratch.picked_distance2.resize(padded, 1.0f);
  scratch.picked_weight.resize(padded), scratch.picked_bits.resize(padded);
  scratch.square = square_of(task.steps.nodes);
  if (simd == Simd::kAvx512) return sum_avx512(task, scratch);
  if (simd == Simd::kAvx2) return sum_avx2(task, scratch);
  sum_baseline(task, scratch);
}

}  // namespace oriel::study
