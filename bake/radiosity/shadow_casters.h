// A scene's triangles as what casts shadows: found by beam, and with the edges at which shadows end.
#pragma once

#include <cstdint>

#include "bake/radiosity/shadow_beam.h"

namespace oriel {

inline constexpr double kLevel = 0x1p-20;  // of a scene's radius: what lies in one plane, by rounding

class ShadowCasters {
 public:
  // lights: whose shadows are asked for, into Scene::lights.
  ShadowCasters(const Scene& scene, std::span<const std::uint32_t> lights);

  const BeamTriangle& triangle(std::uint32_t t) const { return triangles_[t]; }
  // Whether it lets light through somewhere.
  bool is_filter(std::uint32_t t) const { return filters_[t]; }
  // A filter that lets more light through in one place than in another.
  bool is_patterned(std::uint32_t t) const { return patterned_[t]; }
  // Those that may stand in the way of a beam to lights[lamp], ascending. Of a closed body that does not hold the lamp
  // the side that faces it is enough: no ray passes the other alone.
  std::vector<std::uint32_t> in(const ShadowBeam& beam, std::size_t lamp) const;
  // Whether a shadow may end at edge k, from corner k to k + 1: no other triangle continues the surface there, or one
  // that faces the lamp with its other side, or that lets light through where this one does not.
  bool ends_shadow(std::uint32_t t, std::size_t k, std::size_t lamp) const;
  // Whether none of a beam's rays passes by those triangles, ascending: a sheet of opaque ones, joined at edges where
  // no shadow ends, is in the way of the middle ray and has no end among the others. In doubt false.
  bool stop_all(const ShadowBeam& beam, std::span<const std::uint32_t> triangles, std::size_t lamp) const;

 private:
  struct Node {
    TreeBox box;
    std::uint32_t first = 0, count = 0;  // into order_; count 0: two children, the next node and `first`
  };
  // Whether a triangle and those joined to it within the beam have no end there. Marks them as seen.
  bool is_sheet(const ShadowBeam& beam, std::span<const std::uint32_t> all, std::uint32_t first, std::size_t lamp,
                std::vector<bool>& seen) const;
  void join_edges(const Scene& scene);
  void find_bodies();
  void look_from(const Light& light, double level);
  void add_node(std::size_t first, std::size_t count);

  std::vector<BeamTriangle> triangles_;
  std::vector<bool> filters_, patterned_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  // By triangle and edge: the triangle beyond it, ~0u: none or several; and whether both wind the same way.
  std::vector<std::uint32_t> beyond_;
  std::vector<bool> alike_;
  std::vector<std::uint32_t> body_;  // by triangle, ~0u: of no closed body
  std::vector<double> volume_;       // by body: its sign is that of fronts outwards
  // By lamp and triangle: whether its front faces the lamp; whether another one of its body is in the way as well.
  std::vector<std::vector<bool>> fronts_, spared_;
};

}  // namespace oriel
