// A scene's triangles as what casts shadows: found by beam, and with the edges at which shadows end.
#pragma once

#include <cstdint>

#include "bake/radiosity/shadow_beam.h"

namespace oriel {

class ShadowCasters {
 public:
  explicit ShadowCasters(const Scene& scene);

  const BeamTriangle& triangle(std::uint32_t t) const { return triangles_[t]; }
  // Whether it lets light through somewhere.
  bool is_filter(std::uint32_t t) const { return filters_[t]; }
  // Those that may stand in the beam's way, ascending.
  std::vector<std::uint32_t> in(const ShadowBeam& beam) const;
  // Whether a shadow may end at edge k, from corner k to k + 1: no other triangle continues the surface there, or one
  // that faces the lamp with its other side, or that lets light through where this one does not.
  bool ends_shadow(std::uint32_t t, std::size_t k, const ShadowBeam& beam) const;

 private:
  struct Node {
    TreeBox box;
    std::uint32_t first = 0, count = 0;  // into order_; count 0: two children, the next node and `first`
  };
  void join_edges(const Scene& scene);
  void add_node(std::size_t first, std::size_t count);

  std::vector<BeamTriangle> triangles_;
  std::vector<bool> filters_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  // By triangle and edge: the triangle beyond it, ~0u: none or several; and whether both wind the same way.
  std::vector<std::uint32_t> beyond_;
  std::vector<bool> alike_;
};

}  // namespace oriel
