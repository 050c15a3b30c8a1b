#include "formats/shadow/silhouettes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "formats/shadow/column_sums.h"

// Vectors are passed between functions that are always part of their caller.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace oriel {
namespace {

constexpr int kWord = 32;  // texels
constexpr std::uint32_t kNone = ~0u;
constexpr float kSure = 1e-5f;  // of lengths: which side of a face a sample is on is then known
// As OccluderView has it: nearer to a sample's height than this nothing is projected.
constexpr double kLeastRise = 0x1p-20;

using F32x16 = float __attribute__((vector_size(64)));
using I32x16 = std::int32_t __attribute__((vector_size(64)));
using Lanes8 = std::array<std::int8_t, kLanes>;
using Numbers8 = std::array<double, kLanes>;

using F64x8 = double __attribute__((vector_size(64)));
using I64x8 = std::int64_t __attribute__((vector_size(64)));
using U64x8 = std::uint64_t __attribute__((vector_size(64)));
using I32x8 = std::int32_t __attribute__((vector_size(32)));

[[gnu::always_inline]] inline F64x8 load(const Numbers8& from) {
  F64x8 f;
  std::memcpy(&f, &from, sizeof(f));
  return f;
}
[[gnu::always_inline]] inline F64x8 clamp(const F64x8& x, double least, double most) {
  const F64x8 low = F64x8{} + least, high = F64x8{} + most;
  const F64x8 up = x < low ? low : x;
  return up > high ? high : up;
}
// Of what is not negative.
[[gnu::always_inline]] inline F64x8 ceil_of(const F64x8& x) {
  const F64x8 whole = __builtin_convertvector(__builtin_convertvector(x, I64x8), F64x8);
  return whole < x ? whole + 1 : whole;
}

struct LaneEnds {
  F64x8 x, y;
};

// fixed_edge() of eight lanes: compilers leave a loop of it as it is.
[[gnu::always_inline]] inline void fix_lanes(const LaneEnds& a, const LaneEnds& b, double height, EdgeLanes& out) {
  constexpr double kMost = 0x1p30;
  const I64x8 down = a.y <= b.y;
  const F64x8 x0 = down ? a.x : b.x, y0 = down ? a.y : b.y, x1 = down ? b.x : a.x, y1 = down ? b.y : a.y;
  const F64x8 first = ceil_of(clamp(y0 - 0.5, 0, height)), last = ceil_of(clamp(y1 - 0.5, 0, height));
  const F64x8 high = y1 - y0, least = F64x8{} + 1e-290;
  const F64x8 slope = clamp((x1 - x0) / (high > least ? high : least), -kMost, kMost);
  const F64x8 x = clamp(x0 + ((first + 0.5) - y0) * slope - 0.5, -kMost, kMost);
  const U64x8 at = __builtin_convertvector(__builtin_convertvector(x * 0x1p32, I64x8), U64x8) + 0xffffffffu;
  const U64x8 step = __builtin_convertvector(__builtin_convertvector(slope * 0x1p32, I64x8), U64x8);
  const I32x8 from = __builtin_convertvector(first, I32x8), to = __builtin_convertvector(last, I32x8);
  std::memcpy(&out.x, &at, sizeof(at)), std::memcpy(&out.step, &step, sizeof(step));
  std::memcpy(&out.first, &from, sizeof(from)), std::memcpy(&out.last, &to, sizeof(to));
}

}  // namespace

// The steps of add(), compiled for each instruction set.
struct SilhouetteShadows::Kernel {
  SilhouetteShadows& own;
  const ShadowBody& body;
  const BodyPlace& place;
  const TexelWindow& window;
  BlockedRows& rows;

  // Points in the window's texels. Whether the body is lower than every sample.
  [[gnu::always_inline]] bool place_points(bool& casts, bool& cuts) const {
    const std::size_t n = body.points.size();
    own.px_.resize(n), own.py_.resize(n), own.pz_.resize(n);
    const DMat3& m = place.space.linear;
    const DVec3 zero = m * -place.space.corner - DVec3(kWord * window.column, window.row, 0);
    double low = 1e300, high = -1e300;
    for (std::size_t i = 0; i < n; ++i) {
      const DVec3& p = body.points[i];
      own.px_[i] = m[0].x * p.x + m[1].x * p.y + m[2].x * p.z + zero.x;
      own.py_[i] = m[0].y * p.x + m[1].y * p.y + m[2].y * p.z + zero.y;
      const double z = m[0].z * p.x + m[1].z * p.y + m[2].z * p.z + zero.z;
      own.pz_[i] = std::abs(z) <= place.touching ? 0 : z;
      low = std::min(low, own.pz_[i]), high = std::max(high, own.pz_[i]);
    }
    double lowest = 1e300;
    for (const DVec3& a : place.apexes) lowest = std::min(lowest, a.z);
    casts = high > 0, cuts = low < 0;
    return !(high > 0) || high < lowest * (1 - kLeastRise);
  }

