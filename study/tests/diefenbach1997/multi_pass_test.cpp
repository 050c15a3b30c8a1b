// Light of lamps in passes (Diefenbach & Badler 1997): against what a ray from each pixel tells.
#include <cmath>
#include <functional>

#include "formats/query/camera.h"
#include "study/tests/diefenbach1997/passes_fixture.h"

namespace oriel::study {
namespace {
using namespace oriel::testing;

constexpr int kWidth = 96, kHeight = 72;

// Of unit lux on a surface that has no reflectance.
constexpr float kWhite = 1 / kPi;

BrightLight point_light(const Vec3& at, const Vec3& cd) {
  BrightLight light;
  light.position = at, light.intensity = cd;
  return light;
}

// Materials 0: white; 1: a mirror of half the light. Page 0: no light.
Pack dark_pack() {
  Pack pack;
  pack.materials.resize(2);
  pack.materials[0].base_color = Vec3(1);
  pack.materials[0].metallic = 0;
  pack.materials[1].metallic = 1;
  pack.materials[1].fresnel_map = 0;
  pack.fresnel_maps.push_back(flat_reflectance(Vec3(0.5f)));
  pack.lightmaps.push_back(flat_page(Vec3(0)));
  return pack;
}

// 8 x 8 m at y = 0, up.
void add_floor(Pack& pack) {
  add_quad(pack, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, 0, 0);
  pack.mesh.parts.back().name = "floor";
}

// Seen from both sides.
void add_sheet(Pack& pack, const Vec3& corner, const Vec3& right, const Vec3& up) {
  add_quad(pack, corner, right, up, 0, 0);
  pack.mesh.parts.back().name = "sheet";
}

void add_plane_mirror(Pack& pack, const Vec3& corner, const Vec3& right, const Vec3& up) {
  add_bare_mirror(pack, corner, right, up, 1);
  pack.mesh.parts.back().name = "mirror";
}

MultiPassSettings by_mirrors(int mirrors) {
  return {.mirrors = mirrors};
}

// Where a pixel sees the floor, if it does.
std::optional<Vec3> on_floor(const Camera& camera, int x, int y) {
  const PixelRay ray = pixel_ray(camera, static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, kWidth, kHeight);
  if (ray.direction.y >= 0) return std::nullopt;
  const Vec3 p = ray.origin - ray.origin.y / ray.direction.y * ray.direction;
  if (std::max(std::abs(p.x), std::abs(p.z)) > 3.9f) return std::nullopt;
  return p;
}

// Lux of a point light of 1 cd on the floor.
float facing(const Vec3& light, const Vec3& p) {
  const Vec3 to = light - p;
  return to.y / std::pow(glm::length(to), 3.0f);
}

// Where the segment from p to the light meets the plane z = depth, y = height, or x = side; axis says which.
Vec3 crossing_at(const Vec3& p, const Vec3& light, int axis, float value) {
  return p + (value - p[axis]) / (light[axis] - p[axis]) * (light - p);
}

// How far inside a rectangle of two coordinates, metres; negative: outside.
float inside(const Vec2& at, const Vec2& lower, const Vec2& upper) {
  return std::min(std::min(at.x - lower.x, upper.x - at.x), std::min(at.y - lower.y, upper.y - at.y));
}

// Whether something at that z, a rectangle of x and y, hides a place on the floor from an eye before it.
bool hides(const Vec3& eye, const Vec3& p, float z, const Vec2& lower, const Vec2& upper) {
  const Vec3 c = crossing_at(p, eye, 2, z);
  return p.z < z && inside({c.x, c.y}, lower, upper) > -0.1f;
}

class MultiPassFrame : public PassesTest {
 protected:
  // Holds pixels of the floor against `lux`; negative: it does not tell, near an edge. What was looked at.
  int compare(const Picture& picture, const Camera& camera, const std::function<float(const Vec3&)>& lux) {
    int looked = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const auto p = on_floor(camera, x, y);
        const float expected = p ? lux(*p) : -1;
        if (expected < 0) continue;
        const float found = picture.at(x, y).x;
        EXPECT_NEAR(found, kWhite * expected, 2e-3f * kWhite * expected + 1e-5f)
            << "at " << x << ", " << y << ": " << p->x << ", " << p->z;
        ++looked;
        if (::testing::Test::HasFailure()) return looked;
      }
    return looked;
  }
};

const Camera kAbove = look_at({0, 5, 5}, {0, 0, 0}, 0.9f);

TEST_F(MultiPassFrame, PointLightIsItsClosedForm) {
  Pack pack = dark_pack();
  add_floor(pack);
  pack.light_field.lights = {point_light({0.5f, 2, -0.5f}, Vec3(100))};
  const PassPicture p = draw(pack, kAbove, kWidth, kHeight, by_mirrors(0));
  EXPECT_GT(compare(p, kAbove, [](const Vec3& at) { return 100 * facing({0.5f, 2, -0.5f}, at); }), 3000);
  EXPECT_EQ(p.passes.light_passes, 1u);
  EXPECT_EQ(p.passes.shadow_passes, 1u);
}

TEST_F(MultiPassFrame, SunAndSpotAreTheirs) {
  Pack pack = dark_pack();
  add_floor(pack);
  BrightLight sun;
  sun.kind = BrightLightKind::kDirectional;
  sun.direction = glm::normalize(Vec3(0.3f, -1, 0.2f));
  sun.intensity = Vec3(50);
  BrightLight spot = point_light({0, 3, 0}, Vec3(200));
  spot.kind = BrightLightKind::kSpot;
  spot.direction = {0, -1, 0};
  spot.inner_cone_rad = 0.2f, spot.outer_cone_rad = 0.4f;
  pack.light_field.lights = {sun, spot};
  const PassPicture p = draw(pack, kAbove, kWidth, kHeight, by_mirrors(0));
  const auto lux = [&](const Vec3& at) {
    const Vec3 to = glm::normalize(Vec3(0, 3, 0) - at);
    const float t = std::clamp((to.y - std::cos(0.4f)) / (std::cos(0.2f) - std::cos(0.4f)), 0.0f, 1.0f);
    return -50 * sun.direction.y + 200 * t * t * facing({0, 3, 0}, at);
  };
  EXPECT_GT(compare(p, kAbove, lux), 3000);
}

// An open sheet of no thickness: all of its edges are borders.
TEST_F(MultiPassFrame, AnOpenSheetThrowsItsShadow) {
  for (const bool upside_down : {false, true}) {
    Pack pack = dark_pack();
    add_floor(pack);
    if (upside_down)
      add_sheet(pack, {-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1});
    else
      add_sheet(pack, {-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1});
    const Vec3 light(0.2f, 3, 0.1f);
    pack.light_field.lights = {point_light(light, Vec3(100))};
    const Camera camera = look_at({0, 0.8f, 3.9f}, {0, 0, 0}, 0.9f);  // sees under the sheet
    const PassPicture p = draw(pack, camera, kWidth, kHeight, by_mirrors(0));
    const auto lux = [&](const Vec3& at) {
      const Vec3 c = crossing_at(at, light, 1, 1);
      const float in = inside({c.x, c.z}, {-0.5f, -0.5f}, {0.5f, 0.5f});
      if (std::abs(in) < 0.03f) return -1.0f;
      return in > 0 ? 0.0f : 100 * facing(light, at);
    };
    EXPECT_GT(compare(p, camera, lux), 800) << upside_down;
  }
}

// The eye in the shadow of a sheet, and behind the back of a one-sided wall, which it sees through and light does not.
TEST_F(MultiPassFrame, TheEyeMayBeWithinVolumes) {
  Pack pack = dark_pack();
  add_floor(pack);
  add_sheet(pack, {-1, 2, 1}, {2, 0, 0}, {0, 0, -2});
  add_sheet(pack, {-2, 0, 2}, {4, 0, 0}, {0, 1.2f, 0});  // to +z, culled from behind
  const Vec3 light(0.1f, 3, -0.2f);
  pack.light_field.lights = {point_light(light, Vec3(100))};
  const auto lux = [&](const Vec3& at) {
    const Vec3 c = crossing_at(at, light, 1, 2), w = crossing_at(at, light, 2, 2);
    const float in = inside({c.x, c.z}, {-1, -1}, {1, 1});
    const float behind = at.z > 2 ? inside({w.x, w.y}, {-2, 0}, {2, 1.2f}) : -1;
    if (std::abs(in) < 0.05f || std::abs(behind) < 0.05f || std::abs(at.z - 2) < 0.05f) return -1.0f;
    return in > 0 || behind > 0 ? 0.0f : 100 * facing(light, at);
  };
  const Camera under = look_at({0, 1.5f, 0}, {0, 0, 3}, 1.4f);
  EXPECT_GT(compare(draw(pack, under, kWidth, kHeight, by_mirrors(0)), under, lux), 1500) << "within one volume";
  const Camera through = look_at({0, 0.7f, -3.5f}, {0, 0, 3.5f}, 0.9f);  // the wall's back is towards it
  EXPECT_GT(compare(draw(pack, through, kWidth, kHeight, by_mirrors(0)), through, lux), 800) << "through a back";
}

// A mirror's virtual light, cut by its outline.
TEST_F(MultiPassFrame, LightComesByWayOfAMirrorThroughItsOutline) {
  Pack pack = dark_pack();
  add_floor(pack);
  add_plane_mirror(pack, {-0.5f, 0.5f, -2}, {1, 0, 0}, {0, 1, 0});  // to +z
  const Vec3 light(0.3f, 2, 1), image(0.3f, 2, -5);
  pack.light_field.lights = {point_light(light, Vec3(100))};
  const auto lux = [&](const Vec3& at) {
    const Vec3 m = crossing_at(at, image, 2, -2);
    const float in = at.z > -2 ? inside({m.x, m.y}, {-0.5f, 0.5f}, {0.5f, 1.5f}) : -1;
    const Vec3 w = crossing_at(at, light, 2, -2);  // the mirror's own shadow
    const float shadow = at.z < -2 ? inside({w.x, w.y}, {-0.5f, 0.5f}, {0.5f, 1.5f}) : -1;
    if (std::abs(in) < 0.03f || std::abs(shadow) < 0.03f) return -1.0f;
    if (hides({0, 5, 5}, at, -2, {-0.5f, 0.5f}, {0.5f, 1.5f})) return -1.0f;
    return (shadow > 0 ? 0 : 100 * facing(light, at)) + (in > 0 ? 50 * facing(image, at) : 0);
  };
  const PassPicture p = draw(pack, kAbove, kWidth, kHeight, by_mirrors(1));
  EXPECT_GT(compare(p, kAbove, lux), 3000);
  EXPECT_EQ(p.passes.light_passes, 2u * p.passes.images);
}

// Both stretches of a way by a mirror have shadows; either can be left out.
TEST_F(MultiPassFrame, ShadowsAreThrownBeforeAndBehindAMirror) {
  for (const bool before : {false, true}) {
    Pack pack = dark_pack();
    add_floor(pack);
    add_plane_mirror(pack, {-2, 0.2f, -2}, {4, 0, 0}, {0, 2, 0});
    const Vec3 light(0, 2.2f, 2), image(0, 2.2f, -6);
    // Its mirrored ray meets z = 0 on the way there where it meets z = -4 behind the mirror.
    const float y = before ? 1.5f : 0.5f;
    add_sheet(pack, {-0.15f, y, 0}, {0.3f, 0, 0}, {0, 0.3f, 0});
    pack.light_field.lights = {point_light(light, Vec3(100))};
    const auto lux = [&](const Vec3& at, bool bent, bool shadows) {
      const auto blocks = [&](const Vec3& from, const Vec3& to, float z) {
        if ((from.z - z) * (to.z - z) >= 0) return -1.0f;
        const Vec3 c = crossing_at(from, to, 2, z);
        return inside({c.x, c.y}, {-0.15f, y}, {0.15f, y + 0.3f});
      };
      const Vec3 m = crossing_at(at, image, 2, -2);
      const float in = inside({m.x, m.y}, {-2, 0.2f}, {2, 2.2f});
      const float direct = blocks(at, light, 0), behind = blocks(at, image, 0), first = blocks(at, image, -4);
      for (const float f : {in, direct, behind, first})
        if (std::abs(f) < 0.05f) return -1.0f;
      if (at.z < -1.9f || hides({0, 5, 5}, at, 0, {-0.15f, y}, {0.15f, y + 0.3f})) return -1.0f;
      const bool blocked = shadows && (behind > 0 || (bent && first > 0));
      return (direct > 0 ? 0 : 100 * facing(light, at)) + (in > 0 && !blocked ? 50 * facing(image, at) : 0);
    };
    MultiPassSettings how = by_mirrors(1);
    const PassPicture all = draw(pack, kAbove, kWidth, kHeight, how);
    EXPECT_GT(compare(all, kAbove, [&](const Vec3& at) { return lux(at, true, true); }), 1500) << before;
    how.bent_shadows = false;
    const PassPicture straight = draw(pack, kAbove, kWidth, kHeight, how);
    EXPECT_GT(compare(straight, kAbove, [&](const Vec3& at) { return lux(at, false, true); }), 1500) << before;
    how.shadow_mirrors = 0;
    const PassPicture none = draw(pack, kAbove, kWidth, kHeight, how);
    EXPECT_GT(compare(none, kAbove, [&](const Vec3& at) { return lux(at, false, false); }), 1500) << before;
    EXPECT_EQ(all.passes.shadow_passes, 3 * all.passes.images);
    EXPECT_EQ(straight.passes.shadow_passes, 2 * all.passes.images);
    EXPECT_EQ(none.passes.shadow_passes, all.passes.images);
  }
}

// What a mirror shows is lit by the same passes.
TEST_F(MultiPassFrame, MirrorsShowTheLight) {
  Pack pack = dark_pack();
  add_floor(pack);
  add_plane_mirror(pack, {-2, 0, -2}, {4, 0, 0}, {0, 4, 0});
  const Vec3 light(1, 2, 1);
  pack.light_field.lights = {point_light(light, Vec3(100))};
  const Vec3 eye(0, 1.5f, 3), at(-0.4f, 0, 0.8f);  // seen where the mirrored eye sees it
  const Vec3 towards = Vec3(at.x, 0, -4 - at.z) - eye;
  const Camera camera = look_at(eye, eye + towards, 0.02f);
  const PassPicture p = draw(pack, camera, 33, 33, by_mirrors(0));
  EXPECT_NEAR(p.at(16, 16).x, 0.5f * kWhite * 100 * facing(light, at), 0.02f);
  EXPECT_EQ(p.passes.images, 2u);
}

// Of n mirrors that all see each other and the lamp, and to depth d of images and of light: n^d + 1 images, and in each
// n (d² + 3d) / 2 + 1 shadow passes a lamp (equations 7 and 8), up to two mirrors. Their table 3 has eight and nineteen
// for two and three: ways by two mirrors, which visibility leaves them. Three mirrors have six of these, not three.
TEST_F(MultiPassFrame, TakesAsManyPassesAsDiefenbachCounts) {
  Pack pack = dark_pack();
  const Camera camera = look_at({0.05f, 0.02f, 0.6f}, {0, 0, -2}, 1.6f);
  const std::array<std::array<Vec3, 3>, 3> walls{{{Vec3(-1, -1, -2), Vec3(2, 0, 0), Vec3(0, 2, 0)},   // back
                                                  {Vec3(-1, -1, 0), Vec3(0, 0, -2), Vec3(0, 2, 0)},   // left
                                                  {Vec3(1, -1, -2), Vec3(0, 0, 2), Vec3(0, 2, 0)}}};  // right
  add_quad(pack, {-1, -1, 0}, {2, 0, 0}, {0, 0, -2}, 0, 0);
  pack.light_field.lights = {point_light({0.1f, 0.1f, -0.5f}, Vec3(10))};
  for (std::uint32_t n = 1; n <= walls.size(); ++n) {
    const auto& [corner, right, up] = walls[n - 1];
    add_plane_mirror(pack, corner, right, up);
    pack.fresnel_maps[0] = flat_reflectance(Vec3(1));
    for (const std::uint32_t d : {1u, 2u}) {
      FrameOptions options = in_passes();
      options.orders = static_cast<int>(d);
      const MultiPassStats s = draw(pack, camera, 160, 120, by_mirrors(static_cast<int>(d)), options).passes;
      EXPECT_EQ(s.images, 1 + n + (d > 1 ? n * (n - 1) : 0)) << n << ", " << d;
      const std::uint32_t pairs = d > 1 ? n * (n - 1) : 0;
      EXPECT_EQ(s.light_passes, s.images * (1 + n + pairs)) << n << ", " << d;
      EXPECT_EQ(s.shadow_passes, s.images * (1 + 2 * n + 3 * pairs)) << n << ", " << d;
      const std::uint32_t equation_7 = n * (d * d + 3 * d) / 2 + 1;
      if (d == 1 || n == 2) {
        EXPECT_EQ(s.shadow_passes, s.images * equation_7) << n << ", " << d;
      }
    }
  }
}

}  // namespace
}  // namespace oriel::study
