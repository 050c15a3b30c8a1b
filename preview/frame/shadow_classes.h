// Where lamps are seen wholly or not at all, as earlier passes tell: umbra, penumbra and lit (U13).
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "preview/frame/lamps.h"

namespace oriel {

// By block of 8 x 8 pixels and lamp. Where all rays so far agreed, one in eight goes on being asked and answers for
// all: with what was assumed a, and what it finds v, it counts as a + 8 (v - a). Who is asked does not depend on what
// is found, so the mean over passes stays that of all rays.
class ShadowClasses {
 public:
  enum Class : std::uint8_t { kUnknown, kLit, kUmbra, kPenumbra };
  static constexpr std::size_t kSide = 8;   // pixels of a block
  static constexpr std::uint32_t kOne = 8;  // of so many is asked

  explicit ShadowClasses(const IVec2& size);  // of the frame, pixels

  // Before a pass, whose points on lamps these are.
  void begin(std::span<const LampPoint> points, std::uint64_t seed, std::uint32_t pass);
  // Of the pass's points: what is assumed of a block. kLit or kUmbra: asks() tells which pixels are asked.
  Class known(std::size_t point, std::size_t block) const;
  bool asks(std::size_t point, std::size_t x, std::size_t y) const { return (x + 3 * y + turns_[point]) % kOne == 0; }
  // What was found there. Blocks of different threads differ.
  void tell(std::size_t point, std::size_t block, const Vec3& passed);
  std::size_t block_of(std::size_t x, std::size_t y) const { return y / kSide * across_ + x / kSide; }

 private:
  struct Lamp {
    std::uint32_t asked = 0, now = 0;  // points of passes before, and of this one
    std::vector<std::uint8_t> before;  // by block: 1 where light passed, 2 where it did not, wholly
    std::vector<std::uint8_t> seen;    // this pass's too
  };
  std::size_t across_ = 0, blocks_ = 0;
  std::map<std::uint32_t, Lamp> lamps_;  // by LampPoint::lamp
  std::vector<Lamp*> of_points_;         // null: nothing is known of its lamp
  std::vector<std::uint32_t> turns_;     // by point: who is asked, at random
};

}  // namespace oriel