  // Which side of each face the samples are on, sixteen faces at once.
  [[gnu::always_inline]] void find_sides() const {
    const std::size_t n = body.faces.size();
    own.side_.resize(body.offset.size());
    const auto load = [](const float* from) __attribute__((always_inline)) {
      F32x16 f;
      std::memcpy(&f, from, sizeof(f));
      return f;
    };
    float reach = 0;
    for (const DVec3& s : place.samples)
      reach = std::max(reach, static_cast<float>(std::abs(s.x) + std::abs(s.y) + std::abs(s.z)));
    const bool mirrored = glm::determinant(place.space.linear) < 0;
    for (std::size_t f = 0; f < n; f += kFacesAtOnce) {
      const F32x16 x = load(&body.nx[f]), y = load(&body.ny[f]), z = load(&body.nz[f]), offset = load(&body.offset[f]);
      F32x16 least = F32x16{} + 1e30f, most = F32x16{} - 1e30f;
      for (const DVec3& s : place.samples) {
        const F32x16 d = x * static_cast<float>(s.x) + y * static_cast<float>(s.y) + z * static_cast<float>(s.z);
        least = d < least ? d : least, most = d > most ? d : most;
      }
      const F32x16 margin = kSure * (reach + (offset < 0 ? -offset : offset));
      const I32x16 front = least - offset > margin, back = most - offset < -margin;
      for (std::size_t i = 0; i < kFacesAtOnce; ++i)
        own.side_[f + i] = static_cast<std::int8_t>(mirrored ? front[i] - back[i] : back[i] - front[i]);
    }
  }

  [[gnu::always_inline]] void use(std::uint32_t p) const {
    if (own.used_of_[p] != kNone) return;
    own.used_of_[p] = static_cast<std::uint32_t>(own.used_.size());
    own.used_.push_back(p);
  }

  [[gnu::always_inline]] void use(const ShadowBody::Edge& edge) const {
    own.edges_.push_back(edge);
    use(edge.a), use(edge.b);
    for (const std::uint32_t f : edge.faces) {
      if (f == kNone || own.side_[f] != 0 || own.mixed_of_[f] != kNone) continue;
      own.mixed_of_[f] = static_cast<std::uint32_t>(own.mixed_.size());
      own.mixed_.push_back(f);
      for (const std::uint32_t p : body.faces[f]) use(p);
    }
  }

  // Where an edge from one side of the receiver to the other meets it.
  std::uint32_t cut(std::uint32_t e) const {
    std::uint32_t& at = own.cut_of_[e];
    if (at != kNone) return at;
    const auto [a, b] = std::pair(body.edges[e].a, body.edges[e].b);
    const double t = own.pz_[a] / (own.pz_[a] - own.pz_[b]);
    own.px_.push_back(own.px_[a] + (own.px_[b] - own.px_[a]) * t);
    own.py_.push_back(own.py_[a] + (own.py_[b] - own.py_[a]) * t);
    own.pz_.push_back(0);
    own.used_of_.push_back(kNone);
    return at = static_cast<std::uint32_t>(own.pz_.size() - 1);
  }

  // Edges that may be silhouettes, and what these need.
  [[gnu::always_inline]] void choose_edges(bool cuts) const {
    own.edges_.clear(), own.mixed_.clear(), own.used_.clear();
    own.mixed_of_.assign(body.faces.size(), kNone), own.used_of_.assign(body.points.size(), kNone);
    if (cuts) own.cut_of_.assign(body.edges.size(), kNone);
    for (std::size_t e = 0; e < body.edges.size(); ++e) {
      ShadowBody::Edge edge = body.edges[e];
      const int s0 = own.side_[edge.faces[0]], s1 = edge.faces[1] == kNone ? 0 : own.side_[edge.faces[1]];
      if (s0 * s1 > 0 && edge.along[0] != edge.along[1]) continue;
      if (cuts) {
        const bool a = own.pz_[edge.a] >= 0, b = own.pz_[edge.b] >= 0;
        if (!a && !b) continue;
        if (!a) edge.a = cut(static_cast<std::uint32_t>(e));
        if (!b) edge.b = cut(static_cast<std::uint32_t>(e));
      }
      use(edge);
    }
    if (cuts) cut_faces();
    own.x_.resize(own.used_.size()), own.y_.resize(own.used_.size()), own.mixed_side_.resize(own.mixed_.size());
  }

