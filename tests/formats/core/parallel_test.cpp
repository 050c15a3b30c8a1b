// Work on several threads.
#include "formats/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace oriel {
namespace {

TEST(Parallel, EachIsDoneOnce) {
  for (const std::size_t threads : {0, 1, 2, 7, 50})
    for (const std::size_t count : {0, 1, 3, 1000}) {
      std::vector<std::atomic<int>> done(count);
      for_each_parallel(count, threads, [&](std::size_t i) { ++done[i]; });
      for (const auto& times : done) ASSERT_EQ(times, 1);
    }
}

TEST(Parallel, WhatOneThrowsIsThrownOn) {
  std::atomic<int> begun{0};
  const auto body = [&](std::size_t i) {
    ++begun;
    if (i == 3) throw std::length_error("three");
  };
  EXPECT_THROW(for_each_parallel(100000, 1, body), std::length_error);
  EXPECT_EQ(begun, 4) << "none begins after it";
  EXPECT_THROW(for_each_parallel(100000, 4, body), std::length_error);
}

TEST(Parallel, CoresAreAtLeastOne) {
  EXPECT_GE(core_count(), 1u);
  EXPECT_LE(core_count(), 16u);
}

}  // namespace
}  // namespace oriel
