// Which pixels lie on one surface, and means over them: what pixels share must not cross edges.
#pragma once

#include <vector>

#include "bake/jobs/context.h"
#include "formats/core/vec.h"

namespace oriel {

// By pixel, as SeenSurfaces has them, row 0 at the bottom.
struct SeenPoints {
  int width = 0, height = 0;
  std::vector<Vec4> place;   // a: triangle + 1, 0 where nothing is seen
  std::vector<Vec4> face;    // geometric normals, on the eye's side
  std::vector<Vec4> normal;  // shading normals; a: 1 to be traced
};

class Neighbours {
 public:
  explicit Neighbours(const SeenPoints& seen) : seen_(seen) {}

  // Whether two pixels, both of which see something, see one surface. Their normals differ little, and neither lies
  // farther off the other's tangent plane than a surface bends whose normals turn by so much: over a chord c by which
  // normals differ by d a sphere leaves the plane by c d / 2.
  bool same_surface(std::size_t i, std::size_t j) const;

  // By pixel sums over some points, and in a how many: the mean of the pixels around it on its surface, times `all`.
  // Of 3 x 3 pixels, and where those have fewer than `all` points up to 7 x 7. even: 3 x 3 pixels weigh alike; else
  // those in the middle count twice (of points that 2 x 2 pixels share, so that all points weigh the same).
  Result<std::vector<Vec4>> gathered(const std::vector<Vec4>& sums, float all, bool even, Context& context) const;

  // One round of an edge-avoiding à-trous filter (Dammertz et al. 2010), whose nine taps are `step` pixels apart.
  Result<std::vector<Vec4>> smoothed(const std::vector<Vec4>& light, std::size_t step, Context& context) const;

 private:
  Vec4 around(std::size_t x, std::size_t y, const std::vector<Vec4>& sums, float all, bool even) const;

  const SeenPoints& seen_;
};

}  // namespace oriel
