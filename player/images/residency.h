// Which images are kept on the device, how fine, and in which order they come: by how near they are, within a limit of
// bytes. No OpenGL, no threads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "player/navigation/culling.h"

namespace oriel {

inline constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};

// An image that is wanted. Level 0 is the finest; one level more than `bytes` has: it is left out.
struct Wish {
  std::vector<std::uint64_t> bytes;  // on the device by level, each at most the one before
  float rank = 0;                    // how much it matters; smaller ones come first
  int out() const { return static_cast<int>(bytes.size()); }
};

// A level for each wish. All get their coarsest one first, those of the smallest rank before others; then in the same
// order each the finest that still has room. So what matters most is whole before anything else gets finer, and the
// bytes of all levels together never exceed the limit. Ties go to the first.
std::vector<int> plan_residency(std::span<const Wish> wishes, std::uint64_t limit);

// Bytes in use and bytes that are promised to what is about to come: together never above the limit.
class MemoryAccount {
 public:
  explicit MemoryAccount(std::uint64_t limit = kNoLimit) : limit_(limit) {}
  bool has_room(std::uint64_t bytes) const { return bytes <= limit_ - used_; }
  // False, and nothing is taken, where there is no room.
  bool take(std::uint64_t bytes);
  void give_back(std::uint64_t bytes);
  std::uint64_t used() const { return used_; }
  std::uint64_t most_used() const { return most_; }
  std::uint64_t limit() const { return limit_; }

 private:
  std::uint64_t limit_ = kNoLimit, used_ = 0, most_ = 0;
};

// How much what lies in a box matters to an eye: by its distance, in steps of a factor of √2, so that a small move
// changes nothing; what is not in the view counts as eight times as far, what cannot be seen from here as sixteen
// times.
float rank_of(const Bounds& bounds, const Vec3& eye, bool in_view, bool may_be_seen);

}  // namespace oriel
