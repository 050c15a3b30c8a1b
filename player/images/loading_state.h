// How far a pack's images are.
#pragma once

#include <cstddef>

#include "player/images/residency.h"

namespace oriel {

struct LoadingState {
  std::uint64_t wanted = 0, there = 0;  // bytes of images that are wanted by what is in view or near, and on the device
  std::uint64_t used = 0, most_used = 0, limit = kNoLimit;
  std::size_t coarser = 0, left_out = 0, failed = 0;  // images, of those wanted
  bool busy = false;                                  // something is on its way
  bool following = false;                             // what comes is maps that are there, as lamps shine now
  bool checking = false;                              // all is there, but not all of the file was looked at yet
  float share() const {
    return wanted > 0 ? static_cast<float>(static_cast<double>(there) / static_cast<double>(wanted)) : 1;
  }
};

}  // namespace oriel
