#include "formats/image/encode.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "formats/core/half.h"
#include "formats/core/parallel.h"
#include "formats/image/block.h"

namespace oriel {
namespace bc6h {
namespace {

constexpr float kLeastShare = 1 / 16.0f;  // of a channel in fitting: so dark ones do not run away
constexpr float kGood = 0x1p-18f;  // squared error of a texel that no second line need improve: 2^-9 of its light
constexpr std::size_t kTried = 4;  // partitions that promise most
constexpr int kFits = 2;           // rounds of indices and ends
constexpr float kTop = 65535;      // of what endpoints stand for

// Four by four texels. Lines are fitted in the encoding of half floats, times 64/31: nearly a logarithm, and what
// endpoints are stored in.
struct Texels {
  std::array<Vec3, kTexels> code, light, share;  // share: a channel's part of the largest one
  std::array<float, kTexels> per_light{};        // 1 / the largest channel; 0: does not count
};

struct Line {
  Vec3 a{0}, b{0};
};

using Indices = std::array<std::uint8_t, kTexels>;

Texels texels_of(const Halves& halves, std::uint16_t counted) {
  Texels out;
  for (std::size_t i = 0; i < kTexels; ++i) {
    for (int c = 0; c < 3; ++c) {
      out.light[i][c] = float_from_half(halves[i][c]);
      out.code[i][c] = (64 * static_cast<float>(halves[i][c]) + 32) / 31;
    }
    const float most = std::max(max_component(out.light[i]), float_from_half(1));
    out.per_light[i] = counted >> i & 1 ? 1 / most : 0;
    out.share[i] = glm::max(out.light[i] / most, Vec3(kLeastShare));
  }
  return out;
}

// Squared error of one texel, over the square of its largest channel.
float error_at(const Texels& texels, std::size_t i, const Vec3& light) {
  const Vec3 off = (light - texels.light[i]) * texels.per_light[i];
  return glm::dot(off, off);
}

// The direction in which texels of a line vary most, each channel weighed by its share, and how far they go. Returns
// the squared distance that is left, in code.
float fit_axis(const Texels& texels, std::uint32_t mask, Line& line) {
  Vec3 mean(0), scale(0);
  float count = 0;
  for (std::size_t i = 0; i < kTexels; ++i)
    if (mask >> i & 1 && texels.per_light[i] > 0) mean += texels.code[i], scale += texels.share[i], ++count;
  if (count == 0) return 0;
  mean /= count, scale /= count;
  Mat3 spread(0);
  for (std::size_t i = 0; i < kTexels; ++i)
    if (mask >> i & 1 && texels.per_light[i] > 0) {
      const Vec3 d = (texels.code[i] - mean) * scale;
      spread += glm::outerProduct(d, d);
    }
  Vec3 axis(0);
  for (int c = 0; c < 3; ++c)
    if (glm::dot(spread[c], spread[c]) > glm::dot(axis, axis)) axis = spread[c];
  for (int round = 0; round < 4; ++round) {
    const float length = glm::length(axis);
    if (!(length > 0)) break;
    axis = spread * (axis / length);
  }
  const float length = glm::length(axis);
  axis = length > 0 ? axis / length : Vec3(0);
  float low = std::numeric_limits<float>::max(), high = -low, left = 0;
  for (std::size_t i = 0; i < kTexels; ++i)
    if (mask >> i & 1 && texels.per_light[i] > 0) {
      const Vec3 d = (texels.code[i] - mean) * scale;
      const float along = glm::dot(d, axis);
      low = std::min(low, along), high = std::max(high, along);
      left += glm::dot(d, d) - along * along;
    }
  line = {mean + low * axis / scale, mean + high * axis / scale};
  return left;
}

// The ends that fit best, channel by channel, where texels lie on the line as the indices say.
void fit_ends(const Texels& texels, std::uint32_t mask, const Indices& index, std::span<const std::uint8_t> weight,
              Line& line) {
  for (int c = 0; c < 3; ++c) {
    double aa = 0, ab = 0, bb = 0, av = 0, bv = 0;
    for (std::size_t i = 0; i < kTexels; ++i) {
      if (!(mask >> i & 1) || !(texels.per_light[i] > 0)) continue;
      const double b = weight[index[i]] / 64.0, a = 1 - b, v = texels.code[i][c];
      const double w = double{texels.share[i][c]} * texels.share[i][c];
      aa += w * a * a, ab += w * a * b, bb += w * b * b, av += w * a * v, bv += w * b * v;
    }
    const double det = aa * bb - ab * ab;
    if (det <= 1e-6 * aa * bb) continue;  // all at one end
    line.a[c] = static_cast<float>((av * bb - bv * ab) / det);
    line.b[c] = static_cast<float>((bv * aa - av * ab) / det);
  }
}

std::uint32_t quantised(float code, int bits) {
  const float clamped = std::clamp(code, 0.0f, kTop);
  if (bits >= 15) return static_cast<std::uint32_t>(clamped + 0.5f);
  const float steps = clamped / kTop * static_cast<float>((1u << bits) - 1);
  const auto guess = static_cast<std::uint32_t>(steps + 0.5f);
  std::uint32_t best = guess;
  for (const std::uint32_t q : {guess - (guess > 0), std::min(guess + 1, (1u << bits) - 1)})
    if (std::abs(static_cast<float>(unquantised(q, bits)) - clamped) <
        std::abs(static_cast<float>(unquantised(best, bits)) - clamped))
      best = q;
  return best;
}

bool differences_fit(const Mode& mode, const Fields& fields) {
  if (!mode.differences) return true;
  for (std::size_t e = 1; e < 2 * static_cast<std::size_t>(mode.lines); ++e)
    for (std::size_t c = 0; c < 3; ++c) {
      const int d = static_cast<int>(fields.endpoints[e][c]) - static_cast<int>(fields.endpoints[0][c]);
      const int half = 1 << (mode.more_bits[static_cast<int>(c)] - 1);
      if (d < -half || d >= half) return false;
    }
  return true;
}

// The best index of each texel of a line for what its stored ends show, and the sum of errors.
float choose_indices(const Texels& texels, std::uint32_t mask, const Mode& mode, std::size_t line, Fields& fields) {
  const auto weight = weights(mode.lines);
  std::array<Vec3, kTexels> shown;
  for (std::size_t k = 0; k < weight.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      shown[k][static_cast<int>(c)] =
          float_from_positive_half(half_between(unquantised(fields.endpoints[2 * line][c], mode.bits),
                                                unquantised(fields.endpoints[2 * line + 1][c], mode.bits), weight[k]));
  float sum = 0;
  for (std::size_t i = 0; i < kTexels; ++i) {
    if (!(mask >> i & 1)) continue;
    float least = std::numeric_limits<float>::max();
    for (std::size_t k = 0; k < weight.size(); ++k)
      if (const float error = error_at(texels, i, shown[k]); error < least)
        least = error, fields.index[i] = static_cast<std::uint8_t>(k);
    sum += least;
  }
  return sum;
}

// Turns a line round where its anchor's index would have the highest bit.
void anchor_line(std::uint32_t mask, int anchored, std::size_t line, int levels, Fields& fields) {
  if (fields.index[static_cast<std::size_t>(anchored)] < levels / 2) return;
  std::swap(fields.endpoints[2 * line], fields.endpoints[2 * line + 1]);
  for (std::size_t i = 0; i < kTexels; ++i)
    if (mask >> i & 1) fields.index[i] = static_cast<std::uint8_t>(levels - 1 - fields.index[i]);
}

class Search {
 public:
  explicit Search(const Texels& texels) : texels_(texels) {
    for (const float w : texels.per_light) counted_ += w > 0 ? 1.0f : 0.0f;
  }

  Fields run() {
    try_lines(1, 0);
    if (best_error_ > kGood * counted_) {
      std::array<std::pair<float, std::uint32_t>, kPartitions> left;
      for (std::uint32_t p = 0; p < kPartitions; ++p) {
        Line unused;
        const std::uint32_t second = partition_mask(p);
        left[p] = {fit_axis(texels_, ~second, unused) + fit_axis(texels_, second, unused), p};
      }
      std::partial_sort(left.begin(), left.begin() + kTried, left.end());
      for (std::size_t i = 0; i < kTried && best_error_ > kGood * counted_; ++i) try_lines(2, left[i].second);
    }
    return best_;
  }

 private:
  void try_lines(int lines, std::uint32_t partition) {
    const std::uint32_t second = lines == 2 ? partition_mask(partition) : 0;
    const std::array<std::uint32_t, 2> masks = {~second & 0xFFFF, second};
    std::array<Line, 2> fitted;
    for (std::size_t l = 0; l < static_cast<std::size_t>(lines); ++l) {
      fit_axis(texels_, masks[l], fitted[l]);
      for (int round = 0; round < kFits; ++round) {
        const Indices index = nearest(masks[l], fitted[l], weights(lines));
        fit_ends(texels_, masks[l], index, weights(lines), fitted[l]);
      }
    }
    for (std::size_t m = 0; m < modes().size(); ++m)
      if (modes()[m].lines == lines) try_mode(m, partition, masks, fitted);
  }

  Indices nearest(std::uint32_t mask, const Line& line, std::span<const std::uint8_t> weight) const {
    Indices out{};
    for (std::size_t i = 0; i < kTexels; ++i) {
      if (!(mask >> i & 1)) continue;
      float least = std::numeric_limits<float>::max();
      for (std::size_t k = 0; k < weight.size(); ++k) {
        const Vec3 off =
            (glm::mix(line.a, line.b, static_cast<float>(weight[k]) / 64) - texels_.code[i]) * texels_.share[i];
        if (const float error = glm::dot(off, off); error < least) least = error, out[i] = static_cast<std::uint8_t>(k);
      }
    }
    return out;
  }

  void try_mode(std::size_t number, std::uint32_t partition, const std::array<std::uint32_t, 2>& masks,
                const std::array<Line, 2>& fitted) {
    const Mode& mode = modes()[number];
    Fields fields;
    fields.mode = number;
    fields.partition = partition;
    for (std::size_t l = 0; l < static_cast<std::size_t>(mode.lines); ++l)
      for (std::size_t c = 0; c < 3; ++c) {
        fields.endpoints[2 * l][c] = quantised(fitted[l].a[static_cast<int>(c)], mode.bits);
        fields.endpoints[2 * l + 1][c] = quantised(fitted[l].b[static_cast<int>(c)], mode.bits);
      }
    float error = 0;
    for (std::size_t l = 0; l < static_cast<std::size_t>(mode.lines); ++l) {
      error += choose_indices(texels_, masks[l], mode, l, fields);
      anchor_line(masks[l], l == 0 ? 0 : anchor(partition), l, mode.lines == 1 ? 16 : 8, fields);
    }
    if (!(error < best_error_) || !differences_fit(mode, fields)) return;
    best_error_ = error;
    best_ = fields;
  }

  const Texels& texels_;
  float counted_ = 0;
  Fields best_;
  float best_error_ = std::numeric_limits<float>::max();
};

}  // namespace
}  // namespace bc6h

Bytes bc6h_blocks(std::span<const Vec3> rgb, std::uint32_t width, std::uint32_t height,
                  std::span<const std::uint8_t> counts) {
  const std::size_t across = (std::size_t{width} + 3) / 4, down = (std::size_t{height} + 3) / 4;
  Bytes out(across * down * sizeof(bc6h::Block));
  for_each_parallel(down, core_count(), [&](std::size_t row) {
    for (std::size_t column = 0; column < across; ++column) {
      bc6h::Halves halves{};
      std::uint16_t counted = 0;
      for (std::size_t i = 0; i < bc6h::kTexels; ++i) {
        const std::size_t x = std::min<std::size_t>(4 * column + i % 4, width - 1),
                          y = std::min<std::size_t>(4 * row + i / 4, height - 1), at = y * width + x;
        for (int c = 0; c < 3; ++c) halves[i][c] = half_from_float(rgb[at][c] > 0 ? rgb[at][c] : 0.0f);
        if (counts.empty() || counts[at] != 0) counted = static_cast<std::uint16_t>(counted | 1u << i);
      }
      const bc6h::Texels texels = bc6h::texels_of(halves, counted);
      const bc6h::Block block = bc6h::packed(bc6h::Search(texels).run());
      std::memcpy(&out[(row * across + column) * sizeof(block)], block.data(), sizeof(block));
    }
  });
  return out;
}

std::vector<Vec3> rgb_from_bc6h(std::span<const std::byte> blocks, std::uint32_t width, std::uint32_t height) {
  const std::size_t across = (std::size_t{width} + 3) / 4;
  std::vector<Vec3> out(std::size_t{width} * height);
  bc6h::Block block;
  for (std::size_t b = 0; b * sizeof(block) < blocks.size(); ++b) {
    std::memcpy(block.data(), &blocks[b * sizeof(block)], sizeof(block));
    const bc6h::Halves halves = bc6h::decoded(block);
    for (std::size_t i = 0; i < bc6h::kTexels; ++i) {
      const std::size_t x = 4 * (b % across) + i % 4, y = 4 * (b / across) + i / 4;
      if (x >= width || y >= height) continue;
      for (int c = 0; c < 3; ++c) out[y * width + x][c] = float_from_half(halves[i][c]);
    }
  }
  return out;
}

}  // namespace oriel
