// Which texels each light sample does not reach: a bit a texel and sample.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oriel::study {

// Words of 32 texels of a row, bit i of word c for texel 32 c + i. The words of one column lie one after the other, row
// by row, so that eight rows are one vector.
class BlockedRows {
 public:
  void reset(int width, int height, int samples) {
    width_ = width, height_ = height, samples_ = samples;
    words_ = (width + 31) / 32;
    column_ = (static_cast<std::size_t>(height) + 15) / 16 * 16 + 16;  // vectors may reach over the last row
    sample_ = column_ * static_cast<std::size_t>(words_) + 16;         // not a power of two: caches would alias
    bits_.assign(sample_ * static_cast<std::size_t>(samples), 0);
  }
  int width() const { return width_; }
  int height() const { return height_; }
  int samples() const { return samples_; }
  int words() const { return words_; }
  std::size_t column_stride() const { return column_; }
  std::size_t sample_stride() const { return sample_; }

  std::uint32_t* of_sample(int s) { return bits_.data() + sample_ * static_cast<std::size_t>(s); }
  const std::uint32_t* of_sample(int s) const { return bits_.data() + sample_ * static_cast<std::size_t>(s); }
  std::uint32_t& word(int s, int column, int row) {
    return of_sample(s)[column_ * static_cast<std::size_t>(column) + static_cast<std::size_t>(row)];
  }
  std::uint32_t word(int s, int column, int row) const {
    return of_sample(s)[column_ * static_cast<std::size_t>(column) + static_cast<std::size_t>(row)];
  }
  bool blocked(int s, int x, int y) const { return word(s, x / 32, y) >> (x % 32) & 1; }

  // What others of the same size do not let through either.
  void add(const BlockedRows& other) {
    for (std::size_t i = 0; i < bits_.size(); ++i) bits_[i] |= other.bits_[i];
  }
  // Leaves what others of the same size let through.
  void remove(const BlockedRows& other) {
    for (std::size_t i = 0; i < bits_.size(); ++i) bits_[i] &= ~other.bits_[i];
  }
  void invert() {
    for (int s = 0; s < samples_; ++s)
      for (int w = 0; w < words_; ++w)
        for (int y = 0; y < height_; ++y) word(s, w, y) ^= full(w);
  }

  // The bits of a word that are texels.
  std::uint32_t full(int column) const {
    const int rest = width_ - 32 * column;
    return rest >= 32 ? ~0u : (1u << rest) - 1;
  }

 private:
  int width_ = 0, height_ = 0, samples_ = 0, words_ = 0;
  std::size_t column_ = 0, sample_ = 0;
  std::vector<std::uint32_t> bits_;
};

// The bits from texel t of a word on; t may lie beside it.
inline std::uint32_t bits_from(int t) {
  return t <= 0 ? ~0u : t < 32 ? ~0u << t : 0u;
}

}  // namespace oriel::study
