// Light that is computed by pixel: it is what rays find, everywhere.
#include <gtest/gtest.h>

#include "bake/radiosity/sharp_records.h"
#include "bake/trace/punctual.h"
#include "bake/trace/sampler.h"
#include "bake/trace/warp.h"
#include "formats/core/color.h"
#include "formats/query/sharp_light.h"
#include "tests/bake/radiosity/baked.h"

namespace oriel {
namespace {

using test::Baked;
using test::SceneParts;

Light point_at(const Vec3& place) {
  Light light;
  light.position = place, light.intensity = Vec3(100);
  return light;
}

Light sun_along(const Vec3& direction, float radius_rad) {
  Light light;
  light.type = LightType::kDirectional;
  light.direction = glm::normalize(direction), light.intensity = Vec3(1000), light.angular_radius_rad = radius_rad;
  return light;
}

// A floor and a wall with clutter: boxes, a ball, sheets that stand on the floor and float, tiles that meet without
// common corners.
Scene cluttered(std::vector<Light> lights) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", matt, {-3, 0, 3}, {6, 0, 0}, {0, 0, -6});
  parts.quad("wall", matt, {-3, 0, -3}, {6, 0, 0}, {0, 3, 0});
  for (std::uint32_t k = 0; k < 12; ++k) {
    Sampler sampler(5, 0, k);
    const float x = -2.5f + 5 * sampler.next1(), z = -2.5f + 4 * sampler.next1(),
                y = 1.2f * std::max(sampler.next1() - 0.5f, 0.0f);
    const Vec3 size(0.05f + 0.4f * sampler.next1(), 0.02f + 0.6f * sampler.next1(), 0.05f + 0.4f * sampler.next1());
    parts.box("box", matt, {x, y, z}, Vec3(x, y, z) + size);
  }
  parts.sphere("ball", matt, {0.4f, 0.9f, 0.3f}, 0.35f, 3);
  parts.quad("sheet", matt, {-1.5f, 0, 1}, {0.8f, 0, 0.3f}, {0, 0.7f, 0});
  for (int k = 0; k < 3; ++k)
    parts.quad("tile", matt, {1.0f + 0.3f * static_cast<float>(k), 1.1f, 1}, {0.3f, 0, 0},
               {0, 0, -0.25f - 0.1f * static_cast<float>(k)});
  parts.scene().lights = std::move(lights);
  return parts.finish();
}

RadiosityOptions sharp_options() {
  RadiosityOptions options = test::cached_options(0.05);
  options.sharp = true;
  return options;
}

struct LookedAt {
  int points = 0, lit = 0, dark = 0, wrong = 0;  // wrong: further from the rays than a margin
  double worst = 0;                              // of shares of the lamp's light
  double shown = 0, by_rays = 0;                 // all of them
};

// The light of the first lamp at places of flat charts, beside what `rays` rays bring. A place counts as wrong where
// the share of the lamp that shows is off by more than `margin`, unless it is as right some 0.2 mm away.
LookedAt look_at(const Baked& b, std::uint32_t rays, double margin) {
  LookedAt found;
  const Accel accel = *Accel::build(b.scene);
  const LightSet lights(b.scene);
  const auto by_rays = [&](const Vec3& p, const Vec3& normal, std::uint32_t seed) {
    Vec3 sum(0);
    for (std::uint32_t k = 0; k < rays; ++k) {
      Sampler sampler(9, seed, k);
      const Vec3 origin = p + 2e-5f * normal;
      const LightSample s = lights.sample_light(0, origin, sampler.next2());
      sum += s.estimate * std::max(glm::dot(s.direction, normal), 0.0f) *
             accel.transmittance({origin, s.direction, s.distance, true, false}) / static_cast<float>(rays);
    }
    return luminance(sum);
  };
  std::uint32_t number = 0;
  b.each_texel([&](const LightmapPage& page, std::uint32_t texel, std::uint32_t triangle) {
    if (page.sharp_at.empty()) return;
    Sampler sampler(3, number++, 0);
    const UVec3& v = b.scene.triangles[triangle];
    const auto& uv = b.atlas.uv[triangle];
    const Vec2 share = square_to_triangle(sampler.next2());
    const Vec2 at = uv[0] + share.x * (uv[1] - uv[0]) + share.y * (uv[2] - uv[0]);
    const Vec3 normal = geometric_normal(b.scene, triangle);
    const Vec3 &p0 = b.scene.positions[v.x], pu = b.scene.positions[v.y] - p0, pv = b.scene.positions[v.z] - p0;
    const std::string& name = b.scene.surfaces[b.scene.triangle_surface[triangle]].name;
    if (name == "ball" || name == "lattice" || name == "moulding") return;
    (void)texel;
    const Vec3 p = p0 + share.x * pu + share.y * pv;
    const LightSample full = lights.sample_light(0, p, Vec2(0.5f));
    const double all = luminance(full.estimate) * std::max(glm::dot(full.direction, normal), 0.0f);
    if (!(all > 0.01)) return;
    const auto off_at = [&](const Vec3& q) {
      return std::abs(luminance(sharp_irradiance(b.radiosity.sharp_light, page, {at, q, normal})) -
                      by_rays(q, normal, number)) /
             all;
    };
    double off = off_at(p);
    for (const Vec3& step : {pu, -pu, pv, -pv})
      if (off > margin) off = std::min(off, off_at(p + 2e-4f * glm::normalize(step)));
    found.by_rays += by_rays(p, normal, number) / all;
    const double shown = luminance(sharp_irradiance(b.radiosity.sharp_light, page, {at, p, normal})) / all;
    found.shown += shown;
    ++found.points, found.lit += shown > 0.99, found.dark += shown < 0.01;
    found.wrong += off > margin, found.worst = std::max(found.worst, off);
  });
  return found;
}

TEST(SharpLight, OfAPointIsWhatRaysFindToTheEdge) {
  const Baked b = test::bake(cluttered({point_at({0.3f, 2.4f, 0.8f})}), 0.1f, sharp_options());
  const LookedAt found = look_at(b, 1, 0.01);
  EXPECT_GT(found.points, 3000);
  EXPECT_GT(found.dark, 300);
  EXPECT_EQ(found.wrong, 0) << "of " << found.points;
}

// Walls of a closed body meet the next one without an edge of a shadow, and end a fifth into a tile of texels.
TEST(SharpLight, ReachesTheEndsOfTheWallsOfAClosedRoom) {
  SceneParts parts;
  parts.box("room", parts.diffuse(Vec3(0.5f)), {-2, 0, -3}, {2, 2.5f, 3}, true);
  parts.scene().lights = {point_at({-1.8f, 2.3f, -2.7f})};
  const LookedAt found = look_at(test::bake(parts.finish(), 0.2f, sharp_options()), 1, 0.01);
  EXPECT_GT(found.points, 500);
  EXPECT_EQ(found.wrong, 0) << "of " << found.points;
}

TEST(SharpLight, OfASpotAndALowSunToo) {
  Light spot = point_at({-2, 2.6f, 2});
  spot.type = LightType::kSpot;
  spot.direction = glm::normalize(Vec3(0.6f, -1, -0.7f)), spot.inner_cone_rad = 0.3f, spot.outer_cone_rad = 0.6f;
  const LookedAt of_spot = look_at(test::bake(cluttered({spot}), 0.15f, sharp_options()), 1, 0.01);
  EXPECT_LE(of_spot.wrong, 1) << "of " << of_spot.points << ": rays may miss a facet that they see edge-on";
  const LookedAt of_sun =
      look_at(test::bake(cluttered({sun_along({0.8f, -0.3f, -0.4f}, 0)}), 0.15f, sharp_options()), 1, 0.01);
  EXPECT_GT(of_sun.dark, 100);
  EXPECT_EQ(of_sun.wrong, 0) << "of " << of_sun.points;
}

// Uneven angles; how horizontal ones go on is theirs.
LightProfile measured(std::vector<float> horizontal_deg) {
  LightProfile profile{"p", {0, 2.5f, 5, 10, 22.5f, 45, 60, 90}, std::move(horizontal_deg), {}};
  for (std::size_t i = 0; i < profile.vertical_deg.size() * profile.horizontal_deg.size(); ++i)
    profile.candela.push_back(100 + 40 * static_cast<float>(i * i % 7));
  return profile;
}

Light profiled(const Vec3& place, bool mirrored) {
  Light light = point_at(place);
  light.type = LightType::kSpot, light.outer_cone_rad = 0.1f;  // which a profile replaces
  light.direction = glm::normalize(Vec3(0.3f, -1, -0.2f));
  light.right = glm::normalize(glm::cross(light.direction, Vec3(0.2f, 0.1f, 1)));
  light.color = Vec3(0.5f, 1, 2), light.profile = 0, light.mirrored = mirrored;
  return light;
}

TEST(SharpLight, OfAProfileIsWhatWasMeasured) {
  for (const auto& horizontal : {std::vector<float>{0}, {0, 30, 90}, {0, 45, 180}, {90, 135, 270}, {0, 45, 120, 360}})
    for (const bool mirrored : {false, true}) {
      Scene scene;
      scene.profiles = {measured(horizontal)}, scene.lights = {profiled(Vec3(0), mirrored)};
      if (horizontal.back() == 360)
        std::copy_n(scene.profiles[0].candela.begin(), 8, scene.profiles[0].candela.end() - 8);
      SharpLight out;
      add_lamps(scene, std::vector<std::uint32_t>{0}, out);
      for (std::uint32_t k = 0; k < 500; ++k) {
        const Vec3 way = square_to_sphere(Sampler(1, 0, k).next2());
        const Vec3 found = out.lamps[0].intensity * candela_of(out.profiles[0], out.lamps[0], way),
                   wanted = punctual_intensity(scene, scene.lights[0], way);
        EXPECT_LT(max_component(glm::abs(found - wanted)), 0.1f) << horizontal.back() << ", " << k;
      }
    }
  Scene scene = cluttered({profiled({0.3f, 2.4f, 0.8f}, false)});
  scene.profiles = {measured({0, 30, 90})};
  const LookedAt found = look_at(test::bake(std::move(scene), 0.15f, sharp_options()), 1, 0.01);
  EXPECT_GT(found.dark, 100);
  EXPECT_GT(found.lit, 1000);
  EXPECT_LE(found.wrong, 1) << "of " << found.points << ": rays may miss a facet that they see edge-on";
}

TEST(SharpLight, PenumbraeOfASunAreThoseOfItsDisk) {
  for (const auto& [radius, most] : {std::pair{0.0046f, 0.1}, {0.04f, 0.3}}) {
    const Baked b = test::bake(cluttered({sun_along({0.4f, -0.7f, -0.5f}, radius)}), 0.1f, sharp_options());
    const LookedAt found = look_at(b, 1024, 0.1);
    EXPECT_GT(found.points - found.lit - found.dark, 10) << radius;
    // Of a wide sun more of a ball's facets stand in the way than are listed: a square has one share.
    EXPECT_LE(found.wrong, found.points / 200) << radius << ": of " << found.points << ", worst " << found.worst;
    EXPECT_LT(found.worst, most) << radius;
  }
}

// Bars of 16 strips each, whose penumbrae are as wide as a bar.
TEST(SharpLight, PenumbraeOfMouldingsAreThoseOfTheirOutline) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.5f));
  parts.quad("floor", matt, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  for (int bar = 0; bar < 8; ++bar) {
    const auto corner = [&](int k) {
      const float turn = kPi / 8 * static_cast<float>(k), r = k % 2 ? 0.01f : 0.008f;
      return Vec3(-0.6f, 2 + r * std::cos(turn), 0.17f * static_cast<float>(bar) - 0.8f + r * std::sin(turn));
    };
    for (int k = 0; k < 16; ++k) parts.quad("moulding", matt, corner(k), {1.2f, 0, 0}, corner(k + 1) - corner(k));
  }
  parts.scene().lights = {sun_along({0.05f, -1, 0.1f}, 0.00465f)};
  const LookedAt found = look_at(test::bake(parts.finish(), 0.1f, sharp_options()), 1024, 0.05);
  EXPECT_GT(found.points - found.lit - found.dark, 20);
  EXPECT_EQ(found.wrong, 0) << "of " << found.points << ", worst " << found.worst;
}

