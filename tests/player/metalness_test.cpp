// Materials that are metal in places.
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {
using namespace testing;

// No metal in the first texel, all metal in the second.
Texture halves(std::uint32_t width, std::uint32_t height) {
  return {"halves", width, height, Wrap::kClamp, Wrap::kClamp, true, {255, 255, 255, 0, 255, 255, 255, 255}};
}

Camera facing(const Vec3& eye) {
  Camera camera;
  camera.eye = eye;
  return camera;
}

void expect_metal_light(const Vec3& found, const Vec3& expected, float off) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], off) << c;
}

class MetalPlaces : public FrameTest {};

// A plate that is gold on its right: no diffuse light there, and the light around it in gold's colour.
TEST_F(MetalPlaces, HaveNoDiffuseLight) {
  Pack pack;
  pack.materials.resize(1);
  pack.lightmaps = {flat_page(Vec3(kPi))};
  add_quad(pack, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 0, 0);
  const Vec3 gold(1, 0.75f, 0.25f);
  pack.materials[0].base_color = gold;
  pack.materials[0].metallic = 0.5f, pack.materials[0].f0 = 0.5f * gold, pack.materials[0].fresnel_map = 0;
  pack.fresnel_maps = {flat_reflectance(0.5f * gold)};
  pack.textures = {halves(2, 1)};
  pack.metalness = {{0, 0, Vec3(0)}};
  FrameOptions options;
  options.samples = 1;
  const Picture p = draw(pack, facing({0, 0, 2}), 8, 8, options);
  expect_metal_light(p.at(1, 4), gold, 1e-3f);
  expect_metal_light(p.at(6, 4), gold, 1e-3f);
  pack.metalness.clear();
  expect_metal_light(draw(pack, facing({0, 0, 2}), 8, 8, options).at(6, 4), 0.5f * gold + 0.25f * gold, 1e-3f);
}

// A mirror of which the upper half is no metal, and reflects nothing.
TEST_F(MetalPlaces, ReflectAlone) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].metallic = 0.5f, pack.materials[0].roughness = 0, pack.materials[0].fresnel_map = 0;
  pack.fresnel_maps = {flat_reflectance(Vec3(0.5f))};
  add_mirror(pack, {{0, 0, -1}}, 32, [](const Vec2&, const Vec3&) { return Seen{Vec3(10), 3}; });
  pack.materials[0].f0 = Vec3(0.5f);
  pack.textures = {halves(1, 2)};
  pack.metalness = {{0, 0, Vec3(0)}};
  const Picture p = draw(pack, facing({0, 0, 1}), 80, 60);
  expect_metal_light(p.at(20, 15), Vec3(0), 1e-3f);
  expect_metal_light(p.at(20, 45), Vec3(10), 1e-3f);
}

}  // namespace
}  // namespace oriel