  // What is left of a face that the receiver cuts ends in an edge in its plane.
  void cut_faces() const {
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
      std::uint32_t out = kNone, in = kNone;
      for (std::size_t k = 0; k < 3; ++k) {
        const bool from = own.pz_[body.faces[f][k]] >= 0, to = own.pz_[body.faces[f][(k + 1) % 3]] >= 0;
        if (from && !to) out = cut(body.face_edges[f][k]);
        if (!from && to) in = cut(body.face_edges[f][k]);
      }
      if (out != kNone) use(ShadowBody::Edge{out, in, {static_cast<std::uint32_t>(f), kNone}, {1, 0}});
    }
  }

  [[gnu::always_inline]] void project(const std::array<Numbers8, 3>& apex) const {
    for (std::size_t u = 0; u < own.used_.size(); ++u) {
      const double px = own.px_[own.used_[u]], py = own.py_[own.used_[u]], pz = own.pz_[own.used_[u]];
      for (int i = 0; i < kLanes; ++i) {
        const double w = 1 / (apex[2][i] - pz);
        own.x_[u][i] = (px * apex[2][i] - apex[0][i] * pz) * w;
        own.y_[u][i] = (py * apex[2][i] - apex[1][i] * pz) * w;
      }
    }
    for (std::size_t m = 0; m < own.mixed_.size(); ++m) {
      const auto& p = body.faces[own.mixed_[m]];
      const Numbers8 &ax = own.x_[own.used_of_[p[0]]], &ay = own.y_[own.used_of_[p[0]]];
      const Numbers8 &bx = own.x_[own.used_of_[p[1]]], &by = own.y_[own.used_of_[p[1]]];
      const Numbers8 &cx = own.x_[own.used_of_[p[2]]], &cy = own.y_[own.used_of_[p[2]]];
      for (int i = 0; i < kLanes; ++i) {
        const double area = (bx[i] - ax[i]) * (cy[i] - ay[i]) - (cx[i] - ax[i]) * (by[i] - ay[i]);
        own.mixed_side_[m][i] = static_cast<std::int8_t>((area > 0) - (area < 0));
      }
    }
  }

  [[gnu::always_inline]] Lanes8 sides_of(std::uint32_t f) const {
    Lanes8 sides{};
    if (f == kNone) return sides;
    if (own.side_[f] == 0) return own.mixed_side_[own.mixed_of_[f]];
    sides.fill(own.side_[f]);
    return sides;
  }

  // The edges that are silhouettes for some of the lanes, with what the count of faces changes by across them.
  [[gnu::always_inline]] void find_silhouettes() const {
    own.changing_.clear(), own.changes_of_.clear();
    for (std::size_t e = 0; e < own.edges_.size(); ++e) {
      const ShadowBody::Edge& edge = own.edges_[e];
      const Lanes8 s0 = sides_of(edge.faces[0]), s1 = sides_of(edge.faces[1]);
      Lanes8 change;
      for (int i = 0; i < kLanes; ++i)
        change[i] = static_cast<std::int8_t>(s0[i] * edge.along[0] + s1[i] * edge.along[1]);
      std::uint64_t any;
      std::memcpy(&any, &change, sizeof(any));
      if (any == 0) continue;
      own.changing_.push_back({own.used_of_[edge.a], own.used_of_[edge.b]});
      own.changes_of_.push_back(change);
    }
  }

  // Where these cross columns of texels: x and y are exchanged.
  [[gnu::always_inline]] void fix_edges() const {
    const double width = kWord * window.columns;
    own.fixed_.resize(own.changing_.size());
    for (std::size_t e = 0; e < own.changing_.size(); ++e) {
      const auto [a, b] = own.changing_[e];
      fix_lanes({load(own.y_[a]), load(own.x_[a])}, {load(own.y_[b]), load(own.x_[b])}, width, own.fixed_[e]);
    }
  }

  // The changes of a lane, row by row; first and last row that have some.
  [[gnu::always_inline]] IVec2 put_changes(int lane) const {
    IVec2 span(window.rows, 0);
    for (std::size_t e = 0; e < own.changing_.size(); ++e) {
      const int change = own.changes_of_[e][lane];
      if (change == 0) continue;
      const bool right = own.x_[own.changing_[e][0]][lane] <= own.x_[own.changing_[e][1]][lane];
      put(own.fixed_[e].of(lane), right ? change : -change, span);
    }
    return span;
  }

  [[gnu::always_inline]] void put(const FixedEdge& edge, int change, IVec2& span) const {
    const std::size_t stride = static_cast<std::size_t>(kWord) * static_cast<std::size_t>(window.columns);
    std::int16_t* changes = own.changes_.data();
    std::uint64_t y = edge.x;
    for (int x = edge.first; x < edge.last; ++x, y += edge.step) {
      const int row = std::max(static_cast<std::int32_t>(static_cast<std::int64_t>(y) >> 32), 0);
      if (row >= window.rows) continue;
      span = {std::min(span.x, row), std::max(span.y, row + 1)};
      std::int16_t& at = changes[stride * static_cast<std::size_t>(row) + static_cast<std::size_t>(x)];
      at = static_cast<std::int16_t>(at + change);
    }
  }

  // Adds up the changes of a sample and leaves them zero.
  [[gnu::always_inline]] void sum_columns(int sample, const IVec2& span, SumColumn sum) const {
    const std::size_t stride = static_cast<std::size_t>(kWord) * static_cast<std::size_t>(window.columns);
    for (int w = 0; w < window.columns; ++w) {
      std::int16_t* change = own.changes_.data() + static_cast<std::size_t>(span.x) * stride + kWord * w;
      std::uint32_t* word = &rows.word(sample, window.column + w, window.row);
      const std::uint32_t open = sum(change, stride, word + span.x, span.y - span.x);
      // What is not closed goes on beyond the last row.
      for (int row = span.y; open != 0 && row < window.rows; ++row) word[row] |= open;
    }
  }

  [[gnu::always_inline]] bool run(SumColumn sum) const {
    bool casts = false, cuts = false;
    if (!place_points(casts, cuts)) return false;
    if (!casts || place.samples.empty() || window.columns <= 0 || window.rows <= 0) return true;
    find_sides();
    choose_edges(cuts);
    own.changes_.resize(static_cast<std::size_t>(kWord) * static_cast<std::size_t>(window.columns * window.rows));
    const int samples = static_cast<int>(place.apexes.size());
    for (int first = 0; first < samples; first += kLanes) {
      const int count = std::min(kLanes, samples - first);
      std::array<Numbers8, 3> apex;
      for (int i = 0; i < kLanes; ++i) {
        const DVec3& a = place.apexes[static_cast<std::size_t>(std::min(first + i, samples - 1))];
        apex[0][i] = a.x - kWord * window.column, apex[1][i] = a.y - window.row, apex[2][i] = a.z;
      }
      project(apex);
      find_silhouettes();
      fix_edges();
      for (int i = 0; i < count; ++i)
        if (const IVec2 span = put_changes(i); span.x < span.y) sum_columns(first + i, span, sum);
    }
    return true;
  }
};

namespace {

template <class Kernel>
bool add_baseline(const Kernel& kernel) {
  return kernel.run(column_sums(Simd::kBaseline));
}
template <class Kernel>
[[gnu::target("avx2")]] bool add_avx2(const Kernel& kernel) {
  return kernel.run(column_sums(Simd::kAvx2));
}
template <class Kernel>
[[gnu::target("avx2,avx512f,avx512dq,avx512bw,avx512vl")]] bool add_avx512(const Kernel& kernel) {
  return kernel.run(column_sums(Simd::kAvx512));
}

}  // namespace

bool SilhouetteShadows::add(const ShadowBody& body, const BodyPlace& place, const TexelWindow& window, Simd simd,
                            BlockedRows& rows) {
  const Kernel kernel{*this, body, place, window, rows};
  if (simd == Simd::kAvx512) return add_avx512(kernel);
  if (simd == Simd::kAvx2) return add_avx2(kernel);
  return add_baseline(kernel);
}

}  // namespace oriel
