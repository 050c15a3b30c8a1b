#include "player/images/mean_mips.h"

#include <algorithm>
#include <array>

#include "formats/core/color.h"

namespace oriel {
namespace {

// Between 8-bit codes and linear values.
class Coding {
 public:
  explicit Coding(Encoding encoding) {
    for (int code = 0; code < 256; ++code)
      decoded_[static_cast<std::size_t>(code)] = encoding == Encoding::kSrgb
                                                     ? linear_from_srgb8(static_cast<std::uint8_t>(code))
                                                     : static_cast<float>(code) / 255;
    // A value has the code whose own value, encoded, is nearest.
    for (int code = 1; code < 256; ++code) {
      const float between = (static_cast<float>(code) - 0.5f) / 255;
      from_[static_cast<std::size_t>(code)] = encoding == Encoding::kSrgb ? linear_from_srgb(between) : between;
    }
    std::size_t code = 0;
    for (std::size_t i = 0; i < guess_.size(); ++i) {
      const float value = static_cast<float>(i) / static_cast<float>(guess_.size());
      while (code < 255 && from_[code + 1] <= value) ++code;
      guess_[i] = static_cast<std::uint8_t>(code);
    }
  }
  float decoded(std::uint8_t code) const { return decoded_[code]; }
  std::uint8_t encoded(float value) const {
    const float clamped = std::clamp(value, 0.0f, 1.0f);
    const auto at = std::min(static_cast<std::size_t>(clamped * static_cast<float>(guess_.size())), guess_.size() - 1);
    std::size_t code = guess_[at];
    while (code < 255 && from_[code + 1] <= clamped) ++code;
    return static_cast<std::uint8_t>(code);
  }

 private:
  std::array<float, 256> decoded_{}, from_{};  // from_[code]: the least value with that code
  std::array<std::uint8_t, 4096> guess_{};     // the code of a value's lower neighbour
};

struct MeanLevel {
  int width = 0, height = 0;
  std::vector<Vec4> texels;
};

// What of a line of `from` texels texel i of `to` covers: at most three, as sizes are halved and rounded down.
struct Covered {
  int first = 0, count = 0;
  std::array<float, 3> share{};
};

std::vector<Covered> cover(int from, int to) {
  std::vector<Covered> out;
  const double scale = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    const double lower = i * scale, upper = (i + 1) * scale;
    Covered covered{static_cast<int>(lower), 0, {}};
    for (int x = covered.first; x < from && x < upper && covered.count < 3; ++x)
      covered.share[static_cast<std::size_t>(covered.count++)] =
          static_cast<float>((std::min(upper, x + 1.0) - std::max(lower, static_cast<double>(x))) / scale);
    out.push_back(covered);
  }
  return out;
}

template <class At>
MeanLevel halved(int width, int height, const At& at) {
  MeanLevel out{std::max(1, width / 2), std::max(1, height / 2), {}};
  out.texels.reserve(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height));
  const std::vector<Covered> columns = cover(width, out.width), rows = cover(height, out.height);
  for (const Covered& row : rows)
    for (const Covered& column : columns) {
      Vec4 mean(0);
      for (int v = 0; v < row.count; ++v)
        for (int u = 0; u < column.count; ++u)
          mean += row.share[static_cast<std::size_t>(v)] * column.share[static_cast<std::size_t>(u)] *
                  at(column.first + u, row.first + v);
      out.texels.push_back(mean);
    }
  return out;
}

}  // namespace

std::vector<std::vector<std::uint8_t>> mean_mips(const Texture& texture, Encoding encoding) {
  static const Coding srgb(Encoding::kSrgb), linear(Encoding::kLinear);
  const Coding& color = encoding == Encoding::kSrgb ? srgb : linear;
  std::vector<std::vector<std::uint8_t>> out{texture.texels};
  const int width = static_cast<int>(texture.width), height = static_cast<int>(texture.height);
  if (width <= 1 && height <= 1) return out;
  MeanLevel level = halved(width, height, [&](int x, int y) {
    const std::uint8_t* t =
        &texture.texels[4 * (static_cast<std::size_t>(y) * texture.width + static_cast<std::size_t>(x))];
    return Vec4(color.decoded(t[0]), color.decoded(t[1]), color.decoded(t[2]), linear.decoded(t[3]));
  });
  while (true) {
    std::vector<std::uint8_t>& codes = out.emplace_back();
    codes.reserve(4 * level.texels.size());
    for (const Vec4& t : level.texels)
      codes.insert(codes.end(), {color.encoded(t.r), color.encoded(t.g), color.encoded(t.b), linear.encoded(t.a)});
    if (level.texels.size() == 1) return out;
    level = halved(level.width, level.height, [&](int x, int y) {
      return level
          .texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) + static_cast<std::size_t>(x)];
    });
  }
}

}  // namespace oriel
