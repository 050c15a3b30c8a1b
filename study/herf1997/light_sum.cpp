#include "study/herf1997/light_sum.h"

#include <algorithm>
#include <cmath>
#include <cstring>

// Vectors are passed between functions that are always part of their caller.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace oriel::study {
namespace {

constexpr int kStrip = 32;  // texels of a row at once

// Lanes of one register: wider vectors than there are would be taken apart number by number.
template <int N>
struct Lanes {
  using F __attribute__((vector_size(4 * N))) = float;
  using U __attribute__((vector_size(4 * N))) = std::uint32_t;
};

// A sample as a row sees it, and the texels of a strip that it reaches.
struct Term {
  float along = 0, distance2 = 1, weight = 0;
  std::uint32_t open = 0;
};

template <int N>
[[gnu::always_inline]] inline typename Lanes<N>::F where_open(const Term& t, const typename Lanes<N>::U& bit) {
  using F = typename Lanes<N>::F;
  return ((typename Lanes<N>::U{} + t.open) & bit) != 0 ? F{} + t.weight : F{};
}

// Two samples share a division: a / r⁴ + b / s⁴ = (a s⁴ + b r⁴) / (r⁴ s⁴).
template <int N>
[[gnu::always_inline]] inline typename Lanes<N>::F sum_pair(const Term& a, const Term& b, const typename Lanes<N>::F& x,
                                                            const typename Lanes<N>::U& bit) {
  using F = typename Lanes<N>::F;
  const F dx = x - a.along, dy = x - b.along;
  const F r2 = dx * dx + a.distance2, s2 = dy * dy + b.distance2;
  const F r4 = r2 * r2, s4 = s2 * s2;
  return (where_open<N>(a, bit) * s4 + where_open<N>(b, bit) * r4) / (r4 * s4);
}

}  // namespace

LightSum::LightSum(const OccluderView& view, const ShadowReceiver& receiver, const ShadowLight& light) {
  if (view.apexes.empty()) return;
  double top = 0;
  for (const DVec3& a : view.apexes) top = std::max(top, a.z);
  const double unit = 1 / top, length = glm::length(receiver.x);
  const DVec3 along = receiver.x / length, across = glm::cross(receiver.normal, along);
  step_ = static_cast<float>(length * unit);
  skew_ = static_cast<float>(glm::dot(receiver.y, along) * unit);
  step_across_ = static_cast<float>(glm::dot(receiver.y, across) * unit);
  for (std::size_t i = 0; i < view.apexes.size(); ++i) {
    const ShadowLightSample& sample = light.samples[view.apex_of[i]];
    const DVec3 from_corner = sample.position - receiver.corner;
    const double height = view.apexes[i].z * unit;
    along_.push_back(static_cast<float>(glm::dot(from_corner, along) * unit));
    across_.push_back(static_cast<float>(glm::dot(from_corner, across) * unit));
    height2_.push_back(static_cast<float>(height * height));
    weight_.push_back(static_cast<float>(double{sample.power} * height * unit * unit));
  }
  along_.push_back(0), across_.push_back(0), height2_.push_back(1), weight_.push_back(0);
  // cosθ' = -normal · (sample - texel) / r, the same plane for all samples.
  const DVec3 first = light.samples[view.apex_of.front()].position;
  emission_ = static_cast<float>(-glm::dot(light.normal, first - receiver.corner) * unit);
  emission_x_ = static_cast<float>(glm::dot(light.normal, receiver.x) * unit);
  emission_y_ = static_cast<float>(glm::dot(light.normal, receiver.y) * unit);
  double_sided_ = light.double_sided;
}

struct LightSum::Kernel {
  const LightSum& light;
  const BlockedRows& rows;
  std::vector<Term> placed, seen;  // by sample; those that a strip sees, made even

  // Samples as the centres of a row have them.
  [[gnu::always_inline]] void place(int row) {
    const float y = static_cast<float>(row) + 0.5f, skew = y * light.skew_, across = y * light.step_across_;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const float d = light.across_[i] - across;
      placed[i] = {light.along_[i] - skew, d * d + light.height2_[i], light.weight_[i]};
    }
  }

  [[gnu::always_inline]] std::size_t see(int column, int row) {
    const std::uint32_t full = rows.full(column);
    std::size_t n = 0;
    for (int s = 0; s < rows.samples(); ++s) {
      seen[n] = placed[s];
      seen[n].open = ~rows.word(s, column, row) & full;
      n += seen[n].open != 0;
    }
    if (n % 2 != 0) seen[n++] = placed.back();
    return n;
  }

  template <int N>
  [[gnu::always_inline]] void run(std::span<float> out) {
    constexpr int kParts = kStrip / N;
    for (int row = 0; row < rows.height(); ++row) {
      place(row);
      for (int column = 0; column < rows.words(); ++column) {
        const std::size_t count = see(column, row);
        typename Lanes<N>::F x[kParts], sum[kParts];
        typename Lanes<N>::U bit[kParts];
        for (int i = 0; i < kStrip; ++i) {
          x[i / N][i % N] = (static_cast<float>(kStrip * column + i) + 0.5f) * light.step_;
          bit[i / N][i % N] = 1u << i, sum[i / N][i % N] = 0;
        }
        for (std::size_t i = 0; i < count; i += 2)
          for (int k = 0; k < kParts; ++k) sum[k] += sum_pair<N>(seen[i], seen[i + 1], x[k], bit[k]);
        float light_of[kStrip];
        std::memcpy(light_of, sum, sizeof(light_of));
        put(light_of, column, row, out);
      }
    }
  }

  // Times the cosine at the light.
  [[gnu::always_inline]] void put(const float* sum, int column, int row, std::span<float> out) const {
    const float base = light.emission_ + (static_cast<float>(row) + 0.5f) * light.emission_y_;
    const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(rows.width());
    for (int x = kStrip * column; x < std::min(kStrip * (column + 1), rows.width()); ++x) {
      const float cosine = base + (static_cast<float>(x) + 0.5f) * light.emission_x_;
      const float facing = light.double_sided_ ? std::abs(cosine) : std::max(cosine, 0.0f);
      out[at + static_cast<std::size_t>(x)] = sum[x % kStrip] * facing;
    }
  }

  void run_baseline(std::span<float> out) { run<4>(out); }
  [[gnu::target("avx2")]] void run_avx2(std::span<float> out) { run<8>(out); }
  [[gnu::target("avx2,avx512f,avx512dq,avx512bw,avx512vl")]] void run_avx512(std::span<float> out) { run<16>(out); }
};

void LightSum::run(const BlockedRows& rows, Simd simd, std::span<float> out) const {
  if (weight_.empty()) {
    std::ranges::fill(out, 0.0f);
    return;
  }
  Kernel kernel{*this, rows, std::vector<Term>(weight_.size()), std::vector<Term>(weight_.size() + 1)};
  if (simd == Simd::kAvx512) return kernel.run_avx512(out);
  if (simd == Simd::kAvx2) return kernel.run_avx2(out);
  kernel.run_baseline(out);
}

}  // namespace oriel::study
