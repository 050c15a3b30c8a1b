// Which lights movers may block, cell by cell: the visibility database of Barczak 2006 ("Realistic Rendering of Large
// Sets of Point Lights", 4.3.1 and 4.5.1). A mover is a sphere, which never proves that it blocks a light wholly, so
// its state for a cell and a light is none or partial. No OpenGL.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "player/movers/shade_cells.h"

namespace oriel {

// A point that shines.
struct ShadeLight {
  Vec3 position{0};  // pack space, metres
  Vec3 normal{0};    // unit: it shines to the side where that points; 0: to all sides
};

class BlockedLights {
 public:
  // Whether what stands still hides all of the box from the light. May be slow: asked once for a cell and a light, and
  // for each light that a mover may block each time it moves. What it says of cells must not change.
  using Hidden = std::function<bool(std::uint32_t light, const Bounds& box)>;
  static constexpr std::uint32_t kMostMovers = 64;

  // cells: of make_shade_cells(). hidden: nothing where none ever is.
  BlockedLights(std::span<const ShadeCell> cells, std::span<const ShadeLight> lights, Hidden hidden);

  // Puts it there, or moves it from where it was. sphere: centre and radius, metres. One that is not finite, or of a
  // negative radius, is nowhere: the mover is removed. mover: below kMostMovers. What is found does not depend on where
  // the mover was.
  void move(std::uint32_t mover, const Vec4& sphere);
  void remove(std::uint32_t mover);

  // Those that some mover may block in part there, ascending.
  std::vector<std::uint32_t> lights_of(std::uint32_t leaf) const;

 private:
  enum class Sight : std::uint8_t { kUnknown, kFacing, kOpen, kClosed };  // of a cell, from a light
  struct Moving;

  std::size_t at(std::uint32_t cell, std::uint32_t light) const { return cell * lights_.size() + light; }
  bool hides(std::uint32_t light, const Bounds& box) const { return hidden_ && hidden_(light, box); }
  bool blocks(std::uint32_t cell, std::uint32_t light, const Moving& moving);
  bool blocks_any(std::uint32_t light, const Moving& moving);
  void visit(std::uint32_t cell, std::span<const std::uint32_t> lights, const Moving& moving);
  void clear(std::uint32_t cell, std::uint32_t light, std::uint64_t bit);

  std::vector<ShadeCell> cells_;
  std::vector<ShadeLight> lights_;
  Hidden hidden_;
  std::vector<std::uint64_t> movers_;  // by cell and light
  std::vector<Sight> sight_;           // the same
  std::vector<Vec4> spheres_;          // by mover; radius below 0: nowhere
};

}  // namespace oriel
