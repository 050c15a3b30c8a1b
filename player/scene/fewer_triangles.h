// The opaque scene with fewer triangles, for frames while something moves: where the CPU rasterises, a triangle costs
// as much as the 16 pixels of a block, however little it covers.
#pragma once

#include <span>
#include <vector>

#include "player/navigation/view.h"
#include "player/scene/gpu_mesh.h"

namespace oriel {

class FewerTriangles {
 public:
  // What passes draw again by themselves, on the depth of the scene: the same triangles have to be in both.
  struct DrawnAgain {
    std::span<const std::uint32_t> kept;                 // three indices a triangle: planar reflectors, as they are
    std::vector<std::span<const std::uint32_t>> curved;  // by curved reflector: simplified apart
  };

  FewerTriangles() = default;
  // ranges: of `indices`, sorted, as sorted_ranges() gives them. Vertices stay those of the mesh, and borders of
  // ranges where they are, so that nothing opens between them. It takes about a second for a million triangles.
  FewerTriangles(const Mesh& mesh, std::span<const DrawRange> ranges, std::span<const std::uint32_t> indices,
                 const DrawnAgain& again);

  const std::vector<std::uint32_t>& indices() const { return indices_; }
  struct Chosen {
    std::vector<DrawRange> ranges;               // of indices(), in the order of those given
    std::vector<std::vector<DrawRange>> curved;  // those of them that are a curved reflector's
  };
  // Of each range as few triangles as are off by no more than `pixels` of the view.
  Chosen choose(const View& view, float pixels) const;

  // Triangles of a material have moved into this box, where it is not empty: by material.
  void follow(std::span<const Bounds> moved);

 private:
  struct Level {
    std::uint32_t first_index = 0, index_count = 0;
    float error_m = 0;  // how far it is off the surface, about
  };
  // A range, or what of it is one curved reflector's, or is kept.
  struct Piece {
    DrawRange range;
    std::size_t curved = kNone;
    std::vector<Level> levels;  // the first has all triangles, each further one fewer
  };
  static constexpr std::size_t kNone = ~std::size_t{0};
  void add(const Mesh& mesh, const DrawRange& range, std::size_t curved, bool kept,
           const std::vector<std::uint32_t>& triangles);

  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> indices_;
  std::size_t curved_count_ = 0;
};

}  // namespace oriel
