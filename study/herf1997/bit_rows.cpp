#include <cstring>

#include "study/herf1997/count_methods.h"

// Vectors are passed between functions that are always part of their caller.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace oriel::study {
namespace {

using U64x8 = std::uint64_t __attribute__((vector_size(64)));
using I64x8 = std::int64_t __attribute__((vector_size(64)));
using I32x8 = std::int32_t __attribute__((vector_size(32)));
using U32x8 = std::uint32_t __attribute__((vector_size(32)));

constexpr U64x8 kLane = {0, 1, 2, 3, 4, 5, 6, 7};
constexpr I32x8 kLane32 = {0, 1, 2, 3, 4, 5, 6, 7};

struct Target {
  std::uint32_t* bits;
  std::size_t column;
  int width;
};

// A face's edges as rows meet them: one edge beside all rows, and below and above `middle` one of the other two. x is
// that of the first row, for all three.
struct Sides {
  FixedEdge all, lower, upper;
  int middle = 0;
};

[[gnu::always_inline]] inline Sides sides_of(const FixedEdge& a, const FixedEdge& b, const FixedEdge& c) {
  const int ra = a.last - a.first, rb = b.last - b.first, rc = c.last - c.first;
  Sides s = ra >= rb && ra >= rc ? Sides{a, b, c} : rb >= rc ? Sides{b, a, c} : Sides{c, a, b};
  // The longest edge has the rows of both others; one of these may have none.
  const bool lower_empty = s.lower.last == s.lower.first, upper_empty = s.upper.last == s.upper.first;
  if (lower_empty || (!upper_empty && s.upper.first < s.lower.first)) std::swap(s.lower, s.upper);
  s.middle = lower_empty || upper_empty ? s.all.last : s.upper.first;
  s.upper.x -= static_cast<std::uint64_t>(s.middle - s.all.first) * s.upper.step;
  return s;
}

[[gnu::always_inline]] inline I32x8 least(const I32x8& a, const I32x8& b) {
  return a < b ? a : b;
}
[[gnu::always_inline]] inline I32x8 most(const I32x8& a, const I32x8& b) {
  return a > b ? a : b;
}
[[gnu::always_inline]] inline U32x8 from(const I32x8& t) {
  const I32x8 positive = most(t, I32x8{});
  const U32x8 ones = ~U32x8{};
  return positive < 32 ? ones << reinterpret_cast<const U32x8&>(positive) : U32x8{};
}
[[gnu::always_inline]] inline I32x8 texels(const U64x8& x) {
  return __builtin_convertvector(reinterpret_cast<const I64x8&>(x) >> 32, I32x8);
}

[[gnu::always_inline]] inline void fill_face(const FixedEdge& a, const FixedEdge& b, const FixedEdge& c,
                                             const Target& target) {
  const Sides s = sides_of(a, b, c);
  const int rows = s.all.last - s.all.first;
  if (rows <= 0) return;
  // Edges are straight: the outermost texels are at the ends of one.
  const int top = s.all.first, end = s.all.last - 1;
  const int x0 = s.all.at(top), x1 = s.all.at(end);
  int lowest = std::min(x0, x1), highest = std::max(x0, x1);
  for (const FixedEdge* e : {&a, &b, &c}) {
    if (e->first == e->last) continue;
    const int p = e->at(e->first), q = e->at(e->last - 1);
    lowest = std::min(lowest, std::min(p, q)), highest = std::max(highest, std::max(p, q));
  }
  lowest = std::max(lowest, 0), highest = std::min(highest, target.width);
  if (lowest >= highest) return;
  const int first_word = lowest / 32, last_word = (highest - 1) / 32;
  U64x8 x = s.all.x + kLane * s.all.step, lower = s.lower.x + kLane * s.lower.step;
  U64x8 upper = s.upper.x + kLane * s.upper.step;
  const I32x8 zero{}, width = zero + target.width;
  for (int r = 0; r < rows; r += kLanes) {
    const I32x8 row = kLane32 + r;
    const I32x8 other = row < s.middle - top ? texels(lower) : texels(upper);
    const I32x8 p = most(least(texels(x), width), zero), q = most(least(other, width), zero);
    const U32x8 inside = reinterpret_cast<const U32x8&>(static_cast<const I32x8&>(row < rows));
    std::uint32_t* word = target.bits + static_cast<std::size_t>(first_word) * target.column + top + r;
    for (int w = first_word; w <= last_word; ++w, word += target.column) {
      U32x8 now;
      std::memcpy(&now, word, sizeof(now));
      now |= (from(p - 32 * w) ^ from(q - 32 * w)) & inside;
      std::memcpy(word, &now, sizeof(now));
    }
    x += kLanes * s.all.step, lower += kLanes * s.lower.step, upper += kLanes * s.upper.step;
  }
}

[[gnu::always_inline]] inline void fill_all(const SampleBatch& batch, BlockedRows& rows) {
  for (int i = 0; i < batch.count; ++i) {
    const Target target{rows.of_sample(batch.first + i), rows.column_stride(), rows.width()};
    const auto& edges = batch.projected.edges;
    for (std::size_t f = 0; f < batch.view.faces.size(); ++f) {
      if (!casts(batch, f, i)) continue;
      const auto& e = batch.view.faces[f].edges;
      fill_face(edges[e[0]].of(i), edges[e[1]].of(i), edges[e[2]].of(i), target);
    }
    for (const FaceEdges& e : batch.beside_light[i]) fill_face(e[0], e[1], e[2], target);
  }
}

void fill_baseline(const SampleBatch& batch, BlockedRows& rows) {
  fill_all(batch, rows);
}
[[gnu::target("avx2")]] void fill_avx2(const SampleBatch& batch, BlockedRows& rows) {
  fill_all(batch, rows);
}
[[gnu::target("avx2,avx512f,avx512dq,avx512bw,avx512vl")]] void fill_avx512(const SampleBatch& batch,
                                                                            BlockedRows& rows) {
  fill_all(batch, rows);
}

}  // namespace

void fill_bit_rows(const SampleBatch& batch, Simd simd, BlockedRows& rows) {
  if (simd == Simd::kAvx512) return fill_avx512(batch, rows);
  if (simd == Simd::kAvx2) return fill_avx2(batch, rows);
  fill_baseline(batch, rows);
}

}  // namespace oriel::study
