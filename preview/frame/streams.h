// Streams of the preview's random numbers, so that no two are alike.
#pragma once

#include <cstdint>

namespace oriel {

enum PreviewStream : std::uint64_t {
  kNearStream = 1,
  kFarStream = 2,  // and those after it, one a kind of lamp
  kPixelStream = 0x706978,
  kEyeStream = 0x657965,
  kLandingStream = 0x656c656d,
  kGuideStream = 0x696d706f,
  kReflectionStream = 0x72656673,
  kClassStream = 0x636c617373,
  kTracedStream = std::uint64_t{1} << 40,
  kShareStream = std::uint64_t{1} << 41,
};

}  // namespace oriel
