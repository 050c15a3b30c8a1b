// Shadows of movers on the scene beside rays.
#include "formats/query/mover_pose.h"
#include "tests/player/mover_fixture.h"

namespace oriel {
namespace {
using namespace testing;

constexpr float kRadiance = 100;
constexpr int kLampCells = 96;  // of the rays' lamp, along a side

// The lamp is a square of 1 m in the plane y = 2, the floor lies at y = -2.
Pack lamp_scene() {
  Pack pack = shadow_scene();
  BrightLight& lamp = pack.light_field.lights[0];
  lamp.kind = BrightLightKind::kPolygon;
  lamp.intensity = Vec3(kRadiance);
  lamp.direction = {0, -1, 0};
  lamp.corners = {{-0.5f, 2, -0.5f}, {0.5f, 2, -0.5f}, {0.5f, 2, 0.5f},
                  {-0.5f, 2, -0.5f}, {0.5f, 2, 0.5f},  {-0.5f, 2, 0.5f}};
  return pack;
}

bool meets(const DVec3& from, const DVec3& to, const DVec3& a, const DVec3& b, const DVec3& c) {
  const DVec3 way = to - from, n = glm::cross(b - a, c - a);
  const double along = glm::dot(way, n);
  if (along == 0) return false;
  const double t = glm::dot(a - from, n) / along;
  if (!(t > 1e-9 && t < 1 - 1e-9)) return false;
  const DVec3 p = from + t * way;
  return glm::dot(glm::cross(b - a, p - a), n) >= 0 && glm::dot(glm::cross(c - b, p - b), n) >= 0 &&
         glm::dot(glm::cross(a - c, p - c), n) >= 0;
}

bool meets(const DVec3& from, const DVec3& to, const Mesh& mesh, const DMat4& pose) {
  const auto at = [&](std::uint32_t i) { return DVec3(pose * DVec4(DVec3(mesh.positions[mesh.indices[i]]), 1)); };
  for (std::uint32_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    if (meets(from, to, at(i), at(i + 1), at(i + 2))) return true;
  return false;
}

// What the lamp gives a point of the floor that nothing shades, and what movers alone take of it.
struct Lit {
  double open = 0, taken = 0;
};
Lit by_rays(const Pack& pack, std::span<const MoverPose> poses, const DVec3& p) {
  Lit lit;
  for (int i = 0; i < kLampCells; ++i)
    for (int j = 0; j < kLampCells; ++j) {
      const DVec3 q((i + 0.5) / kLampCells - 0.5, 2, (j + 0.5) / kLampCells - 0.5), way = q - p;
      const double r2 = glm::dot(way, way),
                   e = double{kRadiance} * way.y * way.y / (r2 * r2) / (kLampCells * kLampCells);
      lit.open += e;
      if (meets(p, q, pack.mesh, DMat4(1))) continue;
      bool blocked = false;
      for (std::size_t m = 0; m < pack.movers.size(); ++m)
        blocked = blocked || meets(p, q, pack.movers[m].mesh, pack_from_object(poses[m]));
      if (blocked) lit.taken += e;
    }
  return lit;
}

class MoverShadowsTest : public FrameTest {};

// Sixteen points make steps of a penumbra, four coarser ones; the mean of many looks at them is what rays say.
TEST_F(MoverShadowsTest, OfManyLooksAreAsRays) {
  const Pack pack = lamp_scene();
  Camera camera = above_floor(1.4f, 0.1f);
  camera.vertical_fov_rad = 1;
  constexpr int kShadowSide = 33, kLooks = 64;
  FrameOptions options;
  options.light_points = 4;
  std::vector<double> taken(kShadowSide), first(kShadowSide);
  for (options.look = 0; options.look < kLooks; ++options.look) {
    const Picture picture = draw(pack, camera, kShadowSide, kShadowSide, options);
    for (int x = 0; x < kShadowSide; ++x) {
      const double now = 100 - double{picture.at(x, kShadowSide / 2).g * kPi};
      taken[static_cast<std::size_t>(x)] += now / kLooks;
      if (options.look == 0) first[static_cast<std::size_t>(x)] = now;
    }
  }
  double one = 0, many = 0, open = 0;
  for (int x = 0; x < kShadowSide; ++x) {
    const double at = 1.4 + std::tan(0.5) * (2 * (x + 0.5) / kShadowSide - 1);
    const Lit lit = by_rays(pack, std::vector{pack.movers[0].rest}, {at, -2, 0.1});
    const auto i = static_cast<std::size_t>(x);
    one += (first[i] - lit.taken) * (first[i] - lit.taken), many += (taken[i] - lit.taken) * (taken[i] - lit.taken);
    open += lit.open * lit.open;
  }
  std::printf("penumbra by maps, of the light: %.2f %% by one look of 4 points, %.2f %% by %d\n",
              100 * std::sqrt(one / open), 100 * std::sqrt(many / open), kLooks);
  EXPECT_GT(one, 0.04 * 0.04 * open);
  EXPECT_LT(many, 0.02 * 0.02 * open);  // the maps have texels
}

}  // namespace
}  // namespace oriel
