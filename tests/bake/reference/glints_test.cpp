// Lamps and the sun in mirrors, as frames show them, against closed forms.
#include <gtest/gtest.h>

#include "bake/reference/glints.h"
#include "formats/query/camera.h"
#include "tests/bake/support/scene_parts.h"

namespace oriel {
namespace {

using test::SceneParts;

constexpr ReferenceOptions kFrame{.width = 160, .height = 90, .samples = 1};

SceneParts floor_mirror(float roughness = 0) {
  SceneParts parts;
  SceneMaterial m;
  m.base_color = Vec3(0.9f, 0.6f, 0.3f);
  m.metallic = 1, m.roughness = roughness;
  parts.quad("mirror", parts.add(m), {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  return parts;
}
Light point_at(const Vec3& position, float cd) {
  Light light;
  light.position = position;
  light.intensity = Vec3(cd);
  return light;
}
Camera eye_to(const Vec3& eye, const Vec3& target) {
  return look_at(eye, target, 1.0f);
}

struct Seen {
  DVec3 lux{0};  // Σ radiance · solid angle · 1
  Vec3 brightest{0};
  int pixels = 0;
};
// Of a frame's specular part: what arrives at the eye, by pixels_ray()'s own solid angles.
Seen see(const Scene& scene, const Camera& camera, const ReferenceOptions& options = kFrame) {
  Context context;
  const Accel accel = *Accel::build(scene);
  const LightSet lights(scene);
  const ReferenceFrame frame = *render_reference({accel, lights, {}}, camera, options, context);
  Seen seen;
  const auto w = static_cast<float>(options.width), h = static_cast<float>(options.height);
  for (int y = 0; y < options.height; ++y)
    for (int x = 0; x < options.width; ++x) {
      const std::size_t at =
          3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(options.width) + static_cast<std::size_t>(x));
      const Vec3 light(frame.specular.pixels[at], frame.specular.pixels[at + 1], frame.specular.pixels[at + 2]);
      if (max_component(light) <= 0) continue;
      const auto corner = [&](int i, int k) {
        return DVec3(pixel_ray(camera, static_cast<float>(x + i), static_cast<float>(y + k), w, h).direction);
      };
      const double area = glm::length(glm::cross(corner(1, 0) - corner(0, 0), corner(0, 1) - corner(0, 0)));
      seen.lux += area * DVec3(light);
      seen.brightest = glm::max(seen.brightest, light);
      ++seen.pixels;
    }
  return seen;
}
double schlick(double f0, double cosine) {
  return f0 + (1 - f0) * std::pow(1 - cosine, 5);
}

TEST(Glints, APointInAMirrorIsOnePixelOfAllItsLight) {
  SceneParts parts = floor_mirror();
  parts.scene().lights = {point_at({0.3f, 1.2f, -0.5f}, 100)};
  const Vec3 eye(-0.4f, 0.8f, 1);
  const Seen seen = see(parts.finish(), eye_to(eye, {0, 0, 0}));
  const DVec3 way = DVec3(0.3, -1.2, -0.5) - DVec3(eye);
  const double d2 = glm::dot(way, way), cosine = -way.y / std::sqrt(d2);
  EXPECT_EQ(seen.pixels, 1);
  for (int c = 0; c < 3; ++c) {
    const double expected = 100 / d2 * schlick(std::array{0.9, 0.6, 0.3}[static_cast<std::size_t>(c)], cosine);
    EXPECT_NEAR(seen.lux[c] / expected, 1, 0.01) << c;
  }
}

TEST(Glints, TheSunsDiskHasItsRadiance) {
  SceneParts parts = floor_mirror();
  Light sun;
  sun.type = LightType::kDirectional;
  sun.direction = glm::normalize(Vec3(0, -1, 1));
  sun.intensity = Vec3(1000), sun.angular_radius_rad = 0.1f;
  parts.scene().lights = {sun};
  const Seen seen = see(parts.finish(), eye_to({0, 1, 1}, {0, 0, 0}));
  const double reflected = schlick(0.9, std::sqrt(0.5));
  EXPECT_NEAR(seen.lux.r / (1000 * reflected), 1, 0.02);
  EXPECT_NEAR(seen.brightest.r / (1000 * reflected / (kPiD * std::pow(std::sin(0.1), 2))), 1, 0.1);
  const double pixels = kPiD * 0.01 / std::pow(2 * std::tan(0.5) / 90, 2);
  EXPECT_NEAR(seen.pixels / pixels, 1, 0.2);
}

// A lamp that paths meet, in place of the point.
TEST(Glints, ATinyLampSendsTheSame) {
  const Vec3 eye(0, 1, 1);
  SceneParts parts = floor_mirror(), lamp = floor_mirror();
  parts.scene().lights = {point_at({0, 1, -1}, 10)};
  // A square that faces the middle of the mirror: radiance · area = 10 cd along its normal.
  const Vec3 n = glm::normalize(Vec3(0, -1, 1)), u(0.02f, 0, 0), v = 0.02f * glm::cross(n, Vec3(1, 0, 0));
  lamp.quad("lamp", lamp.diffuse(Vec3(0), Vec3(10 / 4e-4f)), Vec3(0, 1, -1) - 0.5f * (u + v), u, v);
  ReferenceOptions many = kFrame;
  many.samples = 256;
  const Seen point = see(parts.finish(), eye_to(eye, {0, 0, 0})),
             square = see(lamp.finish(), eye_to(eye, {0, 0, 0}), many);
  EXPECT_GT(point.lux.g, 0.1);
  EXPECT_NEAR(square.lux.g / point.lux.g, 1, 0.05) << "of paths, 3 %";
}

TEST(Glints, ShadowsBacksAndRoughFloorsShowNone) {
  const Camera camera = eye_to({0, 1, 1}, {0, 0, 0});
  SceneParts parts = floor_mirror();
  parts.scene().lights = {point_at({0, 1, -1}, 10)};
  SceneParts blocked = parts;
  blocked.quad("shade", blocked.diffuse(Vec3(0)), {-0.1f, 0.4f, -0.5f}, {0.2f, 0, 0}, {0, 0.2f, 0});
  EXPECT_EQ(see(parts.finish(), camera).pixels, 1);
  EXPECT_EQ(see(blocked.finish(), camera).pixels, 0);
  SceneParts below = floor_mirror();
  below.scene().lights = {point_at({0, -1, -1}, 10)};
  EXPECT_EQ(see(below.finish(), camera).pixels, 0);
  SceneParts rough = floor_mirror(0.3f);
  rough.scene().lights = {point_at({0, 1, -1}, 10)};
  EXPECT_GT(see(rough.finish(), camera).pixels, 100) << "its lobe is paths', all pixels of it";
  Camera flat = camera;
  flat.vertical_fov_rad = 0, flat.half_height = 1;
  EXPECT_EQ(see(parts.finish(), flat).pixels, 0) << "parallel rays";
}

}  // namespace
}  // namespace oriel
