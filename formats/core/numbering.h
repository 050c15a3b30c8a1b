// Numbers for things, the same for equal ones.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace oriel {

// A hash table that allocates once.
template <class T, class Hash>
class Numbering {
 public:
  explicit Numbering(std::size_t most) : slots_(std::bit_ceil(2 * most), kFree) { things_.reserve(most); }

  std::size_t size() const { return things_.size(); }  // how many different ones there were; the next one's number
  std::uint32_t operator()(const T& thing) {
    std::size_t at = Hash()(thing) & (slots_.size() - 1);
    while (slots_[at] != kFree && !(things_[slots_[at]] == thing)) at = (at + 1) & (slots_.size() - 1);
    if (slots_[at] == kFree) {
      slots_[at] = static_cast<std::uint32_t>(things_.size());
      things_.push_back(thing);
    }
    return slots_[at];
  }

 private:
  static constexpr std::uint32_t kFree = ~0u;
  std::vector<std::uint32_t> slots_;
  std::vector<T> things_;
};

}  // namespace oriel