TEST(SharpLight, TexelsHoldAsMuchAsWithoutIt) {
  const auto lights = [] {
    return std::vector{point_at({0.3f, 2.4f, 0.8f}), sun_along({0.4f, -0.7f, -0.5f}, 0.0046f)};
  };
  RadiosityOptions all_in_texels = sharp_options();
  all_in_texels.sharp = false;
  const Baked a = test::bake(cluttered(lights()), 0.1f, sharp_options());
  const Baked b = test::bake(cluttered(lights()), 0.1f, all_in_texels);
  double sum = 0, of_b = 0, off = 0;
  for (std::size_t p = 0; p < a.radiosity.pages.size(); ++p)
    for (std::size_t i = 0; i < a.radiosity.pages[p].irradiance.size(); ++i) {
      if (a.radiosity.pages[p].state[i] != TexelState::kValid) continue;
      const double lux = luminance(a.radiosity.pages[p].irradiance[i]),
                   other = luminance(b.radiosity.pages[p].irradiance[i]);
      sum += lux, of_b += other, off += std::abs(lux - other);
    }
  EXPECT_NEAR(sum / of_b, 1, 0.005);
  EXPECT_LT(off / of_b, 0.04);
  EXPECT_LT(2 * a.radiosity.report.detail.points, b.radiosity.report.detail.points);
}

