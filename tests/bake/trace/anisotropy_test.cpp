// Anisotropic lobes through a whole scene: which way they are wide.
#include <gtest/gtest.h>

#include "bake/trace/path.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

// A floor whose texture coordinates run along x and -z, with light from a lamp on the ceiling to one side. The lobe
// reaches farther along its wide direction.
TEST(Anisotropy, TheLobeIsWideAlongTheTangent) {
  for (const bool turned : {false, true}) {
    test::SceneParts parts;
    SceneMaterial brushed;
    brushed.metallic = 1;
    brushed.roughness = 0.2f;
    brushed.anisotropy = 0.9f;
    brushed.anisotropy_rotation_rad = turned ? kPi / 2 : 0;
    parts.quad("floor", parts.add(brushed), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    const Scene scene = parts.finish();
    const Hit hit{0, 1, Vec2(0.2f), true};
    const SurfacePoint surface = surface_at(scene, hit, {0, -1, 0});
    EXPECT_NEAR(std::abs(surface.tangent.x), turned ? 0 : 1, 1e-5);
    EXPECT_NEAR(std::abs(surface.tangent.z), turned ? 1 : 0, 1e-5);
    // Seen from above in the lobe's own frame: more light from afar along x than along y.
    const Vec3 along = glm::normalize(Vec3(0.6f, 0, 1)), across = glm::normalize(Vec3(0, 0.6f, 1)), up(0, 0, 1);
    EXPECT_GT(Bsdf(surface.shade, up).eval(along).g, 20 * Bsdf(surface.shade, up).eval(across).g);
  }
}

}  // namespace
}  // namespace oriel
