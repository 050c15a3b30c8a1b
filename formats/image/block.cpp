#include "formats/image/block.h"

#include <cstring>

namespace oriel::bc6h {
namespace {

class Bits {
 public:
  Bits() = default;
  explicit Bits(const Block& block) { std::memcpy(words_, block.data(), sizeof(words_)); }
  void put(std::uint32_t value, int count) {
    for (int i = 0; i < count; ++i, ++at_) words_[at_ >> 6] |= std::uint64_t{value >> i & 1} << (at_ & 63);
  }
  std::uint32_t get(int count) {
    std::uint32_t value = 0;
    for (int i = 0; i < count; ++i, ++at_) value |= static_cast<std::uint32_t>(words_[at_ >> 6] >> (at_ & 63) & 1) << i;
    return value;
  }
  Block block() const {
    Block out;
    std::memcpy(out.data(), words_, sizeof(words_));
    return out;
  }

 private:
  std::uint64_t words_[2] = {};
  std::size_t at_ = 0;
};

int index_bits(const Mode& mode, std::uint32_t partition, int texel) {
  const bool anchored = texel == 0 || (mode.lines == 2 && texel == anchor(partition));
  return (mode.lines == 1 ? 4 : 3) - (anchored ? 1 : 0);
}

bool is_difference(const Mode& mode, std::size_t endpoint) {
  return mode.differences && endpoint > 0;
}

}  // namespace

Block packed(const Fields& fields) {
  const Mode& mode = modes()[fields.mode];
  Bits out;
  out.put(mode.code, mode.code_bits);
  for (const Bit& bit : bits_of(fields.mode)) {
    std::uint32_t value = fields.endpoints[bit.endpoint][bit.channel];
    if (is_difference(mode, bit.endpoint)) value -= fields.endpoints[0][bit.channel];
    out.put(value >> bit.bit, 1);
  }
  if (mode.lines == 2) out.put(fields.partition, 5);
  for (int i = 0; i < kTexels; ++i)
    out.put(fields.index[static_cast<std::size_t>(i)], index_bits(mode, fields.partition, i));
  return out.block();
}

bool unpacked(const Block& block, Fields& fields) {
  Bits in(block);
  std::uint32_t code = in.get(2);
  if (code >= 2) code |= in.get(3) << 2;
  fields = {};
  while (fields.mode < modes().size() && modes()[fields.mode].code != code) ++fields.mode;
  if (fields.mode == modes().size()) return false;
  const Mode& mode = modes()[fields.mode];
  for (const Bit& bit : bits_of(fields.mode)) fields.endpoints[bit.endpoint][bit.channel] |= in.get(1) << bit.bit;
  for (std::size_t e = 1; mode.differences && e < 2 * static_cast<std::size_t>(mode.lines); ++e)
    for (int c = 0; c < 3; ++c) {
      std::uint32_t& value = fields.endpoints[e][static_cast<std::size_t>(c)];
      const std::uint32_t sign = 1u << (mode.more_bits[c] - 1);
      value = (fields.endpoints[0][static_cast<std::size_t>(c)] + ((value ^ sign) - sign)) & ((1u << mode.bits) - 1);
    }
  if (mode.lines == 2) fields.partition = in.get(5);
  for (int i = 0; i < kTexels; ++i)
    fields.index[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(in.get(index_bits(mode, fields.partition, i)));
  return true;
}

Halves decoded(const Block& block) {
  Halves out{};
  Fields fields;
  if (!unpacked(block, fields)) return out;
  const Mode& mode = modes()[fields.mode];
  const auto weight = weights(mode.lines);
  const std::uint32_t second = mode.lines == 2 ? partition_mask(fields.partition) : 0;
  for (std::size_t i = 0; i < kTexels; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t line = second >> i & 1;
      out[i][static_cast<int>(c)] =
          half_between(unquantised(fields.endpoints[2 * line][c], mode.bits),
                       unquantised(fields.endpoints[2 * line + 1][c], mode.bits), weight[fields.index[i]]);
    }
  return out;
}

}  // namespace oriel::bc6h
