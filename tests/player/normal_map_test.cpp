// Normal maps and directional lightmaps in the player's frames, against the model of docs/notes/conventions.md.
#include "tests/player/frame_fixture.h"

namespace oriel {
namespace {
using namespace testing;

const Vec3 kFacing(0, 0, 1);

Texture one_texel(const std::array<std::uint8_t, 3>& rgb) {
  return {"n", 1, 1, Wrap::kRepeat, Wrap::kRepeat, false, {rgb[0], rgb[1], rgb[2], 255}};
}

// The normal that a texel stands for on a quad in the plane z = 0.
Vec3 normal_of(const std::array<std::uint8_t, 3>& rgb, float scale = 1) {
  const Vec3 n = 2.0f * Vec3(rgb[0], rgb[1], rgb[2]) / 255.0f - 1.0f;
  return glm::normalize(Vec3(scale * n.x, scale * n.y, n.z));
}

// A quad that fills the view, lit by E with direction d.
Pack mapped_quad(const Vec3& irradiance, const Vec3& d, const std::array<std::uint8_t, 3>& rgb, bool tangents) {
  Pack pack;
  pack.materials.resize(1);
  pack.materials[0].normal_texture = 0;
  pack.normal_textures.push_back(one_texel(rgb));
  pack.lightmaps.push_back(flat_page(irradiance));
  pack.lightmaps[0].direction.assign(16, d);
  add_quad(pack, {-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, 0, 0);
  pack.mesh.normal_uvs = pack.mesh.uvs;
  pack.mesh.tangents.assign(4, tangents ? Vec4(1, 0, 0, 1) : Vec4(0));
  return pack;
}

Camera camera_over(const Vec3& eye) {
  Camera camera;
  camera.eye = eye;
  camera.forward = -eye;
  return camera;
}

constexpr float kRounding = 1e-5f;  // of some 80 cd/m², in seven digits

void expect_relief(const Vec3& found, const Vec3& expected, float relative) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], relative * std::abs(expected[c]) + kRounding) << c;
}

class NormalMaps : public FrameTest {};

TEST_F(NormalMaps, DiffuseFollowsTheModel) {
  const std::array<std::uint8_t, 3> texels[] = {{200, 128, 220}, {128, 220, 200}, {60, 80, 210}};
  for (const bool tangents : {false, true})
    for (const auto& rgb : texels)
      for (const Vec3& d : {Vec3(0), Vec3(0, 0, 0.5f), Vec3(0.6f, 0, 0.8f), Vec3(-0.25f, 0.5f, 0.125f)})
        for (const float scale : {1.0f, -2.0f}) {
          Pack pack = mapped_quad(Vec3(256, 128, 64), d, rgb, tangents);
          pack.materials[0].normal_scale = scale;
          const float ratio = directional_ratio(d, normal_of(rgb, scale), kFacing);
          for (const Vec3& eye : {Vec3(0, 0, 2), Vec3(1.5f, -0.5f, 1)}) {
            const Vec3 found = draw(pack, camera_over(eye), 8, 8).at(4, 4);
            const Vec3 whole = Vec3(256, 128, 64) / kPi;
            EXPECT_LT(glm::length(found / whole - ratio), 1e-3f * (1 + ratio)) << ratio;  // d in halves
          }
        }
}

// (0.5, 0.5, 1), as near as 8 bits come to it (a tilt of 0.3 degrees), and lamps 45 degrees high all around: the
// picture stays within a code.
TEST_F(NormalMaps, FlatMapChangesNothing) {
  Pack pack = mapped_quad(Vec3(256, 128, 64), Vec3(0), {128, 128, 255}, false);
  for (std::size_t i = 0; i < 16; ++i) {
    const float angle = static_cast<float>(i);
    pack.lightmaps[0].direction[i] = normalize_or({std::sin(angle), std::cos(angle), 1}, kFacing);
  }
  Pack plain = pack;
  plain.materials[0].normal_texture = -1;
  const float ev = std::log2(256 / kPi / 1.2f);
  draw(pack, camera_over({0, 0, 2}), 32, 32);
  const auto mapped = renderer_->read_display(ev, ToneCurve::kNone);
  draw(plain, camera_over({0, 0, 2}), 32, 32);
  const auto flat = renderer_->read_display(ev, ToneCurve::kNone);
  ASSERT_TRUE(mapped && flat);
  for (std::size_t i = 0; i < flat->size(); ++i) EXPECT_NEAR((*mapped)[i], (*flat)[i], 1) << i;
}

TEST_F(NormalMaps, WithoutDirectionsOnlyReflectionsTilt) {
  Pack pack = mapped_quad(Vec3(256), Vec3(0), {218, 128, 218}, false);
  pack.lightmaps[0].direction.clear();
  expect_relief(draw(pack, camera_over({0, 0, 2}), 8, 8).at(4, 4), Vec3(256) / kPi, 1e-3f);
  FresnelMap map;
  for (int i = 0; i < 5; ++i) map.table.emplace_back(1 - static_cast<float>(i) / 4);
  pack.fresnel_maps.push_back(map);
  pack.materials[0].fresnel_map = 0;
  pack.materials[0].base_color = Vec3(0);
  for (const Vec3& eye : {Vec3(0, 0, 2), Vec3(1, 0, 1), Vec3(-2, 0, 0.5f)}) {
    const float cosine = std::max(0.0f, glm::dot(normal_of({218, 128, 218}), glm::normalize(eye)));
    expect_relief(draw(pack, camera_over(eye), 65, 65).at(32, 32), Vec3((1 - std::sqrt(cosine)) * 256 / kPi), 0.01f);
  }
}

TEST_F(NormalMaps, SeeThroughSurfacesToo) {
  Pack pack = mapped_quad(Vec3(256), Vec3(0.6f, 0, 0.8f), {200, 128, 220}, false);
  const Vec3 whole = draw(pack, camera_over({0, 0, 2}), 8, 8).at(4, 4);
  pack.materials[0].alpha_mode = AlphaMode::kBlend;
  pack.materials[0].alpha = 0.25f;
  expect_relief(draw(pack, camera_over({0, 0, 2}), 8, 8).at(4, 4), 0.25f * whole, 1e-3f);
}

TEST_F(NormalMaps, ExtremesStayFinite) {
  for (const float scale : {1e6f, -1e6f, 0.0f})
    for (const auto& rgb : {std::array<std::uint8_t, 3>{0, 0, 0}, {255, 255, 255}, {255, 0, 0}}) {
      Pack pack = mapped_quad(Vec3(256), Vec3(0, 0, -1), rgb, false);
      pack.materials[0].normal_scale = scale;
      pack.mesh.normals[0] = Vec3(0);
      EXPECT_TRUE(draw(pack, camera_over({0, 0, 2}), 8, 8).finite()) << scale;
    }
}

}  // namespace
}  // namespace oriel
