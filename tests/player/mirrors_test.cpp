// Mirrored geometry: mirrors in mirrors, a mirror over a polished floor, what moves and what is curved in mirrors.
#include <cmath>

#include "formats/query/camera.h"
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {
using namespace testing;

const Vec3 kMirroredSky(10, 20, 30);

// Materials 0: a mirror of half the light; 1 … 3: red, green and blue lamps.
Pack empty_pack() {
  Pack pack;
  pack.materials.resize(4);
  pack.materials[0].metallic = 1;
  pack.materials[0].fresnel_map = 0;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.5f)));
  pack.materials[1].emission = {8, 0, 0};
  pack.materials[2].emission = {0, 8, 0};
  pack.materials[3].emission = {0, 0, 8};
  pack.sky = kMirroredSky;
  return pack;
}

// Squares of 2 m at z = 0 and z = 4 that face each other under a sky all around.
Pack facing_mirrors() {
  Pack pack = empty_pack();
  add_bare_mirror(pack, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  add_bare_mirror(pack, {1, -1, 4}, {-2, 0, 0}, {0, 2, 0});
  return pack;
}

// How often a ray between the facing mirrors meets one before it leaves; negative: too near to an edge to tell.
int bounces(Vec3 from, Vec3 along) {
  for (int count = 0;; ++count) {
    const float plane = along.z < 0 ? 0.0f : 4.0f;
    const float t = (plane - from.z) / along.z;
    if (!(t > 0) || t > 1e4f) return count;
    from += t * along;
    const float edge = std::max(std::abs(from.x), std::abs(from.y));
    if (std::abs(edge - 1) < 0.04f * static_cast<float>(count + 1)) return -1;
    if (edge > 1) return count;
    along.z = -along.z;
  }
}

class Mirrors : public FrameTest {};

// The light of a ray that leaves after k mirrors is the sky's times half to the k; beyond the last order it is black,
// as no light falls on the mirrors themselves.
TEST_F(Mirrors, FacingMirrorsShowEachOtherToTheLastOrder) {
  const Pack pack = facing_mirrors();
  const Camera camera = look_at({0.1f, 0.05f, 2}, {0.45f, 0.2f, 0}, 1.0f);
  for (const int orders : {1, 2, 3, 5}) {
    FrameOptions options;
    options.orders = orders;
    const Picture p = draw(pack, camera, 96, 72, options);
    std::vector<int> met(8);
    for (int y = 0; y < 72; ++y)
      for (int x = 0; x < 96; ++x) {
        const PixelRay ray = pixel_ray(camera, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 96, 72);
        const int k = bounces(ray.origin, ray.direction);
        if (k < 0) continue;
        const Vec3 expected = k > orders ? Vec3(0) : kMirroredSky * std::pow(0.5f, static_cast<float>(k));
        ASSERT_LT(glm::length(p.at(x, y) - expected), 1e-3f)
            << orders << " orders, " << k << " mirrors, at " << x << ", " << y;
        ++met[static_cast<std::size_t>(std::min(k, 7))];
      }
    EXPECT_GT(met[2], 100);
    EXPECT_GT(met[3], 10);
  }
}

// A lamp's slanted edge in a mirror: each pixel shows as much light as the lamp covers of it. A sample a pixel is 0.25
// off on the mean.
TEST_F(Mirrors, EdgesInThemAreNoStairs) {
  constexpr float kSlope = 0.15f;
  Pack pack = empty_pack();
  pack.sky = Vec3(0);
  add_bare_mirror(pack, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  const Vec3 along(10, 10 * kSlope, 0);
  add_quad(pack, Vec3(-5, -5 * kSlope, 3), along, {0, -10, 0}, 1, -1);
  const Camera camera = look_at({0, 0, 2}, {0, 0, 0}, 1.0f);
  FrameOptions options;
  options.samples = 4;
  const Picture p = draw(pack, camera, 160, 120, options);
  double off = 0;
  int edge = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      const PixelRay ray = pixel_ray(camera, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 160, 120);
      const Vec3 behind = ray.origin + ray.direction * (-5 / ray.direction.z);
      const float pixel = 10 * std::tan(0.5f) / 120;  // of the lamp's mirror image
      const float above = (behind.y - kSlope * behind.x) / pixel;
      if (std::abs(above) > 0.5f || std::abs(behind.x) > 2) continue;
      ++edge;
      off += std::abs(p.at(x, y).x / 4 - (0.5f - above));
    }
  EXPECT_GT(edge, 60);
  EXPECT_LT(off / edge, 0.08) << "of " << edge;
}

// Where nothing is asked for, mirrors that lose little go on past the second order, and those that lose half do not.
TEST_F(Mirrors, GoOnWhileMostOfTheLightIsLeft) {
  Pack pack = facing_mirrors();
  const Camera camera = look_at({0.01f, 0.01f, 1}, {0, 0, 0}, 0.1f);  // nearly along the axis: no sky is met for long
  const auto reflectors_drawn = [&](float reflectance, std::optional<int> orders) {
    pack.fresnel_maps[0] = flat_reflectance(Vec3(reflectance));
    FrameOptions options;
    options.orders = orders;
    return draw(pack, camera, 96, 72, options).stats.reflectors;
  };
  EXPECT_EQ(reflectors_drawn(0.49f, {}), reflectors_drawn(0.49f, 2));
  EXPECT_EQ(reflectors_drawn(0.8f, {}), reflectors_drawn(0.8f, 3)) << "0.8 to the third is the last above a half";
  EXPECT_GT(reflectors_drawn(0.95f, {}), reflectors_drawn(0.95f, 6));
}

// n mirrors that all see each other take n^d + 1 images to depth d with the frame's own (Diefenbach & Badler 1997,
// equation 8), for the depths of their table 3: one of each mirror, and in that one of each other mirror.
TEST_F(Mirrors, TakeTheirNumberToTheDepthOfImages) {
  Pack pack = empty_pack();
  const Camera camera = look_at({0.05f, 0.02f, 0.6f}, {0, 0, -2}, 1.6f);
  const std::array<std::array<Vec3, 3>, 3> walls{{{Vec3(-1, -1, -2), Vec3(2, 0, 0), Vec3(0, 2, 0)},   // back
                                                  {Vec3(-1, -1, 0), Vec3(0, 0, -2), Vec3(0, 2, 0)},   // left
                                                  {Vec3(1, -1, -2), Vec3(0, 0, 2), Vec3(0, 2, 0)}}};  // right
  for (std::size_t n = 1; n <= walls.size(); ++n) {
    const auto& [corner, right, up] = walls[n - 1];
    add_bare_mirror(pack, corner, right, up);
    pack.fresnel_maps[0] = flat_reflectance(Vec3(1));
    for (const int depth : {1, 2}) {
      FrameOptions options;
      options.orders = depth;
      EXPECT_EQ(draw(pack, camera, 160, 120, options).stats.reflectors, depth == 1 ? n : n * n) << n << ", " << depth;
    }
  }
}

// Three glossy, lit walls of one material. What a budget does not cover shows its mean light, as without reflections;
// what it covers is as without a budget. Whole mirrors are drawn whatever they cost, but nothing in them.
TEST_F(Mirrors, ThatABudgetDoesNotCoverShowTheirMeanLight) {
  Pack pack = empty_pack();
  add_bare_mirror(pack, {-1, -1, -2}, {2, 0, 0}, {0, 2, 0});
  add_bare_mirror(pack, {-1, -1, 0}, {0, 0, -2}, {0, 2, 0});
  add_bare_mirror(pack, {1, -1, -2}, {0, 0, 2}, {0, 2, 0});
  pack.lightmaps = {flat_page({40, 50, 60})};
  for (MeshPart& part : pack.mesh.parts) part.lightmap_page = 0;
  pack.fresnel_maps[0] = flat_reflectance(Vec3(0.3f));
  pack.materials[0].roughness = 0;
  const Camera camera = look_at({0.05f, 0.02f, 0.6f}, {0, 0, -2}, 1.6f);
  FrameOptions options;
  const auto drawn = [&](float budget_ms) {
    options.image_budget_ms = budget_ms;
    return draw(pack, camera, 160, 120, options);
  };
  const float infinity = std::numeric_limits<float>::infinity();
  const Picture all = drawn(infinity);
  EXPECT_EQ(drawn(1e6f).rgb, all.rgb);
  options.reflections = Reflections::kOff;
  const Picture none = drawn(infinity);
  options.reflections = Reflections::kChosen;
  EXPECT_EQ(drawn(0).rgb, none.rgb);
  options.orders = 1;
  const Picture direct = drawn(infinity);
  ASSERT_EQ(direct.stats.reflectors, 3u);
  Picture some;
  for (float budget = 0; some.stats.reflectors == 0 && budget < 100; budget += 0.25f) some = drawn(budget);
  ASSERT_EQ(some.stats.reflectors, 1u);
  int mean = 0, image = 0;
  for (const int x : {10, 80, 150}) {
    ASSERT_GT(glm::length(direct.at(x, 60) - none.at(x, 60)), 0.1f) << x;
    mean += some.at(x, 60) == none.at(x, 60);
    image += some.at(x, 60) == direct.at(x, 60);
  }
  EXPECT_EQ(mean, 2);
  EXPECT_EQ(image, 1);
  pack.fresnel_maps[0] = flat_reflectance(Vec3(0.9f));
  options.orders = {};
  EXPECT_EQ(drawn(0).stats.reflectors, 3u);
}

// Unlit surfaces are as bright as the pack says that their white is.
TEST_F(Mirrors, ShowUnlitSurfacesAsBrightAsThePackSays) {
  Pack pack = empty_pack();
  pack.materials[1].unlit = true;
  pack.materials[1].emission = Vec3(400);
  pack.materials[1].base_color = {0.25f, 0.5f, 1};
  add_bare_mirror(pack, {-2, 0, 0}, {4, 0, 0}, {0, 4, 0});
  add_quad(pack, {0.5f, 1, 2}, {-1, 0, 0}, {0, 1, 0}, 1, -1);  // to -z
  const auto at = [&](const Vec3& eye, const Vec3& target) {
    return draw(pack, look_at(eye, target, 0.05f), 33, 33).at(16, 16);
  };
  EXPECT_LT(glm::length(at({0, 1.5f, 5}, {0, 1.5f, -2}) - 200.0f * Vec3(0.25f, 0.5f, 1)), 1e-2f) << "in the mirror";
  EXPECT_LT(glm::length(at({0, 1.5f, 1}, {0, 1.5f, 2}) - 400.0f * Vec3(0.25f, 0.5f, 1)), 1e-2f) << "straight on";
}

// A wall mirror stands over a polished floor; what hangs before it is seen by way of both, each way round.
TEST_F(Mirrors, AMirrorOverAPolishedFloor) {
  Pack pack = empty_pack();
  pack.sky = Vec3(0);
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.25f)));
  pack.materials.resize(5);
  pack.materials[4] = pack.materials[0];
  pack.materials[4].fresnel_map = 1;
  add_bare_mirror(pack, {-2, 0, 0}, {4, 0, 0}, {0, 4, 0});      // the wall, to +z
  add_bare_mirror(pack, {-2, 0, 6}, {4, 0, 0}, {0, 0, -6}, 4);  // the floor, up
  add_quad(pack, {-0.5f, 1, 2}, {1, 0, 0}, {0, 1, 0}, 1, -1);   // red to +z: seen without any mirror
  add_quad(pack, {0.5f, 1, 2}, {-1, 0, 0}, {0, 1, 0}, 2, -1);   // green to -z: in the wall
  const Vec3 eye(0, 1.6f, 5);
  const auto at = [&](const Vec3& image, const FrameOptions& options) {  // towards an image of the lamp
    return draw(pack, look_at(eye, image, 0.05f), 33, 33, options).at(16, 16);
  };
  FrameOptions options;
  EXPECT_LT(glm::length(at({0, 1.5f, 2}, options) - Vec3(8, 0, 0)), 1e-3f);
  EXPECT_LT(glm::length(at({0, -1.5f, 2}, options) - Vec3(2, 0, 0)), 1e-3f) << "in the floor";
  EXPECT_LT(glm::length(at({0, -1.5f, -2}, options) - Vec3(0, 1, 0)), 1e-3f) << "by way of both";
  options.orders = 1;
  EXPECT_LT(glm::length(at({0, -1.5f, -2}, options)), 1e-3f) << "no mirror in a mirror";
}

