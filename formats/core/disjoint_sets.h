// Sets of numbers that are joined one by one.
#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

namespace oriel {

class DisjointSets {
 public:
  // Each of 0 to count - 1 by itself.
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  // The lowest member of i's set.
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace oriel
