#include "formats/image/modes.h"

#include <charconv>

namespace oriel::bc6h {
namespace {

// Of two lines and of one.
constexpr Mode two(std::uint32_t code, int code_bits, int bits, const glm::ivec3& more, std::string_view layout) {
  return {code, code_bits, 2, bits, more, code != 0b11110, layout};
}
constexpr Mode one(std::uint32_t code, int bits, int more, std::string_view layout) {
  return {code, 5, 1, bits, glm::ivec3(more), code != 0b00011, layout};
}

constexpr std::array<Mode, 14> kModes = {
    two(0b00, 2, 10, {5, 5, 5},
        "gy4 by4 bz4 rw9:0 gw9:0 bw9:0 rx4:0 gz4 gy3:0 gx4:0 bz0 gz3:0 bx4:0 bz1 by3:0 ry4:0 bz2 rz4:0 bz3"),
    two(0b01, 2, 7, {6, 6, 6},
        "gy5 gz4 gz5 rw6:0 bz0 bz1 by4 gw6:0 by5 bz2 gy4 bw6:0 bz3 bz5 bz4 rx5:0 gy3:0 gx5:0 gz3:0 bx5:0 by3:0 ry5:0 "
        "rz5:0"),
    two(0b00010, 5, 11, {5, 4, 4},
        "rw9:0 gw9:0 bw9:0 rx4:0 rw10 gy3:0 gx3:0 gw10 bz0 gz3:0 bx3:0 bw10 bz1 by3:0 ry4:0 bz2 rz4:0 bz3"),
    two(0b00110, 5, 11, {4, 5, 4},
        "rw9:0 gw9:0 bw9:0 rx3:0 rw10 gz4 gy3:0 gx4:0 gw10 gz3:0 bx3:0 bw10 bz1 by3:0 ry3:0 bz0 bz2 rz3:0 gy4 bz3"),
    two(0b01010, 5, 11, {4, 4, 5},
        "rw9:0 gw9:0 bw9:0 rx3:0 rw10 by4 gy3:0 gx3:0 gw10 bz0 gz3:0 bx4:0 bw10 by3:0 ry3:0 bz1 bz2 rz3:0 bz4 bz3"),
    two(0b01110, 5, 9, {5, 5, 5},
        "rw8:0 by4 gw8:0 gy4 bw8:0 bz4 rx4:0 gz4 gy3:0 gx4:0 bz0 gz3:0 bx4:0 bz1 by3:0 ry4:0 bz2 rz4:0 bz3"),
    two(0b10010, 5, 8, {6, 5, 5},
        "rw7:0 gz4 by4 gw7:0 bz2 gy4 bw7:0 bz3 bz4 rx5:0 gy3:0 gx4:0 bz0 gz3:0 bx4:0 bz1 by3:0 ry5:0 rz5:0"),
    two(0b10110, 5, 8, {5, 6, 5},
        "rw7:0 bz0 by4 gw7:0 gy5 gy4 bw7:0 gz5 bz4 rx4:0 gz4 gy3:0 gx5:0 gz3:0 bx4:0 bz1 by3:0 ry4:0 bz2 rz4:0 bz3"),
    two(0b11010, 5, 8, {5, 5, 6},
        "rw7:0 bz1 by4 gw7:0 by5 gy4 bw7:0 bz5 bz4 rx4:0 gz4 gy3:0 gx4:0 bz0 gz3:0 bx5:0 by3:0 ry4:0 bz2 rz4:0 bz3"),
    two(0b11110, 5, 6, {6, 6, 6},
        "rw5:0 gz4 bz0 bz1 by4 gw5:0 gy5 by5 bz2 gy4 bw5:0 gz5 bz3 bz5 bz4 rx5:0 gy3:0 gx5:0 gz3:0 bx5:0 by3:0 ry5:0 "
        "rz5:0"),
    one(0b00011, 10, 10, "rw9:0 gw9:0 bw9:0 rx9:0 gx9:0 bx9:0"),
    one(0b00111, 11, 9, "rw9:0 gw9:0 bw9:0 rx8:0 rw10 gx8:0 gw10 bx8:0 bw10"),
    one(0b01011, 12, 8, "rw9:0 gw9:0 bw9:0 rx7:0 rw10:11 gx7:0 gw10:11 bx7:0 bw10:11"),
    one(0b01111, 16, 4, "rw9:0 gw9:0 bw9:0 rx3:0 rw10:15 gx3:0 gw10:15 bx3:0 bw10:15"),
};

constexpr std::array<std::uint16_t, kPartitions> kMasks = {
    0xCCCC, 0x8888, 0xEEEE, 0xECC8, 0xC880, 0xFEEC, 0xFEC8, 0xEC80, 0xC800, 0xFFEC, 0xFE80,
    0xE800, 0xFFE8, 0xFF00, 0xFFF0, 0xF000, 0xF710, 0x008E, 0x7100, 0x08CE, 0x008C, 0x7310,
    0x3100, 0x8CCE, 0x088C, 0x3110, 0x6666, 0x366C, 0x17E8, 0x0FF0, 0x718E, 0x399C};
constexpr std::array<std::uint8_t, kPartitions> kAnchors = {
    15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 2, 8, 2, 2, 8, 8, 15, 2, 8, 2, 2, 8, 8, 2, 2};
constexpr std::uint8_t kEight[] = {0, 9, 18, 27, 37, 46, 55, 64};
constexpr std::uint8_t kSixteen[] = {0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64};

std::vector<Bit> parsed(std::string_view layout) {
  std::vector<Bit> out;
  while (!layout.empty()) {
    const std::string_view word = layout.substr(0, layout.find(' '));
    layout.remove_prefix(std::min(layout.size(), word.size() + 1));
    const auto channel = static_cast<std::uint8_t>(std::string_view("rgb").find(word[0]));
    const auto endpoint = static_cast<std::uint8_t>(std::string_view("wxyz").find(word[1]));
    int last = 0, first = 0;  // the first is stored lowest
    const char* end = word.data() + word.size();
    const auto read = std::from_chars(word.data() + 2, end, last);
    first = last;
    if (read.ptr != end) std::from_chars(read.ptr + 1, end, first);
    for (int bit = first;; bit += first < last ? 1 : -1) {
      out.push_back({endpoint, channel, static_cast<std::uint8_t>(bit)});
      if (bit == last) break;
    }
  }
  return out;
}

}  // namespace

std::span<const Mode, 14> modes() {
  return kModes;
}

std::span<const Bit> bits_of(std::size_t mode) {
  static const auto all = [] {
    std::array<std::vector<Bit>, kModes.size()> out;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = parsed(kModes[i].layout);
    return out;
  }();
  return all[mode];
}

std::uint16_t partition_mask(std::uint32_t partition) {
  return kMasks[partition];
}

int anchor(std::uint32_t partition) {
  return kAnchors[partition];
}

std::span<const std::uint8_t> weights(int lines) {
  return lines == 1 ? std::span<const std::uint8_t>(kSixteen) : std::span<const std::uint8_t>(kEight);
}

}  // namespace oriel::bc6h