// Clear glass before a floor tints all of its light.
TEST(SharpLight, PassesPanes) {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0.5f)), {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  SceneMaterial glass;
  glass.base_color = {0.9f, 0.5f, 0.2f}, glass.transmission = 1, glass.metallic = 0, glass.roughness = 0;
  glass.double_sided = true;
  parts.quad("pane", parts.add(glass), {-3, 1, 3}, {6, 0, 0}, {0, 0, -6});
  parts.quad("slat", parts.diffuse(Vec3(0.5f)), {-0.5f, 0.4f, 0.2f}, {1, 0, 0}, {0, 0, -0.3f});
  parts.scene().lights = {sun_along({0.2f, -1, 0.1f}, 0)};
  const Baked b = test::bake(parts.finish(), 0.1f, sharp_options());
  const LookedAt found = look_at(b, 1, 0.02);
  EXPECT_GT(found.points, 1000);
  EXPECT_EQ(found.wrong, 0) << "worst " << found.worst;
}

// A pane whose rim lies in its frame: the patch on the floor ends where the frame does.
TEST(SharpLight, OfAPaneEndsAtItsFrame) {
  for (const float radius : {0.0f, 0.00465f}) {
    SceneParts parts;
    const auto matt = parts.diffuse(Vec3(0.5f));
    parts.quad("floor", matt, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    SceneMaterial glass;
    glass.transmission = 1, glass.metallic = 0, glass.roughness = 0, glass.double_sided = true;
    parts.quad("pane", parts.add(glass), {-0.42f, 1, 0.32f}, {0.84f, 0, 0}, {0, 0, -0.64f});
    for (const float side : {-1.0f, 1.0f}) {
      parts.box("frame", matt, {0.425f * side - 0.025f, 0.98f, -0.35f}, {0.425f * side + 0.025f, 1.02f, 0.35f});
      parts.box("frame", matt, {-0.4f, 0.98f, 0.325f * side - 0.025f}, {0.4f, 1.02f, 0.325f * side + 0.025f});
    }
    parts.scene().lights = {sun_along({0.31f, -1, 0.17f}, radius)};
    const LookedAt found = look_at(test::bake(parts.finish(), 0.05f, sharp_options()), radius > 0 ? 1024 : 1, 0.05);
    EXPECT_GT(found.dark, 50);
    EXPECT_EQ(found.wrong, 0) << "of " << found.points << ", worst " << found.worst << ", radius " << radius;
  }
}

// Treads of a fraction of a texel, that end at the next riser: rays from beyond start behind it, where all is dark.
TEST(SharpLight, OfNarrowStepsIsThatOfTheirSurface) {
  SceneParts parts;
  const auto matt = parts.diffuse(Vec3(0.5f));
  for (int k = 0; k < 16; ++k) {
    const float z = -0.03125f * static_cast<float>(k), y = 0.125f * static_cast<float>(k);
    parts.quad("riser", matt, {-1, y, z}, {2, 0, 0}, {0, 0.125f, 0});
    parts.quad("tread", matt, {-1, y + 0.125f, z}, {2, 0, 0}, {0, 0, -0.03125f});
  }
  parts.scene().lights = {sun_along({0.1f, -1, -0.3f}, 0)};
  const LookedAt found = look_at(test::bake(parts.finish(), 0.2f, sharp_options()), 1, 0.01);
  EXPECT_GT(found.lit, 100);
  EXPECT_EQ(found.wrong, 0) << "of " << found.points << ", worst " << found.worst;
}

// A rack of bars over few texels, without and with panes, whose rims take a twelfth of the light.
TEST(SharpLight, OfARackIsThatOfItsBars) {
  for (const bool panes : {false, true}) {
    SceneParts parts;
    const auto matt = parts.diffuse(Vec3(0.5f));
    parts.quad("floor", matt, {-0.4f, 0, 0.4f}, {0.8f, 0, 0}, {0, 0, -0.8f});
    for (int k = 0; k < 24; ++k) {
      const float at = -0.4f + 0.8f * (static_cast<float>(k) + 0.3f) / 24;
      parts.box("bar", matt, {at, 0.1f, -0.4f}, {at + 0.01f, 0.11f, 0.4f});
      parts.box("bar", matt, {-0.4f, 0.12f, at}, {0.4f, 0.13f, at + 0.01f});
    }
    SceneMaterial glass;
    glass.transmission = 1, glass.metallic = 0, glass.roughness = 0, glass.double_sided = true;
    for (int k = 0; panes && k < 16; ++k)
      parts.quad("pane", parts.add(glass), {-0.4f + 0.05f * static_cast<float>(k), 0.3f, 0.4f}, {0.025f, 0, 0},
                 {0, 0, -0.8f});
    parts.scene().lights = {point_at({0.1f, 2, 0.2f})};
    const LookedAt found = look_at(test::bake(parts.finish(), 0.4f, sharp_options()), 1, panes ? 0.15 : 0.01);
    EXPECT_GT(found.dark, 15);
    EXPECT_EQ(found.wrong, 0) << "of " << found.points << ", worst " << found.worst << (panes ? ", panes" : "");
  }
}

// A lattice of holes of 5 cm, whose sun is as coarse as an eighth of a texel.
TEST(SharpLight, OfALatticeIsThatOfItsHoles) {
  SceneParts parts;
  parts.quad("floor", parts.diffuse(Vec3(0.5f)), {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
  Image checks{"checks", 40, 40, {}};
  for (std::uint32_t k = 0; k < 1600; ++k)
    for (const int value : {255, 255, 255, (k % 40 + k / 40) % 2 ? 255 : 0})
      checks.texels.push_back(static_cast<std::uint8_t>(value));
  SceneMaterial lattice;
  lattice.alpha_mode = AlphaMode::kMask, lattice.base_color_texture = {.image = 0, .nearest = true};
  lattice.double_sided = true;
  parts.quad("lattice", parts.add(lattice), {-1, 0.5f, 1}, {2, 0, 0}, {0, 0, -2});
  parts.scene().images.push_back(std::move(checks));
  parts.scene().lights = {sun_along({0.01f, -1, 0.02f}, 0)};
  const Baked b = test::bake(parts.finish(), 0.1f, sharp_options());
  const LookedAt found = look_at(b, 1, 0.5);
  EXPECT_GT(found.points, 300);
  EXPECT_NEAR(found.by_rays / found.points, 0.5, 0.06);
  EXPECT_NEAR(found.shown / found.by_rays, 1, 0.05);
  EXPECT_LT(found.wrong, found.points / 4) << "of holes of four eighths of a texel";
}

TEST(SharpLight, SurvivesLampsInAndOnThings) {
  std::vector<Light> lights{point_at({0, 0, 0}),           point_at({0, 1e-3f, 0}),
                            point_at({0, 1.5f, -3}),       point_at({0.4f, 0.9f, 0.3f}),
                            sun_along({1, 0, 0}, 0.004f),  sun_along({0, 0, -1}, 0.004f),
                            sun_along({0, -1, 0}, 0.049f), sun_along({0, -1, 0.2f}, 0.349f)};
  for (std::size_t k = 0; k < 200; ++k) lights.push_back(point_at({-2.9f + 0.029f * static_cast<float>(k), 2.5f, -2}));
  for (Light& light : lights) light.intensity *= 0.01f;
  const Baked b = test::bake(cluttered(lights), 0.3f, sharp_options());
  EXPECT_LT(b.radiosity.sharp_light.words.size(), 1'000'000u) << "a chart has its sixteen brightest";
  EXPECT_EQ(b.radiosity.sharp_light.lamps.size(), 207u) << "a sun of 20° has no edges";
  b.each_texel([&](const LightmapPage& page, std::uint32_t texel, std::uint32_t) {
    EXPECT_TRUE(oriel::is_finite(page.irradiance[texel]));
  });
}

}  // namespace
}  // namespace oriel