// On the plane, behind it and beside it there is nothing to see; nothing is no number.
TEST_F(Mirrors, AnEyeOnThePlane) {
  const Pack pack = facing_mirrors();
  for (const Vec3& eye :
       {Vec3(0, 0, 0), Vec3(0, 0, 1e-7f), Vec3(0, 0, 4), Vec3(0, 0, -1), Vec3(1, 0, 2), Vec3(3, 0, 1e-4f)}) {
    FrameOptions options;
    options.orders = 4;
    EXPECT_TRUE(draw(pack, look_at(eye, {0.2f, 0.1f, 2.01f}, 1.2f), 48, 32, options).finite()) << eye.z;
  }
}

// Groups that are known not to be seen in a mirror are not drawn in it; beside the places where that is known all are.
TEST_F(Mirrors, DrawWhatTheirSetsHold) {
  Pack pack = empty_pack();
  add_bare_mirror(pack, {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  add_quad(pack, {4, -4, 4}, {-8, 0, 0}, {0, 8, 0}, 1, -1);
  pack.walk_grids = {{{-1, 1}, 0.5f, 4, 4, std::vector<float>(16, -1.0f), 1.0f}};
  pack.visible_sets.groups = 2;
  pack.visible_sets.runs = {{6, 0}, {6, 1}};
  pack.visible_sets.made_for = visibility_hash(pack.mesh, pack.materials, pack.walk_grids);
  const auto seen = [&](std::uint8_t set, float eye_y = 0) {
    pack.reflected_sets.seen = {set};
    pack.reflected_sets.made_for = reflected_hash(pack.visible_sets, pack.reflectors);
    return draw(pack, look_at({0, eye_y, 2}, {0, 0, 0}, 0.3f), 32, 32).at(16, 16);
  };
  EXPECT_LT(glm::length(seen(3) - Vec3(4, 0, 0)), 1e-3f);
  EXPECT_LT(glm::length(seen(1) - 0.5f * kMirroredSky), 1e-3f);
  EXPECT_LT(glm::length(seen(1, 1) - Vec3(4, 0, 0)), 1e-3f) << "nobody asked for eyes up there";
  pack.reflected_sets.made_for = {};
  EXPECT_LT(glm::length(draw(pack, look_at({0, 0, 2}, {0, 0, 0}, 0.3f), 32, 32).at(16, 16) - Vec3(4, 0, 0)), 1e-3f)
      << "of another pack";
}

// Slanted strips on two facing walls: the box around each on the screen is most of the picture, so that what an image
// of it is worth never falls. Their images would be a power of sixteen.
TEST_F(Mirrors, ThatOverlapOnTheScreenEndInTime) {
  Pack pack = empty_pack();
  pack.fresnel_maps[0] = flat_reflectance(Vec3(0.99f));
  for (int i = 0; i < 8; ++i) {
    const float x = -1 + 0.15f * static_cast<float>(i);
    add_bare_mirror(pack, {x, -1, -1}, {0.06f, -0.06f, 0}, {1.4f, 1.4f, 0});
    add_bare_mirror(pack, {x, -1, 1}, {1.4f, 1.4f, 0}, {0.06f, -0.06f, 0});
  }
  const Picture picture = draw(pack, look_at({0, 0, 0.5f}, {0, 0, -1}, 1.2f), 48, 48);
  EXPECT_TRUE(picture.finite());
  EXPECT_GT(picture.stats.reflectors, 100u) << "the scene has many images";
  EXPECT_LE(picture.stats.reflectors, 16u * 1100);
}

}  // namespace
}  // namespace oriel
